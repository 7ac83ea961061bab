"""Maps of what the actuators hold and how fast they move the platform, over the nodes of a workspace."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.rates.acceleration import joints_in_mode
from assur.kinematics.status import Status
from assur.machine.forces.capacity import HeldForces, held_forces
from assur.machine.forces.utilisation import stated
from assur.model.mechanism import MechanismRecord
from assur.work import stage
from assur.workspace.fields import inside_at
from assur.workspace.index_maps import NODES, IndexMaps, map_grid
from assur.workspace.mode_fields import CLOSED_FORM
from assur.workspace.region import Workspace

FloatArray = NDArray[np.float64]
MOST = 0.95
"""Colours end at this quantile of forces, which grow without bound towards some singularities."""


@stage("maps of forces")
def capacity_maps(
    record: MechanismRecord,
    region: Workspace,
    plane: Sequence[str] | None = None,
    held: Mapping[str, float] | None = None,
    nodes: int = NODES,
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
    grid = map_grid(region, plane, held, nodes)
    inside = inside_at(region.margins, grid.points)
    points = grid.points[inside]
    if region.how == CLOSED_FORM:
        values = joints_in_mode(record, region.slice.poses(points), region.mode)
    else:
        values = region.joints(points)
    known = np.all(np.isfinite(values), axis=1)
    inside[np.flatnonzero(inside)[~known]] = False
    own = held_forces(record, values[known])
    told = {
        "sphere": ((r"F_\min", "largest force that is held in every direction", "N"), own.sphere),
        "gravity": ((r"u_g", "largest share of an actuator's limit that gravity asks for", ""), _largest(own)),
    }
    for axis, name in enumerate(own.axes):
        for side, (word, sign) in enumerate((("against", "-"), ("along", "+"))):
            symbol, meaning = rf"F_{{{sign}{name}}}", f"largest force that is held {word} {name}"
            told[f"{word} {name}"] = (symbol, meaning, "N"), own.per_axis[:, axis, side]
    speed = slowest(record, own)
    if speed is not None:
        told["speed"] = (r"v_\min", "speed of the platform in its slowest direction", "m/s"), speed
    return IndexMaps(
        **grid.header(record, region),
        status=grid.spread(inside, own.answer.status, Status.unreachable).reshape(grid.shape),
        length=None,
        reach=None,
        factor=None,
        maps={name: grid.map(*words, grid.spread(inside, part, np.nan)) for name, (words, part) in told.items()},
    )


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
    known = np.flatnonzero(np.abs(np.nan_to_num(np.linalg.det(own.per_load))) > 0.0)
    per_rate[known] = np.swapaxes(np.linalg.inv(own.per_load[known]), -1, -2)  # rates of drives, but for their sign
    return np.asarray(np.min(limits / np.linalg.norm(per_rate, axis=-1), axis=1))


def _largest(own: HeldForces) -> FloatArray:
    return np.asarray(np.max(own.utilisation, axis=1))


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
