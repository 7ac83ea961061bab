"""Near: what of a workspace lies within its stated distance of a parallel-singular surface, as a solid to be drawn."""

from __future__ import annotations

import numpy as np
from manifold3d import Manifold
from numpy.typing import NDArray
from scipy.spatial import KDTree

from assur.kinematics.border import LENGTHS
from assur.workspace.fields import sample
from assur.workspace.grid import UniformGrid
from assur.workspace.nearness import divided, to_triangles, triangles_of
from assur.workspace.region import Workspace
from assur.workspace.solids import intersection, solid_where

FloatArray = NDArray[np.float64]
CELLS_IN_DISTANCE = 1.5
FINEST = 160
CANDIDATES = 3


class Distance:
    """Distance of points from the parallel-singular surfaces of a workspace, up to a bound of twice `near`."""

    def __init__(self, found: Workspace) -> None:
        surfaces = [triangles_of(locus.vertices, locus.faces) for locus in found.loci if len(locus.faces)]
        self.bound = 2.0 * found.near
        self.triangles = divided(np.concatenate(surfaces), found.near) if surfaces else np.zeros((0, 3, 3))
        self.tree = KDTree(self.triangles.mean(axis=1)) if surfaces else None

    def __call__(self, points: FloatArray) -> FloatArray:
        """Distance (n,) of points (n, 3); the bound beyond it."""
        found = np.full(len(points), self.bound)
        if self.tree is None:
            return found
        count = min(CANDIDATES, len(self.triangles))
        nearest = self.tree.query(points, k=[*range(1, count + 1)], distance_upper_bound=self.bound)
        gaps, index = np.asarray(nearest[0]), np.asarray(nearest[1])
        for k in range(count):
            rows = np.flatnonzero(np.isfinite(gaps[:, k]))
            found[rows] = np.minimum(found[rows], to_triangles(points[rows], self.triangles[index[rows, k]]))
        return found


def near_solid(found: Workspace) -> Manifold:
    """What of the workspace is within `near` of a parallel-singular surface, on the axes of its own solid."""
    if any(locus.everywhere for locus in found.loci):
        return found.region.solid
    if any(name not in LENGTHS for name in found.box.names) or not any(
        len(locus.faces) for locus in found.loci
    ):
        return Manifold()
    wanted = np.ceil(CELLS_IN_DISTANCE * np.subtract(found.box.high, found.box.low) / found.near).astype(int)
    grid = UniformGrid(found.box, tuple(np.clip(wanted, 24, FINEST).tolist()))
    distance = Distance(found)

    def field(columns: tuple[FloatArray, ...]) -> FloatArray:
        wide = np.broadcast_arrays(*columns)
        points = np.zeros((wide[0].size, 3))
        for k, column in enumerate(wide):
            points[:, k] = column.ravel()
        return found.near - distance(points).reshape(wide[0].shape)

    slab = np.ones(3)
    slab[grid.dimension :] = found.region.grid.slack / grid.slack
    return intersection([found.region.solid, solid_where(sample(field, grid), grid).scale(slab)])
