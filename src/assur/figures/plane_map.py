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
from numpy.typing import NDArray

from assur.figures.context import Context
from assur.figures.contours import continued, draw_contours, round_levels
from assur.figures.coordinates import drawn_span, dress, plane_words, symbol, value_words
from assur.figures.page import HIGHEST, side_by_side
from assur.figures.plots import outline
from assur.figures.ridges import followed
from assur.figures.style import GREY, INK, MILLIMETRE, SMALL, TEXT, new_figure
from assur.model.pose import LENGTHS, is_angle

FloatArray = NDArray[np.float64]
COLOURS = "cividis"
SHOWN = 0.95
"""Colours, by decades, end at this quantile of what grows without bound towards a singularity."""

DECADES = 1e4
"""By this factor the ends of a bar of colours by decades differ at most."""

ACROSS, LEAST, TALLEST, LEFT = 3, 44.0, 50.0, 14.0
"""Maps in a row of panels, the share of the page's width that one needs there, the height of one at most, and the room
to the left of the first; in mm."""

FINER = 6
"""Parts of a step between two nodes where a ridge is followed."""

BELOW, BETWEEN = 10.0, 3.0
"""Room below a map in mm: for the numbers of its axis, and where the same axis stands below another map."""


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
        """E.g. "XOZ, y = 0 mm", and at what the orientation is held where the workspace leaves it out."""
        held = {**self.context.workspace.slice.held, **self.held}
        return plane_words(*self.names) + "".join(
            f", {symbol(name)} = {value_words(self.context, name, value)}" for name, value in held.items()
        )


def ridged(plane: MappedPlane, values: FloatArray) -> tuple[MappedPlane, FloatArray]:
    """A finer plane, and on it values (b, a) that grow without bound towards zeros of parallel factors, as `followed`.

    >>> import assur
    >>> from assur.workspace.region import workspace
    >>> record = assur.load("fivebar")
    >>> plane = planes(Context(record, workspace(record, resolution=16)), 8)[0]
    >>> fine, shown = ridged(plane, np.ones((8, 8)))
    >>> shown.shape == (len(fine.ys), len(fine.xs)), float(np.ptp(shown)) < 1e-12
    (True, True)
    """
    finer = plane_through(plane.context, plane.names, plane.held, FINER * (len(plane.xs) - 1) + 1)
    nodes = tuple(plane.points.reshape(-1, plane.points.shape[-1]).T)
    factors = plane.context.workspace.region.factors.values()
    sides = [np.where(field(nodes) < 0, -1.0, 1.0).reshape(values.shape) for field in factors]
    return finer, followed(values, sides, (plane.ys, plane.xs), (finer.ys, finer.xs))


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
    ridges: bool = False,
) -> QuadMesh | None:
    """A map of values (b, a): colours, white lines at levels, and lines of their own colours at marked ones, numbered.

    `ridges` says that values grow without bound towards singularities, and follows them there (`ridged`).

    All ends at the border of the workspace, which is drawn. None, and no colours, where nothing is known.
    """
    dress(plane.context, axes, plane.context.workspace.box, plane.names)
    axes.tick_params(color=GREY)
    path = outline(plane.polygons)
    if ridges:
        plane, values = ridged(plane, values)
    known = np.isfinite(values)
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
    if high - low >= 1e-6 * max(abs(low), abs(high)):
        draw_contours(axes, (plane.xs, plane.ys), shown, levels, path, marked or {})
    return image


def panels(plane: MappedPlane, titles: Sequence[str], right: float) -> tuple[Figure, list[tuple[Axes, Axes]]]:
    """A figure with a map of the same plane for each title, and beside each its bar of colours, `right` mm wide.

    The axes are the same: what they are stands left of the first and below the last map of a row and of a column.
    """
    wide, tall = plane.spans
    head, top = 5.0, 6.5
    columns = side_by_side(plane.context.page, ACROSS, LEAST)
    rows = math.ceil(len(titles) / columns)
    below = [BELOW if (k + 2) * columns > len(titles) else BETWEEN for k in range(rows)]  # the last of some column
    tallest = min(TALLEST, (HIGHEST - head - sum(below)) / rows - top)
    cell = (plane.context.page - LEFT) / columns  # as large as where there are more
    scale = min((cell - right) / wide, tallest / tall)
    page = LEFT + cell * min(columns, len(titles))
    height = head + sum(below) + rows * (top + scale * tall)
    figure = new_figure(page, height)
    headed(figure, plane)
    pairs = []
    for k, title in enumerate(titles):
        line, column = divmod(k, columns)
        x = LEFT + column * cell
        y = height - head - (line + 1) * (top + scale * tall) - sum(below[:line])
        axes = figure.add_axes((x / page, y / height, scale * wide / page, scale * tall / height))
        bar = figure.add_axes(((x + scale * wide + 2.0) / page, y / height, 2.5 / page, scale * tall / height))
        middle, above = (x + scale * wide / 2) / page, (y + scale * tall + 1.5) / height
        figure.text(middle, above, f"({chr(97 + k)}) {title}", ha="center", fontsize=TEXT)
        for axis, shown in ((axes.yaxis, column == 0), (axes.xaxis, k + columns >= len(titles))):
            axis.label.set_visible(shown)
            axis.set_tick_params(labelleft=shown, labelbottom=shown)
        pairs.append((axes, bar))
    return figure, pairs


