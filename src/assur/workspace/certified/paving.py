"""Paving: a box of poses cut into boxes that are certainly inside the region, certainly outside, or about its boundary.

The boxes that leave most open are halved until what all leave open is small (`planes` says how much a box leaves open),
or until they are as small as was asked for.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from assur.errors import UnknownNameError, UsageError
from assur.numerics.intervals import rounding
from assur.numerics.intervals.interval import Interval, as_interval
from assur.work import Progress
from assur.workspace.certified.boxes import Boxes, together
from assur.workspace.certified.criteria import Criteria
from assur.workspace.certified.planes import BoxQuestion, JudgedBoxes, joined, judged
from assur.workspace.domain import Box

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]

MOST_OF = 0.8
"""The boxes that are cut next leave this share of the gap open."""

MOST = 10_000_000
"""Boxes looked at, at most, some two minutes; then the paving ends with the gap that it has."""

AT_ONCE = 5
"""One in so many of these may be open at once: two million, some 200 MB."""

FIRST = 256
"""Parts into which the box is cut before anything is judged, about: few steps over many boxes are fast."""

SMALLEST = 1e-6
"""Of a region below this share of its box the bounds are that share times the gap apart, not its own volume's."""

ENOUGH, IDLE = 0.999, 20
"""Where so many cuts one after the other do not make the gap smaller by this factor, it is that of rounding."""

Stopped = Literal["", "too many boxes", "interrupted", "rounding"]
"""Why a paving ended early: too many boxes for the memory, Ctrl-C, or boxes that floats cannot cut further."""


@dataclass(frozen=True, eq=False)
class Paving:
    """The boxes, and bounds of the volume inside.

    Attributes:
        names: coordinates of the boxes, those that the criteria depend on.
        length: extent of the others, which no margin depends on (1 where there is none).
        inside, outside: boxes certainly inside and certainly outside.
        boundary: the others; a part of each may be inside.
        low, high: bounds of the volume of the region over all coordinates.
        stopped: why it ended before what was asked for was reached; "" where it did not.
    """

    names: tuple[str, ...]
    length: Interval
    inside: Boxes
    outside: Boxes
    boundary: Boxes
    low: float
    high: float
    stopped: Stopped = ""


@dataclass(frozen=True, eq=False)
class _State:
    """What is done so far: settled boxes and their volume, open boxes and what is known of them."""

    boundary: Boxes
    known: JudgedBoxes
    inside: tuple[Boxes, ...] = ()
    outside: tuple[Boxes, ...] = ()
    settled: Interval = field(default_factory=lambda: as_interval(0.0))

    def with_judged(self, boxes: Boxes, known: JudgedBoxes, rest: BoolArray) -> _State:
        """The state in which only the `rest` of the boundary is left, and new boxes take the place of the others."""
        left = ~known.inside & ~known.outside
        return _State(
            boundary=together([self.boundary[rest], boxes[left]]),
            known=joined([self.known[rest], known[left]]),
            inside=(*self.inside, boxes[known.inside]),
            outside=(*self.outside, boxes[known.outside]),
            settled=self.settled + _sum(known[~left]),
        )

    @property
    def volume(self) -> Interval:
        """Bounds of the volume inside, over the coordinates that are cut."""
        return self.settled + _sum(self.known)


class _Work:
    """A paving on its way. Its state changes in one step, so that Ctrl-C at any moment leaves a valid one."""

    def __init__(self, frame: BoxQuestion, boxes: Boxes, shares: bool) -> None:
        self.frame, self.shares = frame, shares
        none = judged(frame, boxes[:0], shares)
        found = judged(frame, boxes, shares)
        self.examined = len(boxes)
        self.state = _State(boxes[:0], none).with_judged(boxes, found, np.zeros(0, dtype=bool))

    def cut(self, chosen: BoolArray) -> None:
        """Halve chosen boxes about the boundary."""
        state = self.state
        parts = state.boundary[chosen].halved(state.known.axis[chosen])
        self.examined += len(parts)
        self.state = state.with_judged(parts, judged(self.frame, parts, self.shares), ~chosen)


