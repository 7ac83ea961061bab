"""Rails on the base: where sliders run, as long as they and their strokes need."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.home import home_values
from assur.scene.companion import Companion
from assur.scene.companion import length as formula_value
from assur.scene.sizes import thickness
from assur.scene.skeleton import JointMark, Skeleton
from assur.scene.strokes import strokes

FloatArray = NDArray[np.float64]
HALF, BEYOND = 0.24, 0.06
"""Half the length of a rail without strokes, and how far it goes beyond one, as shares of the mechanism's size."""

CARRIAGE, ROOM, TRIES = 4.0, 4.0, 20
"""A rail is so long on either side of its slider at least, and keeps so far from what is hinged elsewhere, in
thicknesses; how many lengths are tried."""


@dataclass(frozen=True, eq=False)
class Rail:
    """What sliders run on: its ends (3,) in the base frame, and those sliders."""

    start: FloatArray
    end: FloatArray
    sliders: tuple[JointMark, ...]

    @property
    def ends(self) -> FloatArray:
        """Both ends (2, 3)."""
        return np.array([self.start, self.end])


def rails(skeleton: Skeleton, companion: Companion) -> list[Rail]:
    """The rails on the base; sliders whose ways overlap share one."""
    home = home_values(skeleton.record)
    found: list[Rail] = []
    for mark in skeleton.marks:
        if mark.grounded and mark.slides:
            low, high = _way(skeleton, companion, mark, home)
            new = Rail(mark.rail + low * mark.axes[0], mark.rail + high * mark.axes[0], (mark,))
            shared = next((rail for rail in found if _overlap(rail, new, skeleton.size)), None)
            if shared:
                found.remove(shared)
                new = _joined(shared, new)
            found.append(new)
    return found


def _way(skeleton: Skeleton, companion: Companion, mark: JointMark, home: FloatArray) -> tuple[float, float]:
    """From where to where a slider's rail goes, from the joint's point on the base along its axis.

    The companion's length lies about that point, or about the slider at home where it would not reach it.
    """
    record = skeleton.record
    index = next(item.index for item in record.coordinates if item.joint == mark.joint.name and item.kind == "length")
    stands = (float((mark.at - mark.rail) @ mark.axes[0]), float(home[index]))
    if companion.rail:
        half = formula_value(record, companion.rail)
        middle = stands[1] if abs(stands[1]) > half else 0.0
        low, high = middle - half, middle + half
    elif mark.joint.name in strokes(record):
        low, high = strokes(record)[mark.joint.name]
        low, high = low - BEYOND * skeleton.size, high + BEYOND * skeleton.size
    else:
        low, high = (stands[1] + sense * _free(skeleton, mark, sense * mark.axes[0]) for sense in (-1.0, 1.0))
    return min(low, *stands), max(high, *stands)


def _free(skeleton: Skeleton, mark: JointMark, way: FloatArray) -> float:
    """How far a rail without a stroke goes one way (3,) from its slider: to `HALF`, or to what is in its way."""
    pairs = [{joint.parent, joint.child} for joint in skeleton.record.joints.values()]
    own = set().union(*(pair for pair in pairs if mark.joint.child in pair))
    size = thickness(skeleton.record)
    lengths = np.linspace(HALF * skeleton.size, CARRIAGE * size, TRIES)
    return next(
        (float(length) for length in lengths if skeleton.room(mark.at, mark.at + length * way, own) > ROOM * size),
        float(lengths[-1]),
    )


def _overlap(first: Rail, second: Rail, size: float) -> bool:
    """Whether two rails lie on one line and have a part of it in common, or almost."""
    way = (first.end - first.start) / np.linalg.norm(first.end - first.start)
    apart = second.ends - first.start
    across = apart - np.outer(apart @ way, way)
    if np.max(np.abs(across)) > 1e-6 * size:
        return False
    low, high = np.sort(apart @ way)
    return bool(low < np.linalg.norm(first.end - first.start) + BEYOND * size and high > -BEYOND * size)


def _joined(first: Rail, second: Rail) -> Rail:
    """One rail in place of two on a line."""
    points = np.concatenate([first.ends, second.ends])
    along = points @ (first.end - first.start)
    sliders = (*first.sliders, *second.sliders)
    return replace(first, start=points[np.argmin(along)], end=points[np.argmax(along)], sliders=sliders)
