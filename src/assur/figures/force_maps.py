"""What the actuators hold at rest, and how fast they move the platform, over one plane through the workspace."""

from __future__ import annotations

import numpy as np

from assur.figures.context import Context
from assur.figures.force_polytope import no_capacity
from assur.figures.index_maps import drawn
from assur.figures.plane_map import plane_of_lengths
from assur.figures.plots import mode_words, no_workspace
from assur.figures.spec import Drawing, FigureKind
from assur.machine.forces.capacity_maps import MOST, capacity_maps, tops
from assur.machine.masses.link_masses import masses
from assur.workspace.index_maps import IndexMaps

NODES = 32


def _missing(context: Context) -> str:
    return no_capacity(context) or no_workspace(context)


def whole(context: Context) -> IndexMaps:
    """The maps of the middle plane of the workspace, worked out once."""
    plane = plane_of_lengths(context, NODES)
    return context.kept(
        "force maps", lambda: capacity_maps(context.record, context.workspace, plane.names, plane.held, NODES)
    )


def _caption(context: Context) -> str:
    maps = whole(context).maps
    told = "; ".join(f"${item.symbol}$: {item.meaning}" for item in maps.values())
    falls = np.any(masses(context.record).gravity)
    return (
        f"What the actuators hold at rest{' under gravity' * bool(falls)} within their limits ({mode_words(context)})."
        f" {told}. Colours of forces end at their {100 * MOST:.0f} % quantile."
    )


def _draw(context: Context) -> Drawing:
    maps = whole(context)
    return drawn(
        context, maps, tops(maps), spent=("gravity", [name for name, item in maps.maps.items() if item.unit == "N"])
    )


FORCE_MAPS = FigureKind(
    "forces",
    "Forces over one plane",
    _missing,
    _caption,
    _draw,
)
