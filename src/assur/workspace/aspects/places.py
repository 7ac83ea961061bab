"""Places: in which box a pose lies, or how it is joined to one by a straight line of proved poses."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.numerics.intervals.interval import Interval
from assur.workspace.aspects.search import BoxSearch
from assur.workspace.bounds import not_reached
from assur.workspace.certified.boxes import Boxes
from assur.workspace.certified.planes import judged
from assur.workspace.domain import Box

FloatArray = NDArray[np.float64]

NEAREST = 16
"""Certain boxes to which a pose in an undecided one is joined, if it can be, nearest first."""

HALVINGS = 12
"""Times that a piece of a straight line is halved before it counts as not proved."""

PADDING = 1e-12
"""Boxes about pieces of a line are wider by this share of the search box, so that none is flat."""

Where = Literal["inside", "outside", "beyond", "undecided"]


@dataclass(frozen=True, eq=False)
class Place:
    """Where a pose is.

    Attributes:
        status: "inside" an aspect; "outside": certainly not reached; "beyond" the box that was looked at; "undecided".
        aspect: label of the aspect; "" where it is not inside one.
        signs: of the factors at the pose, those that are certain.
        why: in words, where it is not inside.
        points: (n, k) from the pose straight to a point of a certain box, over the coordinates that the boxes have.
        boxes: the n - 1 boxes in which its pieces lie.
        box: number of that certain box; -1 where there is none.
    """

    status: Where
    aspect: str
    signs: Mapping[str, int]
    why: str
    points: FloatArray = field(repr=False)
    boxes: Boxes = field(repr=False)
    box: int = field(default=-1, repr=False)


def point_of(box: Box, pose: Mapping[str, float] | Sequence[float] | FloatArray) -> FloatArray:
    """The point (free,) that a user means: values in the order of the free coordinates, or by name.

    >>> point_of(Box(("x", "z"), (0.0, 0.0), (1.0, 1.0)), {"z": 0.5, "x": 0.25}).tolist()
    [0.25, 0.5]
    """
    if isinstance(pose, Mapping):
        if set(pose) != set(box.names):
            raise UsageError(f"pose: {', '.join(pose) or 'nothing'} given; {', '.join(box.names)} wanted")
        pose = [pose[name] for name in box.names]
    point = np.asarray(pose, dtype=float)
    if point.shape != (len(box.names),):
        raise UsageError(f"pose: values of shape {point.shape} for {', '.join(box.names)}")
    if not np.all(np.isfinite(point)):
        raise UsageError("pose: a value is not finite")
    return point


def place(state: BoxSearch, labels: Sequence[str], point: FloatArray) -> Place:
    """Where a point (free,) is; labels are those of the components.

    A pose in an undecided box is inside an aspect if a straight line to one of its boxes is proved piece by piece.
    """
    frame = state.frame
    box, criteria = frame.box, frame.criteria
    at = point[list(frame.used)]
    here, nothing = at[None, :], state.certain[:0]
    for name, value, low, high in zip(box.names, point, box.low, box.high, strict=True):
        if not low <= value <= high:
            why = f"{name} = {value:g} is beyond the box, {low:g} to {high:g}"
            return Place("beyond", "", {}, why, here, nothing)
    found = criteria.over([Interval.of([value]) for value in point])
    signs = {name: 1 if found[name].positive[0] else -1 for name in criteria.names if found[name].nonzero[0]}
    negative = [name for name in criteria.margins if found[name].high[0] < 0]
    if negative:
        return Place("outside", "", {}, not_reached(", ".join(negative)), here, nothing)
    for k in holding(state.certain, at)[:1]:
        return Place("inside", labels[state.links.component[k]], signs, "", here, nothing, int(k))
    unclear = [name for name in criteria.names if name not in signs]
    if unclear:
        return Place("undecided", "", signs, f"{', '.join(unclear)} may be zero here", here, nothing)
    wanted = np.array([signs[name] for name in criteria.names])
    targets = np.flatnonzero(np.all(state.signs == wanted, axis=1))
    boxes = state.certain[targets]
    ends = np.clip(at[:, None], boxes.low, boxes.high)
    extent = np.subtract(box.high, box.low)[list(frame.used)]
    order = np.argsort(np.sum(((ends - at[:, None]) / extent[:, None]) ** 2, axis=0), kind="stable")
    for k in order[:NEAREST]:
        line = straight(state, at, ends[:, k])
        if line is not None:
            label = labels[state.links.component[targets[k]]]
            return Place("inside", label, signs, "", line[0], line[1], int(targets[k]))
    return Place("undecided", "", signs, "undecided here: near the border or a singularity", here, nothing)


def holding(boxes: Boxes, point: FloatArray) -> NDArray[np.int64]:
    """Numbers of the closed boxes that hold a point (k,).

    >>> holding(Boxes(np.array([[0.0, 1.0]]), np.array([[1.0, 2.0]])), np.array([1.0])).tolist()
    [0, 1]
    """
    column = point[:, None]
    return np.flatnonzero(np.all((boxes.low <= column) & (column <= boxes.high), axis=0))


def straight(state: BoxSearch, start: FloatArray, end: FloatArray) -> tuple[FloatArray, Boxes] | None:
    """Points (n, k) on the straight line between two, and the n - 1 proved boxes about its pieces; None if not proved.

    Points are rounded; each piece runs straight between two of them.
    """
    frame = state.frame
    pad = PADDING * np.subtract(frame.box.high, frame.box.low)[list(frame.used)]
    shares = np.array([0.0, 1.0])
    for _ in range(HALVINGS):
        points = start + shares[:, None] * (end - start)
        points[-1] = end
        low, high = np.minimum(points[:-1], points[1:]) - pad, np.maximum(points[:-1], points[1:]) + pad
        boxes = Boxes(low.T.copy(), high.T.copy())
        known = judged(frame, boxes, shares=False)
        if known.outside.any():
            return None
        if known.inside.all():
            return points, boxes
        halves = 0.5 * (shares[:-1] + shares[1:])[~known.inside]
        shares = np.sort(np.concatenate([shares, halves]))
    return None
