"""Parasitic motion: a map of each coordinate that the pose leaves out, over one plane through the workspace."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Normalize
from matplotlib.patches import PathPatch
from numpy.typing import NDArray

from assur.figures.context import Context
from assur.figures.coordinates import axis_title, drawn_span, dress, plane_words, shown, symbol, value_words
from assur.figures.dexterity import planes
from assur.figures.indices import continued
from assur.figures.plots import free_coordinates, mode_words, no_workspace, outline
from assur.figures.spec import Drawing, Entry
from assur.figures.style import GREY, INK, PAGE, SMALL, TEXT, new_figure
from assur.kinematics.parasitic import moving
from assur.model.pose import is_angle
from assur.workspace.parasitic import Largest, largest_parasitic, parasitic_over

FloatArray = NDArray[np.float64]
ACROSS = 3
NODES = 48
COLOURS = "RdBu_r"
TALLEST = 50.0
"""Height of one map in mm, at most."""


@dataclass(frozen=True, eq=False)
class Maps:
    """What is drawn.

    Attributes:
        axes: the two coordinates and their nodes (a,) and (b,).
        held: the third coordinate -> its value; empty in a plane workspace.
        values: coordinate that the pose leaves out -> (a, b), in a length or rad; NaN where a pose is not reached.
        largest: where each is largest in size, over the whole workspace.
    """

    axes: tuple[tuple[str, FloatArray], tuple[str, FloatArray]]
    held: dict[str, float]
    values: dict[str, FloatArray]
    largest: dict[str, Largest]


def maps(context: Context) -> Maps:
    """The maps, worked out once."""
    key = "parasitic: data"
    if key not in context.drawings:
        context.drawings[key] = _maps(context)
    found: Maps = context.drawings[key]
    return found


def _maps(context: Context) -> Maps:
    region, (first, second, third, level) = context.workspace, _plane(context)
    box = region.box
    spans = {name: box.intervals[box.axis(name)] for name in (first, second)}
    nodes = {name: np.linspace(low, high, NODES) for name, (low, high) in spans.items()}
    grid = dict(zip((first, second), np.meshgrid(nodes[first], nodes[second], indexing="ij"), strict=True))
    columns = [grid[name] if name in grid else np.full((NODES, NODES), level) for name in box.names]
    points = np.stack(columns, axis=-1).reshape(-1, len(columns))
    values = parasitic_over(context.record, region, points)
    return Maps(
        ((first, nodes[first]), (second, nodes[second])),
        {third: level} if third else {},
        {name: values[name].reshape(NODES, NODES) for name in moving(context.record)},
        largest_parasitic(context.record, region),
    )


def _plane(context: Context) -> tuple[str, str, str, float]:
    """That of two angles where there is one: tilts are what a platform pays for with other motions."""
    box = context.workspace.box
    angles = [name for name in box.names if is_angle(name)]
    if len(angles) == 2 and len(box.names) == 3:
        third = next(name for name in box.names if name not in angles)
        return angles[0], angles[1], third, sum(box.intervals[box.axis(third)]) / 2
    return planes(context)[0]


def _draw(context: Context) -> Drawing:
    found = maps(context)
    (first, _), (second, _) = found.axes
    wide, tall = drawn_span(context, first), drawn_span(context, second)
    left, right, bottom, top = 14.0, 15.0, 13.0, 7.0
    scale = min((PAGE / ACROSS - left - right) / wide, TALLEST / tall)
    cell, row = PAGE / ACROSS, bottom + top + scale * tall
    height = math.ceil(len(found.values) / ACROSS) * row + 5.0
    figure = new_figure(PAGE, height)
    held = "".join(f", {symbol(name)} = {value_words(context, name, value)}" for name, value in found.held.items())
    figure.text(left / PAGE, 1.0 - 3.5 / height, f"{plane_words(first, second)}{held}", fontsize=TEXT)
    for k, name in enumerate(found.values):
        x, y = (k % ACROSS) * cell + left, height - 5.0 - (k // ACROSS) * row - top - scale * tall
        axes = figure.add_axes((x / PAGE, y / height, scale * wide / PAGE, scale * tall / height))
        bar = figure.add_axes(((x + scale * wide + 2.0) / PAGE, y / height, 2.5 / PAGE, scale * tall / height))
        _draw_one(context, (axes, bar), found, name)
        title = f"({chr(97 + k)}) {axis_title(context, name)}"
        figure.text((x + scale * wide / 2) / PAGE, (y + scale * tall + 1.5) / height, title, ha="center", fontsize=TEXT)
    return Drawing(figure, _data(found))


def _draw_one(context: Context, pair: tuple[Axes, Axes], found: Maps, name: str) -> None:
    (first, xs), (second, ys) = found.axes
    axes, bar = pair
    dress(context, axes, (first, second))
    axes.tick_params(color=GREY)
    values = np.vectorize(lambda value: shown(context, name, value))(found.values[name])
    path = outline(_polygons(context, found))
    if path is None or not np.any(np.isfinite(values)):
        bar.set_axis_off()
        axes.text(0.5, 0.5, "not reached", transform=axes.transAxes, ha="center", va="center", fontsize=SMALL)
        return
    border = PathPatch(path, facecolor="none", edgecolor=INK, linewidth=0.8, zorder=5)
    axes.add_patch(border)
    most = float(np.nanmax(np.abs(values))) or 1.0
    colours = Normalize(-most, most)
    image = axes.pcolormesh(xs, ys, continued(values).T, cmap=COLOURS, norm=colours, shading="gouraud")
    image.set_clip_path(border)
    image.set_rasterized(True)
    axes.figure.colorbar(image, cax=bar, extend="neither")
    bar.tick_params(labelsize=SMALL)


def _polygons(context: Context, found: Maps) -> list[FloatArray]:
    """Border of the workspace in the plane, its columns in the order of the axes."""
    region, names = context.workspace, [name for name, _ in found.axes]
    kept = [name for name in region.box.names if name in names]
    if found.held:
        ((name, value),) = found.held.items()
        polygons = region.section(value, name).polygons
    else:
        polygons = region.projection(*kept).polygons
    return [polygon[:, [kept.index(name) for name in names]] for polygon in polygons]


def _data(found: Maps) -> dict[str, object]:
    return {
        "axes": dict(found.axes),
        "held": found.held,
        "values": found.values,
        "largest": {name: {"value": item.value, "at": dict(item.at)} for name, item in found.largest.items()},
    }


def _missing(context: Context) -> str:
    if no_workspace(context):
        return no_workspace(context)
    if not moving(context.record):
        return "nothing moves that the pose leaves out"
    held = set(context.record.platform.pose) - set(free_coordinates(context))
    return f"{', '.join(sorted(held))} is held in the workspace" if held else ""


def _caption(context: Context) -> str:
    found = maps(context)
    parts = [
        f"{symbol(name)} = {value_words(context, name, item.value)} at"
        f" {', '.join(f'{symbol(key)} = {value_words(context, key, value)}' for key, value in item.at.items())}"
        for name, item in found.largest.items()
    ]
    largest = f" Largest in size over the whole workspace: {'; '.join(parts)}." if parts else ""
    return f"Parasitic motion: the platform's coordinates that the pose leaves out ({mode_words(context)}).{largest}"


PARASITIC = Entry("parasitic", "Parasitic motion", _missing, _caption, _draw)
