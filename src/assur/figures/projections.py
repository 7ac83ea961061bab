"""The projections of the workspace on the planes XOZ and YOZ, with what is near a parallel singularity."""

from __future__ import annotations

from typing import Any

from assur.figures.context import Context
from assur.figures.coordinates import drawn_span, dress, plane_words
from assur.figures.page import legend_above, side_by_side
from assur.figures.plots import (
    CLOSE,
    FREE,
    curves,
    fill,
    legend_of,
    limits_words,
    mode_words,
    near_words,
    nearness,
    no_solid_workspace,
    present,
    rim,
)
from assur.figures.spec import Drawing, FigureKind
from assur.figures.style import GREY, TEXT, new_figure
from assur.workspace.projections import shadow

LEAST = 55.0
"""Share of the page's width that a projection needs at least to stand beside another, in mm."""


def _planes(context: Context) -> list[tuple[str, str]]:
    first, second, third = context.workspace.box.names
    return [(first, third), (second, third)]


def _caption(context: Context) -> str:
    names = "; ".join(plane_words(a, b) for a, b in _planes(context))
    near = f"Coloured as singular is what has a pose {near_words(context)} on its line of sight; "
    lines = "lines are the rims of the singular surfaces."
    rest = near + lines if nearness(context) else lines.capitalize() if present(context.workspace) else ""
    said = f"Projections of the workspace ({mode_words(context)}) on the planes {names}.{limits_words(context)} {rest}"
    return said.strip()


def _draw(context: Context) -> Drawing:
    found = context.workspace
    planes = _planes(context)
    spans = [(drawn_span(context, a), drawn_span(context, b)) for a, b in planes]
    left, gap, bottom, top = 14.0, 18.0, 17.0, 3.0
    beside = side_by_side(context.page, 2, LEAST) == 2
    room = sum(wide for wide, _ in spans) if beside else max(wide for wide, _ in spans)
    margins = left + 4.0 + gap * beside
    scale = min(70.0 / max(tall for _, tall in spans), (context.page - margins) / room)
    width, row = margins + scale * room, bottom + top + scale * max(tall for _, tall in spans)
    height = row if beside else 2 * row
    figure = new_figure(width, height)
    data: dict[str, Any] = {
        "unit": context.record.unit,
        "mode": found.mode,
        "near": found.near,
        "projections": [],
    }
    start = left
    for k, ((a, b), (wide, tall)) in enumerate(zip(planes, spans, strict=True)):
        level = 0.0 if beside else row * (1 - k)
        axes = figure.add_axes((start / width, (level + bottom) / height, scale * wide / width, scale * tall / height))
        outline = found.projection(a, b)
        across = next(i for i, name in enumerate(found.box.names) if name not in (a, b))
        close = shadow(context.near, across)
        fill(axes, outline.polygons, FREE)
        fill(axes, close[1], CLOSE, order=2)
        fill(axes, outline.polygons, "none", GREY, 3)
        keep = [found.box.axis(a), found.box.axis(b)]
        for j, locus in enumerate(present(found)):
            curves(axes, rim(locus)[:, :, keep], j)
        dress(context, axes, context.workspace.box, (a, b))
        middle = (start + scale * wide / 2) / width
        figure.text(middle, (level + 1.5) / height, f"({chr(97 + k)}) {plane_words(a, b)}", ha="center", fontsize=TEXT)
        start += (scale * wide + gap) * beside
        data["projections"].append(
            {
                "plane": [a, b],
                "area": outline.area,
                "polygons": outline.polygons,
                "near_area": close[0],
                "near": close[1],
            }
        )
    legend_above(figure, legend_of(context))
    return Drawing(figure, data)


PROJECTIONS = FigureKind("projections", "Projections of the workspace", no_solid_workspace, _caption, _draw)
