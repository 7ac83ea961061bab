"""Stacking: hinges of the base that share an axis and a place, as the drives of a wrist, lie above one another on it.

Where on its axis a hinge lies is free: it is drawn only.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from assur.scene.skeleton import JointMark, Rod, Skeleton

FloatArray = NDArray[np.float64]
STEP = 1.8
"""From one to the next, in thicknesses: round rods have room above one another."""

COINCIDENT = 1e-9
"""Places nearer to each other than this share of the mechanism's size are one."""


def stacked(skeleton: Skeleton, size: float) -> Skeleton:
    """The skeleton whose hinges on one axis have each a place of their own, for a thickness.

    Flat bars across the axis have layers instead.
    """
    tiny = COINCIDENT * skeleton.size
    moved: list[tuple[JointMark, FloatArray]] = []
    for mark in skeleton.marks:
        group = [other for other in skeleton.marks if _one_axis(mark, other, tiny) and _round(skeleton, other, tiny)]
        if mark in group and len(group) > 1:
            moved.append((mark, (group.index(mark) - (len(group) - 1) / 2) * STEP * size * group[0].axes[0]))
    if not moved:
        return skeleton

    def rod(whole: Rod) -> Rod:
        points = whole.points.copy()
        for mark, way in moved:
            points[_ends(whole, mark, tiny)] += way
        return replace(whole, points=points)

    shifts = {mark.joint.name: way for mark, way in moved}
    marks = tuple(
        replace(mark, at=mark.at + shifts[mark.joint.name], rail=mark.rail + shifts[mark.joint.name])
        if mark.joint.name in shifts
        else mark
        for mark in skeleton.marks
    )
    return replace(skeleton, rods=tuple(rod(item) for item in skeleton.rods), marks=marks)


def _one_axis(first: JointMark, second: JointMark, tiny: float) -> bool:
    """Whether two joints are hinges of the base in one place, on one axis."""
    for mark in (first, second):
        if not mark.grounded or mark.slides or mark.joint.type.turns != 1:
            return False
    parallel = np.linalg.norm(np.cross(first.axes[0], second.axes[0])) < COINCIDENT
    return bool(parallel) and float(np.linalg.norm(first.at - second.at)) < tiny


def _ends(rod: Rod, mark: JointMark, tiny: float) -> list[int]:
    """Which ends of a rod are at a joint of its link."""
    if rod.link not in (mark.joint.parent, mark.joint.child):
        return []
    return [k for k in range(2) if float(np.linalg.norm(rod.points[k] - mark.at)) < tiny]


def _round(skeleton: Skeleton, mark: JointMark, tiny: float) -> bool:
    """Whether a rod leaves a hinge otherwise than across its axis."""
    ways = [rod.points[1] - rod.points[0] for rod in skeleton.rods if _ends(rod, mark, tiny)]
    return any(abs(float(way @ mark.axes[0])) > COINCIDENT * skeleton.size for way in ways)
