"""The workspace: the region of a working mode coloured by how near it is to a parallel singularity."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from assur.figures.axes3d import draw_axes, draw_box
from assur.figures.canvas import POINTS, Canvas, View, canvas, inside
from assur.figures.context import Context
from assur.figures.coordinates import axis_title, drawn_span, dress, shown, stretch
from assur.figures.lines import before, facing_of, mesh_edges
from assur.figures.page import HIGHEST, legend_above, side_by_side
from assur.figures.plots import (
    CLOSE,
    FREE,
    LOCI,
    curves,
    factor_of,
    fill,
    legend_of,
    limits_words,
    locus_words,
    mode_words,
    near_words,
    no_workspace,
    present,
)
from assur.figures.raster import filled, lit
from assur.figures.singular import condition
from assur.figures.solid import strokes
from assur.figures.spec import Drawing, FigureKind
from assur.figures.style import DOTS_PER_INCH, GREY, SMALL, TEXT, new_figure
from assur.figures.written import times_ten, units
from assur.model.pose import is_angle
from assur.scene.camera import orthographic
from assur.scene.mesh import Mesh, creases, joined, surface
from assur.workspace.projections import shadow
from assur.workspace.region import Workspace
from assur.workspace.solids import mesh as mesh_of

FloatArray = NDArray[np.float64]
SIDE, LEAST = 14.0, 65.0
"""White beside a panel, and the share of the page's width that one needs to stand beside another, in mm."""

FLATTER = 2e-4
"""Faces are joined where that moves the surface by less than this share of the box; for the picture only."""


def _caption(context: Context) -> str:
    found = context.workspace
    mixed = any(map(is_angle, found.box.names))
    what = "Extent" if mixed else "Area" if len(found.box.names) == 2 else "Volume"
    share = "" if found.share is None else f", {100 * found.share:.1f} % of it {near_words(context)}"
    return (
        f"Workspace in {mode_words(context)} inside the box of the mechanism's file. {what} {size_words(found)} by"
        f" solids at two resolutions{share}.{limits_words(context)} {locus_words(context)}"
    )


def size_words(region: Workspace) -> str:
    """Volume or area with its error in a power of ten.

    >>> from types import SimpleNamespace
    >>> size_words(SimpleNamespace(volume=22_813_484.0, volume_error=3674.0, unit="mm^3"))
    '(2.2813 ± 0.0004)·10$^{7}$ mm$^3$'
    >>> size_words(SimpleNamespace(volume=2.8459, volume_error=0.0003, unit="m^3"))
    '2.8459 ± 0.0003 m$^3$'
    """
    if region.volume == 0:
        return f"0 {units(region.unit)}"
    power = int(np.floor(np.log10(region.volume)))
    digits = int(np.clip(power - np.floor(np.log10(max(region.volume_error, 1e-6 * region.volume))), 1, 6))
    value, error = region.volume / 10.0**power, region.volume_error / 10.0**power
    pair = f"{value:.{digits}f} ± {error:.{digits}f}"
    return f"{times_ten(f'({pair})' if power else pair, power)} {units(region.unit)}"


def _draw(context: Context) -> Drawing:
    figure = _plane(context) if len(context.workspace.box.names) == 2 else _space(context)
    found = context.workspace
    data = {
        **found.to_json(),
        "vertices": found.vertices,
        "faces": found.faces,
        "loci": [{"factor": item.factor, "vertices": item.vertices, "faces": item.faces} for item in found.loci],
    }
    return Drawing(figure, data)


def _plane(context: Context) -> Any:
    """A plane region as an area."""
    found = context.workspace
    across, upward = (drawn_span(context, name) for name in found.box.names)
    width = min(110.0, context.page)
    height = 14.0 + (width - 20.0) * upward / across
    figure = new_figure(width, height)
    axes = figure.add_axes((16.0 / width, 11.0 / height, (width - 20.0) / width, (height - 14.0) / height))
    fill(axes, found.projection(*found.box.names).polygons, FREE, GREY)
    fill(axes, shadow(context.near, 2)[1], CLOSE)
    for k, locus in enumerate(present(found)):
        curves(axes, locus.vertices[locus.faces], k)
    dress(context, axes, found.box, found.box.names)
    legend_above(figure, legend_of(context))
    return figure


