"""Rims: where a zero surface ends at the border of a region, read on the border itself.

Where branches merge a factor runs as a + b sqrt(d) at the distance d from the border. So its zero surface touches the
border instead of crossing it, and the meshes of both cross in teeth, one or two cells from where it ends. On the
border's own faces the factor is smooth: its zeros there are the rim.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from assur.workspace.grid import UniformGrid

FloatArray = NDArray[np.float64]
Faces = NDArray[np.int64]
BoolArray = NDArray[np.bool_]

FAR = 3.0
"""Steps of the grid over which a vertex is moved at most. Surfaces that touch with a curvature of 1/R are a tenth of a
step h apart at sqrt(0.2 h R): two steps where R is twenty, as in a box of that many cells."""

LEAST = 0.02
"""Steps below which a vertex stays: a surface that crosses the border has its rim there already, more exactly than the
field is known on the border."""

ON_FACE = 1e-7
"""Share of a step within which a point lies on a face of the box: booleans of meshes keep single precision at worst."""

CANDIDATES = 8
"""Pieces of the rim that are compared for each vertex: those whose middles are nearest."""


def with_rim(
    surface: tuple[FloatArray, Faces],
    border: tuple[FloatArray, Faces],
    field: Callable[[FloatArray], FloatArray],
    grid: UniformGrid,
) -> tuple[FloatArray, Faces]:
    """A zero surface whose vertices at the border of its region are moved to where the field is zero on that border.

    Args:
        surface: vertices (n, 3) and faces (k, 3) inside the region.
        border: the surface of the region, vertices (v, 3) and faces (f, 3), of which those on the box are no border.
        field: its values (m,) at points (m, 3) of the border, NaN where they are not known.
        grid: of the region; its steps measure how far a vertex may be moved.

    Returns:
        Vertices, and the faces that are left: none that the rim passes, and no slivers between two meshes.

    >>> from assur.workspace.domain import Box
    >>> from assur.workspace.grid import grid_over
    >>> grid = grid_over(Box(("x", "y", "z"), (0.0, 0.0, 0.0), (8.0, 8.0, 8.0)), 8)
    >>> border = np.array([[4.0, 0, 0], [4, 8, 0], [4, 8, 8], [4, 0, 8]]), np.array([[0, 1, 2], [0, 2, 3]])
    >>> teeth = np.array([[2.0, 2, 4], [4, 2, 1], [4, 3, 4], [4, 2, 7], [0, 2, 8], [0, 2, 0]])
    >>> fan = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5], [0, 5, 1]])
    >>> with_rim((teeth, fan), border, lambda points: points[:, 1] - 2.5, grid)[0][3:]
    array([[4. , 2.5, 1. ],
           [4. , 2.5, 4. ],
           [4. , 2.5, 7. ]])
    """
    vertices, faces = surface
    edges = rim_edges(faces)
    rows = np.unique(edges[~_on_one_face(grid, vertices[edges])])
    if not len(rows):
        return surface
    lines = _zero_lines(*_beside(border, vertices[rows], grid), field)
    if not len(lines):
        return surface
    moved = vertices.copy()
    sides = _on_faces(grid, vertices[rows])
    points = lines.reshape(-1, 3)
    sides_of_points = _on_faces(grid, points)
    for side in np.unique(sides, axis=0):
        own = rows[np.all(sides == side, axis=1)]
        ends = points[np.all(sides_of_points | ~side, axis=1)]
        if len(ends):
            to = ends[cKDTree(ends / grid.step).query(vertices[own] / grid.step)[1]]
            to = to if np.any(side) else _nearest(lines, vertices[own], grid)
            far = np.linalg.norm((to - vertices[own]) / grid.step, axis=1)
            off = (far > LEAST) & (far <= FAR)
            moved[own[off]] = to[off]
    return _welded(moved, faces[_reaching_inside(faces, rows)])


def _welded(vertices: FloatArray, faces: Faces) -> tuple[FloatArray, Faces]:
    """Vertices that are used, those in one place as one, and the faces (k, 3) that keep three corners."""
    used, index = np.unique(faces, return_inverse=True)
    kept, place = np.unique(vertices[used], axis=0, return_inverse=True)
    corners = place.ravel()[index].reshape(-1, 3)
    return kept, corners[np.all(corners != np.roll(corners, -1, axis=1), axis=1)]


def _reaching_inside(faces: Faces, rim: Faces) -> BoolArray:
    """Which faces (k, 3) hang together with a vertex that is none of the rim's: slivers of two meshes do not."""
    size = int(np.max(faces)) + 1
    ends = faces[:, [0, 1, 1, 2]].reshape(-1, 2)
    parts = connected_components(coo_array((np.ones(len(ends)), ends.T), shape=(size, size)), directed=False)[1]
    inner = np.setdiff1d(faces, rim)
    return np.isin(parts[faces[:, 0]], parts[inner])


