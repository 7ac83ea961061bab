"""Placing letters: each beside its point, where it hides least; further off with a thin leader where it must."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text
from numpy.typing import NDArray

from assur.figures.canvas import Canvas
from assur.figures.style import GREY, INK, LETTER

FloatArray = NDArray[np.float64]
DIRECTIONS = 24
RINGS = (0.0, 2.0, 5.0, 9.0, 14.0, 20.0, 28.0)
LEADER_FROM = 8.0
SWEEPS = 4
SHARES = (0.5, 0.42, 0.58, 0.34, 0.66, 0.26, 0.74)
GAP = 1.0
"""Distances in points."""


@dataclass(eq=False)
class _Label:
    anchors: FloatArray
    text: Text
    clear: float
    own: FloatArray | None = None
    size: FloatArray = field(default_factory=lambda: np.zeros(2))
    boxes: FloatArray = field(default_factory=lambda: np.zeros((0, 4)))
    fixed: FloatArray = field(default_factory=lambda: np.zeros(0))
    rings: FloatArray = field(default_factory=lambda: np.zeros(0))
    feet: FloatArray = field(default_factory=lambda: np.zeros((0, 2)))
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

    def avoid_box(self, corners: FloatArray) -> None:
        """The box about some points (k, 2) that labels should not lie on."""
        low, high = np.min(corners, axis=0), np.max(corners, axis=0)
        self._boxes.append((float(low[0]), float(low[1]), float(high[0]), float(high[1])))

    def add(self, at: FloatArray, text: str, clear: float = 3.0, **style: Any) -> None:
        """A label at a distance of at least `clear` points from a point (2,), or one of (k, 2), the first rather."""
        anchors = np.reshape(at, (-1, 2))
        self._labels.append(_Label(anchors, self._text(anchors[0], text, style), clear))

    def add_along(self, ends: FloatArray, text: str, clear: float = 3.0, **style: Any) -> None:
        """A label beside the line between two ends (2, 2), nearer to it than to any other line."""
        flat = np.asarray(ends, dtype=float)
        anchors = flat[0] + np.array(SHARES)[:, None] * (flat[1] - flat[0])
        self._labels.append(_Label(anchors, self._text(anchors[0], text, style), clear, flat))

    def _text(self, at: FloatArray, text: str, style: dict[str, Any]) -> Text:
        style = {"fontsize": LETTER, "color": INK, "zorder": 20, **style}
        drawn: Text = self.page.text((float(at[0]), float(at[1])), text, **style)
        return drawn

    def place(self) -> None:
        """Choose a position for every label and draw leaders; the same input gives the same output."""
        renderer = FigureCanvasAgg(self.page.figure).get_renderer()  # type: ignore[no-untyped-call]  # matplotlib does not say
        lines = np.array(self._lines) if self._lines else np.zeros((0, 2, 2))
        boxes = np.array(self._boxes) if self._boxes else np.zeros((0, 4))
        page = np.array([*self.page.axes.get_xlim(), *self.page.axes.get_ylim()])
        for label in self._labels:
            patch = label.text.get_bbox_patch()
            if patch is not None:
                label.text.update_bbox_position_size(renderer)
            extent = (patch or label.text).get_window_extent(renderer)
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
            foot = label.feet[label.chosen]
            gap = np.clip(foot, [x0, y0], [x1, y1]) - foot
            start = foot + gap * label.clear / max(float(np.linalg.norm(gap)), 1e-9)
            style: Any = {"path_effects": label.text.get_path_effects()} if label.text.get_path_effects() else {}
            self.page.line(np.array([start, foot + gap]), 0.4, INK if style else GREY, 19, **style)


def _candidates(label: _Label) -> None:
    angles = 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
    way = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    half = label.size / 2 + GAP
    # the centre of the box is where the box just clears a disc about the point
    reach = np.min(half / np.maximum(np.abs(way), 1e-9), axis=1)
    every = RINGS if label.own is None else RINGS[:5]
    feet = np.repeat(label.anchors, len(every) * DIRECTIONS, axis=0)
    rings = np.tile(np.repeat(every, DIRECTIONS), len(label.anchors))
    away = label.clear + rings + np.resize(0.85 * reach, len(rings))
    centres = feet + np.resize(way, feet.shape) * away[:, None]
    label.boxes = np.concatenate([centres - half, centres + half], axis=1)
    label.rings, label.feet = rings, feet


def _cost(label: _Label, lines: FloatArray, boxes: FloatArray, page: FloatArray) -> FloatArray:
    """What a candidate (c,) hides: length of lines, area of symbols, how far off it is, and what it is nearer to."""
    covered = _length_inside(label.boxes, lines)
    area = _overlap(label.boxes, boxes).sum(axis=1)
    left, right, bottom, top = page
    outside = np.maximum(left - label.boxes[:, 0], 0) + np.maximum(label.boxes[:, 2] - right, 0)
    outside += np.maximum(bottom - label.boxes[:, 1], 0) + np.maximum(label.boxes[:, 3] - top, 0)
    cost = 4.0 * covered + 2.0 * area + 100.0 * outside + 1.0 * label.rings
    slid = np.linalg.norm(label.feet - label.anchors[0], axis=1)
    if label.own is not None:
        centres = (label.boxes[:, :2] + label.boxes[:, 2:]) / 2
        others = np.array([line for line in lines if not np.allclose(line, label.own)]).reshape(-1, 2, 2)
        gap = np.min(_distances(centres, others), axis=1, initial=np.inf)
        cost += 8.0 * np.maximum(_distances(centres, label.own[None])[:, 0] + 3.0 - gap, 0.0)
    return np.asarray(cost + 0.05 * slid)


def _distances(points: FloatArray, lines: FloatArray) -> FloatArray:
    """Distances (p, k) of points (p, 2) from segments (k, 2, 2)."""
    start, way = lines[:, 0], lines[:, 1] - lines[:, 0]
    to = points[:, None] - start[None]
    share = np.clip(np.sum(to * way, axis=2) / np.maximum(np.sum(way * way, axis=1), 1e-12), 0.0, 1.0)
    return np.asarray(np.linalg.norm(to - share[..., None] * way, axis=2))


def _overlap(first: FloatArray, second: FloatArray) -> FloatArray:
    """Areas (a, b) that boxes (a, 4) and (b, 4) share."""
    sides = [
        np.maximum(
            np.minimum(first[:, None, k + 2], second[:, k + 2]) - np.maximum(first[:, None, k], second[:, k]),
            0.0,
        )
        for k in (0, 1)
    ]
    return np.asarray(sides[0] * sides[1])


def _length_inside(boxes: FloatArray, lines: FloatArray) -> FloatArray:
    """Total length (c,) of the parts of segments (k, 2, 2) inside each of the boxes (c, 4)."""
    start, way = lines[:, 0], lines[:, 1] - lines[:, 0]
    low, high = boxes[:, None, :2], boxes[:, None, 2:]
    still = np.abs(way) < 1e-12
    safe = np.where(still, 1.0, way)
    first, second = (low - start) / safe, (high - start) / safe
    within = (start >= low) & (start <= high)
    enter = np.where(still, np.where(within, -np.inf, np.inf), np.minimum(first, second))
    leave = np.where(still, np.where(within, np.inf, -np.inf), np.maximum(first, second))
    share = np.minimum(leave.min(axis=2), 1.0) - np.maximum(enter.max(axis=2), 0.0)
    return np.asarray(np.maximum(share, 0.0) @ np.linalg.norm(way, axis=1))
