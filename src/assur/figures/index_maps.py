"""Index maps: every index over one plane, on the same axes, each with a scale of its own."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Normalize
from matplotlib.patches import PathPatch
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.figures.context import Context
from assur.figures.coordinates import drawn_span, dress, plane_words, symbol, value_words
from assur.figures.dexterity import SHOWN, beyond, planes
from assur.figures.indices import COLOURS, continued
from assur.figures.plots import mode_words, no_workspace, outline
from assur.figures.spec import Drawing, Entry
from assur.figures.style import GREY, INK, PAGE, SMALL, TEXT, new_figure
from assur.figures.written import units
from assur.model.pose import LENGTHS
from assur.performance.indices import INDICES
from assur.workspace.index_maps import IndexMaps, index_maps

FloatArray = NDArray[np.float64]
ACROSS = 3
NODES = 32
UNBOUNDED = ("manipulability", "largest")
"""They grow without bound towards a parallel singularity: their colours end at a quantile."""

TALLEST = 50.0
"""Height of one map in mm, at most."""


def whole(context: Context) -> IndexMaps:
    """The maps of the middle plane of the workspace, worked out once."""
    key = "index maps: data"
    if key not in context.drawings:
        first, second, third, level = _plane(context)
        held = {third: level} if third else {}
        context.drawings[key] = index_maps(context.record, context.workspace, (first, second), held, NODES)
    found: IndexMaps = context.drawings[key]
    return found


def _plane(context: Context) -> tuple[str, str, str, float]:
    """That of two lengths where there is one."""
    chosen = planes(context)
    return next((plane for plane in chosen if plane[0] in LENGTHS and plane[1] in LENGTHS), chosen[0])


def drawn(context: Context, found: IndexMaps) -> Drawing:
    """Every index over two coordinates of the workspace of a context.

    Errors:
        UsageError: maps of one or of three coordinates.
    """
    if len(found.axes) != 2:
        raise UsageError(f"{len(found.axes)} coordinates are not a plane", hint="map two, hold the others")
    (first, _), (second, _) = found.axes
    wide, tall = drawn_span(context, first), drawn_span(context, second)
    left, right, bottom, top = 14.0, 13.0, 13.0, 7.0
    scale = min((PAGE / ACROSS - left - right) / wide, TALLEST / tall)
    cell, row = PAGE / ACROSS, bottom + top + scale * tall
    rows = math.ceil(len(found.maps) / ACROSS)
    height = rows * row + 5.0
    figure = new_figure(PAGE, height)
    held = "".join(
        f", {symbol(name)} = {value_words(context, name, value)}"
        for name, value in found.held.items()
        if name in context.workspace.box.names
    )
    figure.text(left / PAGE, 1.0 - 3.5 / height, f"{plane_words(first, second)}{held}", fontsize=TEXT)
    for k, (name, item) in enumerate(found.maps.items()):
        x, y = (k % ACROSS) * cell + left, height - 5.0 - (k // ACROSS) * row - top - scale * tall
        axes = figure.add_axes((x / PAGE, y / height, scale * wide / PAGE, scale * tall / height))
        bar = figure.add_axes(((x + scale * wide + 2.0) / PAGE, y / height, 2.5 / PAGE, scale * tall / height))
        _draw_one(context, (axes, bar), found, name)
        unit = f" ({units(item.unit)})" if item.unit else ""
        figure.text(
            (x + scale * wide / 2) / PAGE,
            (y + scale * tall + 1.5) / height,
            f"({chr(97 + k)}) ${item.symbol}${unit}",
            ha="center",
            fontsize=TEXT,
        )
    return Drawing(figure, found.to_json())


def _draw_one(context: Context, pair: tuple[Axes, Axes], found: IndexMaps, name: str) -> None:
    (first, xs), (second, ys) = found.axes
    (axes, bar), item = pair, found.maps[name]
    dress(context, axes, (first, second))
    axes.tick_params(color=GREY)
    known = item.values[np.isfinite(item.values)]
    path = outline(_polygons(context, found))
    if path is None:
        bar.set_axis_off()
        return
    border = PathPatch(path, facecolor="none", edgecolor=INK, linewidth=0.8, zorder=5)
    axes.add_patch(border)
    if not len(known):
        bar.set_axis_off()
        axes.text(0.5, 0.5, "none found", transform=axes.transAxes, ha="center", va="center", fontsize=SMALL)
        return
    top = _top(name, known)
    shown = continued(np.where(np.isinf(item.values), top, item.values)).T
    colours = Normalize(0.0, top)
    image = axes.pcolormesh(xs, ys, shown, cmap=COLOURS, norm=colours, shading="gouraud")
    image.set_clip_path(border)
    image.set_rasterized(True)
    axes.figure.colorbar(image, cax=bar, extend=beyond(top, item.values))
    bar.tick_params(labelsize=SMALL)


def _top(name: str, known: FloatArray) -> float:
    """Where the colours end."""
    if name in INDICES and INDICES[name].power == 0:
        return 1.0
    return float(np.quantile(known, SHOWN if name in UNBOUNDED else 1.0)) or 1.0


def _polygons(context: Context, found: IndexMaps) -> list[FloatArray]:
    region, names = context.workspace, [name for name, _ in found.axes]
    cut = [name for name in region.box.names if name not in names]
    if cut:
        polygons = region.section(found.held[cut[0]], cut[0]).polygons
        kept = [name for name in region.box.names if name in names]
    else:
        polygons, kept = region.projection(*names).polygons, names
    order = [kept.index(name) for name in names]
    return [polygon[:, order] for polygon in polygons]


def _caption(context: Context) -> str:
    found = whole(context)
    parts = [
        f"Every index over one plane ({mode_words(context)}). $1/\\kappa(J)$, $1/\\kappa_F(J)$, ITI, OTI and LTI lie"
        f" between 0, singular, and 1; the colours of $\\mu$ and $\\sigma_{{\\max}}$ end at their {100 * SHOWN:.0f} %"
        " quantile."
    ]
    if found.length is not None:
        parts.append(
            f"Lengths are divided by the characteristic length {found.length:.4g} {context.record.unit}"
            " in all but the distance."
        )
    if found.reach is not None:
        item = found.maps["distance"]
        parts.append(
            f"${item.symbol}$ is the distance from the nearest parallel singularity inside the reach that rays found"
            f" within {found.reach:.4g} {context.record.unit}, the orientation held, so an upper bound; the border of"
            " the reach is not counted; where there is none the colour is that of the largest."
        )
    return " ".join(parts)


INDEX_MAPS = Entry(
    "indices",
    "Every index over one plane",
    no_workspace,
    _caption,
    lambda context: drawn(context, whole(context)),
)