def _space(context: Context) -> Any:
    """Left the region from outside, right the singular surfaces in it, where there are any."""
    found = context.workspace
    drawn = stretch(context)
    low, high = drawn * found.box.low, drawn * found.box.high
    titles = [axis_title(context, name) for name in found.box.names]
    per = [shown(context, name, 1.0) / float(size) for name, size in zip(found.box.names, drawn, strict=True)]
    camera = context.companion.camera("workspace", orthographic(-60, 24))
    corners = np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])
    span = np.ptp(camera.project(corners), axis=0)
    columns = side_by_side(context.page, 2, LEAST)
    panels = 2 if present(found) else 1
    beside = min(columns, panels)
    rows = panels // beside
    aspect = float(span[1] / span[0])
    panel = min((context.page - (columns + 1) * SIDE) / columns, (HIGHEST / rows - 26.0) / aspect)
    height = panel * aspect
    row = height + 26.0
    page = canvas(SIDE + beside * (panel + SIDE), rows * row)
    corner = [(SIDE + (k % beside) * (panel + SIDE), (rows - 1 - k // beside) * row) for k in range(panels)]
    views = [inside(camera, corners, (left, low + 15.0, panel, height)) for left, low in corner]
    for view in views:
        draw_box(page, view, low, high)
        draw_axes(page, view, low, high, titles, per)
    if len(found.faces):
        fine = FLATTER * float(np.min(np.subtract(found.box.high, found.box.low)))
        parts = [(found.region.solid - context.near, FREE), (context.near, CLOSE)]
        meshes = [(mesh_of(part.simplify(fine)), colour) for part, colour in parts if not part.is_empty()]
        solids = [surface(drawn * vertices, faces, colour) for (vertices, faces), colour in meshes]
        _paste(page, views[0], joined(solids), solid=True)
    surfaces = [
        surface(drawn * item.vertices, item.faces, LOCI[k % len(LOCI)]) for k, item in enumerate(present(found))
    ]
    if surfaces:
        edges = np.concatenate([creases(drawn * found.vertices, found.faces), _contour(found, drawn, views[1])])
        _paste(page, views[1], joined(surfaces), solid=False, edges=edges)
    _captions(context, page, [(left + panel / 2, low, low + row) for left, low in corner])
    return page.figure


def _contour(region: Workspace, drawn: FloatArray, view: View) -> FloatArray:
    """Edges (e, 2, 3) of the region beyond which nothing of it is seen."""
    body = surface(drawn * region.vertices, region.faces, GREY)
    edges = mesh_edges(body, facing_of(body, view))
    return edges.ends[edges.outline]


def _paste(page: Canvas, view: View, mesh: Mesh, *, solid: bool, edges: FloatArray | None = None) -> None:
    """The picture of a mesh, where it is on the page, and what it leaves to be seen of edges (e, 2, 3)."""
    flat = view(mesh.corners.reshape(-1, 3))
    (left, bottom), (right, top) = flat.min(axis=0) - 2.0, flat.max(axis=0) + 2.0
    local = View(view.camera, view.scale, view.offset - [left, bottom])
    painted = filled(mesh, local, (right - left, top - bottom), DOTS_PER_INCH, solid=solid)
    image = lit(mesh, local, painted, DOTS_PER_INCH)
    if edges is not None:
        strokes(page, before(edges, local, painted, DOTS_PER_INCH) + np.array([left, bottom]), 0.35, 5, GREY)
    page.axes.imshow(image, extent=(left, right, bottom, top), interpolation="antialiased", zorder=2, aspect="auto")


def _captions(context: Context, page: Canvas, panels: list[tuple[float, float, float]]) -> None:
    """Letters below and legends above each of the panels (middle, low, top), in mm."""
    found = context.workspace
    areas = legend_of(context, loci=False)
    lines = [
        Line2D([], [], color=LOCI[k % len(LOCI)], linewidth=4, label=condition(factor_of(context, item.factor)))
        for k, item in enumerate(present(found))
    ]
    shown: list[list[Any]] = [areas, lines] if lines else [areas]
    legend = None
    width, height = page.axes.get_xlim()[1] / POINTS, page.axes.get_ylim()[1] / POINTS
    for k, (handles, (middle, low, top)) in enumerate(zip(shown, panels, strict=True)):
        if lines:
            page.text((middle * POINTS, (low + 3.5) * POINTS), f"({chr(97 + k)})", fontsize=TEXT)
        place = (middle / width, top / height)
        if handles:
            if legend is not None:
                page.axes.add_artist(legend)  # the axes themselves keep the last one only
            legend = page.axes.legend(
                handles=handles, loc="upper center", bbox_to_anchor=place, ncols=len(handles), fontsize=SMALL
            )


WORKSPACE = FigureKind("workspace", "Workspace and parallel singularities", no_workspace, _caption, _draw)
