"""Solids: where a signed field is not negative, closed, as a manifold mesh that can be intersected and measured.

Each field is meshed by itself (marching cubes) and the solids are intersected exactly; a 0/1 mask of the
region is never meshed, so edges where two surfaces meet stay sharp.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from manifold3d import Error, Manifold, Mesh64, OpType
from numpy.typing import NDArray
from skimage.measure import marching_cubes

from assur.errors import AssurError
from assur.workspace.crossings import Crossing, on_surface
from assur.workspace.grid import UniformGrid

FloatArray = NDArray[np.float64]
Faces = NDArray[np.int64]
TINY = 1e-6


def solid_where(
    values: NDArray[np.float32],
    grid: UniformGrid,
    crossing: Crossing | None = None,
    cells: NDArray[np.bool_] | None = None,
) -> Manifold:
    """Solid where a field >= 0, from its values at the nodes of a grid.

    `crossing` says where the field is zero on an edge of the grid; with it every vertex lies on the surface as
    exactly as it does, without it vertices are interpolated. Where only a part of the solid matters, `cells` (one
    fewer than nodes along each axis) says in which cells: vertices beside none of them stay interpolated. The solid is
    closed outside the box; intersect it with `cuboid`.

    Example: half the ball of radius 1, to 1 % with 8 cells across.

    >>> from assur.workspace.domain import Box
    >>> from assur.workspace.grid import grid_over
    >>> grid = grid_over(Box(("x", "y", "z"), (-1.0, -1.0, 0.0), (1.0, 1.0, 1.0)), 16)
    >>> x, y, z = np.moveaxis(grid.position(np.stack(np.indices(grid.shape), axis=-1)), -1, 0)
    >>> ball = solid_where((1 - x**2 - y**2 - z**2).astype(np.float32), grid)
    >>> round(intersection([ball, cuboid(grid)]).volume(), 2)  # 2 pi / 3 = 2.094
    2.08
    """
    size = np.float32(np.max(np.abs(values)))
    if size == 0 or np.min(values) >= 0:
        return cuboid(grid)
    if np.max(values) < 0:
        return Manifold()
    # a node exactly on the surface counts as inside; the padding closes the solid outside the box
    scaled = np.pad(np.where(values == 0, np.float32(TINY), values / size), 1, constant_values=-1.0)
    vertices, faces, _, _ = marching_cubes(scaled, 0.0, gradient_direction="ascent", allow_degenerate=True)
    index = vertices.astype(float) - 1.0
    if crossing is not None:
        everywhere = np.ones(tuple(size - 1 for size in grid.shape), dtype=bool)
        index = on_surface(index, values, crossing, grid, everywhere if cells is None else cells)
    solid = Manifold(Mesh64(np.ascontiguousarray(grid.position(index)), np.ascontiguousarray(faces, dtype=np.uint64)))
    if solid.status() != Error.NoError:
        raise AssurError(f"marching cubes gave a mesh that is no solid: {solid.status()}")
    return solid.as_original()


def cuboid(grid: UniformGrid) -> Manifold:
    """The box of a grid, exactly."""
    return Manifold.cube(grid.high - grid.low).translate(grid.low)


def intersection(solids: Sequence[Manifold]) -> Manifold:
    """What all solids share."""
    return Manifold.batch_boolean(list(solids), OpType.Intersect)


def union(solids: Sequence[Manifold]) -> Manifold:
    """What lies in any of the solids."""
    return Manifold.batch_boolean(list(solids), OpType.Add)


def mesh(solid: Manifold) -> tuple[FloatArray, Faces]:
    """Vertices (n, 3) and faces (k, 3), seen from outside counter-clockwise."""
    data = solid.to_mesh64()
    return np.array(data.vert_properties[:, :3]), np.array(data.tri_verts, dtype=np.int64)


def surface_in(region: Manifold, cutter: Manifold) -> tuple[FloatArray, Faces]:
    """The part of a cutter's surface that lies inside a region: vertices (n, 3) and faces (k, 3).

    Exact for the two meshes: the faces of their intersection that descend from the cutter.
    """
    data = intersection([region, cutter]).to_mesh64()
    parts = [
        data.tri_verts[data.run_index[k] // 3 : data.run_index[k + 1] // 3]
        for k, source in enumerate(data.run_original_id)
        if source == cutter.original_id()
    ]
    faces = np.concatenate([np.empty((0, 3)), *parts]).astype(np.int64)
    used, renumbered = np.unique(faces, return_inverse=True)
    return np.array(data.vert_properties[used, :3]), renumbered.reshape(-1, 3)


def area_of(vertices: FloatArray, faces: Faces) -> float:
    """Total area of the triangles."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    return float(np.sum(np.linalg.norm(np.cross(b - a, c - a), axis=1)) / 2)
