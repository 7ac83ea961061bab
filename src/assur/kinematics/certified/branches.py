"""Branches of a kernel over intervals: which certainly exist, which certainly do not, and which nobody can tell."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.certified.given import number, printed
from assur.kinematics.certified.result import Doubt
from assur.model.closed_form import Branch, Margin
from assur.model.mechanism import MechanismRecord
from assur.numerics.branch_and_prune import Existing
from assur.numerics.intervals.interval import Interval, as_interval
from assur.numerics.intervals.shapes import broadcast
from assur.numerics.krawczyk import stacked
from assur.numerics.number_types import Intervals

BoolArray = NDArray[np.bool_]
Kernel = Callable[[Any], Branch]
"""(namespace) -> all K branches of one problem, along the last axis."""


@dataclass(frozen=True, eq=False)
class JudgedBranches:
    """K branches of one problem.

    Attributes:
        pose, inputs: bounds (K, m) and (K, n).
        exists: (K,) every margin is certainly what it must be.
        absent: (K,) a margin is certainly negative; `by` says which.
        merging: (K,) in doubt only because radicands may be zero, nothing degenerates.
        doubts: for each branch in doubt the margin that is met first.
    """

    pose: Interval
    inputs: Interval
    exists: BoolArray
    absent: BoolArray
    merging: BoolArray
    doubts: tuple[tuple[int, Doubt], ...]
    by: dict[str, int]


def judged(record: MechanismRecord, kernel: Kernel, margins: Sequence[Margin], count: int) -> JudgedBranches:
    """What the margins of a kernel's K branches say, in the order in which they are met.

    A margin that is certainly negative excludes its branch, unless the formulas may have degenerated before; there the
    roots are those of radicands that are not negative. A branch exists where every margin is certain, and no root
    whatever may be of a negative number.
    """
    branch, sure_branch = kernel(Existing()), kernel(Intervals())
    absent, degenerate, exists = (np.zeros(count, dtype=bool) for _ in range(3))
    exists |= True
    first: dict[int, Doubt] = {}
    by: dict[str, int] = {}
    for margin in margins:
        value = _wide(branch.margins[margin.name], count)
        sure = value.nonzero if margin.zero == "degenerate" else value.positive
        if margin.zero != "degenerate":
            out = value.negative & ~degenerate & ~absent
            absent |= out
            if np.any(out):
                by[margin.name] = int(np.sum(out))
        else:
            degenerate |= ~sure & ~absent
        exists &= sure
        for k in np.flatnonzero(~sure & ~absent).tolist():
            first.setdefault(k, _doubt(margin, value[k]))
    doubts = tuple((k, item) for k, item in sorted(first.items()) if not absent[k])
    pose = stacked([_wide(number(value), count) for value in branch.pose], count)
    inputs = stacked([_wide(value, count) for value in printed(record, branch.inputs)], count)
    exists &= ~absent
    for value in (*sure_branch.pose, *sure_branch.inputs):
        exists &= _wide(number(value), count).defined
    return JudgedBranches(pose, inputs, exists, absent, ~exists & ~absent & ~degenerate, doubts, by)


def grouped(doubts: Sequence[tuple[int, Doubt]]) -> tuple[Doubt, ...]:
    """Doubts about several branches by one margin as one, with the hull of its bounds."""
    found: dict[str, Doubt] = {}
    for _, item in doubts:
        other = found.get(item.name)
        if other is not None:
            low, high = np.minimum(item.low, other.low), np.maximum(item.high, other.high)
            item = Doubt(item.name, low, high, item.meaning, item.unit, item.branches + other.branches)
        found[item.name] = item
    return tuple(found.values())


def _doubt(margin: Margin, value: Interval) -> Doubt:
    return Doubt(margin.name, np.atleast_1d(value.low), np.atleast_1d(value.high), margin.meaning, margin.unit)


def _wide(value: Any, count: int) -> Interval:
    """A kernel's number for each of K branches, whatever the shape of its sign axes."""
    return broadcast(as_interval(value), (count,))
