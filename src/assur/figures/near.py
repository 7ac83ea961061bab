"""Near: what of a workspace lies within its stated distance of a parallel-singular surface, as a solid to be drawn."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from manifold3d import Manifold
from numpy.typing import NDArray
from scipy.spatial import KDTree

from assur.model.pose import is_angle
from assur.workspace.fields import sample
from assur.workspace.grid import UniformGrid
from assur.workspace.nearness import divided, to_triangles, triangles_of
from assur.workspace.region import Workspace
from assur.workspace.slices import Columns
from assur.workspace.solids import intersection, solid_where, union

FloatArray = NDArray[np.float64]
CELLS_IN_DISTANCE = 1.5
FINEST = 160
CANDIDATES = 3


@dataclass(frozen=True, eq=False)
class TriangleDistance:
    """Distance of points from triangles (k, 3, 3), looked for up to a bound."""

    triangles: FloatArray
    bound: float

    @cached_property
    def _parts(self) -> FloatArray:
        return divided(self.triangles, self.bound / 2)

    @cached_property
    def _tree(self) -> KDTree:
        return KDTree(self._parts.mean(axis=1))

    def __call__(self, points: FloatArray) -> FloatArray:
        """Distance (n,) of points (n, 3); the bound beyond it.

        >>> from_square = TriangleDistance(np.array([[[0.0, 0, 0], [4, 0, 0], [4, 4, 0]]]), 10.0)
        >>> from_square(np.array([[3.0, 1.0, 2.0], [0.0, 0.0, 50.0]]))
        array([ 2., 10.])
        """
        found = np.full(len(points), self.bound)
        count = min(CANDIDATES, len(self._parts))
        nearest = self._tree.query(points, k=[*range(1, count + 1)], distance_upper_bound=self.bound)
        gaps, index = np.asarray(nearest[0]), np.asarray(nearest[1])
        for k in range(count):
            rows = np.flatnonzero(np.isfinite(gaps[:, k]))
            found[rows] = np.minimum(found[rows], to_triangles(points[rows], self._parts[index[rows, k]]))
        return found

    def field(self, columns: Columns) -> FloatArray:
        """The distance at poses whose coordinates broadcast."""
        wide = np.broadcast_arrays(*columns)
        points = np.zeros((wide[0].size, 3))
        for k, column in enumerate(wide):
            points[:, k] = column.ravel()
        return self(points).reshape(wide[0].shape)


def near_solid(region: Workspace) -> Manifold:
    """What of the workspace is within `near` of a parallel-singular surface, on the axes of its own solid."""
    if any(locus.everywhere for locus in region.loci):
        return region.region.solid
    surfaces = [triangles_of(locus.vertices, locus.faces) for locus in region.loci if len(locus.faces)]
    if not surfaces or any(is_angle(name) for name in region.box.names):
        return Manifold()
    wanted = np.ceil(CELLS_IN_DISTANCE * np.subtract(region.box.high, region.box.low) / region.near).astype(int)
    grid = UniformGrid(region.box, tuple(np.clip(wanted, 24, FINEST).tolist()))
    slab = np.ones(3)
    slab[grid.dimension :] = region.region.grid.slack / grid.slack
    close = [_round(TriangleDistance(surface, 2 * region.near), grid, region.near).scale(slab) for surface in surfaces]
    return intersection([region.region.solid, union(close)])


def _round(distance: TriangleDistance, grid: UniformGrid, near: float) -> Manifold:
    return solid_where(sample(lambda columns: near - distance.field(columns), grid), grid)
