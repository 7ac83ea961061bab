"""The projections of the workspace on the planes XOZ and YOZ, with what is near a parallel singularity."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.figures.context import Context
from assur.figures.plots import (
    CLOSE,
    FREE,
    axis_title,
    curves,
    fill,
    legend_of,
    mode_words,
    near_words,
    no_solid_workspace,
    present,
    rim,
)
from assur.figures.spec import Drawing, Entry
from assur.figures.style import GREY, PAGE, TEXT, new_figure
from assur.workspace.projections import shadow

FloatArray = NDArray[np.float64]


def _planes(context: Context) -> list[tuple[str, str]]:
    first, second, third = context.workspace.box.names
    return [(first, third), (second, third)]


def _caption(context: Context) -> str:
    names = " and ".join(f"{a.upper()}O{b.upper()}" for a, b in _planes(context))
    return (
        f"Projections of the workspace ({mode_words(context)}) on {names}. Coloured as singular is what has a pose"
        f" {near_words(context)} on its line of sight; lines are the rims of the singular surfaces."
    )


def _draw(context: Context) -> Drawing:
    found = context.workspace
    planes = _planes(context)
    box = dict(zip(found.box.names, found.box.intervals, strict=True))
    spans = [(box[a][1] - box[a][0], box[b][1] - box[b][0]) for a, b in planes]
    left, gap, bottom, top = 14.0, 18.0, 17.0, 9.0
    scale = min(70.0 / max(tall for _, tall in spans), (PAGE - left - gap - 4.0) / sum(wide for wide, _ in spans))
    width = left + gap + 4.0 + scale * sum(wide for wide, _ in spans)
    height = bottom + top + scale * max(tall for _, tall in spans)
    figure = new_figure(width, height)
    data: dict[str, Any] = {
        "unit": context.record.unit,
        "mode": found.mode,
        "near": found.near,
        "projections": [],
    }
    start = left
    for k, ((a, b), (wide, tall)) in enumerate(zip(planes, spans, strict=True)):
        axes = figure.add_axes((start / width, bottom / height, scale * wide / width, scale * tall / height))
        outline = found.projection(a, b)
        across = next(i for i, name in enumerate(found.box.names) if name not in (a, b))
        close = shadow(context.near, across)
        fill(axes, outline.polygons, FREE)
        fill(axes, close[1], CLOSE, order=2)
        fill(axes, outline.polygons, "none", GREY, 3)
        keep = [found.box.axis(a), found.box.axis(b)]
        for j, locus in enumerate(present(found)):
            curves(axes, rim(locus)[:, :, keep], j)
        axes.set_xlim(*box[a])
        axes.set_ylim(*box[b])
        axes.set_xlabel(axis_title(context, a))
        axes.set_ylabel(axis_title(context, b))
        middle = (start + scale * wide / 2) / width
        figure.text(middle, 1.5 / height, f"({chr(97 + k)}) {a.upper()}O{b.upper()}", ha="center", fontsize=TEXT)
        start += scale * wide + gap
        data["projections"].append(
            {
                "plane": [a, b],
                "area": outline.area,
                "polygons": outline.polygons,
                "near_area": close[0],
                "near": close[1],
            }
        )
    figure.legend(handles=legend_of(context), loc="upper center", ncols=4)
    return Drawing(figure, data)


PROJECTIONS = Entry("projections", "Projections of the workspace", no_solid_workspace, _caption, _draw)
