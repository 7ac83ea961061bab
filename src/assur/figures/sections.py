"""The sections of the workspace across its last coordinate, with their areas, borders and singular curves."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from assur.figures.borders import border_words, kinds
from assur.figures.context import Context
from assur.figures.coordinates import drawn_span, dress, symbol, value_words
from assur.figures.page import HIGHEST, legend_above, side_by_side
from assur.figures.plots import (
    CLOSE,
    FREE,
    curves,
    fill,
    free_coordinates,
    in_plane,
    legend_of,
    limits_words,
    mode_words,
    no_solid_workspace,
    present,
)
from assur.figures.spec import Drawing, FigureKind
from assur.figures.style import BLUE, GREY, INK, PINK, SKY, SMALL, TEXT, new_figure
from assur.figures.written import units
from assur.workspace.certified.region import unit
from assur.workspace.sections import RegionSection, cut

FloatArray = NDArray[np.float64]
BORDERS = (INK, BLUE, PINK, SKY)
LEAST = 40.0
"""Share of the page's width that a section needs at least to stand beside another, in mm."""


def _missing(context: Context) -> str:
    if no_solid_workspace(context):
        return no_solid_workspace(context)
    if context.given_workspace is not None:
        return "" if context.given_workspace.sections else "the workspace was computed without a section in its box"
    low, high = context.record.box[free_coordinates(context)[-1]]
    inside = [value for value in context.record.sections if low <= value <= high]
    return "" if inside else "the mechanism's file names no section in its box"


def _caption(context: Context) -> str:
    found = context.workspace
    areas = ", ".join(_area(*item) for item in _known_areas(context))
    name = found.box.names[-1]
    values = ", ".join(value_words(context, name, item.value) for item in found.sections)
    curved = any(
        len(in_plane(locus, len(found.box.names) - 1, item.value))
        for locus in present(found)
        for item in found.sections
    )
    rest = (
        "" if curved else " No parallel-singular surface inside the workspace of this mode was found that meets them."
    )
    return (
        f"Sections of the workspace ({mode_words(context)}) at {symbol(name)} = {values};"
        f" areas {areas} {_unit(context)}, {_known_by(context)}."
        f"{limits_words(context)}"
        " Borders are named by the margin that is zero there, with the factors that vanish with it in brackets."
        f"{rest}"
    )


