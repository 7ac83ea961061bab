"""The region itself: every pose of a box at which no margin of a working mode is negative, as one solid."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np
from manifold3d import Manifold
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt

from assur.workspace.crossings import root_of
from assur.workspace.fields import Field, at_points, samples
from assur.workspace.followed_field import FollowedField
from assur.workspace.followed_reach import ReachField
from assur.workspace.grid import UniformGrid
from assur.workspace.rims import with_rim
from assur.workspace.solids import Faces, area_of, cuboid, intersection, mesh, solid_where, surface_in

FloatArray = NDArray[np.float64]
INSIDE = 0.04
"""Share of the way from the border to the nearest node inside at which a factor is read: a facet of the border may be
off by the square of a step, which would count as depth nearer to it."""


@dataclass(frozen=True, eq=False)
class Reach:
    """A region on a grid.

    Attributes:
        grid: the domain and its nodes.
        factors: the parallel factors of the working mode.
        solid: the region on three axes, cut exactly by the box.
        inside: (nodes) where no margin is negative.
        at_nodes: (nodes) each field, by "margin" or "factor" and its name.
        cells: (cells) that may hold a part of the region: at no margin all of its corners are negative.
    """

    grid: UniformGrid
    factors: Mapping[str, Field]
    solid: Manifold
    inside: NDArray[np.bool_]
    at_nodes: Mapping[tuple[str, str], NDArray[np.float32]]
    cells: NDArray[np.bool_]

    @property
    def volume(self) -> float:
        """Volume, or area of a plane region, in the units of the pose coordinates."""
        return float(self.solid.volume()) / self.grid.thickness

    def factor_inside(self, name: str) -> NDArray[np.float32]:
        """A factor at the nodes (k,) that the region reaches, one cell beyond the box included; none if it is empty."""
        if self.solid.is_empty():
            return np.empty(0, dtype=np.float32)
        return self.at_nodes["factor", name][self.inside]

    def positive(self, name: str) -> Manifold:
        """Where a factor is positive, on three axes: it divides the region by its sign."""
        return _solid(self.factors[name], self.at_nodes["factor", name], self.grid, self.cells)

    def zero_surface(self, name: str) -> tuple[FloatArray, Faces, float]:
        """Zero set of a factor inside the region: vertices (n, m), faces (k, 3) or segments (k, 2), area or length."""
        surface = surface_in(self.solid, self.positive(name))
        vertices, faces = with_rim(surface, mesh(self.solid), partial(self._at_border, name), self.grid)
        size = area_of(vertices, faces) / self.grid.thickness
        return *in_pose_coordinates(self.grid, vertices, faces), size

    def _at_border(self, name: str, points: FloatArray) -> FloatArray:
        """A factor (n,) at points (n, 3) on the border. One that was followed is not known there, but 1, 4 and 9 times
        `INSIDE` further in: it runs as a + b s + c s^2 with s = sqrt(depth), and is a at s = 0.
        """
        field = self.factors[name]
        if not isinstance(field, FollowedField):
            return at_points(field, self.grid.dimension, points)
        index = np.rint((points - self.grid.position(np.zeros(3))) / self.grid.step).astype(np.intp)
        index = np.clip(index, 0, np.subtract(self.grid.shape, 1))
        nodes = distance_transform_edt(~self.inside, return_distances=False, return_indices=True)[:, *index.T].T
        way = self.grid.position(nodes.astype(float)) - points
        first, second, third = (
            at_points(field, self.grid.dimension, points + depth * way) for depth in (INSIDE, 4 * INSIDE, 9 * INSIDE)
        )
        return 3 * first - 3 * second + third

    def mesh(self) -> tuple[FloatArray, Faces]:
        """Surface of the region, vertices (n, 3) and faces (k, 3); of a plane one its inside, triangulated."""
        vertices, faces = mesh(self.solid)
        if self.grid.dimension == 3:
            return vertices, faces
        floor = np.all(_on_floor(self.grid, vertices)[faces], axis=1)
        return _compact(vertices[:, : self.grid.dimension], faces[floor, ::-1])


def reach(
    margins: Mapping[str, Field],
    factors: Mapping[str, Field],
    grid: UniformGrid,
    tick: Callable[[], None] = lambda: None,
    finer: Reach | None = None,
) -> Reach:
    """Intersect the box with the solid of every margin; equal fields count once, positive ones not at all.

    Margins and factors are read together, once per node; not again where `finer`, the same on twice as many cells,
    has the node. Resolution: what is thinner than a cell between two nodes is not seen. `tick` is called after each
    margin.
    """
    kinds = {"margin": margins, "factor": factors}
    fields = {(kind, name): field for kind in kinds for name, field in kinds[kind].items()}
    at_nodes = samples(fields, grid, finer.at_nodes if finer else None)
    inside = np.ones(grid.shape, dtype=bool)
    cells = _in_box(grid)
    for name in margins:
        inside &= at_nodes["margin", name] >= 0
        cells &= _highest(at_nodes["margin", name]) >= 0
    solids = [cuboid(grid)]
    seen: set[bytes] = set()
    for name, field in margins.items():
        values = at_nodes["margin", name]
        digest = hashlib.blake2b(values.tobytes()).digest()
        if digest not in seen and np.min(values) < 0:
            solids += _solids(field, values, grid, cells)
        seen.add(digest)
        tick()
    return Reach(grid, factors, intersection(solids), inside, at_nodes, cells)


def _in_box(grid: UniformGrid) -> NDArray[np.bool_]:
    """The cells that are not outside the box."""
    cells = np.zeros(tuple(size - 1 for size in grid.shape), dtype=bool)
    cells[1:-1, 1:-1, 1:-1] = True
    return cells


def _highest(values: NDArray[np.float32]) -> NDArray[np.float32]:
    """The largest value at the corners of each cell."""
    for axis in range(values.ndim):
        low, high = (np.take(values, range(first, values.shape[axis] - 1 + first), axis) for first in (0, 1))
        values = np.maximum(low, high)
    return values


def _solids(field: Field, values: NDArray[np.float32], grid: UniformGrid, cells: NDArray[np.bool_]) -> list[Manifold]:
    """What a margin allows, as the intersection of solids: the reach of a mode that was followed has several."""
    parts = field.parts if isinstance(field, ReachField) else ()
    if len(parts) < 2:
        return [_solid(field, values, grid, cells)]
    sampled = samples(dict(enumerate(parts)), grid)
    return [_solid(part, sampled[k], grid, cells) for k, part in enumerate(parts) if np.min(sampled[k]) < 0]


def _solid(field: Field, values: NDArray[np.float32], grid: UniformGrid, cells: NDArray[np.bool_]) -> Manifold:
    """Where a field is not negative, from its values at the nodes; one that was followed finds its own crossings."""
    if isinstance(field, FollowedField):
        # a measure may be so small beside its other end that interpolation would put the vertex at the node
        sides = np.where(values >= 0, np.float32(1.0), np.float32(-1.0))
        return solid_where(sides, grid, lambda edges: field.crossing(edges.start, edges.end), cells)
    return solid_where(values, grid, root_of(partial(at_points, field, grid.dimension)), cells)


def in_pose_coordinates(grid: UniformGrid, vertices: FloatArray, faces: Faces) -> tuple[FloatArray, Faces]:
    """A surface as it is; a strip that stands on a slack axis as the segments (k, 2) of its lower rim."""
    if grid.dimension == 3:
        return vertices, faces
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    return _compact(vertices[:, : grid.dimension], edges[np.all(_on_floor(grid, vertices)[edges], axis=1)])


def _on_floor(grid: UniformGrid, vertices: FloatArray) -> NDArray[np.bool_]:
    slack = vertices[:, grid.dimension :]
    floor: NDArray[np.bool_] = np.all(np.abs(slack) < 1e-9 * grid.slack, axis=1)
    return floor


def _compact(vertices: FloatArray, faces: Faces) -> tuple[FloatArray, Faces]:
    used, renumbered = np.unique(faces, return_inverse=True)
    return vertices[used], renumbered.reshape(faces.shape)
