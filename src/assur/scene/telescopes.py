"""Telescopes: the tube and the rod of a leg that grows longer, which stay in one another over its whole stroke."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.scene.shapes import Cylinder
from assur.scene.skeleton import JointMark, Skeleton
from assur.scene.strokes import strokes

FloatArray = NDArray[np.float64]
TUBE, LONG, ROD = 0.62, 0.75, 0.9
"""Lengths of a tube, of one whose leg grows longer by a known stroke, and of a rod, at most, as shares of the leg's."""

SHORT, SHAFT = 3.0, 8.0
"""A leg that is shorter than this has a shaft through its collar, of this half length, in thicknesses."""

COLLAR, HELD = 3.4, 2.0
"""How far a tube ends before the joint at the rod's end, and what of the rod stays in it, in thicknesses."""


def telescope(skeleton: Skeleton, mark: JointMark, size: float) -> tuple[Cylinder, Cylinder]:
    """Tube and rod of a leg, in the base frame where they are made, for a thickness.

    At the shortest leg the tube ends before the joint at the rod's end, and at the longest the rod is still held in
    the tube, as far as it has room where it is made.
    """
    way, axis = mark.at - mark.rail, mark.axes[0]
    length = float(np.linalg.norm(way))
    if length < SHORT * size:
        tube = Cylinder(mark.rail, mark.rail + TUBE * way, 0.8 * size)
        return tube, Cylinder(mark.at - SHAFT * size * axis, mark.at + SHAFT * size * axis, 0.5 * size)
    shortest, longest = _lengths(skeleton, mark, way)
    tubed = min((LONG if longest > length else TUBE) * length, max(shortest - COLLAR * size, 0.5 * shortest))
    rodded = min(max(ROD * min(length, shortest), longest - tubed + HELD * size), ROD * length)
    along = way / length
    tube = Cylinder(mark.rail, mark.rail + tubed * along, 0.8 * size)
    return tube, Cylinder(mark.at - rodded * along, mark.at, 0.5 * size)


def _lengths(skeleton: Skeleton, mark: JointMark, way: FloatArray) -> tuple[float, float]:
    """The shortest and the longest leg of the stroke; as it stands twice where none is known."""
    record = skeleton.record
    index = next(item.index for item in record.coordinates if item.joint == mark.joint.name and item.kind == "length")
    now = float(skeleton.values[index])
    ends = strokes(record).get(mark.joint.name, (now, now))
    found = [float(np.linalg.norm(way + (end - now) * mark.axes[0])) for end in (now, *ends)]
    return min(found), max(found)
