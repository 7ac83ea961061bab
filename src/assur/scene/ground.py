"""The ground: what the base is drawn as: a plate with stands under what stands on it, rails, and forks."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from assur.numerics.segments import segment_distances
from assur.scene.companion import Companion
from assur.scene.joining import stand
from assur.scene.part import DARK, PLATE, STEEL, Part
from assur.scene.rails import rails
from assur.scene.shapes import Cuboid
from assur.scene.skeleton import JointMark, Skeleton
from assur.scene.yokes import Yoke

FloatArray = NDArray[np.float64]
SUNK, OVER = 4.2, 2.0
"""How far a rail lies below a slider that has a joint nearer than this to its own point, in thicknesses."""

WAYS = 12
"""Directions in which room for such a rail is looked for."""

THICKEST = 1.6
"""What is drawn about points that a plate must not hide reaches so far, in thicknesses."""

UPRIGHT = 0.9
"""An axis whose cosine to Z is above it is upright: its joint stands on a pillar."""


def ground(
    skeleton: Skeleton, companion: Companion, forks: Sequence[Yoke], size: float, reach: Callable[[JointMark], float]
) -> Iterator[Part]:
    """The parts of the base in its own frame; without a plate, where one would hide what is below it, forks alone.

    Args:
        skeleton: the mechanism as it is drawn.
        companion: says how long the rails are.
        forks: the yokes of all universal joints.
        size: the thickness.
        reach: half the length of a joint's pin, in thicknesses.
    """
    base = skeleton.record.base
    ends, lowest = rails(skeleton, companion), 1.6
    feet = [mark.at for mark in skeleton.marks if mark.grounded and not mark.slides]
    deep = depth(skeleton, size)
    for k, (start, end) in enumerate(ends, 1):
        slider = next(mark for mark in skeleton.marks if _runs_on(mark, start, end))
        side, up = bed(skeleton, slider, deep)
        sides = np.array([(end - start) / 2, 0.8 * size * side, 0.95 * size * up])
        yield Part(f"rail {k}", base, Cuboid((start + end) / 2 - (0.65 * size + deep) * up, sides), STEEL, "rail")
        lowest = max(lowest, float(1.6 + deep / size * up[2]))
        feet += [start, end]
    drop = _drop(skeleton, np.array(feet), lowest if ends else None, size) if feet else None
    if drop is None:
        for yoke in forks:
            if yoke.link == base:
                for role, shape in yoke.shapes(size):
                    yield Part(f"{yoke.joint} {role}", base, shape, DARK, role, yoke.joint)
        return
    low, high = np.min(feet, axis=0) - 3.2 * size, np.max(feet, axis=0) + 3.2 * size
    high[2] = (np.min(feet, axis=0)[2] if drop > 0 else np.max(feet, axis=0)[2]) - drop * size
    low[2] = high[2] - 1.3 * size
    yield Part("base plate", base, Cuboid((low + high) / 2, np.diag((high - low) / 2)), PLATE, "plate")
    for mark in skeleton.marks:
        if mark.grounded and not mark.slides and not upright(mark):
            height = (low[2] + 1.15 * size if drop > 0 else high[2] - 1.15 * size) - mark.at[2]
            for shape in stand(mark, np.array([0.0, 0.0, height]), (reach(mark) - 0.4) * size, size):
                yield Part(f"{mark.joint.name} stand", base, shape, DARK, "stand", mark.joint.name)


def _drop(skeleton: Skeleton, feet: FloatArray, lowest: float | None, size: float) -> float | None:
    """How far the plate lies below the feet (k, 3), in thicknesses, negative where they hang; None without a plate.

    `lowest` is how far rails reach below their sliders, in thicknesses; None where there are none.
    """
    drop = 4.0 if lowest is None else lowest
    others = [rod.points for rod in skeleton.rods if not _on_base(skeleton, rod.link)]
    others += [plate.points for plate in skeleton.plates if not _on_base(skeleton, plate.link)]
    low = min((float(np.min(points[:, 2])) for points in others), default=np.inf) - THICKEST * size
    if min(low, np.min(skeleton.cloud[:, 2])) >= np.min(feet[:, 2]) - drop * size:
        return drop
    hangs = np.max(skeleton.cloud[:, 2]) <= np.max(feet[:, 2]) + size
    return None if lowest is not None or not hangs or np.ptp(feet[:, 2]) > size else -drop - 1.3


def _on_base(skeleton: Skeleton, link: str) -> bool:
    """Whether a link shares a joint with the base."""
    return any({joint.parent, joint.child} == {link, skeleton.record.base} for joint in skeleton.record.joints.values())


def depth(skeleton: Skeleton, size: float) -> float:
    """How far all rails lie below their sliders: as much as what is hinged to a slider right over its rail needs."""
    return SUNK * size if any(held(skeleton, mark, size) for mark in skeleton.marks) else 0.0


def held(skeleton: Skeleton, slider: JointMark, size: float) -> list[JointMark]:
    """Joints of what slides on the base that lie right over its rail, where a thickness is given."""
    if not _railed(slider):
        return []
    link = slider.joint.child if slider.joint.parent == skeleton.record.base else slider.joint.parent
    of_link = [mark for mark in skeleton.marks if link in (mark.joint.parent, mark.joint.child) and mark is not slider]
    return [mark for mark in of_link if np.linalg.norm(mark.at - slider.at) < OVER * size]


def _railed(mark: JointMark) -> bool:
    return mark.slides and mark.grounded


def _runs_on(mark: JointMark, start: FloatArray, end: FloatArray) -> bool:
    """Whether a slider is one of a rail between two points (3,)."""
    way = (end - start) / np.linalg.norm(end - start)
    middle = np.allclose(mark.rail, (start + end) / 2, atol=1e-6 * float(np.linalg.norm(end - start)))
    return _railed(mark) and middle and abs(float(mark.axes[0] @ way)) > 1.0 - 1e-9


def bed(skeleton: Skeleton, slider: JointMark, deep: float) -> tuple[FloatArray, FloatArray]:
    """Unit vectors across a rail, the second from it to its slider: upwards; of a deep one where most room is left."""
    axis = slider.axes[0]
    side, up = across(axis)
    if not deep:
        return side, up
    half = 0.5 * skeleton.size * axis
    moving = np.array([rod.points for rod in skeleton.rods if rod.link != skeleton.record.base]).reshape(-1, 2, 3)

    def room(way: FloatArray) -> float:
        middle = slider.rail - deep * way
        gaps = segment_distances(middle - half, middle + half, moving[:, 0], moving[:, 1])
        return float(np.min(gaps, initial=np.inf))

    turns = 2 * np.pi * np.arange(WAYS) / WAYS
    ways = np.cos(turns)[:, None] * up + np.sin(turns)[:, None] * side
    rooms = np.array([room(way) for way in ways])
    way = ways[np.argmax(rooms > (1.0 - 1e-6) * rooms.max())]
    return np.cross(way, axis), way


def upright(mark: JointMark) -> bool:
    """Whether the first axis of a joint is upright."""
    return bool(len(mark.axes)) and abs(float(mark.axes[0][2])) > UPRIGHT


def across(axis: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Unit vectors across an axis, the second as far upwards as can be."""
    up = np.array([0.0, 0.0, 1.0]) if abs(axis[2]) < UPRIGHT else np.array([1.0, 0.0, 0.0])
    up = up - (up @ axis) * axis
    up = up / np.linalg.norm(up)
    return np.cross(up, axis), up
