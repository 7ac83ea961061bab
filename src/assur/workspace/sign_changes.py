"""Where a map of the workspace shows that something vanishes: ways across its singular surfaces and its border.

A workspace that was followed knows joint values on both sides of a surface on which det Jp changes its sign, and next
to the border at which its mode ends. Each way begins at a reached node and leads to a neighbour beyond.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from assur.singularity.examples import Way
from assur.singularity.loci import OUTPUT
from assur.workspace.followed_field import FollowedField
from assur.workspace.region import Workspace

MOST = 16
"""Ways along one axis across a surface, and ways beyond the border, at most."""


def ways_across(region: Workspace) -> Iterator[Way]:
    """Ways on which a followed workspace shows that det Jp changes its sign, then ways beyond its border.

    Joint values (n,) at a reached node of the grid, and the pose (m,) of a neighbour. None with a closed form.

    >>> from assur.model.registry import load_record
    >>> from assur.workspace.region import workspace
    >>> list(ways_across(workspace(load_record("fivebar"), resolution=8)))
    []
    """
    field = next((item for item in region.margins.values() if isinstance(item, FollowedField)), None)
    if field is None or not np.any(field.over.reached):
        return
    over = field.over
    sides = np.full(over.reached.shape, np.nan)
    if OUTPUT.name in region.region.factors:
        sides[over.reached] = np.sign(over.at_nodes.measures[1])
    for axis in range(sides.ndim):
        here, there = (np.take(sides, range(first, sides.shape[axis] + first - 1), axis) for first in (0, 1))
        nodes = np.argwhere(here * there < 0)
        nodes = nodes[_central(nodes, sides.shape)]
        ahead = nodes + np.eye(sides.ndim, dtype=np.intp)[axis]
        yield from zip(over.joints[tuple(nodes.T)], region.slice.poses(over.points(ahead)), strict=True)
    rows = _central(over.ends.tails, sides.shape)
    tails, heads = over.ends.tails[rows], over.ends.heads[rows]
    yield from zip(over.joints[tuple(tails.T)], region.slice.poses(over.points(heads)), strict=True)


def _central(nodes: NDArray[np.intp], shape: tuple[int, ...]) -> NDArray[np.intp]:
    """Which nodes (k, d) are nearest to the middle of the grid, at most `MOST`; the outermost are not in the box."""
    away = np.max(np.abs(nodes / np.maximum(np.subtract(shape, 1), 1) - 0.5), axis=1, initial=0.0)
    return np.argsort(away, kind="stable")[:MOST]
