"""Plots in a plane: regions as filled polygons, singular curves, and the words that go with a workspace."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import networkx as nx
import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, PathPatch
from matplotlib.path import Path
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.figures.context import Context
from assur.figures.coordinates import held_words
from assur.figures.singular import condition
from assur.figures.style import BLUE, GREEN, ORANGE, PINK, RED
from assur.kinematics.limits import limits_note
from assur.model.closed_form import Factor
from assur.results.typeset_text import minus
from assur.singularity.loci import Locus, parallel_factors
from assur.workspace.region import Workspace
from assur.workspace.rims import rim_edges
from assur.workspace.slices import slice_at

FloatArray = NDArray[np.float64]
FREE = "#8fd3bd"
CLOSE = "#e2703a"
LOCI = (RED, BLUE, PINK, ORANGE, GREEN)
STYLES: tuple[Literal["-", "--", "-.", ":"], ...] = ("-", "--", "-.", ":")


def no_workspace(context: Context) -> str:
    """Why a mechanism has no workspace figures; empty where it has."""
    try:
        free = free_coordinates(context)
    except UsageError as error:
        return error.message
    known = context.given_workspace.box.names if context.given_workspace else context.record.box
    missing = [name for name in free if name not in known]
    if missing:
        return f"the mechanism's file gives no interval for {', '.join(missing)}"
    return "" if len(free) in (2, 3) else "a workspace is drawn in two or three coordinates"


def no_solid_workspace(context: Context) -> str:
    """Why there are no sections or projections; empty where there are."""
    if no_workspace(context):
        return no_workspace(context)
    return "" if len(free_coordinates(context)) == 3 else "the workspace is plane; its figure shows all of it"


def free_coordinates(context: Context) -> tuple[str, ...]:
    """The coordinates of the pose that vary in the workspace; the others are held."""
    given = context.given_workspace
    return given.box.names if given else slice_at(context.record).free


def outline(polygons: Sequence[FloatArray]) -> Path | None:
    """Polygons (n, 2) as one area, outer ones counter-clockwise and holes clockwise; None where there is none."""
    whole = [polygon for polygon in polygons if len(polygon) > 2]
    closed = [Path(np.concatenate([polygon, polygon[:1]]), closed=True) for polygon in whole]
    return Path.make_compound_path(*closed) if closed else None


def fill(axes: Axes, polygons: Sequence[FloatArray], colour: str, edge: str = "none", order: float = 1.0) -> None:
    """Polygons as one area."""
    path = outline(polygons)
    if path is not None:
        axes.add_patch(PathPatch(path, facecolor=colour, edgecolor=edge, linewidth=0.7, zorder=order))


def curves(axes: Axes, segments: FloatArray, index: int) -> None:
    """Segments (k, 2, 2) in the colour and the dashes of the locus with that index."""
    style, colour = STYLES[index % len(STYLES)], LOCI[index % len(LOCI)]
    for line in strung(segments):
        axes.plot(line[:, 0], line[:, 1], color=colour, linewidth=1.1, linestyle=style, zorder=4)


def strung(segments: FloatArray) -> list[FloatArray]:
    """Segments (k, 2, d) as polylines where their ends meet, so that dashes run through them.

    >>> [line.tolist() for line in strung(np.array([[[0.0, 0], [1, 0]], [[2, 0], [1, 0]]]))]
    [[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]]
    """
    if not len(segments):
        return []
    flat = segments.reshape(-1, segments.shape[-1])
    size = max(float(np.max(np.ptp(flat, axis=0))), 1e-300)
    _, index = np.unique(np.round(flat / size, 7), axis=0, return_inverse=True)
    ends = index.reshape(-1, 2)
    graph: nx.Graph[int] = nx.Graph()
    graph.add_edges_from((int(a), int(b)) for a, b in ends if a != b)
    place = dict(zip(index.ravel().tolist(), flat, strict=True))
    lines = []
    for part in nx.connected_components(graph):
        piece = graph.subgraph(part).copy()
        while piece.number_of_edges():
            odd = sorted(node for node, degree in piece.degree if degree % 2)
            path = _walk(piece, odd[0] if odd else min(node for node, degree in piece.degree if degree))
            lines.append(np.array([place[node] for node in path]))
    return lines


def _walk(graph: nx.Graph[int], start: int) -> list[int]:
    """Follow unused edges from a node as far as they go, and take them away."""
    path = [start]
    while graph.degree[path[-1]]:
        following = min(graph.neighbors(path[-1]))
        graph.remove_edge(path[-1], following)
        path.append(following)
    return path


def rim(locus: Locus) -> FloatArray:
    """Edges (k, 2, 3) that bound a locus: where it meets the border of the workspace."""
    return np.asarray(locus.vertices[rim_edges(locus.faces)])


def in_plane(locus: Locus, axis: int, value: float) -> FloatArray:
    """Segments (k, 2, 3) in which the triangles of a locus meet the plane where a coordinate has a value.

    >>> flat = Locus("f", "", np.array([[0.0, 0, 0], [2, 0, 0], [0, 0, 2]]), np.array([[0, 1, 2]]), 2.0)
    >>> in_plane(flat, 2, 1.0).tolist()
    [[[1.0, 0.0, 1.0], [0.0, 0.0, 1.0]]]
    """
    if locus.faces.shape[1] != 3 or not len(locus.faces):
        return np.zeros((0, 2, 3))
    corners = locus.vertices[locus.faces]  # (f, 3, 3)
    height = corners[:, :, axis] - value
    above = height > 0
    crossed = above != np.roll(above, -1, axis=1)  # edge k runs from corner k to the next
    rows = np.flatnonzero(crossed.sum(axis=1) == 2)
    edges = np.nonzero(crossed[rows])[1].reshape(-1, 2)  # (k, 2)
    a, b = edges, (edges + 1) % 3
    own = rows[:, None]
    share = height[own, a] / (height[own, a] - height[own, b])
    return np.asarray(corners[own, a] + share[..., None] * (corners[own, b] - corners[own, a]))


def factor_of(context: Context, name: str) -> Factor:
    """The parallel factor of that name."""
    return next(item for item in parallel_factors(context.record) if item.name == name)


def present(region: Workspace) -> list[Locus]:
    """The loci that have a surface inside the workspace."""
    return [locus for locus in region.loci if len(locus.faces)]


def legend_of(context: Context, *, near: bool = True, loci: bool = True) -> list[Patch | Line2D]:
    """Handles for the areas and the curves of a workspace figure."""
    found = context.workspace
    words = "farther away" if near and nearness(context) else "workspace"
    handles: list[Patch | Line2D] = [Patch(facecolor=FREE, label=words)]
    if near and nearness(context):
        handles.append(Patch(facecolor=CLOSE, label=near_words(context)))
    if loci:
        handles += [
            Line2D(
                [],
                [],
                color=LOCI[k % len(LOCI)],
                linestyle=STYLES[k % len(STYLES)],
                label=condition(factor_of(context, locus.factor)),
            )
            for k, locus in enumerate(present(found))
        ]
    return handles


def nearness(context: Context) -> bool:
    """Whether something is near a parallel singularity and can be told: not where lengths and angles mix."""
    found = context.workspace
    return found.share is not None and bool(present(found) or any(locus.everywhere for locus in found.loci))


def limits_words(context: Context) -> str:
    """A sentence for what is said of reach where the file states no limits; else nothing."""
    note = limits_note(context.record)
    return f" {note[0].upper()}{note[1:]}." if note else ""


def near_words(context: Context) -> str:
    """E.g. "within 10 mm of a parallel singularity"."""
    return f"within {context.workspace.near:g} {context.record.unit} of a parallel singularity"


def mode_words(context: Context) -> str:
    """The working mode for a caption."""
    mode = minus(context.workspace.mode)
    only = "its only working mode" if context.record.closed_form else "the working mode of home"
    return (f"working mode {mode}" if mode else only) + held_words(context)


def locus_words(context: Context) -> str:
    """The singular surfaces inside the workspace and what they mean, for a caption."""
    items = [f"{condition(factor_of(context, locus.factor))} ({locus.meaning})" for locus in present(context.workspace)]
    if not items:
        cells = max(context.workspace.region.grid.cells)
        return f"On a grid of {cells} cells along each coordinate no parallel-singular surface was found inside."
    return "Parallel-singular surfaces inside: " + "; ".join(items) + "."
