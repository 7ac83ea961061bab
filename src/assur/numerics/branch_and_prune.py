"""All zeros of n equations in boxes: what holds none is thrown away, what holds one is kept, the rest is halved.

A box is thrown away where an equation cannot be zero in it, an inequality cannot hold, or its Krawczyk image misses it
(`assur.numerics.krawczyk`). What is left when boxes are too small or too many is handed back as undecided.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.numerics.intervals.interval import Interval, as_interval, common
from assur.numerics.intervals.shapes import concatenate, empty
from assur.numerics.krawczyk import image, inflated, parts, proves, refutes, tightened
from assur.numerics.number_types import Intervals
from assur.work import WorkStage, stage

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.intp]
Conditions = Callable[[Any, tuple[Any, ...], IntArray], tuple[Sequence[Any], Sequence[Any]]]
"""(namespace, n numbers (N,), labels (N,)) -> n numbers that are to be zero, others that must not be negative."""

FINE_ENOUGH = 0.25
"""Part of the scale below which a box is tested by its image: a wider one is only halved."""

FEW = 256
"""So many boxes at once take hardly longer than one: what is called costs more than its elements."""

MOST_CLUSTERED = 1000
"""Of more undecided boxes than these only one hull is given."""


class Existing(Intervals):
    """Intervals whose root is defined of what is not negative in its radicand: for places that a condition allows.

    Where a radicand is negative there is no solution, and a condition of its own says so; so nothing is lost.

    >>> bool(Existing().sqrt(Interval.of(-1.0, 4.0)).defined), bool(Existing().sqrt(Interval.of(-1.0, 4.0)).contains(2))
    (True, True)
    """

    def sqrt(self, radicand: Any, /) -> Interval:
        """Root of max(radicand, 0)."""
        number = as_interval(radicand)
        root = number.sqrt()
        return Interval(root.low, root.high, number.defined)


@dataclass(frozen=True, eq=False)
class Zeros:
    """What is known of the zeros in some boxes.

    Attributes:
        isolated: (K, n) narrow boxes that hold exactly one zero each, no two the same.
        labels: (K,) the label of each.
        undecided: (U, n) boxes in which nothing is proved, neighbours joined; every other zero would be in one of them.
        examined: how many boxes were looked at.
    """

    isolated: Interval
    labels: IntArray
    undecided: Interval
    examined: int


def zeros(
    conditions: Conditions,
    boxes: Interval,
    labels: IntArray,
    scale: ArrayLike,
    *,
    smallest: float = 1e-7,
    most: int = 200_000,
    total: int = 5_000_000,
) -> Zeros:
    """Every zero in boxes (N, n), each with a label that the conditions are told.

    Args:
        conditions: what is to hold.
        boxes: where to look.
        labels: (N,) such as a number of a choice of signs.
        scale: (n,) sizes of the unknowns, against which widths are judged.
        smallest: part of the scale below which a box is not halved any more.
        most: so many boxes at most are open at once, else all of them are undecided.
        total: so many are looked at, at most.

    Example: x^2 = 2, x y = 1, between -3 and 3.

    >>> answer = zeros(lambda ns, x, label: ([x[0] * x[0] - 2, x[0] * x[1] - 1], []),
    ...     Interval.of([[-3.0, -3.0]], [[3.0, 3.0]]), np.zeros(1, dtype=int), [1.0, 1.0])
    >>> sorted(answer.isolated.middle.round(6).tolist()), len(answer.undecided.low)
    ([[-1.414214, -0.707107], [1.414214, 0.707107]], 0)
    """
    with stage("boxes") as work:
        return _zeros(conditions, boxes, labels, scale, smallest, most, total, work)


def _zeros(
    conditions: Conditions,
    boxes: Interval,
    labels: IntArray,
    scale: ArrayLike,
    smallest: float,
    most: int,
    total: int,
    work: WorkStage,
) -> Zeros:
    size = np.broadcast_to(np.asarray(scale, dtype=float), boxes.shape[-1:])
    proved: list[tuple[Interval, Interval, IntArray]] = []
    left: list[tuple[Interval, IntArray]] = []
    examined = 0
    while len(boxes.low):
        work.at(examined, result=f"{len(boxes.low)} open, {sum(len(known[0].low) for known in proved)} proved so far")
        examined += len(boxes.low)
        if len(boxes.low) > most or examined > total:
            left.append((boxes, labels))
            break
        kept = ~excluded(conditions, boxes, labels)
        boxes, labels = boxes[kept], labels[kept]
        small = np.max(boxes.width / size, axis=-1) < FINE_ENOUGH
        tested, known, open_ = _tested(conditions, boxes[small], labels[small], size)
        proved.append(known)
        boxes, labels = _joined([(boxes[~small], labels[~small]), (tested, labels[small][open_])], boxes.shape[-1])
        done = np.max(boxes.width / size, axis=-1) < smallest
        left.append((boxes[done], labels[done]))
        boxes, labels = _halved(boxes[~done], labels[~done], size, smallest)
    isolated, of_isolated, doubtful = _distinct(conditions, proved, boxes.shape[-1])
    left.append(doubtful)
    rest = _clusters(_joined(left, boxes.shape[-1])[0], 4 * smallest * size)
    return Zeros(isolated, of_isolated, rest, examined)


def excluded(conditions: Conditions, boxes: Interval, labels: IntArray) -> NDArray[np.bool_]:
    """Where (N,) boxes (N, n) certainly hold no zero, because one equation or one inequality says so."""
    if not len(boxes.low):
        return np.zeros(0, dtype=bool)
    zero, positive = conditions(Existing(), parts(boxes), labels)
    none = np.zeros(len(boxes.low), dtype=bool)
    for value in zero:
        none |= as_interval(value).nonzero
    for value in positive:
        none |= as_interval(value).negative
    return none


def certain(conditions: Conditions, boxes: Interval, labels: IntArray) -> NDArray[np.bool_]:
    """Where (N,) every inequality certainly holds all over a box."""
    if not len(boxes.low):
        return np.zeros(0, dtype=bool)
    _, positive = conditions(Intervals(), parts(boxes), labels)
    sure = np.ones(len(boxes.low), dtype=bool)
    for value in positive:
        sure &= as_interval(value).positive
    return sure


def _tested(
    conditions: Conditions, boxes: Interval, labels: IntArray, size: FloatArray
) -> tuple[Interval, tuple[Interval, Interval, IntArray], NDArray[np.bool_]]:
    """Boxes that stay open, narrowed; those proved with what is unique in them; and which (N,) stay open."""
    if not len(boxes.low):
        return boxes, (boxes, boxes, labels), np.zeros(0, dtype=bool)
    wide = inflated(boxes, 1e-12 * size)
    picture = image(_equations(conditions, labels), wide)
    unique = proves(picture, wide)
    unique[unique] &= certain(conditions, picture[unique], labels[unique])
    open_ = ~unique & ~refutes(picture, boxes)
    narrow, apart = common(boxes, picture)
    usable = narrow.defined & ~apart
    low, high = np.where(usable, narrow.low, boxes.low), np.where(usable, narrow.high, boxes.high)
    return Interval(low, high, boxes.defined)[open_], (picture[unique], wide[unique], labels[unique]), open_


def _equations(conditions: Conditions, labels: IntArray) -> Callable[[Any, tuple[Any, ...]], Sequence[Any]]:
    return partial(_zero_part, conditions, labels)


def _zero_part(conditions: Conditions, labels: IntArray, ns: Any, x: tuple[Any, ...]) -> Sequence[Any]:
    return conditions(ns, x, labels)[0]


def _halved(boxes: Interval, labels: IntArray, size: FloatArray, smallest: float) -> tuple[Interval, IntArray]:
    """Both halves of each box, across its widest coordinate against the scale; halves of these while they are few."""
    shares = boxes.width / size
    while len(boxes.low):
        rows, widest = np.arange(len(boxes.low)), np.argmax(shares, axis=-1)
        cut = boxes.middle[rows, widest]
        below, above = boxes.high.copy(), boxes.low.copy()
        below[rows, widest], above[rows, widest] = cut, cut
        low, high = np.concatenate([boxes.low, above]), np.concatenate([below, boxes.high])
        boxes = Interval(low, high, np.concatenate([boxes.defined, boxes.defined]))
        labels = np.concatenate([labels, labels])
        shares = boxes.width / size
        if len(boxes.low) > FEW or np.min(np.max(shares, axis=-1)) < smallest:
            break
    return boxes, labels


def _joined(pieces: Sequence[tuple[Interval, IntArray]], width: int) -> tuple[Interval, IntArray]:
    """All boxes and labels of some pieces, one after the other."""
    boxes = [box for box, _ in pieces if len(box.low)]
    if not boxes:
        return empty(width), np.zeros(0, dtype=np.intp)
    return concatenate(boxes), np.concatenate([label for box, label in pieces if len(box.low)])


def _distinct(
    conditions: Conditions, proved: Sequence[tuple[Interval, Interval, IntArray]], width: int
) -> tuple[Interval, IntArray, tuple[Interval, IntArray]]:
    """Each zero once, and what may be one zero or two.

    Two proofs are of one zero where the narrow box of one lies where the other's is the only one, and of two where the
    narrow boxes have nothing in common.
    """
    images, labels = _joined([(box, label) for box, _, label in proved], width)
    unique, _ = _joined([(box, label) for _, box, label in proved], width)
    if not len(images.low):
        return images, labels, (images, labels)
    narrow = tightened(_equations(conditions, labels), images)
    kept: list[int] = []
    doubtful: list[int] = []
    for k in range(len(narrow.low)):
        rivals = [j for j in kept if labels[j] == labels[k] and not np.any(common(narrow[j], narrow[k])[1])]
        if not rivals:
            kept.append(k)
        elif not any(_within(narrow[k], unique[j]) or _within(narrow[j], unique[k]) for j in rivals):
            doubtful.append(k)
    return narrow[kept], labels[kept], (narrow[doubtful], labels[doubtful])


def _within(inner: Interval, outer: Interval) -> bool:
    return bool(np.all(inner.within(outer)))


def _clusters(boxes: Interval, near: FloatArray) -> Interval:
    """Hulls of boxes that lie together."""
    if len(boxes.low) > MOST_CLUSTERED:
        return Interval.of(np.min(boxes.low, axis=0)[None], np.max(boxes.high, axis=0)[None])
    groups: list[tuple[FloatArray, FloatArray]] = []
    for low, high in zip(boxes.low, boxes.high, strict=True):
        touching = [g for g in groups if np.all(g[0] <= high + near) and np.all(low <= g[1] + near)]
        groups = [g for g in groups if not any(g is other for other in touching)]
        low = np.min([low, *(g[0] for g in touching)], axis=0)
        high = np.max([high, *(g[1] for g in touching)], axis=0)
        groups.append((low, high))
    return Interval.of(np.array([g[0] for g in groups]), np.array([g[1] for g in groups])) if groups else boxes