def pave(
    criteria: Criteria,
    box: Box,
    gap: float = 1e-3,
    finest: Mapping[str, float] | None = None,
    progress: Progress | None = None,
    most: int = MOST,
) -> Paving:
    """Pave a box until the bounds of the volume differ by at most a share of it, or down to a size.

    Args:
        criteria: what a pose must satisfy.
        box: the poses looked at, over the free coordinates of the criteria.
        gap: wanted difference of the bounds, as a share of the lower one.
        finest: largest extent of a box about the boundary, by coordinate, in length units and rad. Where it is
            given, boxes are cut down to it and no further, whatever the gap. Boxes that floats cannot halve stay open.
        progress: called with (done, in all), of the way from the first gap to the wanted one.
        most: boxes looked at, at most; a fifth of them open at once.

    Returns:
        The paving. Ctrl-C ends it with what is done.

    Errors:
        UsageError: a gap, an extent or a number of boxes that is not positive, a box over other coordinates.

    Example: a quarter of the paper's search box, 10 mm.

    >>> from assur.model.registry import load_record
    >>> from assur.workspace.certified.criteria import criteria
    >>> from assur.workspace.domain import box_of
    >>> record = load_record("zeng2019")
    >>> found = pave(criteria(record), box_of(record, None), finest={"x": 10.0, "z": 10.0})
    >>> found.names, len(found.inside) > 100, found.low < 22_814_586.4 < found.high
    (('x', 'z'), True, True)
    """
    if not (gap > 0 and math.isfinite(gap)):
        raise UsageError(f"gap: {gap!r} is not positive", hint="1e-3 means bounds that differ by a thousandth")
    if most < 1:
        raise UsageError(f"boxes: {most} are none to look at", hint=f"{MOST} if nothing else is said")
    if box.names != criteria.slice.free:
        raise UsageError(f"box over {', '.join(box.names)}; {', '.join(criteria.slice.free)} are free")
    used = criteria.used if any(criteria.used) else (True, *criteria.used[1:])
    names = tuple(name for name, has in zip(box.names, used, strict=True) if has)
    limits = None if finest is None else _finest(names, box.names, finest)
    frame = BoxQuestion(criteria, box, used)
    work = _begun(frame, limits)
    stopped = _run(work, gap, limits, most, progress)
    length = as_interval(1.0)
    for has, low, high in zip(used, box.low, box.high, strict=True):
        length = length if has else length * (Interval.of(high) - low)
    state = work.state
    total = state.volume * length
    return Paving(
        names=names,
        length=length,
        inside=together(state.inside),
        outside=together(state.outside),
        boundary=state.boundary,
        low=max(float(total.low), 0.0),
        high=float(total.high) if state.volume.high > 0 else 0.0,
        stopped=stopped,
    )


def _run(work: _Work, gap: float, limits: FloatArray | None, most: int, progress: Progress | None) -> Stopped:
    """Cut boxes until there is no need to; say why, where it is for another reason."""
    whole = max(float(work.state.volume.high), 1e-300)
    least = SMALLEST * float(np.sum(work.state.boundary.sizes.high))
    best, idle = math.inf, 0
    try:
        while len(work.state.boundary):
            state, volume = work.state, work.state.volume
            wanted, reached = gap * max(float(volume.low), least), float(volume.high - volume.low)
            best, idle = min(best, reached), 0 if reached < ENOUGH * best else idle + 1
            if progress is not None:
                progress(*_way(reached / whole, max(wanted, 1e-300) / whole))
            if limits is None and reached <= wanted:
                break
            large, ended = _large(state.boundary, state.known.axis, limits)
            chosen = (_worst(state.known) if limits is None else np.ones(len(large), dtype=bool)) & large
            if limits is None and (idle > IDLE or not chosen.any()):
                return "rounding"
            if not chosen.any():
                return "rounding" if ended else ""
            cut = int(np.sum(chosen))
            if len(state.boundary) + cut > most // AT_ONCE + 1 or work.examined + 2 * cut > most:
                return "too many boxes"
            work.cut(chosen)
    except KeyboardInterrupt:
        return "interrupted"
    return ""


