"""Adjacency: which of many boxes share a face, or touch at all.

The boxes come from halving one box, so that their faces lie on the same floats where they meet, and no two share an
inner point. On each plane with faces the rectangles of both sides are cut into strips; in a strip they follow one
another in order, and a binary search finds those that overlap. Nothing is rounded: coordinates are compared, and
counted, but not computed with. Where a coordinate turns, what begins at the beginning of the turn is there again at
its end.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.workspace.aspects.turning import Ends
from assur.workspace.certified.boxes import Boxes

IntArray = NDArray[np.int64]


def shared_faces(boxes: Boxes, ends: Ends = ()) -> tuple[IntArray, IntArray]:
    """Pairs (n, 2) of boxes that share a part of a face with an area of its own, and the axis (n,) across it.

    The first box of a pair is below the face, the second above it. In a plane faces are edges with a length, on a line
    they are points. The `ends` of a turn are one face.

    >>> boxes = Boxes(np.array([[0.0, 1.0, 1.0], [0.0, 0.0, 1.0]]), np.array([[1.0, 2.0, 2.0], [1.0, 1.0, 2.0]]))
    >>> [item.tolist() for item in shared_faces(boxes)]  # the first and the last have only a corner in common
    [[[0, 1], [1, 2]], [0, 1]]
    """
    return _meeting(boxes, 0, ends)


def contacts(boxes: Boxes, ends: Ends = ()) -> IntArray:
    """Pairs (n, 2) of boxes that have at least one point in common, each pair once, the lower number first.

    >>> boxes = Boxes(np.array([[0.0, 1.0, 1.0], [0.0, 0.0, 1.0]]), np.array([[1.0, 2.0, 2.0], [1.0, 1.0, 2.0]]))
    >>> contacts(boxes).tolist()
    [[0, 1], [0, 2], [1, 2]]
    """
    pairs, _ = _meeting(boxes, 1, ends)
    return _unique(np.sort(pairs, axis=1), len(boxes))


def _meeting(boxes: Boxes, wider: int, ends: Ends = ()) -> tuple[IntArray, IntArray]:
    """Pairs across each axis; the faces of the first boxes are `wider` by that many half steps of the coordinates."""
    low, high, number = _ranks(boxes, ends)
    found, axes = [np.zeros((0, 2), dtype=np.int64)], [np.zeros(0, dtype=np.int64)]
    for axis in range(len(low)):
        rest = [k for k in range(len(low)) if k != axis]
        below, above = np.isin(high[axis], low[axis]), np.isin(low[axis], high[axis])
        first = high[axis][below], low[rest][:, below] - wider, high[rest][:, below] + wider, number[below]
        second = low[axis][above], low[rest][:, above], high[rest][:, above], number[above]
        pairs = _unique(_overlapping(first, second), len(boxes))
        pairs = pairs[pairs[:, 0] != pairs[:, 1]]  # a box all around meets itself
        found.append(pairs)
        axes.append(np.full(len(pairs), axis, dtype=np.int64))
    return np.concatenate(found), np.concatenate(axes)


def _ranks(boxes: Boxes, ends: Ends) -> tuple[IntArray, IntArray, IntArray]:
    """Low and high (k, M) as numbers of the distinct coordinates along each axis, and the number (M,) of each box.

    They are times two to leave room between. What begins where a turn does is there twice.
    """
    low, high = np.empty(boxes.low.shape, dtype=np.int64), np.empty(boxes.low.shape, dtype=np.int64)
    number = np.arange(len(boxes))
    spans: list[tuple[int, int]] = []
    for axis, (first, last) in enumerate(zip(boxes.low, boxes.high, strict=True)):
        turn = ends[axis] if ends else None
        edges = np.unique(np.concatenate([first, last, turn or ()]))
        low[axis], high[axis] = 2 * np.searchsorted(edges, first), 2 * np.searchsorted(edges, last)
        spans += [(axis, 2 * (len(edges) - 1))] if turn else []
    for axis, span in spans:
        again = np.flatnonzero(low[axis] == 0)
        low, high, number = (np.concatenate([part, part[..., again]], axis=-1) for part in (low, high, number))
        for part in (low, high):
            part[axis, -len(again) or len(number) :] += span
    return low, high, number


Rectangles = tuple[IntArray, IntArray, IntArray, IntArray]
"""The plane (N,) of each, low and high (d, N) in it, and the number (N,) of its box."""


def _overlapping(first: Rectangles, second: Rectangles) -> IntArray:
    """Pairs of boxes whose rectangles lie on one plane and overlap; one pair may come several times.

    Rectangles of the second kind that lie on one plane do not overlap each other.
    """
    size = len(first[1])
    if size == 0:  # boxes on a line, of which the faces are points
        ends = np.zeros((1, len(first[0])), dtype=np.int64), np.zeros((1, len(second[0])), dtype=np.int64)
        return _in_order((first[0], ends[0], ends[0] + 1, first[3]), (second[0], ends[1], ends[1] + 1, second[3]))
    if size == 1:
        return _in_order(first, second)
    return _overlapping(*_in_strips(first, second))


def _in_strips(first: Rectangles, second: Rectangles) -> tuple[Rectangles, Rectangles]:
    """Rectangles cut along their first axis wherever one on their plane ends; each strip becomes a plane of its own."""
    span = _span(first, second)
    ends = [(planes * span + low[0] + 1, planes * span + high[0] + 1) for planes, low, high, _ in (first, second)]
    edges = _distinct(np.concatenate([values for pair in ends for values in pair]))
    parts = []
    for (start, end), (_, low, high, number) in zip(ends, (first, second), strict=True):
        begin = np.searchsorted(edges, start)
        counts = np.searchsorted(edges, end) - begin
        strips, own = _runs(begin, counts)
        parts.append((strips, low[1:, own], high[1:, own], number[own]))
    return parts[0], parts[1]


def _in_order(first: Rectangles, second: Rectangles) -> IntArray:
    """The same for intervals: those of the second kind on one line stand in order, so that overlaps are runs."""
    span = _span(first, second)
    (planes, low, high, number), (others, low_2, high_2, number_2) = first, second
    order = np.argsort(others * span + low_2[0], kind="stable")
    starts, ends = (others * span + low_2[0])[order], (others * span + high_2[0])[order]
    begin = np.searchsorted(ends, planes * span + low[0], side="right")
    end = np.searchsorted(starts, planes * span + high[0], side="left")
    places, own = _runs(begin, np.maximum(end - begin, 0))
    return np.stack([number[own], number_2[order][places]], axis=1)


def _span(first: Rectangles, second: Rectangles) -> int:
    """More than any coordinate along the first axis, with room for one that is wider by one at both ends."""
    return max((int(np.max(high[0], initial=0)) for _, _, high, _ in (first, second)), default=0) + 4


def _runs(begin: IntArray, counts: IntArray) -> tuple[IntArray, IntArray]:
    """Numbers begin, begin + 1, .. of each of N runs, one run after the other, and the run (n,) of each."""
    own = np.repeat(np.arange(len(begin)), counts)
    within = np.arange(len(own)) - np.repeat(np.cumsum(counts) - counts, counts)
    return begin[own] + within, own


def _unique(pairs: IntArray, count: int) -> IntArray:
    """The pairs, each once and in order."""
    keys = _distinct(pairs[:, 0] * max(count, 1) + pairs[:, 1])
    return np.stack([keys // max(count, 1), keys % max(count, 1)], axis=1)


def _distinct(numbers: IntArray) -> IntArray:
    """The numbers in order, each once; by sorting, which of many is faster than the hashing of `numpy.unique`."""
    ordered = np.sort(numbers)
    return ordered[np.concatenate([[True], ordered[1:] != ordered[:-1]])] if len(ordered) else ordered
