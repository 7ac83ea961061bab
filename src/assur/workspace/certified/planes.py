"""Judging boxes: certainly inside, certainly outside, or how much of a box is inside at least and at most.

A box is inside where every margin is certainly not negative all over it, outside where one certainly is. In the others
each margin m is bounded by two planes: with slopes enclosed in g -+ d, m(x) lies within d . |x - c| of
m(c) + g . (x - c). What lies above the lower planes of all margins is inside, what lies below an upper one is outside;
so what a box leaves open falls with the square of its size. No margin need be differentiable for it (see `sloped`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.numerics.intervals import rounding
from assur.numerics.intervals.interval import Interval, as_interval
from assur.numerics.intervals.shapes import broadcast
from assur.numerics.intervals.sloped import Sloped, ranged
from assur.workspace.certified import cuts
from assur.workspace.certified.boxes import LEAST, Boxes
from assur.workspace.certified.criteria import Criteria
from assur.workspace.domain import Box

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]

BLOCK = 2048
"""Boxes that are worked on at a time: their intermediate results stay in a processor's cache."""

CORNER = 0.1
"""How much the change of a margin counts beside its curvature, for the choice of the coordinate that is cut next.

Where only what is certain counts, and no part of a box, it is 1: cuts go across the direction in which it changes.
"""


@dataclass(frozen=True, eq=False)
class BoxQuestion:
    """The question that boxes are judged by: criteria over a box of which only some coordinates are cut.

    Attributes:
        criteria: what a pose must satisfy.
        box: over the free coordinates of the criteria.
        used: per free coordinate whether boxes have it; the others have the extent of `box`.
    """

    criteria: Criteria
    box: Box
    used: tuple[bool, ...]

    def whole(self, intervals: Sequence[Interval]) -> list[Interval]:
        """One interval per free coordinate, from those that are used."""
        rest, box = iter(intervals), self.box
        return [
            next(rest) if has else Interval.of(low, high)
            for has, low, high in zip(self.used, box.low, box.high, strict=True)
        ]

    def middles(self, middles: FloatArray) -> list[FloatArray | None]:
        """One middle (N,) per free coordinate, None for those that are not used."""
        rest = iter(middles)
        return [next(rest) if has else None for has in self.used]


@dataclass(frozen=True, eq=False)
class JudgedBoxes:
    """What is known of N boxes.

    Attributes:
        inside, outside: (N,) certain for every pose of the box.
        least, most: (N,) bounds of the volume of the part of the box that is inside.
        axis: (N,) the coordinate across which to cut the box, if it is cut.
    """

    inside: BoolArray
    outside: BoolArray
    least: FloatArray
    most: FloatArray
    axis: NDArray[np.int64]

    def __getitem__(self, index: NDArray[np.bool_]) -> JudgedBoxes:
        return JudgedBoxes(
            self.inside[index], self.outside[index], self.least[index], self.most[index], self.axis[index]
        )


def judged(frame: BoxQuestion, boxes: Boxes, shares: bool = True) -> JudgedBoxes:
    """Judge boxes, block by block; without `shares` nothing is said of parts of boxes."""
    parts = [_block(frame, boxes[k : k + BLOCK], shares) for k in range(0, len(boxes), BLOCK)]
    return joined(parts) if parts else _block(frame, boxes, shares)


def joined(parts: Sequence[JudgedBoxes]) -> JudgedBoxes:
    """The answers of several lots of boxes, one after the other."""
    return JudgedBoxes(
        *(np.concatenate([getattr(part, name) for part in parts]) for name in JudgedBoxes.__dataclass_fields__)
    )


def _block(frame: BoxQuestion, boxes: Boxes, shares: bool) -> JudgedBoxes:
    count = len(boxes)
    criteria, shape = frame.criteria, (count,)
    found = criteria.over(frame.whole(boxes.intervals))
    certain = np.ones(shape, dtype=bool)
    outside = np.zeros(shape, dtype=bool)
    for name in (*criteria.margins, *criteria.radicands):
        certain &= (found[name].low >= 0) & found[name].defined
    for name in criteria.margins:
        outside |= found[name].high < 0
    for name in criteria.regular:
        certain &= found[name].nonzero
    inside = certain & ~outside
    sizes = boxes.sizes
    least, most = np.where(inside, sizes.low, 0.0), np.where(outside, 0.0, sizes.high)
    axis = np.zeros(count, dtype=np.int64)
    rest = np.flatnonzero(~inside & ~outside)
    if len(rest):
        closer = _closer(frame, boxes[rest], shares)
        inside[rest], outside[rest], axis[rest] = closer.inside, closer.outside, closer.axis
        size = sizes[rest]
        least[rest] = rounding.down(closer.least * size.low)
        most[rest] = np.where(closer.outside, 0.0, rounding.up(closer.most * size.high))
    return JudgedBoxes(inside, outside, np.maximum(least, 0.0), most, axis)


