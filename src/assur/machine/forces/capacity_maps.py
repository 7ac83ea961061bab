"""Maps of what the actuators hold and how fast they move the platform, over the nodes of a workspace."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from assur.machine.forces.capacity import HeldForces, held_forces
from assur.machine.forces.utilisation import stated
from assur.model.mechanism import MechanismRecord
from assur.work import Progress
from assur.workspace.index_maps import NODES, IndexMaps
from assur.workspace.measured_maps import ChosenNodes, NodeMeasure, measured_maps
from assur.workspace.region import Workspace

FloatArray = NDArray[np.float64]
MOST = 0.95
"""Colours end at this quantile of forces, which grow without bound towards some singularities."""


def capacity_maps(
    record: MechanismRecord,
    region: Workspace,
    plane: Sequence[str] | None = None,
    held: Mapping[str, float] | None = None,
    nodes: int = NODES,
    progress: Progress | None = None,
) -> IndexMaps:
    """What is held at rest under gravity, at the nodes of a grid over the box of a workspace; NaN outside it.

    "sphere" [N] is held in every direction, "along x" and "against x" [N] along an axis; "gravity" is the largest share
    of an actuator's limit that gravity asks for; "speed" [m/s], where the file says how fast all actuators are and
    the pose has lengths alone, is that of the platform in its slowest direction.

    Errors:
        UsageError: actuators without a largest force, links without a mass, a grid that is none.

    >>> from assur.model.registry import load_record
    >>> from assur.workspace.region import workspace
    >>> record = load_record("tripteron")
    >>> maps = capacity_maps(record, workspace(record, resolution=8), ["x", "z"], nodes=4)
    >>> list(maps.maps)[:3], maps["sphere"].shape
    (['sphere', 'gravity', 'against x'], (4, 4))
    """
    grid = ChosenNodes(plane, held, nodes)
    return measured_maps(record, region, lambda values: _measured(record, values), grid, "maps of forces", progress)


def _measured(record: MechanismRecord, values: FloatArray) -> tuple[NDArray[np.int8], dict[str, NodeMeasure]]:
    own = held_forces(record, values)
    most = np.max(own.utilisation, axis=1)
    told = {
        "sphere": NodeMeasure(r"F_\min", "largest force that is held in every direction", "N", own.sphere),
        "gravity": NodeMeasure(r"u_g", "largest share of an actuator's limit that gravity asks for", "", most),
    }
    for axis, name in enumerate(own.axes):
        for side, (word, sign) in enumerate((("against", "-"), ("along", "+"))):
            symbol, meaning = rf"F_{{{sign}{name}}}", f"largest force that is held {word} {name}"
            told[f"{word} {name}"] = NodeMeasure(symbol, meaning, "N", own.per_axis[:, axis, side])
    speed = slowest(record, own)
    if speed is not None:
        told["speed"] = NodeMeasure(r"v_\min", "speed of the platform in its slowest direction", "m/s", speed)
    return own.answer.status, told


def slowest(record: MechanismRecord, own: HeldForces) -> FloatArray | None:
    """Speed (N,) of the platform in its slowest direction within those of the actuators, by the forces of loads.

    None where the file does not say them all, or the pose has angles, or drives are redundant.

    >>> from assur.kinematics.rates.acceleration import reached_in_mode
    >>> from assur.model.registry import load_record
    >>> record = load_record("orthoglide")
    >>> slowest(record, held_forces(record, *reached_in_mode(record, np.zeros((1, 3))))).round(9).tolist()
    [1.0]
    """
    limits = stated(record, "speed")
    if np.isnan(limits).any() or {*own.per_load.shape[1:]} != {len(record.platform.pose)}:
        return None
    per_rate = np.full(own.per_load.shape, np.nan)
    known = np.flatnonzero(np.isfinite(own.per_load).all(axis=(1, 2)))
    known = known[np.linalg.det(own.per_load[known]) != 0.0]
    per_rate[known] = np.swapaxes(np.linalg.inv(own.per_load[known]), -1, -2)  # rates of drives, but for their sign
    return np.asarray(np.min(limits / np.linalg.norm(per_rate, axis=-1), axis=1))


def tops(maps: IndexMaps) -> dict[str, float]:
    """Where colours of maps end; of the share that gravity asks for at 1, where an actuator is at its limit.

    >>> from assur.model.registry import load_record
    >>> from assur.workspace.region import workspace
    >>> record = load_record("tripteron")
    >>> tops(capacity_maps(record, workspace(record, resolution=8), ["x", "z"], nodes=4))["gravity"] <= 1.0
    True
    """
    known = {name: item.values[np.isfinite(item.values)] for name, item in maps.maps.items()}
    ends = {name: float(np.quantile(values, MOST)) for name, values in known.items() if len(values)}
    if "gravity" in ends:
        ends["gravity"] = min(float(known["gravity"].max()), 1.0)
    return {name: top for name, top in ends.items() if top > 0.0}
