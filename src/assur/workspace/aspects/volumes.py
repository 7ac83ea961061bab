"""Volumes of aspects: what their certain boxes hold at least, and with undecided boxes at most."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.numerics.intervals import rounding
from assur.numerics.intervals.interval import as_interval
from assur.workspace.aspects.search import BoxSearch
from assur.workspace.aspects.signs import Signs
from assur.workspace.aspects.turning import ends_of, once
from assur.workspace.certified import cuts
from assur.workspace.certified.planes import BLOCK, judged

FloatArray = NDArray[np.float64]
Pair = tuple[float, float]


def volumes(state: BoxSearch) -> list[Pair]:
    """Bounds (low, high) of the volume of the aspect that holds each component, over the coordinates that are cut.

    The lower one counts the component's boxes. The upper one adds the components that are not told apart from it, and
    of undecided boxes the part where margins are not negative and factors have the aspect's signs.
    """
    found, most = state.links, state.certain.sizes.high
    least = once(state.certain, ends_of(state.frame)).sizes.low
    rows = [np.flatnonzero(found.component == k) for k in range(len(found.group))]
    low = [max(float(rounding.down(math.fsum(least[row]))), 0.0) for row in rows]
    own = [float(rounding.up(math.fsum(most[row]))) for row in rows]
    open_ = _open(state)
    high: list[float] = []
    for group, boxes in enumerate(found.reached):
        members = np.flatnonzero(found.group == group)
        added = math.fsum(open_.most(boxes, found.signs[members[0]]))
        total = math.fsum([*(own[int(k)] for k in members), float(rounding.up(added))])
        high.append(float(rounding.up(total)))
    return [(value, high[group]) for value, group in zip(low, found.group, strict=True)]


@dataclass(frozen=True, eq=False)
class _Open:
    """What undecided boxes may hold.

    Attributes:
        reached: (M,) upper bounds of the volume of what is reached in each.
        room: (M,) upper bounds of the volume of the boxes of which `shares` speak.
        shares: (2, f, M) upper bounds of the share in which each factor is positive, and negative.
    """

    reached: FloatArray
    room: FloatArray
    shares: FloatArray

    def most(self, boxes: NDArray[np.int64], signs: Signs) -> FloatArray:
        """Upper bounds (n,) of the volume, in some boxes, of what is reached with given signs (f,) of the factors."""
        sides = np.where(signs > 0, 0, 1)
        share = np.min(self.shares[sides, np.arange(len(signs))][:, boxes], axis=0, initial=1.0)
        return np.minimum(self.reached[boxes], rounding.up(share * self.room[boxes]))


def _open(state: BoxSearch) -> _Open:
    """Each undecided box that an aspect may reach is looked at once, for all signs."""
    count, names = len(state.undecided), state.frame.criteria.names
    found = _Open(np.zeros(count), np.zeros(count), np.ones((2, len(names), count)))
    rows = np.unique(np.concatenate([np.zeros(0, dtype=np.int64), *state.links.reached]))
    for k in range(0, len(rows), BLOCK):
        row = rows[k : k + BLOCK]
        boxes = state.undecided[row]
        found.reached[row] = judged(state.frame, boxes).most
        middles = boxes.middles
        reach = rounding.up_sum(np.maximum(boxes.high - middles, middles - boxes.low))
        size = as_interval(np.ones(len(boxes)))
        for extent in reach:  # shares are those of the box of half extents `reach`
            size = size * as_interval(2 * extent)
        found.room[row] = size.high
        values = state.frame.criteria.sloped(state.frame.whole(boxes.intervals), state.frame.middles(middles))
        for j, name in enumerate(names):
            open_ = np.flatnonzero(state.possible[row, j] == 0)  # of the others only boxes with that sign are asked for
            if len(open_):
                least, most = cuts.shares(values[name].of(open_, len(boxes)), reach[:, open_])
                found.shares[:, j, row[open_]] = most, rounding.up(1.0 - least)
    return found
