"""Maps over a plane through the workspace: the plane, its nodes, and colours that end exactly at the border."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import LogNorm, Normalize
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt

from assur.figures.context import Context
from assur.figures.coordinates import drawn_span, dress, plane_words, symbol, value_words
from assur.figures.plots import outline
from assur.figures.style import GREY, INK, MILLIMETRE, PAGE, SMALL, TEXT, new_figure
from assur.model.pose import LENGTHS, is_angle

FloatArray = NDArray[np.float64]
COLOURS = "cividis"
PLAIN = 10.0
"""A bar of colours by decades has plain numbers where its ends differ by less than this factor."""
SHOWN = 0.75
"""Colours end at this quantile of what grows without bound towards a singularity."""

ACROSS, TALLEST, LEFT = 3, 50.0, 14.0
"""Maps in a row of panels, the height of one in mm at most, and the room to the left of the first."""


@dataclass(frozen=True, eq=False)
class MappedPlane:
    """A plane through the workspace of a context and the nodes at which something is mapped.

    Attributes:
        context: whose workspace.
        names: the two coordinates, to the right and upwards.
        held: the third coordinate -> its value; empty in a plane workspace.
        xs, ys: nodes (a,) and (b,) along both.
    """

    context: Context
    names: tuple[str, str]
    held: Mapping[str, float]
    xs: FloatArray
    ys: FloatArray

    @cached_property
    def points(self) -> FloatArray:
        """The nodes as points of the workspace (b, a, coordinates)."""
        known: dict[str, FloatArray | float] = {**self.held, self.names[0]: self.xs, self.names[1]: self.ys[:, None]}
        shape = len(self.ys), len(self.xs)
        return np.stack([np.broadcast_to(known[name], shape) for name in self.context.workspace.box.names], axis=-1)

    @cached_property
    def polygons(self) -> list[FloatArray]:
        """The border of the workspace in the plane, polygons (n, 2) in the order of the names."""
        region = self.context.workspace
        kept = [name for name in region.box.names if name in self.names]
        cut = [name for name in region.box.names if name not in self.names]
        polygons = region.section(self.held[cut[0]], cut[0]).polygons if cut else region.projection(*kept).polygons
        return [polygon[:, [kept.index(name) for name in self.names]] for polygon in polygons]

    @property
    def spans(self) -> tuple[float, float]:
        """Width and height as they are drawn, before they are scaled to the page."""
        return drawn_span(self.context, self.names[0]), drawn_span(self.context, self.names[1])

    @property
    def words(self) -> str:
        """E.g. "XOZ, y = 0 mm"."""
        return plane_words(*self.names) + "".join(
            f", {symbol(name)} = {value_words(self.context, name, value)}" for name, value in self.held.items()
        )


def planes(context: Context, nodes: int) -> list[MappedPlane]:
    """The planes through the middle of the workspace: all of a plane one, of one in space two that meet in it."""
    box = context.workspace.box
    if len(box.names) == 2:
        return [plane_through(context, box.names, {}, nodes)]
    first, second, third = box.names
    middle = {name: (low + high) / 2 for name, (low, high) in zip(box.names, box.intervals, strict=True)}
    sections = [item.value for item in context.workspace.sections if item.area > 0]
    level = sections[len(sections) // 2] if sections else middle[third]
    return [
        plane_through(context, (first, third), {second: middle[second]}, nodes),
        plane_through(context, (first, second), {third: level}, nodes),
    ]


def plane_of_lengths(context: Context, nodes: int) -> MappedPlane:
    """That of two lengths among these where there is one, else the first."""
    chosen = planes(context, nodes)
    return next((plane for plane in chosen if set(plane.names) <= set(LENGTHS)), chosen[0])


def plane_of_tilts(context: Context, nodes: int) -> MappedPlane:
    """That of two angles where there is one, at the middle of a third coordinate, else the first."""
    box = context.workspace.box
    angles = [name for name in box.names if is_angle(name)]
    if len(angles) == 2 and len(box.names) == 3:
        third = next(name for name in box.names if name not in angles)
        return plane_through(context, angles, {third: sum(box.intervals[box.axis(third)]) / 2}, nodes)
    return planes(context, nodes)[0]


def plane_through(context: Context, names: Sequence[str], held: Mapping[str, float], nodes: int) -> MappedPlane:
    """The plane of two coordinates over the box of the workspace, the third held."""
    box = context.workspace.box
    xs, ys = (np.linspace(box.low[box.axis(name)], box.high[box.axis(name)], nodes) for name in names)
    return MappedPlane(context, (names[0], names[1]), held, xs, ys)


def coloured(
    axes: Axes,
    plane: MappedPlane,
    values: FloatArray,
    colours: Normalize,
    palette: str = COLOURS,
    levels: Sequence[float] = (),
    marked: Mapping[float, str] | None = None,
) -> QuadMesh | None:
    """A map of values (b, a): colours, white lines at levels, and lines of their own colours at marked ones.

    All ends at the border of the workspace, which is drawn. None, and no colours, where nothing is known.
    """
    dress(plane.context, axes, plane.context.workspace.box, plane.names)
    axes.tick_params(color=GREY)
    path, known = outline(plane.polygons), np.isfinite(values)
    if path is None:
        return None
    border = PathPatch(path, facecolor="none", edgecolor=INK, linewidth=0.8, zorder=5)
    axes.add_patch(border)
    if not np.any(known):
        return None
    shown = continued(values)
    image = axes.pcolormesh(plane.xs, plane.ys, shown, cmap=palette, norm=colours, shading="gouraud")
    image.set_clip_path(border)
    image.set_rasterized(True)
    low, high = float(np.min(values[known])), float(np.max(values[known]))
    if levels and high - low >= 1e-6 * max(abs(low), abs(high)):
        axes.contour(plane.xs, plane.ys, shown, levels=levels, colors="white", linewidths=0.5).set_clip_path(border)
    for level, colour in (marked or {}).items():
        if low < level < high:
            line = axes.contour(plane.xs, plane.ys, shown, levels=[level], colors=colour, linewidths=1.4)
            line.set_clip_path(border)
    return image


def panels(plane: MappedPlane, titles: Sequence[str], right: float) -> tuple[Figure, list[tuple[Axes, Axes]]]:
    """A figure with a map of the same plane for each title, and beside each its bar of colours, `right` mm wide."""
    wide, tall = plane.spans
    left, bottom, top = LEFT, 13.0, 7.0
    scale = min((PAGE / ACROSS - left - right) / wide, TALLEST / tall)
    cell, row = PAGE / ACROSS, bottom + top + scale * tall
    height = math.ceil(len(titles) / ACROSS) * row + 5.0
    figure = new_figure(PAGE, height)
    headed(figure, plane)
    pairs = []
    for k, title in enumerate(titles):
        x, y = (k % ACROSS) * cell + left, height - 5.0 - (k // ACROSS) * row - top - scale * tall
        axes = figure.add_axes((x / PAGE, y / height, scale * wide / PAGE, scale * tall / height))
        bar = figure.add_axes(((x + scale * wide + 2.0) / PAGE, y / height, 2.5 / PAGE, scale * tall / height))
        middle, above = (x + scale * wide / 2) / PAGE, (y + scale * tall + 1.5) / height
        figure.text(middle, above, f"({chr(97 + k)}) {title}", ha="center", fontsize=TEXT)
        pairs.append((axes, bar))
    return figure, pairs


def row(
    planes: Sequence[MappedPlane], titles: Sequence[str], *, gap: float, bottom: float, right: float, tallest: float
) -> tuple[Figure, list[Axes], Axes]:
    """A figure with maps of planes side by side, true to one scale, their titles below, and one bar of colours.

    Lengths are in mm: between two maps, below them, to the right for the bar, and the height of a map at most.
    """
    left, top, spans = LEFT, 5.0, [plane.spans for plane in planes]
    between = gap * (len(planes) - 1)
    across, upward = sum(wide for wide, _ in spans), max(tall for _, tall in spans)
    scale = min(tallest / upward, (PAGE - left - right - between) / across)
    width, height = left + right + between + scale * across, bottom + top + scale * upward
    figure, maps, start = new_figure(width, height), [], left
    for k, ((wide, tall), title) in enumerate(zip(spans, titles, strict=True)):
        maps.append(figure.add_axes((start / width, bottom / height, scale * wide / width, scale * tall / height)))
        middle = (start + scale * wide / 2) / width
        figure.text(middle, 1.5 / height, f"({chr(97 + k)}) {title}", ha="center", fontsize=TEXT)
        start += scale * wide + gap
    bar = figure.add_axes(((width - right + 5.0) / width, bottom / height, 3.5 / width, scale * upward / height))
    return figure, maps, bar


def headed(figure: Figure, plane: MappedPlane) -> None:
    """The name of a plane over the maps of it."""
    width, height = figure.get_size_inches() / MILLIMETRE
    figure.text(LEFT / width, 1.0 - 3.5 / height, plane.words, fontsize=TEXT)


def with_bar(
    pair: tuple[Axes, Axes], image: QuadMesh | None, otherwise: str, extend: Literal["max", "neither"] = "neither"
) -> None:
    """The bar of colours beside a map; where there are none, words in the map."""
    axes, bar = pair
    if image is None:
        bar.set_axis_off()
        axes.text(0.5, 0.5, otherwise, transform=axes.transAxes, ha="center", va="center", fontsize=SMALL)
        return
    colours = image.figure.colorbar(image, cax=bar, extend=extend)
    low, high = image.get_clim()
    if isinstance(image.norm, LogNorm) and high < PLAIN * low:
        ticks = [tick for tick in MaxNLocator(6).tick_values(low, high) if low <= tick <= high]
        colours.set_ticks(ticks, labels=[f"{tick:.4g}" for tick in ticks])
        colours.minorticks_off()
    bar.tick_params(labelsize=SMALL)


def beyond(top: float, *values: FloatArray) -> Literal["max", "neither"]:
    """The end of a bar of colours: an arrow where there are values beyond it.

    >>> beyond(2.0, np.array([1.0, np.nan]), np.array([3.0])), beyond(3.0, np.array([1.0, 3.0]))
    ('max', 'neither')
    """
    return "max" if any(np.any(item > top * (1 + 1e-9)) for item in values) else "neither"


def continued(values: FloatArray) -> FloatArray:
    """Values with those of the nearest node where there are none, so that colours reach the border."""
    nearest = distance_transform_edt(~np.isfinite(values), return_distances=False, return_indices=True)
    return np.asarray(values[tuple(nearest)])
