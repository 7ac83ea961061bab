"""Volumes of aspects: what their certain boxes hold at least, and with undecided boxes at most."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from assur.numerics.intervals import rounding
from assur.numerics.intervals.interval import as_interval
from assur.workspace.aspects.search import Search
from assur.workspace.aspects.signs import Signs
from assur.workspace.certified import cuts
from assur.workspace.certified.boxes import Boxes
from assur.workspace.certified.planes import BLOCK, Frame, judged

FloatArray = NDArray[np.float64]
Pair = tuple[float, float]


def volumes(state: Search) -> list[Pair]:
    """Bounds (low, high) of the volume of the aspect that holds each component, over the coordinates that are cut.

    The lower one counts the component's boxes. The upper one adds the components that are not told apart from it, and
    of undecided boxes the part where margins are not negative and factors have the aspect's signs.
    """
    found, sizes = state.links, state.certain.sizes
    rows = [np.flatnonzero(found.component == k) for k in range(len(found.group))]
    own = [(math.fsum(sizes.low[row]), math.fsum(sizes.high[row])) for row in rows]
    most = [_most_of(state, group, [pair[1] for pair in own]) for group in range(len(found.reached))]
    return [
        (max(float(rounding.down(low)), 0.0), most[group]) for (low, _), group in zip(own, found.group, strict=True)
    ]


def _most_of(state: Search, group: int, sizes: Sequence[float]) -> float:
    """Upper bound of the volume of a group: its components, of at most these sizes, and what undecided boxes add."""
    members = np.flatnonzero(state.links.group == group)
    boxes = state.undecided[state.links.reached[group]]
    signs = state.links.signs[members[0]]
    parts = [_most(state.frame, boxes[k : k + BLOCK], signs) for k in range(0, len(boxes), BLOCK)]
    added = math.fsum(value for part in parts for value in part)
    total = math.fsum([*(float(rounding.up(sizes[int(k)])) for k in members), float(rounding.up(added))])
    return float(rounding.up(total))


def _most(frame: Frame, boxes: Boxes, signs: Signs) -> FloatArray:
    """Upper bounds (N,) of the volume, in each box, of what is reached with given signs (f,) of the factors."""
    return np.minimum(judged(frame, boxes).most, _signed(frame, boxes, signs))


def _signed(frame: Frame, boxes: Boxes, signs: Signs) -> FloatArray:
    """The same for the signs alone, from the values of the factors in the middle and their slopes."""
    middles = boxes.middles
    reach = rounding.up_sum(np.maximum(boxes.high - middles, middles - boxes.low))
    found = frame.criteria.sloped(frame.whole(boxes.intervals), frame.middles(middles))
    share = np.ones(len(boxes))
    for name, sign in zip(frame.criteria.names, signs, strict=True):
        share = np.minimum(share, cuts.shares(found[name] if sign > 0 else -found[name], reach)[1])
    size = as_interval(share)
    for row in reach:  # shares are those of the box of half extents `reach`
        size = size * as_interval(2 * row)
    return size.high
