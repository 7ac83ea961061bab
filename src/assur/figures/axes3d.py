"""Axes in space: the box of a region with ticks and units on the three edges that lie best for the reader."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from assur.figures.canvas import Canvas, View
from assur.figures.style import GREY, INK, PALE, SMALL, TEXT
from assur.results.typeset_text import minus

FloatArray = NDArray[np.float64]
ROOM = 24.0
"""Points along an axis for each number on it."""

HALF = SMALL * np.array([0.26, 0.5])
"""Half the width of a character, and half the height of a number, in points."""


def draw_box(page: Canvas, view: View, low: FloatArray, high: FloatArray) -> None:
    """The twelve edges of a box, the three at the corner farthest from the reader thinnest."""
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    toward = view.camera.toward > 0
    for start in corners:
        for axis in range(3):
            if start[axis]:
                continue
            end = start.copy()
            end[axis] = 1
            behind = all(bool(start[k]) != bool(toward[k]) for k in range(3) if k != axis)
            ends = view(low + np.array([start, end]) * (high - low))
            page.line(ends, 0.4, PALE if behind else GREY, 1.0 if behind else 1.2)


def draw_axes(
    page: Canvas, view: View, low: FloatArray, high: FloatArray, titles: Sequence[str], per: Sequence[float]
) -> None:
    """Ticks and titles of three coordinates on edges of the box between `low` and `high` (3,).

    A tick says what it is times `per` (3,): the number that stands there for one unit of what is drawn. Each number
    stands at its tick; one that would stand on another number, where two axes meet, is left out.
    """
    middle = view((low + high) / 2)
    taken: list[tuple[FloatArray, FloatArray]] = []
    for axis in range(3):
        ends = _ends(view, low, high, axis)
        flat = view(ends)
        away = _outwards(flat, middle)
        page.line(flat, 0.7, INK, 3)
        first, last = low[axis] * per[axis], high[axis] * per[axis]
        most = int(np.clip(np.linalg.norm(flat[1] - flat[0]) / ROOM, 1, 5))
        for tick in MaxNLocator(most, steps=[1, 2, 3, 5, 10]).tick_values(first, last):
            if first - 1e-9 <= tick <= last + 1e-9:
                place = ends[0].copy()
                place[axis] = tick / per[axis]
                foot = view(place)
                page.line(np.array([foot, foot + 3 * away]), 0.5, INK, 3)
                number = minus(f"{tick:g}")
                half = HALF * [len(number), 1.0]
                at = foot + (5.0 + np.abs(away) @ half) * away
                if not any(bool(np.all(np.abs(at - other) < half + size)) for other, size in taken):
                    taken.append((at, half))
                    page.text(at, number, fontsize=SMALL)
        upright = abs(away[0]) > 0.9  # a title beside it would stand on the numbers
        at = flat[int(np.argmax(flat[:, 1]))] + [-9.0, 9.5] if upright else flat.mean(axis=0) + 23 * away
        page.text(at, titles[axis], fontsize=TEXT)


def _ends(view: View, low: FloatArray, high: FloatArray, axis: int) -> FloatArray:
    """Ends (2, 3) of the edge on which an axis is drawn."""
    base = _edge(view, low, high, axis)
    ends = np.array([base, base])
    ends[0, axis], ends[1, axis] = low[axis], high[axis]
    return ends


def _edge(view: View, low: FloatArray, high: FloatArray, axis: int) -> FloatArray:
    """A point of the edge for an axis: on the outline, low on the page; of Z the one farthest to the left."""
    others = [k for k in range(3) if k != axis]
    best, place = -np.inf, low.copy()
    for first in (low, high):
        for second in (low, high):
            point = (low + high) / 2
            point[others[0]], point[others[1]] = first[others[0]], second[others[1]]
            flat = view(point)
            score = -flat[0] if axis == 2 else -flat[1]
            if score > best + 1e-9:
                best, place = score, point
    return place


def _outwards(ends: FloatArray, middle: FloatArray) -> FloatArray:
    """Unit direction across an edge, away from the middle of the box."""
    way = ends[1] - ends[0]
    across = np.array([-way[1], way[0]]) / max(float(np.linalg.norm(way)), 1e-9)
    return across if across @ (ends.mean(axis=0) - middle) > 0 else -across