def rim_edges(faces: Faces) -> Faces:
    """Edges (e, 2) that belong to one face (k, 3) alone."""
    edges = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    unique, count = np.unique(edges, axis=0, return_counts=True)
    return np.asarray(unique[count == 1])


def _on_faces(grid: UniformGrid, points: FloatArray) -> BoolArray:
    """On which faces (.., 6) of the box points (.., 3) lie."""
    near = ON_FACE * grid.step
    return np.concatenate([np.abs(points - end) <= near for end in (grid.low, grid.high)], axis=-1)


def _on_one_face(grid: UniformGrid, simplices: FloatArray) -> BoolArray:
    """Which simplices (k, corners, 3) lie on one face of the box."""
    return np.asarray(np.any(np.all(_on_faces(grid, simplices), axis=1), axis=1))


def _beside(border: tuple[FloatArray, Faces], points: FloatArray, grid: UniformGrid) -> tuple[FloatArray, Faces]:
    """What of a border, but for the box, is so near to points (N, 3) that they may be moved there."""
    vertices, faces = border
    faces = faces[~_on_one_face(grid, vertices[faces])]
    away = cKDTree(points / grid.step).query(vertices / grid.step, distance_upper_bound=FAR)[0]
    used, renumbered = np.unique(faces[np.any(np.isfinite(away)[faces], axis=1)], return_inverse=True)
    return vertices[used], renumbered.reshape(-1, 3)


def _zero_lines(vertices: FloatArray, faces: Faces, field: Callable[[FloatArray], FloatArray]) -> FloatArray:
    """Segments (k, 2, 3) on which a field is zero between the vertices (v, 3) of faces (f, 3)."""
    values = field(vertices)
    of_faces = values[faces]
    above = of_faces >= 0
    crossed = above != np.roll(above, -1, axis=1)  # edge k runs from corner k to the next
    rows = np.flatnonzero(np.any(crossed, axis=1) & np.all(np.isfinite(of_faces), axis=1))
    first = np.nonzero(crossed[rows])[1].reshape(-1, 2)
    start, end = (np.take_along_axis(faces[rows], at, axis=1) for at in (first, (first + 1) % 3))
    share = values[start] / (values[start] - values[end])
    return np.asarray(vertices[start] + share[..., None] * (vertices[end] - vertices[start]))


def _nearest(lines: FloatArray, points: FloatArray, grid: UniformGrid) -> FloatArray:
    """The points (N, 3) on segments (k, 2, 3) that are nearest to points (N, 3), measured in steps."""
    lines, points = lines / grid.step, points / grid.step
    count = min(CANDIDATES, len(lines))
    nearest = cKDTree(lines.mean(axis=1)).query(points, k=[*range(1, count + 1)])[1]  # (N, c)
    start, way = lines[nearest, 0], lines[nearest, 1] - lines[nearest, 0]
    length = np.sum(way**2, axis=-1)
    along = np.sum((points[:, None] - start) * way, axis=-1)
    share = np.clip(np.divide(along, length, out=np.zeros_like(along), where=length > 0), 0.0, 1.0)
    feet = start + share[..., None] * way
    best = np.argmin(np.sum((feet - points[:, None]) ** 2, axis=-1), axis=1)
    return np.asarray(feet[np.arange(len(points)), best] * grid.step)
