"""Maps of what is measured at configurations of a working mode, block by block over the nodes of a workspace."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import nullcontext
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.home import home_values
from assur.kinematics.rates.acceleration import joints_in_mode
from assur.kinematics.status import Status
from assur.model.mechanism import MechanismRecord
from assur.work import Progress, stage
from assur.workspace.fields import inside_at
from assur.workspace.index_maps import NODES, IndexMaps, map_grid
from assur.workspace.mode_fields import CLOSED_FORM
from assur.workspace.region import Workspace

FloatArray = NDArray[np.float64]
AT_ONCE = 1024
"""Nodes that are measured together."""


class NodeMeasure(NamedTuple):
    """A number (N,) at N configurations, with the symbol, the meaning and the unit of its map."""

    symbol: str
    meaning: str
    unit: str
    values: FloatArray


class ChosenNodes(NamedTuple):
    """Which nodes maps have; arguments of `assur.workspace.index_maps.index_maps`."""

    plane: Sequence[str] | None = None
    held: Mapping[str, float] | None = None
    nodes: int = NODES


Measure = Callable[[FloatArray], tuple[NDArray[np.int8], Mapping[str, NodeMeasure]]]
"""Status (N,) and measures by name, of joint values (N, n)."""


def measured_maps(
    record: MechanismRecord,
    region: Workspace,
    measure: Measure,
    grid: ChosenNodes,
    name: str,
    progress: Progress | None,
) -> IndexMaps:
    """What is measured at the nodes of a grid over the box of a workspace; NaN outside it."""
    nodes = map_grid(region, *grid)
    inside = inside_at(region.margins, nodes.points)
    points = nodes.points[inside]
    by_form = region.how == CLOSED_FORM
    values = joints_in_mode(record, region.slice.poses(points), region.mode) if by_form else region.joints(points)
    known = np.all(np.isfinite(values), axis=1)
    inside[inside], values = known, values[known]
    parts = [measure(home_values(record)[None])]  # which tells the names, also where no node is inside
    with stage(name) if progress is None else nullcontext() as work:
        told = progress or (work.at if work else None)
        for first in range(0, len(values), AT_ONCE):
            parts.append(measure(values[first : first + AT_ONCE]))
            if told:
                told(min(first + AT_ONCE, len(values)), len(values))
    status = np.concatenate([part for part, _ in parts])[1:]
    maps = {
        key: own._replace(values=np.concatenate([told[key].values for _, told in parts])[1:])
        for key, own in parts[0][1].items()
    }
    return IndexMaps(
        **nodes.header(record, region),
        status=nodes.spread(inside, status, Status.unreachable).reshape(nodes.shape),
        length=None,
        reach=None,
        factor=None,
        maps={
            key: nodes.map(own.symbol, own.meaning, own.unit, nodes.spread(inside, own.values, np.nan))
            for key, own in maps.items()
        },
    )
