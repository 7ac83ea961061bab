"""Turning: an angle that is looked at over a whole turn has no ends, so boxes meet across them.

In floats no box is a whole turn long. One that means it is made longer by a rounding, so that its ends certainly meet:
what lies there is looked at twice.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from assur.model.pose import is_angle
from assur.numerics.intervals.functions import TURN
from assur.numerics.intervals.interval import Interval
from assur.workspace.certified.boxes import Boxes
from assur.workspace.certified.planes import BoxQuestion
from assur.workspace.domain import Box

FloatArray = NDArray[np.float64]
Ends = Sequence[tuple[float, float] | None]
"""Per coordinate of boxes the ends of a turn, which are one place; None where it has ends."""

NEARLY = 2e-15
"""Share of the larger end, some roundings: a box that is a whole turn long but for so much means the whole turn."""


def turned(box: Box, names: Sequence[str]) -> Box:
    """The box whose turning coordinates, of those named, are certainly a whole turn long.

    >>> found = turned(Box(("x", "phi"), (-1.0, -np.pi), (1.0, np.pi)), ["phi"])
    >>> found.high[1] > np.pi, found.high[1] - np.pi < 1e-14, found.high[0]
    (True, True, 1.0)
    """
    high = [
        _around(low) if name in names and is_angle(name) and _meant(low, high) else high
        for name, low, high in zip(box.names, box.low, box.high, strict=True)
    ]
    return replace(box, high=tuple(high))


def ends_of(frame: BoxQuestion) -> Ends:
    """Which coordinates of a frame's boxes turn, and where the ends of their turn are."""
    box = frame.box
    return tuple(
        (low, high) if is_angle(name) and high == _around(low) else None
        for name, has, low, high in zip(box.names, frame.used, box.low, box.high, strict=True)
        if has
    )


def once(boxes: Boxes, ends: Ends) -> Boxes:
    """The boxes without what certainly is beyond a whole turn, so that no pose is in two of them."""
    high = boxes.high.copy()
    for axis, pair in enumerate(ends):
        if pair is not None:
            high[axis] = np.minimum(high[axis], (Interval.of(pair[0]) + TURN).low)
    return Boxes(boxes.low, high)


def turns(boxes: Boxes, ends: Ends) -> NDArray[np.int64]:
    """Whole turns (k, N) by which boxes, each of which meets the next, go on beyond an end.

    >>> boxes = Boxes(np.array([[0.0, 5.0, 0.0, 1.0]]), np.array([[1.0, 6.0, 1.0, 5.0]]))
    >>> turns(boxes, [(0.0, 6.0)]).tolist(), turns(boxes, [None]).tolist()
    ([[0, -1, 0, 0]], [[0, 0, 0, 0]])
    """
    found = np.zeros(boxes.low.shape, dtype=np.int64)
    for axis, pair in enumerate(ends):
        if pair is None:
            continue
        low, high = boxes.low[axis], boxes.high[axis]
        apart = (low[1:] > high[:-1]) | (high[1:] < low[:-1])  # otherwise they meet without it
        onward = apart & (high[:-1] == pair[1]) & (low[1:] == pair[0])
        back = apart & (low[:-1] == pair[0]) & (high[1:] == pair[1])
        found[axis, 1:] = np.cumsum(onward.astype(int) - back.astype(int))
    return found


def moved(values: FloatArray, count: NDArray[np.int64], ends: Ends) -> FloatArray:
    """Values (k, N) after so many turns (k, N), rounded; the end of one turn is the beginning of the next.

    >>> moved(np.array([[0.0, 6.0, 1.0]]), np.array([[1, 0, 2]]), [(0.0, 6.0)]).tolist()
    [[6.0, 6.0, 13.0]]
    """
    found = values.copy()
    for axis, pair in enumerate(ends):
        if pair is None:
            continue
        low, high = pair
        ahead, behind = (count[axis] > 0) & (values[axis] == low), (count[axis] < 0) & (values[axis] == high)
        start = np.where(ahead, high, np.where(behind, low, values[axis]))
        found[axis] = start + (count[axis] - ahead + behind) * (high - low)
    return found


def _meant(low: float, high: float) -> bool:
    """Whether the interval is a whole turn long but for roundings of its ends."""
    return abs(high - _around(low)) < NEARLY * max(abs(low), abs(high))


def _around(low: float) -> float:
    """At least a whole turn further."""
    return float((Interval.of(low) + TURN).high)
