"""The canvas: a page measured in points, and views that put space on it, so that symbols keep their size."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyArrowPatch, Polygon
from numpy.typing import NDArray

from assur.figures.style import GREY, INK, MILLIMETRE, PAPER, new_figure
from assur.scene.camera import Camera

FloatArray = NDArray[np.float64]
POINTS = 72 * MILLIMETRE
"""Points in one mm."""


@dataclass(frozen=True, eq=False)
class View:
    """A camera with a scale (points per unit of length) and an offset (2,) in points."""

    camera: Camera
    scale: float
    offset: FloatArray

    def __call__(self, points: FloatArray) -> FloatArray:
        """Positions (..., 2) on the page, in points, of points (..., 3) in space."""
        return self.scale * self.camera.project(points) + self.offset


@dataclass(frozen=True, eq=False)
class Canvas:
    """A figure with one axes over all of it, whose unit is the point (1/72 inch)."""

    figure: Figure
    axes: Axes

    def line(self, points: FloatArray, width: float = 1.0, colour: str = INK, order: float = 2.0, **more: Any) -> None:
        """A polyline (k, 2)."""
        flat = np.asarray(points, dtype=float)
        more.setdefault("solid_capstyle", "round")
        self.axes.plot(flat[:, 0], flat[:, 1], color=colour, linewidth=width, zorder=order, **more)

    def polygon(
        self,
        corners: FloatArray,
        fill: str = PAPER,
        edge: str = INK,
        width: float = 0.8,
        order: float = 2.0,
        **more: Any,
    ) -> None:
        """A closed polygon (k, 2)."""
        patch = Polygon(corners, closed=True, facecolor=fill, edgecolor=edge, linewidth=width, zorder=order, **more)
        self.axes.add_patch(patch)

    def disc(
        self,
        centre: FloatArray,
        radius: float,
        fill: str = PAPER,
        edge: str = INK,
        width: float = 0.8,
        order: float = 2.0,
    ) -> None:
        """A disc."""
        patch = Circle((centre[0], centre[1]), radius, facecolor=fill, edgecolor=edge, linewidth=width, zorder=order)
        self.axes.add_patch(patch)

    def arrow(
        self,
        start: FloatArray,
        end: FloatArray,
        colour: str = INK,
        width: float = 0.8,
        order: float = 3.0,
        style: str = "-|>",
        head: float = 6.0,
        **more: Any,
    ) -> None:
        """An arrow from start (2,) to end (2,)."""
        patch = FancyArrowPatch(
            (start[0], start[1]),
            (end[0], end[1]),
            arrowstyle=style,
            mutation_scale=head,
            color=colour,
            linewidth=width,
            zorder=order,
            shrinkA=0,
            shrinkB=0,
            **more,
        )
        self.axes.add_patch(patch)

    def text(self, at: Sequence[float] | FloatArray, text: str, **more: Any) -> Any:
        """Text; centred unless told otherwise."""
        more.setdefault("ha", "center")
        more.setdefault("va", "center")
        more.setdefault("zorder", 20)
        return self.axes.text(at[0], at[1], text, **more)


def canvas(width: float, height: float) -> Canvas:
    """An empty canvas of width x height mm."""
    figure = new_figure(width, height)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set_axis_off()
    axes.set_xlim(0.0, width * POINTS)
    axes.set_ylim(0.0, height * POINTS)
    return Canvas(figure, axes)


class TextWidths:
    """Widths of texts in points.

    >>> widths = TextWidths()
    >>> widths("iii", 8.0) < widths("mmm", 8.0) < widths("mmm", 9.0)
    True
    """

    def __init__(self) -> None:
        self._figure = new_figure(10, 10)
        self._renderer = FigureCanvasAgg(self._figure).get_renderer()  # type: ignore[no-untyped-call]  # matplotlib does not say

    def __call__(self, text: str, size: float) -> float:
        """That of a text at a size of letters in points."""
        return float(self._figure.text(0, 0, text, fontsize=size).get_window_extent(self._renderer).width)


def fitted(camera: Camera, cloud: FloatArray, width: float, tallest: float, margin: float = 8.0) -> tuple[View, Canvas]:
    """A canvas at most width x tallest mm for a cloud (k, 3) with margins, and the view that fills it.

    A canvas of a narrow cloud is half as wide at least. A cloud in one point is in its middle, a unit of length being a
    quarter of its height.

    >>> from assur.scene.camera import plane
    >>> view, page = fitted(plane("x", "y"), np.array([[0.0, 0, 0], [2, 1, 0]]), width=40, tallest=90, margin=10)
    >>> (page.figure.get_size_inches() / MILLIMETRE).round(9).tolist(), (view(np.zeros(3)) / POINTS).round(9).tolist()
    ([40.0, 30.0], [10.0, 10.0])
    """
    flat = camera.project(cloud)
    low, high = flat.min(axis=0), flat.max(axis=0)
    span = high - low if np.any(high > low) else np.full(2, 4.0)
    span = np.maximum(span, 1e-300)
    scale = min((width - 2 * margin) / span[0], (tallest - 2 * margin) / span[1])
    sides = np.maximum(scale * span + 2 * margin, [width / 2, 0.0])
    view = View(camera, scale * POINTS, POINTS * (sides / 2 - scale * (low + high) / 2))
    return view, canvas(float(sides[0]), float(sides[1]))


def inside(camera: Camera, cloud: FloatArray, rectangle: tuple[float, float, float, float]) -> View:
    """The view in which a cloud (k, 3) is centred in a rectangle (left, bottom, width, height) in mm."""
    flat = camera.project(cloud)
    low, high = flat.min(axis=0), flat.max(axis=0)
    left, bottom, width, height = rectangle
    span = np.maximum(high - low, 1e-300)
    scale = float(min(width * POINTS / span[0], height * POINTS / span[1]))
    centre = np.array([left + width / 2, bottom + height / 2]) * POINTS
    return View(camera, scale, centre - scale * (low + high) / 2)


def guide(page: Canvas, points: FloatArray, order: float = 1.0) -> None:
    """A thin dash-dotted line: an axis, or a direction that an angle is measured from."""
    page.line(points, 0.5, GREY, order, linestyle=(0, (6, 2, 1, 2)), solid_capstyle="butt")
