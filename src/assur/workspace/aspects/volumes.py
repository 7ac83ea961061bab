"""Volumes of aspects: what their certain boxes hold at least, and with undecided boxes at most."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from assur.numerics.intervals import rounding
from assur.numerics.intervals.interval import Interval, as_interval
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
    found, boxes = state.links, state.undecided
    sizes = state.certain.sizes
    rows = [np.flatnonzero(found.component == k) for k in range(len(found.group))]
    own = [(math.fsum(sizes.low[row]), math.fsum(sizes.high[row])) for row in rows]
    bounds = []
    for k, group in enumerate(found.group):
        reached = found.reached[group]
        most = math.fsum(_most(state.frame, boxes[reached], found.signs[k]))
        together = math.fsum(own[other][1] for other in np.flatnonzero(found.group == group))
        total = as_interval(together) + Interval.of(0.0, float(rounding.up(most)))
        bounds.append((max(float(rounding.down(own[k][0])), 0.0), float(rounding.up(total.high))))
    return bounds


def _most(frame: Frame, boxes: Boxes, signs: Signs) -> FloatArray:
    """Upper bounds (N,) of the volume, in each box, of what is reached with given signs (f,) of the factors."""
    parts = [np.zeros(0)]
    for k in range(0, len(boxes), BLOCK):
        block = boxes[k : k + BLOCK]
        parts.append(np.minimum(judged(frame, block).most, _signed(frame, block, signs)))
    return np.concatenate(parts)


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
