"""Index maps: every index over one plane, on the same axes, each with a scale of its own."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
from matplotlib.colors import Normalize
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.figures.context import Context
from assur.figures.contours import continued
from assur.figures.plane_map import (
    SHOWN,
    MappedPlane,
    beyond,
    coloured,
    panels,
    plane_of_lengths,
    scale_of,
    with_bar,
)
from assur.figures.plots import mode_words, no_workspace, outline
from assur.figures.spec import Drawing, FigureKind
from assur.figures.written import units
from assur.performance.indices import INDICES
from assur.results.json_text import plain
from assur.workspace.index_maps import IndexMaps, index_maps

FloatArray = NDArray[np.float64]
NODES = 32
ROUND, POWERS = 13.0, 15.0
"""Room for a bar of colours in mm, with round numbers at its ticks and with powers of ten."""


def whole(context: Context) -> IndexMaps:
    """The maps of the middle plane of the workspace, worked out once."""
    plane = plane_of_lengths(context, NODES)
    return context.kept(
        "index maps", lambda: index_maps(context.record, context.workspace, plane.names, plane.held, NODES)
    )


def drawn(
    context: Context,
    maps: IndexMaps,
    tops: Mapping[str, float] | None = None,
    *,
    by_decades: bool = False,
    spent: tuple[str, Sequence[str]] = ("", ()),
) -> Drawing:
    """Every index over two coordinates of the workspace of a context; `tops` are where colours of some end.

    By decades are those of indices that grow without bound, or of all. `spent` is the map of a share, and those that
    fall to 0 where it passes 1: they jump there, along that contour and not from node to node.

    Errors:
        UsageError: maps of one or of three coordinates.
    """
    if len(maps.axes) != 2:
        raise UsageError(f"{len(maps.axes)} coordinates are not a plane", hint="map two, hold the others")
    (first, xs), (second, ys) = maps.axes
    plane = MappedPlane(context, (first, second), maps.held, xs, ys)
    titles = [f"${item.symbol}$" + (f" ({units(item.unit)})" if item.unit else "") for item in maps.maps.values()]
    figure, pairs = panels(plane, titles, right=POWERS if by_decades else ROUND)
    for pair, (name, item) in zip(pairs, maps.maps.items(), strict=True):
        top, index = (tops or {}).get(name), INDICES.get(name)
        known = item.values[np.isfinite(item.values)]
        unbounded = by_decades or (index is not None and index.unbounded)
        colours = Normalize(0.0, top or 1.0) if top is not None else scale_of(known, unbounded=unbounded)
        values = np.where(np.isinf(item.values), float(colours.vmax or np.nan) if len(known) else np.nan, item.values)
        share = maps.maps[spent[0]].values if name in spent[1] else np.zeros_like(values)
        some = np.any(share > 1.0) and np.any(share <= 1.0)
        kept = np.where(share > 1.0, np.nan, values).T if some else values.T
        image = coloured(pair[0], plane, kept, colours, ridges=index is not None and index.unbounded)
        if some and image is not None:
            past = pair[0].contourf(xs, ys, continued(share).T, levels=[1.0, np.inf], colors=[image.cmap(0)], zorder=2)
            past.set_clip_path(outline(plane.polygons), pair[0].transData)
        with_bar(pair, image, "none found", beyond(float(colours.vmax or np.inf), item.values))
    return Drawing(figure, plain(maps.answer()))


def _listed(symbols: Iterable[str]) -> str:
    """Symbols as in a sentence.

    >>> _listed(["a", "b", "c"])
    '$a$, $b$ and $c$'
    """
    *first, last = (f"${item}$" for item in symbols)
    return f"{', '.join(first)} and {last}" if first else last


def _caption(context: Context) -> str:
    found = whole(context)
    parts = [
        f"Every index over one plane ({mode_words(context)})."
        f" {_listed(item.symbol for item in INDICES.values() if item.power == 0)} lie between 0, singular, and 1;"
        f" the colours of {_listed(item.symbol for item in INDICES.values() if item.unbounded)}, by decades, end"
        f" at their {100 * SHOWN:.0f} % quantile."
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


INDEX_MAPS = FigureKind(
    "indices",
    "Every index over one plane",
    no_workspace,
    _caption,
    lambda context: drawn(context, whole(context)),
)
