"""What is mapped of forces, of stiffness and of errors."""

from __future__ import annotations

from typing import TYPE_CHECKING

from assur.cli.mapped import PlaneMap
from assur.machine.accuracy.error_maps import error_maps, toleranced
from assur.machine.elasticity.stiffness_maps import stiffness_maps
from assur.machine.elasticity.structure import structure
from assur.machine.forces.capacity import force_limits
from assur.machine.forces.capacity_maps import capacity_maps, tops
from assur.machine.masses.link_masses import all_masses
from assur.workspace.index_maps import IndexMaps

if TYPE_CHECKING:
    from assur.figures.context import Context
    from assur.figures.spec import Drawing


def _forces_drawn(context: Context, maps: IndexMaps) -> Drawing:
    from assur.figures.index_maps import drawn

    return drawn(context, maps, tops(maps))


def _errors_drawn(context: Context, maps: IndexMaps) -> Drawing:
    from assur.figures.accuracy import errors_drawn

    return errors_drawn(context, maps)


def _stiffness_drawn(context: Context, maps: IndexMaps) -> Drawing:
    from assur.figures.stiffness_maps import drawn

    return drawn(context, maps)


FORCES = PlaneMap(
    "force",
    40,
    lambda record: (force_limits(record), all_masses(record)),
    lambda record, region, names, count, step: capacity_maps(record, region, names, nodes=count, progress=step),
    _forces_drawn,
    lambda _, maps: (
        "at rest under gravity, within the limits of the file; means and extremes are those of the nodes",
        "; ".join(f"{name}: {item.meaning}" for name, item in maps.maps.items() if " " not in name),
    ),
)
STIFFNESS = PlaneMap(
    "stiffness",
    30,
    structure,
    lambda record, region, names, count, step: stiffness_maps(record, region, names, nodes=count, progress=step),
    _stiffness_drawn,
    lambda _, __: (
        "means and extremes are those of the nodes; the direction is that of the least stiffness, without sense",
    ),
)
ERRORS = PlaneMap(
    "error",
    30,
    toleranced,
    lambda record, region, names, count, step: error_maps(record, region, names, nodes=count, progress=step),
    _errors_drawn,
    lambda _, maps: (
        "of first order, inputs held, with the tolerances of the file; means and extremes are those of the nodes",
        "; ".join(f"{name}: {item.meaning}" for name, item in maps.maps.items()),
    ),
)