def _begun(frame: BoxQuestion, limits: FloatArray | None) -> _Work:
    """The box in equal parts: of the finest size if they are few, else some for a start."""
    low = np.array([value for value, has in zip(frame.box.low, frame.used, strict=True) if has])
    high = np.array([value for value, has in zip(frame.box.high, frame.used, strict=True) if has])
    counts = np.full(len(low), round(FIRST ** (1 / len(low))))
    if limits is not None:
        wanted = np.ceil((high - low) / limits)
        counts = np.maximum(np.minimum(wanted, 2.0 ** np.ceil(np.log2(counts))), 1).astype(int)
        halvings = np.ceil(np.log2(np.maximum(wanted / counts, 1.0)))  # so that halves end at the size that is wanted
        counts = np.ceil(wanted / 2.0**halvings).astype(int)
    boxes = Boxes(low[:, None], high[:, None]).divided(counts.tolist())
    return _Work(frame, boxes, limits is None)


def _finest(names: tuple[str, ...], allowed: tuple[str, ...], finest: Mapping[str, float]) -> FloatArray:
    """The largest extent for each coordinate that is cut."""
    for name, value in finest.items():
        if name not in allowed:
            raise UnknownNameError("pose coordinate", name, allowed)
        if not (value > 0 and math.isfinite(value)):
            raise UsageError(f"finest: {name} = {value!r} is not a positive extent")
    missing = [name for name in names if name not in finest]
    if missing:
        raise UsageError(f"finest: no extent for {', '.join(missing)}")
    return np.array([finest[name] for name in names])


def _large(boxes: Boxes, axis: NDArray[np.int64], limits: FloatArray | None) -> tuple[BoolArray, bool]:
    """Boxes (N,) that may be cut across the coordinate of that number; it is changed where another one must be.

    And whether any is larger than wanted and cannot be cut, because floats end.
    """
    every, middles = np.arange(len(boxes)), boxes.middles
    divisible = (boxes.low < middles) & (middles < boxes.high)
    if limits is None:
        return np.asarray(divisible[axis, every]), False
    wide = boxes.high - boxes.low > limits[:, None] * (1 + 1e-9)
    relative = np.where(divisible & wide, (boxes.high - boxes.low) / limits[:, None], 0.0)
    axis[:] = np.where(relative[axis, every] > 0, axis, np.argmax(relative, axis=0))
    return np.max(relative, axis=0) > 0, bool(np.any(wide & ~divisible))


def _worst(known: JudgedBoxes) -> BoolArray:
    """The boxes (N,) that leave most open: together most of all that is open."""
    gaps = known.most - known.least
    order = np.argsort(-gaps, kind="stable")
    count = int(np.searchsorted(np.cumsum(gaps[order]), MOST_OF * float(np.sum(gaps)))) + 1
    chosen = np.zeros(len(gaps), dtype=bool)
    chosen[order[:count]] = True
    return chosen & (gaps > 0)


def _sum(known: JudgedBoxes) -> Interval:
    """Bounds of the volume in several boxes: a correctly rounded sum of bounds, and that rounding."""
    low, high = math.fsum(known.least), math.fsum(known.most)
    one, two = float(rounding.down_sum(low)), float(rounding.up_sum(high))
    return Interval.of(max(one, 0.0), max(two, 0.0))


def _way(reached: float, gap: float) -> tuple[int, int]:
    """How far it is from all to the wanted gap, in thousandths of the way on a logarithmic scale."""
    if reached <= gap or gap >= 1:
        return 1000, 1000
    return round(1000 * math.log(max(min(reached, 1.0), gap)) / math.log(gap)), 1000