def _closer(frame: BoxQuestion, boxes: Boxes, shares: bool) -> JudgedBoxes:
    """The same with slopes, where `least` and `most` are shares of the boxes' volume."""
    criteria, count = frame.criteria, len(boxes)
    middles = boxes.middles
    reach = rounding.up_sum(np.maximum(boxes.high - middles, middles - boxes.low))
    offsets = [Interval(-row, row, np.ones(count, dtype=bool)) for row in reach]
    found = criteria.sloped(frame.whole(boxes.intervals), frame.middles(middles))
    ranges = {name: broadcast(ranged(number, offsets), (count,)) for name, number in found.items()}
    inside = np.ones(count, dtype=bool)
    outside, changes = np.zeros(count, dtype=bool), np.zeros((len(reach), count))
    missing, most = np.zeros(count), np.ones(count)
    bend = CORNER if shares else 1.0
    for name in (*criteria.margins, *criteria.radicands):
        certain = (ranges[name].low >= 0) & ranges[name].defined
        inside &= certain
        rises, errors = _rises(found[name], reach)
        changes += np.where(certain, 0.0, _relative(errors + bend * np.abs(rises)))
        if name in criteria.margins:
            outside |= ranges[name].high < 0
        rows = np.flatnonzero(~certain)
        if shares and len(rows):
            low, high = cuts.shares(found[name].of(rows, count), reach[:, rows])
            missing[rows] += np.where(ranges[name].defined[rows], 1.0 - low, 1.0) * (1 + 1e-14)
            if name in criteria.margins:
                most[rows] = np.minimum(most[rows], high)
    certain, negligible = _regular(criteria, found, ranges, count)
    for name in criteria.regular:
        rises, errors = _rises(found[name], reach)
        changes += np.where(ranges[name].nonzero, 0.0, _relative(errors + bend * np.abs(rises)))
    larger = _cube(boxes, reach)
    least = np.clip(rounding.down_sum(1.0 - missing * larger), 0.0, 1.0) if shares else np.zeros(count)
    least = np.where(certain | negligible, np.where(inside, 1.0, least), 0.0)
    most = np.minimum(rounding.up(most * larger), 1.0)
    axis = np.argmax(changes + 1e-6 * reach / np.maximum(np.max(reach, axis=0), LEAST), axis=0)
    return JudgedBoxes(inside & certain & ~outside, outside, least, np.where(outside, 0.0, most), axis)


def _cube(boxes: Boxes, reach: FloatArray) -> FloatArray:
    """Upper bound (N,) of the volume of the box of half extents `reach` about the middle, as a share of the box's.

    Shares are worked out over the former, which is larger because middles are rounded.
    """
    ratio = as_interval(np.ones(len(boxes)))
    for own, far in zip(boxes.intervals, reach, strict=True):
        ratio = ratio * (as_interval(2 * far) / (as_interval(own.high) - own.low))
    return ratio.high * (1 + 1e-14)


def _regular(
    criteria: Criteria, factors: dict[str, Sloped], ranges: dict[str, Interval], count: int
) -> tuple[BoolArray, BoolArray]:
    """Where nothing that the formulas divide by is zero, and where it may be but on a set without volume.

    The second is so where it is an analytic function all over the box (every divisor is away from zero and every
    radicand above it) and not zero in the middle.
    """
    certain, negligible = np.ones(count, dtype=bool), np.full(count, criteria.analytic)
    for name in criteria.roots:
        negligible &= ranges[name].positive
    for name in criteria.regular:
        nonzero = ranges[name].nonzero
        certain &= nonzero
        negligible &= nonzero | (factors[name].centre.nonzero & ranges[name].defined)
    return certain, negligible


def _rises(number: Sloped, reach: FloatArray) -> tuple[FloatArray, FloatArray]:
    """By how much the number rises from the middle to each face (k, N), and how far that may be wrong."""
    rises, errors = np.zeros(reach.shape), np.zeros(reach.shape)
    for k, slope in enumerate(number.slopes):
        if slope is None:
            continue
        with np.errstate(all="ignore"):
            middle = 0.5 * slope.low + 0.5 * slope.high
            spread = rounding.up_sum(np.maximum(slope.high - middle, middle - slope.low))
            known = np.isfinite(middle) & np.isfinite(spread)
            rises[k] = np.where(known, middle, 0.0) * reach[k]
            # the product above is rounded too
            errors[k] = np.where(known, rounding.up(spread * reach[k]) + np.abs(rises[k]) * 1e-15, np.inf)
    return rises, errors


def _relative(changes: FloatArray) -> FloatArray:
    """Shares (k, N) of the sum over the coordinates; those that have no bound share everything."""
    endless = np.isinf(changes)
    finite = np.where(endless.any(axis=0), endless.astype(float), changes)
    total = np.sum(finite, axis=0)
    return np.where(total > 0, finite / np.where(total > 0, total, 1.0), 0.0)
