"""Maps of the least stiffness and of its direction over coordinates of a workspace."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from assur.machine.elasticity.stiffness import stiffness_at
from assur.machine.elasticity.structure import structure
from assur.model.mechanism import MechanismRecord
from assur.work import Progress
from assur.workspace.index_maps import NODES, IndexMaps
from assur.workspace.measured_maps import ChosenNodes, NodeMeasure, measured_maps
from assur.workspace.region import Workspace

FloatArray = NDArray[np.float64]
LEAST, MOTORS = "least_stiffness", "least_stiffness_of_actuators"
WAYS = ("direction_x", "direction_y", "direction_z")


def stiffness_maps(
    record: MechanismRecord,
    region: Workspace,
    plane: Sequence[str] | None = None,
    held: Mapping[str, float] | None = None,
    nodes: int = NODES,
    progress: Progress | None = None,
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
    grid = ChosenNodes(plane, held, nodes)
    return measured_maps(record, region, lambda values: _measured(record, values), grid, "maps of stiffness", progress)


def _measured(record: MechanismRecord, values: FloatArray) -> tuple[NDArray[np.int8], dict[str, NodeMeasure]]:
    solved = stiffness_at(record, values)
    sizes, ways = solved.translational
    motors = solved.actuator_only.translational[0]
    meaning = "least stiffness against a force without moment"
    told = {
        LEAST: NodeMeasure(r"k_{\min}", meaning, "N/m", sizes[:, 0]),
        MOTORS: NodeMeasure(r"k_{\min}^a", f"{meaning}, if only the actuators gave way", "N/m", motors[:, 0]),
    }
    for axis, name in enumerate(WAYS):
        of = f"{name[-1]} of the direction of the former"
        told[name] = NodeMeasure(rf"e_{name[-1]}", of, "", ways[:, 0, axis])
    return solved.status, told
