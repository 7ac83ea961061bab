"""Maps of what the tolerances of a file add to, over coordinates of a workspace."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.home import home_values
from assur.kinematics.status import Status
from assur.machine.accuracy.farthest import farthest
from assur.machine.accuracy.pose_errors import pose_errors_at
from assur.model.mechanism import MechanismRecord
from assur.work import Progress
from assur.workspace.index_maps import NODES, IndexMaps
from assur.workspace.measured_maps import ChosenNodes, NodeMeasure, measured_maps
from assur.workspace.region import Workspace

FloatArray = NDArray[np.float64]
ROUNDED = 1e-9
"""Share of the largest displacement, over the mechanism's size, below which a rotation is rounding."""
WORST, SQUARES, TURNED = "worst_displacement", "root_sum_square", "worst_rotation"


def toleranced(record: MechanismRecord) -> None:
    """Nothing where a file states tolerances.

    Errors:
        UsageError: it states none.
    """
    if not record.machine.tolerances:
        first = next(iter(record.parameters), record.drives[0].name)
        raise UsageError(f"{record.name} states no tolerances", hint=f"write [tolerances] and below it {first} = 0.05")


def error_maps(
    record: MechanismRecord,
    region: Workspace,
    plane: Sequence[str] | None = None,
    held: Mapping[str, float] | None = None,
    nodes: int = NODES,
    progress: Progress | None = None,
) -> IndexMaps:
    """How far the platform is off, to first order, on a grid over the box of a workspace; inputs are held.

    "worst_displacement" is the largest that tolerances at their bounds allow, "root_sum_square" the root of the sum of
    the squares of what each bound does, in the mechanism's unit; "worst_rotation" the largest rotation, in rad, also of
    a platform that should have none. Arguments are those of `assur.workspace.index_maps.index_maps`.

    Errors:
        UsageError: no tolerances, or one of what no joint is written with; a grid that is none.

    >>> from dataclasses import replace
    >>> from assur.model.machine_data import Tolerance
    >>> from assur.model.registry import load_record
    >>> from assur.workspace.region import workspace
    >>> record = load_record("tripteron")
    >>> record = replace(record, machine=replace(record.machine, tolerances={"q1": Tolerance(0.1, 0.03)}))
    >>> own = error_maps(record, workspace(record, resolution=8), ["x", "z"], nodes=4)
    >>> float(own["worst_displacement"][1, 1].round(9)), float(own["worst_rotation"][1, 1].round(9))
    (0.1, 0.0)
    """
    toleranced(record)
    at_home = pose_errors_at(record, home_values(record), bent=False)
    bent = any(not at_home.compatible(name) for name in record.machine.tolerances)
    grid = ChosenNodes(plane, held, nodes)
    return measured_maps(
        record, region, lambda values: _measured(record, values, bent=bent), grid, "maps of errors", progress
    )


def _measured(
    record: MechanismRecord, values: FloatArray, *, bent: bool
) -> tuple[NDArray[np.int8], dict[str, NodeMeasure]]:
    status = np.full(len(values), Status.regular, dtype=np.int8)
    rows = np.full((len(values), len(record.machine.tolerances), 6), np.nan)
    for place, joints in enumerate(values):
        own = pose_errors_at(record, joints, bent=bent)
        status[place] = own.status
        if own.status == Status.regular:
            rows[place] = [own.sensitivity[name] * bound for name, bound in own.bounds.items()]
    shifts, turns = rows[..., :3], rows[..., 3:]
    least = ROUNDED * np.max(np.abs(shifts), axis=(1, 2), initial=0.0) / characteristic_length(record)
    turns = np.where(np.abs(turns) < least[:, None, None], 0.0, turns)
    squares = np.sqrt(np.sum(shifts**2, axis=(1, 2)))
    return status, {
        WORST: NodeMeasure(r"e_{\max}", "largest displacement within the tolerances", record.unit, farthest(shifts)),
        SQUARES: NodeMeasure(r"e_{\mathrm{rss}}", "root sum square of the displacements", record.unit, squares),
        TURNED: NodeMeasure(r"\varphi_{\max}", "largest rotation within the tolerances", "rad", farthest(turns)),
    }
