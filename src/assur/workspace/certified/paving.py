"""Paving: a box of poses cut into boxes that are certainly inside the region, certainly outside, or about its boundary.

A box is inside where every margin is certainly not negative all over it, outside where one certainly is. The others are
halved until what they leave open is small. In a box about the boundary each margin m is bounded by two planes,
m(c) + g . (x - c) -+ e with the derivative enclosed in g +- d and e = d . |x - c|: what lies above the lower plane is
inside, what lies below the upper one is outside. So the gap falls with the square of the size of the boxes.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.numerics.dual import Dual, DualIntervals
from assur.numerics.intervals.interval import Interval, as_interval
from assur.workspace.certified.criteria import Criteria, components
from assur.workspace.certified.cuts import share
from assur.workspace.domain import Box

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
Progress = Callable[[float, float], None]

BLOCK = 16384
"""Boxes that are worked on at a time."""

MOST_OF = 0.7
"""The boxes that are cut next leave this share of the gap open."""

MOST = 4_000_000
"""Boxes at most; then the paving ends with the gap that it has."""


@dataclass(frozen=True, eq=False)
class Boxes:
    """N boxes: low and high (k, N), one row per coordinate."""

    low: FloatArray
    high: FloatArray

    def __len__(self) -> int:
        return self.low.shape[1]

    def __getitem__(self, index: NDArray[np.bool_] | NDArray[np.int64] | slice) -> Boxes:
        return Boxes(self.low[:, index], self.high[:, index])

    @property
    def intervals(self) -> list[Interval]:
        """One interval (N,) per coordinate."""
        return [Interval.of(low, high) for low, high in zip(self.low, self.high, strict=True)]

    @property
    def sizes(self) -> Interval:
        """Enclosure (N,) of the volume of each."""
        total = as_interval(np.ones(len(self)))
        for low, high in zip(self.low, self.high, strict=True):
            total = total * (Interval.of(high) - Interval.of(low))
        return total

    def halved(self, axis: NDArray[np.int64]) -> Boxes:
        """Each cut in two across the coordinate (N,) of that number."""
        every = np.arange(len(self))
        middle = 0.5 * self.low[axis, every] + 0.5 * self.high[axis, every]
        first, second = self.high.copy(), self.low.copy()
        first[axis, every] = second[axis, every] = middle
        return Boxes(np.hstack([self.low, second]), np.hstack([first, self.high]))


@dataclass(frozen=True, eq=False)
class Paving:
    """The answer: boxes over the coordinates that margins depend on, and bounds of the volume inside.

    Attributes:
        names: coordinates of the boxes; `length` is the extent of the others, which no margin depends on.
        inside, boundary: boxes certainly inside, and those of which only a part may be; the rest is outside.
        low, high: bounds of the volume of the region over all coordinates.
    """

    names: tuple[str, ...]
    length: float
    inside: Boxes
    boundary: Boxes
    low: float
    high: float


def pave(
    criteria: Criteria,
    box: Box,
    gap: float = 1e-3,
    finest: float = 0.0,
    progress: Progress | None = None,
) -> Paving:
    """Pave a box until the bounds of the volume differ by at most a share of it.

    Args:
        criteria: what a pose must satisfy.
        box: the poses looked at, over the free coordinates of the criteria.
        gap: wanted difference of the bounds, as a share of the lower one.
        finest: boxes are not cut below this share of the box's extents; 0 for no limit.
        progress: called with the gap reached and the gap wanted.

    Errors:
        UsageError: a gap that is not positive, a box over other coordinates.
    """
    if not gap > 0:
        raise UsageError(f"gap: {gap!r} is not positive", hint="1e-3 means bounds that differ by a thousandth")
    if box.names != criteria.slice.free:
        raise UsageError(f"box over {', '.join(box.names)}; {', '.join(criteria.slice.free)} are free")
    used = np.array(criteria.used)
    if not used.any():
        used[0] = True
    low, high = np.array(box.low), np.array(box.high)
    extents = (Interval.of(high) - Interval.of(low))[~used]
    length = math.prod(extents.middle.tolist())
    weights = 1 / (high - low)[used]
    inside: list[Boxes] = []
    settled_low, settled_high = 0.0, 0.0
    boxes = Boxes(low[used, None], high[used, None])
    fresh = _judged_blocks(criteria, box, used, boxes)
    least, most = np.empty(0), np.empty(0)
    boundary = boxes[:0]
    while True:
        within, new_least, new_most = fresh
        settled_low, settled_high = (
            settled_low + math.fsum(new_least[within]),
            settled_high + math.fsum(new_most[within]),
        )
        inside.append(boxes[within])
        left = ~within & (new_most > 0)
        boundary = _together([boundary, boxes[left]])
        least, most = np.concatenate([least, new_least[left]]), np.concatenate([most, new_most[left]])
        gaps = most - least
        wanted = gap * (settled_low + math.fsum(least))
        reached = settled_high - settled_low + math.fsum(gaps)
        if progress is not None:
            progress(reached, wanted)
        if reached <= wanted or len(boundary) > MOST:
            break
        cut = _worst(gaps) & np.any((boundary.high - boundary.low) * weights[:, None] > finest, axis=0)
        if not cut.any():
            break
        boxes = boundary[cut]
        boxes = boxes.halved(_axes(criteria, box, used, boxes, weights))
        boundary, least, most = boundary[~cut], least[~cut], most[~cut]
        fresh = _judged_blocks(criteria, box, used, boxes)
    settled_low, settled_high = settled_low + math.fsum(least), settled_high + math.fsum(most)
    names = tuple(name for name, wanted_name in zip(box.names, used, strict=True) if wanted_name)
    return Paving(
        names,
        length,
        _together(inside),
        boundary,
        math.nextafter(settled_low * length * (1 - 1e-15), 0.0),
        settled_high * length * (1 + 1e-15),
    )


def _worst(gaps: FloatArray) -> BoolArray:
    """The boxes (N,) that leave most open: together most of all that is open."""
    order = np.argsort(-gaps)
    count = int(np.searchsorted(np.cumsum(gaps[order]), MOST_OF * float(np.sum(gaps)))) + 1
    chosen = np.zeros(len(gaps), dtype=bool)
    chosen[order[:count]] = True
    return chosen & (gaps > 0)


def _judged_blocks(
    criteria: Criteria, box: Box, used: BoolArray, boxes: Boxes
) -> tuple[BoolArray, FloatArray, FloatArray]:
    parts = [_judged(criteria, box, used, boxes[k : k + BLOCK]) for k in range(0, len(boxes), BLOCK)]
    return tuple(np.concatenate([part[k] for part in parts]) for k in range(3))


def _judged(criteria: Criteria, box: Box, used: BoolArray, boxes: Boxes) -> tuple[BoolArray, FloatArray, FloatArray]:
    """Per box whether it is inside, and bounds of the volume of its part that is."""
    found = criteria.over(_whole(box, used, boxes.intervals))
    inside = np.ones(len(boxes), dtype=bool)
    outside = np.zeros(len(boxes), dtype=bool)
    for name in criteria.margins:
        inside &= (found[name].low >= 0) & found[name].defined
        outside |= found[name].high < 0
    for name in criteria.regular:
        inside &= found[name].nonzero
    sizes = boxes.sizes
    least, most = np.where(inside, sizes.low, 0.0), np.where(outside, 0.0, sizes.high)  # where inside: least and most
    rest = np.flatnonzero(~inside & ~outside)
    if len(rest):
        low, high = _parts(criteria, box, used, boxes[rest])
        least[rest], most[rest] = low * sizes.low[rest], high * sizes.high[rest] * (1 + 1e-15)
    return inside, least, most


def _parts(criteria: Criteria, box: Box, used: BoolArray, boxes: Boxes) -> tuple[FloatArray, FloatArray]:
    """Bounds of the share of each box that is inside, from planes below and above every margin."""
    size, count = boxes.low.shape
    centres = 0.5 * boxes.low + 0.5 * boxes.high
    reach = np.maximum(boxes.high - centres, centres - boxes.low) * (1 + 1e-15)
    units = np.eye(size)[:, :, None]  # the direction of each coordinate, (k, k, 1)
    wide = iter(units)
    directions = [Interval.of(next(wide)) if has else as_interval(np.zeros((size, 1))) for has in used]
    intervals = _whole(box, used, boxes.intervals)
    rates = criteria.tape.evaluate(_dual_components(criteria, intervals, directions), criteria.uniform, DualIntervals())
    at_centre = criteria.over(_whole(box, used, [Interval.of(row) for row in centres]))
    low, high = np.zeros(count), np.ones(count)
    missing = np.zeros(count)
    for name in criteria.margins:
        rate = rates[name]
        if not isinstance(rate, Dual):
            continue
        slope = as_interval(rate.derivative)
        known = np.all(slope.defined & np.isfinite(slope.low) & np.isfinite(slope.high), axis=0)
        known = np.broadcast_to(known, (count,)) & at_centre[name].defined
        slope_low, slope_high = (np.broadcast_to(part, (size, count)) for part in (slope.low, slope.high))
        with np.errstate(invalid="ignore"):
            middle = 0.5 * slope_low + 0.5 * slope_high
            spread = np.maximum(slope_high - middle, middle - slope_low) * reach
            error = np.sum(spread, axis=0) * (1 + 1e-14)
        height = np.broadcast_to(at_centre[name].low, (count,)), np.broadcast_to(at_centre[name].high, (count,))
        known &= np.any(middle != 0, axis=0)
        rise = np.where(known, middle * reach, 1.0)
        slack = np.sum(np.abs(rise), axis=0) * 1e-15
        below = share(np.where(known, height[0] - error - slack, 0.0), rise)[0]
        above = share(np.where(known, height[1] + error + slack, 0.0), rise)[1]
        missing += np.where(known, 1 - below, 1.0)
        high = np.minimum(high, np.where(known, above, 1.0))
    low = np.clip(1 - missing * (1 + 1e-15), 0.0, 1.0)
    return low, high


def _axes(criteria: Criteria, box: Box, used: BoolArray, boxes: Boxes, weights: FloatArray) -> NDArray[np.int64]:
    """Across which coordinate (N,) to cut: the one along which the margins that are still open change most."""
    count = len(boxes)
    whole = criteria.over(_whole(box, used, boxes.intervals))
    centres = [Interval.of(row) for row in 0.5 * boxes.low + 0.5 * boxes.high]
    changes = np.zeros((len(boxes.low), count))
    for axis, own in enumerate(boxes.intervals):
        alone = criteria.over(_whole(box, used, [*centres[:axis], own, *centres[axis + 1 :]]))
        for name in (*criteria.margins, *criteria.regular):
            is_open = ~whole[name].positive & (whole[name].high >= 0)
            with np.errstate(invalid="ignore"):
                part = np.nan_to_num(
                    (alone[name].high - alone[name].low) / (whole[name].high - whole[name].low), nan=1.0
                )
            changes[axis] += np.where(is_open, part, 0.0)
    widths = (boxes.high - boxes.low) * weights[:, None]
    return np.argmax(changes + 1e-3 * widths, axis=0)


def _whole(box: Box, used: BoolArray, intervals: list[Interval]) -> list[Interval]:
    """One interval per free coordinate: that of the boxes, or the whole extent where nothing depends on it."""
    rest = iter(intervals)
    return [
        next(rest) if has else Interval.of(low, high) for has, low, high in zip(used, box.low, box.high, strict=True)
    ]


def _dual_components(criteria: Criteria, intervals: list[Interval], directions: list[Interval]) -> list[Dual]:
    """The varying numbers of the tape with their derivatives along the coordinates."""
    values = components(criteria.tape, criteria.slice, intervals)
    rates = components_rates(criteria, intervals, directions)
    return [Dual(value, rate) for value, rate in zip(values, rates, strict=True)]


def components_rates(criteria: Criteria, intervals: list[Interval], directions: list[Interval]) -> list[Interval]:
    """Derivatives of the varying numbers."""
    values = dict(zip(criteria.tape.varying, components(criteria.tape, criteria.slice, intervals), strict=True))
    along = dict(zip(criteria.slice.free, directions, strict=True))
    factor = 0.5 if "qw" in criteria.slice.pose else 1.0
    found = []
    for name in criteria.tape.varying:
        if name.startswith("cos "):
            found.append(-values[name.replace("cos ", "sin ")] * along[name[4:]] * factor)
        elif name.startswith("sin "):
            found.append(values[name.replace("sin ", "cos ")] * along[name[4:]] * factor)
        else:
            found.append(along[name])
    return found


def _together(parts: list[Boxes]) -> Boxes:
    return Boxes(np.hstack([part.low for part in parts]), np.hstack([part.high for part in parts]))
