"""The aspects of a working mode: a plane, or cuts through space, in which each aspect has its colour and its label."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, PathPatch
from matplotlib.patheffects import withStroke
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from assur.errors import UsageError
from assur.figures.aspect_parts import TracedPlane, listed, rectangles, traced, united
from assur.figures.context import Context
from assur.figures.contours import filled
from assur.figures.coordinates import dress, symbol, value_words
from assur.figures.page import HIGHEST, legend_above, side_by_side
from assur.figures.plots import limits_words, no_workspace, outline
from assur.figures.singular import symbol_of
from assur.figures.spec import Drawing, FigureKind
from assur.figures.style import INK, PALE, PAPER, SERIES, SMALL, TEXT, new_figure
from assur.figures.written import at_least, units
from assur.model.pose import is_angle
from assur.results.typeset_text import minus
from assur.workspace.aspects.aspects import KINDS, Aspect, Aspects
from assur.workspace.aspects.path import AspectPath
from assur.workspace.certified.boxes import Boxes
from assur.workspace.certified.criteria import criteria

FloatArray = NDArray[np.float64]

CUTS = 4
"""Sections through space where the mechanism's file names none."""

HATCHES = ("", "////", "\\\\\\\\", "....", "xxxx")
"""Beyond the colours aspects are told apart by these, and always by their labels."""

NAMED = 10
"""Aspects in the legend, the largest first."""

PATCH = 0.003
"""An aspect has its label in a cut where it covers so much of the panel."""

LARGE = 0.7
"""Places this share of the largest distance away from the outline are far enough for a label."""

LEFT, BOTTOM, TITLE, TOP, GAP, PANEL, LEAST = 14.0, 11.0, 8.0, 3.0, 6.0, 70.0, 60.0
"""Margins, the room for a title below a panel, that between panels and the width of one, in mm."""