def row(
    planes: Sequence[MappedPlane], titles: Sequence[str], *, gap: float, bottom: float, right: float, tallest: float
) -> tuple[Figure, list[Axes], Axes]:
    """A figure with maps of planes, true to one scale, their titles below, and one bar of colours for all of them.

    They stand side by side, or on a narrow page below one another. Lengths are in mm: between two maps, below them, to
    the right for the bar, and the height of a map at most.
    """
    page, top = planes[0].context.page, 5.0
    beside = side_by_side(page, len(planes), LEAST) == len(planes)
    lines = [list(planes)] if beside else [[plane] for plane in planes]
    tallest = min(tallest, (HIGHEST - top) / len(lines) - bottom)
    scale, across = tallest / max(plane.spans[1] for plane in planes), 0.0
    for line in lines:
        wide = sum(plane.spans[0] for plane in line)
        scale = min(scale, (page - LEFT - right - gap * (len(line) - 1)) / wide)
        across = max(across, wide)
    drawn = scale * across + gap * (len(planes) - 1) * beside
    heights = [bottom + scale * max(plane.spans[1] for plane in line) for line in lines]
    width, height = LEFT + right + drawn, sum(heights) + top
    figure = new_figure(width, height)
    maps: list[Axes] = []
    for k, line in enumerate(lines):
        start, low = LEFT, sum(heights[k + 1 :])
        for plane in line:
            wide, tall = (scale * span for span in plane.spans)
            place = (start / width, (low + bottom) / height, wide / width, tall / height)
            title = f"({chr(97 + len(maps))}) {titles[len(maps)]}"
            maps.append(figure.add_axes(place))
            figure.text((start + wide / 2) / width, (low + 1.5) / height, title, ha="center", fontsize=TEXT)
            start += wide + gap
    place = ((width - right + 5.0) / width, bottom / height, 3.5 / width, (height - top - bottom) / height)
    return figure, maps, figure.add_axes(place)


def headed(figure: Figure, plane: MappedPlane) -> None:
    """The name of a plane over the maps of it."""
    width, height = figure.get_size_inches() / MILLIMETRE
    figure.text(LEFT / width, 1.0 - 3.5 / height, plane.words, fontsize=TEXT)


def with_bar(
    pair: tuple[Axes, Axes],
    image: QuadMesh | None,
    otherwise: str,
    extend: Literal["max", "neither"] = "neither",
    levels: Sequence[float] = (),
) -> None:
    """The bar of colours beside a map, with a white line at each of its levels; where there are none, words in the map.

    In a small map few lines have room for their number: ticks stand at levels, as far as there is room beside the bar.
    """
    axes, bar = pair
    if image is None:
        bar.set_axis_off()
        axes.text(0.5, 0.5, otherwise, transform=axes.transAxes, ha="center", va="center", fontsize=SMALL)
        return
    colours = image.figure.colorbar(image, cax=bar, extend=extend)
    scale, rounds = image.norm, [0.0, *levels, *(end for end in (1.0,) if end == image.norm.vmax)]
    if isinstance(scale, LogNorm):
        top = float(scale.vmax or 1.0)
        rounds = [*round_levels(scale, 6), *(end for end in (top,) if float(f"{end:.1g}") == end)]
    if isinstance(scale, Normalize) and len(rounds) > 1:
        height = bar.get_window_extent().height / image.figure.dpi * 72.0
        ticks = apart(rounds, scale, height / (1.3 * SMALL))
        colours.set_ticks(ticks, labels=[_tick_words(tick) for tick in ticks])
        colours.minorticks_off()
    for level in levels:
        bar.axhline(level, color="white", linewidth=0.5)
    bar.tick_params(labelsize=SMALL)


def _tick_words(tick: float) -> str:
    """A level on a scale by decades; far from 1 it is a power of ten."""
    mantissa, exponent = f"{tick:.0e}".split("e")
    if -4 < int(exponent) < 4:
        return f"{tick:.4g}"
    return rf"${'' if mantissa == '1' else mantissa + chr(92) + 'cdot'}10^{{{int(exponent)}}}$"


def apart(ticks: Sequence[float], colours: Normalize, lines: float) -> list[float]:
    """Of ticks on a scale as many as there are lines of text beside it for them, from below.

    >>> apart([1.0, 2.0, 5.0, 10.0], LogNorm(1.0, 10.0), 2.5)
    [1.0, 5.0]
    """
    kept: list[float] = []
    for tick in ticks:
        if not kept or lines * float(colours(tick) - colours(kept[-1])) >= 1.0:
            kept.append(tick)
    return kept


def scale_of(known: FloatArray, *, unbounded: bool) -> Normalize:
    """Colours of known values (k,): from 0 to the largest; by decades up to a quantile of what grows without bound.

    >>> scale_of(np.array([1.0, 2.0]), unbounded=False).vmax, type(scale_of(np.arange(1, 9.0), unbounded=True)).__name__
    (2.0, 'LogNorm')
    """
    positive = known[(known > 0) & np.isfinite(known)]
    if not len(positive):
        return Normalize(0.0, 1.0)
    if not unbounded:
        return Normalize(0.0, float(np.max(positive)))
    low, top = float(np.min(positive)), float(np.quantile(positive, SHOWN))
    low = max(low, top / DECADES)
    return LogNorm(low, top) if low < top else Normalize(0.0, top)


def beyond(top: float, *values: FloatArray) -> Literal["max", "neither"]:
    """The end of a bar of colours: an arrow where there are values beyond it.

    >>> beyond(2.0, np.array([1.0, np.nan]), np.array([3.0])), beyond(3.0, np.array([1.0, 3.0]))
    ('max', 'neither')
    """
    return "max" if any(np.any(item > top * (1 + 1e-9)) for item in values) else "neither"
