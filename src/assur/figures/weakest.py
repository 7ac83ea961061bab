"""The least stiffness over one plane through the workspace, beside what the actuators alone would leave."""

from __future__ import annotations

from assur.figures.context import Context
from assur.figures.plane_map import plane_of_lengths
from assur.figures.plots import mode_words, no_workspace
from assur.figures.spec import FigureKind
from assur.figures.stiffness_maps import drawn
from assur.figures.strain_colours import no_springs
from assur.machine.elasticity.stiffness_maps import stiffness_maps
from assur.model.pose import LENGTHS
from assur.workspace.index_maps import IndexMaps

NODES = 30


def _missing(context: Context) -> str:
    return no_springs(context) or no_workspace(context)


def _maps(context: Context) -> IndexMaps:
    plane = plane_of_lengths(context, NODES)
    return context.kept(
        "stiffness maps", lambda: stiffness_maps(context.record, context.workspace, plane.names, plane.held, NODES)
    )


def _caption(context: Context) -> str:
    dashes = ", with dashes along the direction in which the platform gives way most, points where that is across"
    of_lengths = set(plane_of_lengths(context, NODES).names) <= set(LENGTHS)
    return (
        f"The least stiffness against a force without moment ({mode_words(context)}): (a) links and"
        f" actuators{f'{dashes} the plane' if of_lengths else ''}; (b) if only the actuators gave way; (c) how many"
        " times as much that is. Colours by decades."
    )


WEAKEST = FigureKind(
    "weakest", "Least stiffness over one plane", _missing, _caption, lambda context: drawn(context, _maps(context))
)
