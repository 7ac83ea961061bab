"""Parasitic motion: a map of each coordinate that the pose leaves out, over one plane through the workspace."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from matplotlib.colors import Normalize
from numpy.typing import NDArray

from assur.figures.context import Context
from assur.figures.coordinates import axis_title, shown, symbol, value_words
from assur.figures.plane_map import MappedPlane, coloured, panels, plane_of_tilts, with_bar
from assur.figures.plots import free_coordinates, mode_words, no_workspace
from assur.figures.spec import Drawing, FigureKind
from assur.kinematics.parasitic import moving
from assur.workspace.parasitic import Largest, largest_parasitic, parasitic_over

FloatArray = NDArray[np.float64]
NODES = 48
COLOURS = "RdBu_r"


@dataclass(frozen=True, eq=False)
class ParasiticMaps:
    """What is drawn.

    Attributes:
        plane: of two angles where there are two: tilts are what a platform pays for with other motions.
        values: coordinate that the pose leaves out -> (b, a), in a length or rad; NaN where a pose is not reached.
        largest: where each is largest in size, over the whole workspace.
    """

    plane: MappedPlane
    values: dict[str, FloatArray]
    largest: dict[str, Largest]


def maps(context: Context) -> ParasiticMaps:
    """The maps, worked out once."""
    return context.kept("parasitic maps", lambda: _maps(context))


def _maps(context: Context) -> ParasiticMaps:
    region, plane = context.workspace, plane_of_tilts(context, NODES)
    values = parasitic_over(context.record, region, plane.points.reshape(-1, plane.points.shape[-1]))
    known = {name: values[name].reshape(plane.points.shape[:-1]) for name in moving(context.record)}
    return ParasiticMaps(plane, known, largest_parasitic(context.record, region))


def _draw(context: Context) -> Drawing:
    drawn = maps(context)
    figure, pairs = panels(drawn.plane, [axis_title(context, name) for name in drawn.values], right=15.0)
    for pair, (name, values) in zip(pairs, drawn.values.items(), strict=True):
        sizes = np.vectorize(lambda value, name=name: shown(context, name, value))(values)
        most = float(np.max(np.abs(sizes), where=np.isfinite(sizes), initial=0.0)) or 1.0
        with_bar(pair, coloured(pair[0], drawn.plane, sizes, Normalize(-most, most), COLOURS), "not reached")
    return Drawing(figure, _data(drawn))


def _data(drawn: ParasiticMaps) -> dict[str, object]:
    plane = drawn.plane
    return {
        "axes": dict(zip(plane.names, (plane.xs, plane.ys), strict=True)),
        "held": plane.held,
        "values": {name: values.T for name, values in drawn.values.items()},
        "largest": {name: {"value": item.value, "at": dict(item.at)} for name, item in drawn.largest.items()},
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


PARASITIC = FigureKind("parasitic", "Parasitic motion", _missing, _caption, _draw)
