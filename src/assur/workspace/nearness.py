"""Nearness: how much of a region lies within a distance of a set of triangles."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from manifold3d import Manifold
from numpy.typing import NDArray
from scipy.spatial import KDTree

from assur.workspace.fields import sample
from assur.workspace.grid import UniformGrid
from assur.workspace.reach import Reach
from assur.workspace.slices import Columns
from assur.workspace.solids import intersection, solid_where, union

FloatArray = NDArray[np.float64]
FINEST = 256
COARSEST = 32
CANDIDATES = 3
"""Triangles that are looked at for the distance of one point."""


def near_volume(region: Reach, surfaces: Sequence[FloatArray], distance: float) -> float | None:
    """Volume of what lies in a region within `distance` of surfaces, triangles (k, 3, 3) each, in units of the pose.

    Round each surface the solid `distance` - d >= 0 of the distance d is meshed, on a grid of its own whose
    cells are at most 2/3 of `distance`; None where that would take more than 256 cells along a coordinate.
    """
    box = region.grid.box
    cells = np.maximum(COARSEST, np.ceil(1.5 * np.subtract(box.high, box.low) / distance)).astype(int)
    if np.any(cells > FINEST):
        return None
    grid = UniformGrid(box, tuple(cells.tolist()))
    near = union([_round(triangles, grid, distance) for triangles in surfaces])
    slab = np.ones(3)
    slab[grid.dimension :] = grid.slack / region.grid.slack
    return float(intersection([region.solid.scale(slab), near]).volume()) / grid.thickness


def _round(triangles: FloatArray, grid: UniformGrid, distance: float) -> Manifold:
    search = _Search(triangles, distance, 2 * distance + float(np.linalg.norm(grid.step)))
    return solid_where(sample(lambda columns: distance - search.field(columns), grid), grid)


def triangles_of(vertices: FloatArray, faces: NDArray[np.int64]) -> FloatArray:
    """Corners (k, 3, 3) of triangles, or of segments taken as flat triangles, at zero on slack axes."""
    points = np.zeros((len(vertices), 3))
    points[:, : vertices.shape[1]] = vertices
    return points[faces[:, [0, 1, -1]]]


class _Search:
    """Distance from points to triangles, looked for among those with the nearest centroids, up to a bound."""

    def __init__(self, triangles: FloatArray, longest: float, bound: float) -> None:
        self.triangles = divided(triangles, longest)
        self.bound = bound
        self.tree = KDTree(self.triangles.mean(axis=1))

    def field(self, columns: Columns) -> FloatArray:
        """The distance at poses whose coordinates broadcast."""
        wide = np.broadcast_arrays(*columns)
        points = np.zeros((wide[0].size, 3))
        for k, column in enumerate(wide):
            points[:, k] = column.ravel()
        return self.distance(points).reshape(wide[0].shape)

    def distance(self, points: FloatArray) -> FloatArray:
        """The distance (n,) of points (n, 3); `bound` beyond it."""
        found = np.full(len(points), self.bound)
        count = min(CANDIDATES, len(self.triangles))
        nearest = self.tree.query(points, k=[*range(1, count + 1)], distance_upper_bound=self.bound, workers=-1)
        gaps, index = np.asarray(nearest[0]), np.asarray(nearest[1])
        for k in range(count):
            rows = np.flatnonzero(np.isfinite(gaps[:, k]))
            found[rows] = np.minimum(found[rows], to_triangles(points[rows], self.triangles[index[rows, k]]))
        return found


def divided(triangles: FloatArray, longest: float) -> FloatArray:
    """Triangles (k, 3, 3) cut across their longest edges until no edge is longer than `longest`.

    >>> divided(np.array([[[0.0, 0, 0], [4, 0, 0], [0, 3, 0]]]), 2.6).shape
    (4, 3, 3)
    """
    done = []
    while len(triangles):
        lengths = np.linalg.norm(np.roll(triangles, -1, axis=1) - triangles, axis=2)  # edge k: from corner k
        edge = np.argmax(lengths, axis=1)
        rows = np.arange(len(triangles))
        long = lengths[rows, edge] > longest
        done.append(triangles[~long])
        start, end, apex = (triangles[rows, (edge + k) % 3][long] for k in range(3))
        middle = 0.5 * (start + end)
        triangles = np.concatenate([np.stack([start, middle, apex], 1), np.stack([middle, end, apex], 1)])
    return np.concatenate(done)


def to_triangles(points: FloatArray, corners: FloatArray) -> FloatArray:
    """Distance (n,) of points (n, 3) to one triangle each, corners (n, 3, 3).

    >>> to_triangles(np.array([[0.2, 0.2, 2.0], [4.0, 0.0, 0.0]]), np.array([[[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]] * 2))
    array([2., 3.])
    """
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normal, axis=1)
    inside = length > 0
    best = np.full(len(points), np.inf)
    for k in range(3):
        start, side = corners[:, k], corners[:, (k + 1) % 3] - corners[:, k]
        to = points - start
        square = np.einsum("nx,nx->n", side, side)
        share = np.clip(np.einsum("nx,nx->n", to, side) / np.where(square > 0, square, 1.0), 0.0, 1.0)
        best = np.minimum(best, np.linalg.norm(to - share[:, None] * side, axis=1))
        inside &= np.einsum("nx,nx->n", np.cross(side, to), normal) >= 0
    height = np.abs(np.einsum("nx,nx->n", points - corners[:, 0], normal)) / np.where(length > 0, length, 1.0)
    return np.where(inside, height, best)