def drawn(context: Context, aspects: Aspects, path: AspectPath | None = None) -> Drawing:
    """The figure of the aspects, with a path between two poses where one is given and the aspects lie in a plane.

    Errors:
        UsageError: only one coordinate matters.

    >>> from assur.model.registry import load_record
    >>> from assur.figures.style import styled
    >>> from assur.workspace.aspects.aspects import aspects
    >>> record = load_record("fivebar")
    >>> with styled():
    ...     drawn(Context(record), aspects(record)).data["aspects"][0]["label"]
    '+'
    """
    if len(aspects.names) < 2:
        raise UsageError(f"only {aspects.names[0]} matters for these aspects; a picture needs two coordinates")
    across, upward = aspects.names[:2]
    cuts = _cuts(context, aspects)
    whole = float(np.prod([np.ptp(aspects.box.intervals[aspects.box.axis(name)]) for name in (across, upward)]))
    columns = min(side_by_side(context.page, 2, LEAST), len(cuts))
    rows = -(-len(cuts) // columns)
    below = BOTTOM + (TITLE if len(aspects.names) > 2 else 0.0)
    room = (context.page - LEFT - 4.0 - (columns - 1) * (GAP + LEFT)) / columns
    slope = _aspect(aspects, across, upward)
    wide = min(PANEL, room, ((HIGHEST - TOP) / rows - below) / slope)
    tall = wide * slope
    width = LEFT + columns * wide + (columns - 1) * (GAP + LEFT) + 4.0
    height = TOP + rows * (tall + below)
    figure = new_figure(width, height)
    planes = [traced(context, aspects, value) for value in cuts]
    for k, (value, plane) in enumerate(zip(cuts, planes, strict=True)):
        start = LEFT + (k % columns) * (wide + GAP + LEFT)
        low = (rows - 1 - k // columns) * (tall + below) + below
        axes = figure.add_axes((start / width, low / height, wide / width, tall / height))
        _panel(axes, aspects, value, PATCH * whole, plane)
        if path is not None and value is None:
            _way(axes, path)
        dress(context, axes, aspects.box, (across, upward))
        if value is not None:
            title = f"({chr(97 + k)}) {symbol(aspects.names[2])} = {value_words(context, aspects.names[2], value)}"
            figure.text((start + wide / 2) / width, (low - 14.0) / height, title, ha="center", fontsize=TEXT)
    signs = f"signs of {_factors(context, aspects)}" if aspects.naming else None
    legend_above(figure, _legend(aspects, planes, path if cuts == [None] else None), title=signs, title_fontsize=SMALL)
    return Drawing(figure, _data(aspects, cuts, path))


def caption(context: Context, aspects: Aspects) -> str:
    """What the figure shows, in words."""
    signs = _factors(context, aspects) or "no factor"
    of_mode = f" of the working mode {minus(aspects.mode)}" if aspects.mode else ""
    held = ", ".join(
        f"{symbol(name)} = {value_words(context, name, value)}" for name, value in aspects.slice.held.items()
    )
    return (
        f"Aspects{of_mode}{f' with {held}' if held else ''} inside the box of the mechanism's file: parts without a"
        f" parallel or serial singularity, named by the signs of {signs}.{limits_words(context)} {_parts(aspects)}"
    )


def _parts(aspects: Aspects) -> str:
    """How much of the workspace is proved, at least, and what may be undecided, at most."""
    if not aspects.aspects:
        return "No part is proved; what there may be of the workspace lies in the grey."
    size = f"{at_least(math.fsum(item.volume[0] for item in aspects.aspects))} {units(aspects.unit)}"
    open_ = shown(100 * aspects.undecided_share)
    least = f"{100 - float(open_):.4g}"
    return (
        f"Lines are traced: the border, and inside it where a factor is zero. At least {size} or {least} % of the"
        f" workspace are proved; the rest, at most {open_} %, is undecided and lies along the lines or in the grey."
    )


def _factors(context: Context, aspects: Aspects) -> str:
    """The factors that name the aspects, as mathematics."""
    form = context.record.closed_form
    known = {item.name: symbol_of(item) for item in form.factor_list} if form else {}
    return ", ".join(known.get(name, name) for name in aspects.naming)


def shown(share: float) -> str:
    """A share to two digits, rounded up.

    >>> shown(35.71), shown(0.0123), shown(0.0)
    ('36', '0.013', '0')
    """
    if share == 0:
        return "0"
    digits = 1 - math.floor(math.log10(share))
    return f"{math.ceil(share * 10.0**digits) / 10.0**digits:.{max(digits, 0)}f}"


def no_aspects(context: Context) -> str:
    """Why a mechanism has no picture of aspects; empty where it has."""
    if no_workspace(context):
        return no_workspace(context)
    if context.record.closed_form is None:
        return "aspects are proved by a closed form"
    return "" if sum(criteria(context.record, factors=KINDS).used) > 1 else "its aspects depend on one coordinate only"


def _cuts(context: Context, aspects: Aspects) -> list[float | None]:
    """Where the third coordinate is cut; None in a plane."""
    if len(aspects.names) == 2:
        return [None]
    last = aspects.names[2]
    k = aspects.box.axis(last)
    low, high = aspects.box.low[k], aspects.box.high[k]
    if aspects.aspects:  # elsewhere there is nothing to see
        low = min(float(np.min(item.boxes.low[2])) for item in aspects.aspects)
        high = max(float(np.max(item.boxes.high[2])) for item in aspects.aspects)
    own = context.record.sections if last == context.record.platform.pose[-1] else ()
    inside = [float(value) for value in own if low < value < high]
    return [*inside] or [float(value) for value in np.linspace(low, high, CUTS + 2)[1:-1]]


def _aspect(aspects: Aspects, across: str, upward: str) -> float:
    """Height of a panel over its width: true to scale where both are lengths."""
    low, high = aspects.box.low, aspects.box.high
    spans = [high[aspects.box.axis(name)] - low[aspects.box.axis(name)] for name in (across, upward)]
    return float(np.clip(spans[1] / spans[0], 0.3, 1.6)) if is_angle(across) == is_angle(upward) else 1.0


def _panel(axes: Axes, aspects: Aspects, value: float | None, least: float, plane: TracedPlane) -> None:
    """One plane, with the labels of those aspects that have at least so large an area there."""
    _fill(axes, plane.border, {"facecolor": PALE, "edgecolor": "none"})
    for part in plane.parts:
        first, *others = part.aspects
        _fill(axes, part.polygons, {**_style(first), "linewidth": 0.5})
        for other in others:  # not told from the first by its border
            _fill(axes, united(rectangles(aspects.aspects[other].boxes, value)), {**_style(other), "linewidth": 0.15})
    closed = [np.concatenate([line, line[:1]]) for line in plane.border]
    axes.add_collection(LineCollection(closed, colors=INK, linewidths=0.8))
    for item in aspects.aspects:
        _letter(axes, item, rectangles(item.boxes, value), least)


def _fill(axes: Axes, polygons: Sequence[FloatArray], style: dict[str, Any]) -> None:
    area = outline(polygons)
    if area is not None:
        axes.add_patch(PathPatch(area, **style))


def _style(k: int) -> dict[str, Any]:
    colour = SERIES[k % len(SERIES)]
    hatch = HATCHES[min(k // len(SERIES), len(HATCHES) - 1)]
    return {"facecolor": colour, "edgecolor": PAPER if hatch else INK, "hatch": hatch or None, "alpha": 0.75}


def _letter(axes: Axes, aspect: Aspect, corners: FloatArray, least: float) -> None:
    """The label where the aspect has much room about it, of such places in that nearest to its middle."""
    areas = np.prod(corners[:, 2] - corners[:, 0], axis=1)
    if not len(corners) or np.sum(areas) < least:
        return
    middles, size = corners.mean(axis=1), np.ptp(corners.reshape(-1, 2), axis=0)
    edge = np.concatenate([filled(polygon) for polygon in united(corners)])
    room = cKDTree(edge / size).query(middles / size)[0]
    away = np.sum(((middles - np.average(middles, axis=0, weights=areas)) / size) ** 2, axis=1)
    at = middles[np.argmin(np.where(room >= LARGE * np.max(room), away, np.inf))]
    halo = [withStroke(linewidth=2.0, foreground=PAPER)]
    axes.text(
        float(at[0]),
        float(at[1]),
        _words(aspect.label),
        ha="center",
        va="center",
        fontsize=TEXT,
        color=INK,
        path_effects=halo,
        zorder=6,
    )


def _words(label: str) -> str:
    """A label whose signs stay apart.

    >>> _words("-+/2")
    '− + / 2'
    """
    return " ".join(minus(label))


def _way(axes: Axes, path: AspectPath) -> None:
    keep = [path.coordinates.index(name) for name in path.names[:2]]
    line = path.points[:, keep]
    halo = [withStroke(linewidth=3.0, foreground=PAPER)]
    axes.plot(*line.T, color=INK, linewidth=1.3, path_effects=halo, zorder=5)
    axes.plot(*line[[0, -1]].T, "o", color=INK, markersize=3.5, zorder=6)


def _legend(aspects: Aspects, planes: Sequence[TracedPlane], path: AspectPath | None) -> list[Any]:
    """Handles for what is seen in the planes."""
    seen = listed(planes)
    handles: list[Any] = [Patch(label=_words(aspects.aspects[k].label), **_style(k)) for k in seen[:NAMED]]
    if len(seen) > NAMED:
        handles.append(Patch(facecolor="none", label=f"and {len(seen) - NAMED} smaller ones"))
    if any(plane.open for plane in planes):
        handles.append(Patch(facecolor=PALE, label="undecided"))
    if path is not None:
        handles.append(Line2D([], [], color=INK, marker="o", markersize=3.5, label="path"))
    return handles


def _data(aspects: Aspects, cuts: list[float | None], path: AspectPath | None) -> dict[str, Any]:
    def in_cuts(boxes: Boxes) -> list[Any]:
        return [rectangles(boxes, value) for value in cuts]

    return {
        "mode": aspects.mode,
        "plane": list(aspects.names[:2]),
        "cuts": cuts,
        "aspects": [
            {"label": item.label, "volume": list(item.volume), "rectangles": in_cuts(item.boxes)}
            for item in aspects.aspects
        ],
        "undecided": in_cuts(aspects.search.undecided),
        "path": None if path is None else path.points,
    }


ASPECTS = FigureKind(
    "aspects",
    "Aspects: parts without singularities",
    no_aspects,
    lambda context: caption(context, context.aspects),
    lambda context: drawn(context, context.aspects),
)
