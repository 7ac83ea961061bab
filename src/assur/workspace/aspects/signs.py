"""Signs of factors over boxes: what certainly holds at every pose of a box that is reached."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from assur.numerics.intervals import rounding
from assur.numerics.intervals.interval import Interval
from assur.numerics.intervals.sloped import ranged
from assur.workspace.certified.boxes import Boxes
from assur.workspace.certified.planes import BLOCK, BoxQuestion

Signs = NDArray[np.int8]


def factor_signs(frame: BoxQuestion, boxes: Boxes) -> Signs:
    """Signs (N, f) of the factors in the order of `frame.criteria.names`; 0 where both, or zero, may occur.

    Where a pose of the box is reached, each factor there has the sign that is given.

    >>> from assur.model.registry import load_record
    >>> from assur.workspace.certified.criteria import criteria
    >>> from assur.workspace.domain import box_of
    >>> record = load_record("fivebar")
    >>> frame = BoxQuestion(criteria(record, "-+", factors=["parallel"]), box_of(record, None), (True, True))
    >>> boxes = Boxes(np.array([[-10.0, -10.0], [150.0, 50.0]]), np.array([[10.0, 10.0], [160.0, 260.0]]))
    >>> factor_signs(frame, boxes).tolist()
    [[1], [0]]
    """
    names = frame.criteria.names
    none = np.zeros((0, len(names)), dtype=np.int8)
    return np.concatenate([none, *(_block(frame, boxes[k : k + BLOCK]) for k in range(0, len(boxes), BLOCK))])


def _block(frame: BoxQuestion, boxes: Boxes) -> Signs:
    names = frame.criteria.names
    signs = np.zeros((len(boxes), len(names)), dtype=np.int8)
    _tell(signs, frame.criteria.over(frame.whole(boxes.intervals)), names)
    rest = np.flatnonzero(np.any(signs == 0, axis=1))
    if len(rest):  # slopes tell more
        boxes, told = boxes[rest], signs[rest]
        middles = boxes.middles
        reach = rounding.up_sum(np.maximum(boxes.high - middles, middles - boxes.low))
        offsets = [Interval(-row, row, np.ones(len(boxes), dtype=bool)) for row in reach]
        found = frame.criteria.sloped(frame.whole(boxes.intervals), frame.middles(middles))
        _tell(told, {name: ranged(found[name], offsets) for name in names}, names)
        signs[rest] = told
    return signs


def _tell(signs: Signs, factors: Mapping[str, Interval], names: Sequence[str]) -> None:
    """Write down the signs (N, f) that intervals (N,) have."""
    for k, name in enumerate(names):
        value = factors[name]
        signs[:, k] = np.where(value.positive, 1, np.where(value.negative, -1, signs[:, k]))
