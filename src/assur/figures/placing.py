"""Placing letters: each beside its point, where it hides least; further off with a thin leader where it must."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text
from numpy.typing import NDArray

from assur.figures.canvas import Canvas
from assur.figures.style import GREY, INK, LETTER

FloatArray = NDArray[np.float64]
DIRECTIONS = 32
RINGS = (0.0, 2.0, 5.0, 9.0, 14.0, 20.0, 28.0)
LEADER_FROM = 8.0
SWEEPS = 4
GAP = 1.0
"""Distances in points."""


@dataclass(eq=False)
class _Label:
    at: FloatArray
    text: Text
    clear: float
    size: FloatArray = field(default_factory=lambda: np.zeros(2))
    boxes: FloatArray = field(default_factory=lambda: np.zeros((0, 4)))
    fixed: FloatArray = field(default_factory=lambda: np.zeros(0))
    rings: FloatArray = field(default_factory=lambda: np.zeros(0))
    chosen: int = 0


class Letters:
    """Collects the labels of a page and what they should not hide; `place` sets them all."""

    def __init__(self, page: Canvas) -> None:
        self.page = page
        self._labels: list[_Label] = []
        self._lines: list[FloatArray] = []
        self._boxes: list[tuple[float, float, float, float]] = []

    def avoid(self, points: FloatArray) -> None:
        """A polyline (k, 2) that labels should not lie on."""
        flat = np.asarray(points, dtype=float)
        self._lines += [flat[k : k + 2] for k in range(len(flat) - 1)]

    def avoid_disc(self, centre: FloatArray, radius: float) -> None:
        """A symbol that labels should not lie on."""
        x, y = float(centre[0]), float(centre[1])
        self._boxes.append((x - radius, y - radius, x + radius, y + radius))

    def add(self, at: FloatArray, text: str, clear: float = 3.0, **style: Any) -> None:
        """A label at a distance of at least `clear` points from a point (2,)."""
        style = {"fontsize": LETTER, "color": INK, "zorder": 20, **style}
        drawn = self.page.text((float(at[0]), float(at[1])), text, **style)
        self._labels.append(_Label(np.asarray(at, dtype=float), drawn, clear))

    def place(self) -> None:
        """Choose a position for every label and draw leaders; the same input gives the same output."""
        renderer = FigureCanvasAgg(self.page.figure).get_renderer()
        lines = np.array(self._lines) if self._lines else np.zeros((0, 2, 2))
        boxes = np.array(self._boxes) if self._boxes else np.zeros((0, 4))
        page = np.array([*self.page.axes.get_xlim(), *self.page.axes.get_ylim()])
        for label in self._labels:
            extent = label.text.get_window_extent(renderer)
            label.size = np.array([extent.width, extent.height])
            _candidates(label)
            label.fixed = _cost(label, lines, boxes, page)
            label.chosen = int(np.argmin(label.fixed))
        for _ in range(SWEEPS):
            for label in self._labels:
                others = np.array([item.boxes[item.chosen] for item in self._labels if item is not label])
                clash = _overlap(label.boxes, others.reshape(-1, 4)).sum(axis=1)
                label.chosen = int(np.argmin(label.fixed + 6.0 * clash))
        for label in self._labels:
            self._settle(label)

    def _settle(self, label: _Label) -> None:
        x0, y0, x1, y1 = label.boxes[label.chosen]
        label.text.set_position(((x0 + x1) / 2, (y0 + y1) / 2))
        if label.rings[label.chosen] >= LEADER_FROM:
            end = np.clip(label.at, [x0, y0], [x1, y1])
            gap = end - label.at
            start = label.at + gap * label.clear / max(float(np.linalg.norm(gap)), 1e-9)
            self.page.line(np.array([start, end]), 0.4, GREY, 19)


def _candidates(label: _Label) -> None:
    angles = 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
    way = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    half = label.size / 2 + GAP
    boxes, rings = [], []
    for ring in RINGS:
        # the centre of the box is where the box just clears a disc about the point
        reach = np.min(half / np.maximum(np.abs(way), 1e-9), axis=1)
        centre = label.at + way * (label.clear + ring + 0.85 * reach)[:, None]
        boxes.append(np.concatenate([centre - half, centre + half], axis=1))
        rings.append(np.full(DIRECTIONS, ring))
    label.boxes, label.rings = np.concatenate(boxes), np.concatenate(rings)


def _cost(label: _Label, lines: FloatArray, boxes: FloatArray, page: FloatArray) -> FloatArray:
    """What a candidate (c,) hides: length of lines, area of symbols, and how far off it is."""
    covered = np.array([_length_inside(box, lines) for box in label.boxes])
    area = _overlap(label.boxes, boxes).sum(axis=1)
    left, right, bottom, top = page
    outside = np.maximum(left - label.boxes[:, 0], 0) + np.maximum(label.boxes[:, 2] - right, 0)
    outside += np.maximum(bottom - label.boxes[:, 1], 0) + np.maximum(label.boxes[:, 3] - top, 0)
    return np.asarray(4.0 * covered + 2.0 * area + 100.0 * outside + 1.0 * label.rings)


def _overlap(first: FloatArray, second: FloatArray) -> FloatArray:
    """Areas (a, b) that boxes (a, 4) and (b, 4) share."""
    low = np.maximum(first[:, None, :2], second[None, :, :2])
    high = np.minimum(first[:, None, 2:], second[None, :, 2:])
    return np.asarray(np.prod(np.maximum(high - low, 0.0), axis=2))


def _length_inside(box: FloatArray, lines: FloatArray) -> float:
    """Total length of the parts of segments (k, 2, 2) inside a box."""
    start, way = lines[:, 0], lines[:, 1] - lines[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        first, second = (box[:2] - start) / way, (box[2:] - start) / way
    still = np.abs(way) < 1e-12
    within = (start >= box[:2]) & (start <= box[2:])
    enter = np.where(still, np.where(within, -np.inf, np.inf), np.minimum(first, second))
    leave = np.where(still, np.where(within, np.inf, -np.inf), np.maximum(first, second))
    share = np.minimum(leave.min(axis=1), 1.0) - np.maximum(enter.max(axis=1), 0.0)
    return float(np.sum(np.maximum(share, 0.0) * np.linalg.norm(way, axis=1)))


def spread(points: Sequence[FloatArray]) -> FloatArray:
    """Middle (2,) of a few points on the page."""
    return np.asarray(np.mean(np.array(points), axis=0))