def _draw(context: Context) -> Drawing:
    found = context.workspace
    names = found.sections[0].plane
    across, upward = (drawn_span(context, name) for name in names)
    left, bottom, top, gap = 13.0, 21.0, 3.0, 4.5
    count = len(found.sections)
    columns = min(side_by_side(context.page, 4, LEAST), count)
    rows = -(-count // columns)
    tallest = HIGHEST / rows - bottom - top
    wide = min((context.page - left - 3.0 - gap * (columns - 1)) / columns, tallest * across / upward)
    tall = wide * upward / across
    height = top + rows * (tall + bottom)
    figure = new_figure(context.page, height)
    used: dict[str, Line2D] = {}
    areas = _known_areas(context)
    for k, item in enumerate(found.sections):
        start = left + (k % columns) * (wide + gap)
        low = (rows - 1 - k // columns) * (tall + bottom) + bottom
        axes = figure.add_axes((start / context.page, low / height, wide / context.page, tall / height))
        _panel(context, axes, item, used)
        dress(context, axes, context.workspace.box, names)
        if k % columns:
            axes.set_ylabel("")
            axes.set_yticklabels([])
        middle = (start + wide / 2) / context.page
        title = f"({chr(97 + k)}) {symbol(item.coordinate)} = {value_words(context, item.coordinate, item.value)}"
        figure.text(middle, (low - 14.0) / height, title, ha="center", fontsize=TEXT)
        area = f"area {_area(*areas[k])} {_unit(context)}"
        figure.text(middle, (low - 18.0) / height, area, ha="center", fontsize=SMALL)
    borders = sorted(used, key=lambda name: name == "")
    legend_above(figure, [*_areas(context), *(used[name] for name in borders)])
    return Drawing(figure, _data(context))


def _panel(context: Context, axes: Axes, section: RegionSection, used: dict[str, Line2D]) -> None:
    found = context.workspace
    axis = found.box.axis(section.coordinate)
    fill(axes, section.polygons, FREE)
    fill(axes, _close(context, section)[1], CLOSE, order=2)
    keep = [found.box.axis(name) for name in section.plane]
    for k, locus in enumerate(present(found)):
        curves(axes, in_plane(locus, axis, section.value)[:, :, keep], k)
    for polygon in section.polygons:
        edges = np.stack([polygon, np.roll(polygon, -1, axis=0)], axis=1)  # (k, 2, 2)
        middles = np.full((len(edges), 3), section.value)
        middles[:, keep] = edges.mean(axis=1)
        names = kinds(context, middles)
        for name in dict.fromkeys(names):
            if name not in used:
                words = border_words(context, name, middles[names.index(name)]) if name else "box"
                colour = BORDERS[len(used.keys() - {""}) % len(BORDERS)] if name else GREY
                used[name] = Line2D(
                    [], [], color=colour, linewidth=1.2, linestyle="-" if name else (0, (3, 2)), label=words
                )
            style: dict[str, Any] = {"color": used[name].get_color(), "linestyle": used[name].get_linestyle()}
            for run in _runs(edges, [other == name for other in names]):
                axes.plot(run[:, 0], run[:, 1], linewidth=1.2, zorder=5, clip_on=False, **style)


def _areas(context: Context) -> list[Any]:
    """Handles for what the sections show: without singular curves where none meets them."""
    met = any(_close(context, item)[0] > 0 for item in context.workspace.sections)
    return legend_of(context) if met else legend_of(context, near=False, loci=False)


def _runs(edges: FloatArray, kept: list[bool]) -> list[FloatArray]:
    """Polylines of the edges (k, 2, 2) of a closed polygon that are wanted, each as long as it runs on."""
    if all(kept):
        return [np.concatenate([edges[:, 0], edges[:1, 0]])]
    start = kept.index(False)
    order = [*range(start, len(edges)), *range(start)]
    found: list[list[FloatArray]] = []
    running = False
    for k in order:
        if kept[k]:
            if not running:
                found.append([edges[k, 0]])
            found[-1].append(edges[k, 1])
        running = kept[k]
    return [np.array(run) for run in found]


def _close(context: Context, section: RegionSection) -> tuple[float, tuple[FloatArray, ...]]:
    """Area and polygons of what is near a parallel singularity in a section."""
    box = context.workspace.box
    axis = box.axis(section.coordinate)
    return cut(context.near, axis, section.value, (box.low[axis], box.high[axis]))


def _proved(context: Context) -> dict[float, tuple[float, float]]:
    """Where a section lies -> proved bounds of its area; none without a closed form."""
    found = context.bounds
    return {} if isinstance(found, str) else {item.value: item.area for item in found.sections}


def _known_areas(context: Context) -> list[tuple[float, float]]:
    """Area of each section and its error: of proved bounds where there are, else of the solids."""
    proved = _proved(context)
    return [
        (0.5 * sum(proved[item.value]), 0.5 * (proved[item.value][1] - proved[item.value][0]))
        if item.value in proved
        else (item.area, item.area_error)
        for item in context.workspace.sections
    ]


def _known_by(context: Context) -> str:
    """By what the errors of areas are known."""
    if _proved(context):
        return "with bounds that are proved"
    return "errors estimated from solids at two resolutions"


def _area(value: float, error: float) -> str:
    """A number with its error, rounded to one digit of it and up, so that it still holds; in groups of three.

    >>> _area(92749.75, 0.65), _area(0.123456, 0.00021), _area(0.0, 0.0)
    ('92 749.8 ± 0.8', '0.1235 ± 0.0003', '0')
    """
    error = max(error, 1e-9 * abs(value))
    if error == 0:
        return "0"
    digits = -int(np.floor(np.log10(error)))
    rounded = round(value, digits)
    bound = math.ceil((error + abs(rounded - value)) * 10.0**digits) / 10.0**digits
    shown = max(digits, 0)
    return f"{rounded:,.{shown}f} ± {bound:,.{shown}f}".replace(",", " ")


def _unit(context: Context) -> str:
    """Unit of the area of a section."""
    return units(unit(context.record, context.workspace.sections[0].plane))


def _data(context: Context) -> dict[str, Any]:
    found = context.workspace
    sections = []
    for item in found.sections:
        near = _close(context, item)
        sections.append(
            {
                item.coordinate: item.value,
                "plane": item.plane,
                "area": item.area,
                "area_error": item.area_error,
                "proved": _proved(context).get(item.value),
                "polygons": item.polygons,
                "near_area": near[0],
                "near": near[1],
            }
        )
    return {"unit": context.record.unit, "mode": found.mode, "near": found.near, "sections": sections}


SECTIONS = FigureKind("sections", "Sections of the workspace", _missing, _caption, _draw)
