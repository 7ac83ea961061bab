"""Maps of the least stiffness and of its direction over coordinates of a workspace."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.rates.acceleration import joints_in_mode
from assur.kinematics.status import Status
from assur.machine.elasticity.stiffness import stiffness_at
from assur.machine.elasticity.structure import structure
from assur.model.mechanism import MechanismRecord
from assur.work import stage
from assur.workspace.fields import inside_at
from assur.workspace.index_maps import NODES, IndexMaps, map_grid
from assur.workspace.region import Workspace

FloatArray = NDArray[np.float64]
LEAST, MOTORS = "least_stiffness", "least_stiffness_of_actuators"
WAYS = ("direction_x", "direction_y", "direction_z")


@stage("maps of stiffness")
def stiffness_maps(
    record: MechanismRecord,
    region: Workspace,
    plane: Sequence[str] | None = None,
    held: Mapping[str, float] | None = None,
    nodes: int = NODES,
) -> IndexMaps:
    """The least translational stiffness on a grid over the box of a workspace, with its direction in the base's axes.

    Beside it the least that the actuators alone would leave. Arguments and errors are those of
    `assur.workspace.index_maps.index_maps`, and those of `assur.machine.elasticity.stiffness.stiffness`.

    >>> from assur.model.registry import load_record
    >>> from assur.workspace.region import workspace
    >>> record = load_record("tripteron")
    >>> own = stiffness_maps(record, workspace(record, resolution=8), ["x", "z"], nodes=4)
    >>> own["least_stiffness_of_actuators"].round(-3)[1, 1]
    np.float64(10000000.0)
    """
    structure(record)  # what the file lacks is told before anything is solved
    grid = map_grid(region, plane, held, nodes)
    inside = inside_at(region.margins, grid.points)
    points = grid.points[inside]
    by_form = record.closed_form is not None
    values = joints_in_mode(record, region.slice.poses(points), region.mode) if by_form else region.joints(points)
    reached = np.all(np.isfinite(values), axis=-1)
    inside[inside] = reached
    solved = stiffness_at(record, values[reached])
    sizes, ways = solved.translational
    motors = solved.actuator_only.translational[0]

    def spread(part: FloatArray) -> FloatArray:
        return np.asarray(grid.spread(inside, part, np.nan))

    meaning = "least stiffness against a force without moment"
    maps = {
        LEAST: grid.map(r"k_{\min}", meaning, "N/m", spread(sizes[:, 0])),
        MOTORS: grid.map(r"k_{\min}^a", f"{meaning}, if only the actuators gave way", "N/m", spread(motors[:, 0])),
    }
    for axis, name in enumerate(WAYS):
        maps[name] = grid.map(
            rf"e_{name[-1]}", f"{name[-1]} of the direction of the former", "", spread(ways[:, 0, axis])
        )
    return IndexMaps(
        **grid.header(record, region),
        status=grid.spread(inside, solved.status, Status.unreachable).reshape(grid.shape),
        length=None,
        reach=None,
        factor=None,
        maps=maps,
    )
