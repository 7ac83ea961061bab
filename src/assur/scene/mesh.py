"""Meshes: boxes, cylinders, balls and bars with round ends, as triangles with a normal at every corner."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

FloatArray = NDArray[np.float64]
ROUND, CREASE = 36, 25.0
"""Sides of what is round; degrees beyond which two faces meet in an edge, more than those of what is round."""

POINT = 1e-9
"""Two points that are nearer than this share of a part's radius are one."""


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles in space.

    Attributes:
        corners: (f, 3, 3) positions.
        normals: (f, 3, 3) unit normals at the corners.
        patch: (f,) the smooth face that a triangle is part of, counted from 0; an edge is drawn where it changes.
        colour: (f, 3) between 0 and 1.
    """

    corners: FloatArray
    normals: FloatArray
    patch: NDArray[np.int64]
    colour: FloatArray

    def moved(self, rotation: FloatArray, origin: FloatArray) -> Mesh:
        """The same triangles where their frame has an orientation (3, 3) and an origin (3,)."""
        return Mesh(self.corners @ rotation.T + origin, self.normals @ rotation.T, self.patch, self.colour)


def joined(meshes: Sequence[Mesh]) -> Mesh:
    """All in one, with patches of their own."""
    patches, start = [], 0
    for mesh in meshes:
        patches.append(mesh.patch + start)
        start += int(mesh.patch.max(initial=-1)) + 1
    return Mesh(
        np.concatenate([mesh.corners for mesh in meshes]),
        np.concatenate([mesh.normals for mesh in meshes]),
        np.concatenate(patches),
        np.concatenate([mesh.colour for mesh in meshes]),
    )


def rgb(colour: str) -> FloatArray:
    """A colour "#rrggbb" as three numbers between 0 and 1."""
    return np.array([int(colour[k : k + 2], 16) for k in (1, 3, 5)]) / 255


def box(centre: FloatArray, sides: FloatArray, colour: str) -> Mesh:
    """A box by its centre (3,) and its three half sides (3, 3) as rows, at right angles to one another.

    >>> found = box(np.zeros(3), np.eye(3), "#000000")
    >>> found.corners.shape, int(found.patch.max())
    ((12, 3, 3), 5)
    """
    squares, normals = [], []
    for k in range(3):
        for sense in (1.0, -1.0):
            middle, a, b = sense * sides[k], sides[(k + 1) % 3], sense * sides[(k + 2) % 3]
            squares.append(centre + np.array([middle - a - b, middle + a - b, middle + a + b, middle - a + b]))
            normals.append(middle / max(float(np.linalg.norm(middle)), 1e-300))
    corners = np.concatenate([np.stack([square[[0, 1, 2]], square[[0, 2, 3]]]) for square in squares])
    flat = np.repeat(np.array(normals), 2, axis=0)
    return _flat(corners, flat, np.repeat(np.arange(6), 2), colour)


def cylinder(start: FloatArray, end: FloatArray, radius: float, colour: str) -> Mesh:
    """A solid cylinder between two points (3,); a ball where they are one.

    >>> point = np.ones(3)
    >>> int(cylinder(point, point, 0.5, "#ffffff").patch.max())
    0
    """
    along = end - start
    if np.linalg.norm(along) <= POINT * radius:
        return ball(start, radius, colour)
    across, up = _frame(along)
    ring = _ring(ROUND)
    way = ring[:, :1] * across + ring[:, 1:] * up  # (k, 3)
    return _prism(start, along, radius * way, way, colour)


def bar(start: FloatArray, end: FloatArray, normal: FloatArray, radius: float, thickness: float, colour: str) -> Mesh:
    """A flat bar with round ends about two points, its flat sides normal to a direction; a ball where they are one."""
    along = end - start
    length = float(np.linalg.norm(along))
    if length <= POINT * radius:
        return ball(start, radius, colour)
    along = along / length
    across = np.cross(normal, along)
    half = _ring(ROUND)
    half = half[half[:, 0] > -1e-9][np.argsort(np.arctan2(*half[half[:, 0] > -1e-9].T[::-1]))]
    near, far = half * [-1.0, -1.0], half
    flat = np.concatenate([near, far])
    way = flat[:, :1] * along + flat[:, 1:] * across
    shift = np.concatenate([np.zeros((len(near), 3)), np.tile(end - start, (len(far), 1))])
    foot = start - 0.5 * thickness * normal
    return _prism(foot, thickness * normal, radius * way + shift, way, colour)


def ball(centre: FloatArray, radius: float, colour: str) -> Mesh:
    """A ball."""
    rows, turns = ROUND // 2, ROUND
    polar = np.linspace(0.0, np.pi, rows + 1)
    ring = _ring(turns)
    ring = np.concatenate([ring, ring[:1]])
    unit = np.stack(
        [
            np.sin(polar)[:, None] * ring[:, 0],
            np.sin(polar)[:, None] * ring[:, 1],
            np.broadcast_to(np.cos(polar)[:, None], (rows + 1, turns + 1)),
        ],
        axis=-1,
    )
    a, b, c, d = unit[:-1, :-1], unit[1:, :-1], unit[1:, 1:], unit[:-1, 1:]
    ways = np.concatenate([np.stack([a, b, c], -2).reshape(-1, 3, 3), np.stack([a, c, d], -2).reshape(-1, 3, 3)])
    shape = np.zeros(len(ways), dtype=np.int64)
    return Mesh(centre + radius * ways, ways, shape, np.tile(rgb(colour), (len(ways), 1)))


def slab(outline: FloatArray, along: FloatArray, colour: str) -> Mesh:
    """A convex plane outline (k, 3), counter-clockwise seen against `along` (3,), extruded along that vector.

    >>> triangle = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    >>> len(slab(triangle, np.array([0.0, 0, 0.2]), "#ffffff").corners)
    8
    """
    count = len(outline)
    low = np.arange(count)
    after = np.roll(low, -1)
    fan = np.column_stack([np.zeros(count - 2, dtype=int), low[1:-1], low[2:]])
    sides = np.concatenate(
        [np.column_stack([low, after, after + count]), np.column_stack([low, after + count, low + count])]
    )
    return surface(
        np.concatenate([outline, outline + along]), np.concatenate([fan[:, ::-1], fan + count, sides]), colour
    )


def surface(vertices: FloatArray, faces: NDArray[np.int64], colour: str) -> Mesh:
    """A triangle mesh (n, 3), (f, 3), smooth except where two faces meet at more than `CREASE` degrees.

    >>> square = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 1]])
    >>> roof = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    >>> sorted(set(surface(square, roof, "#ffffff").patch.tolist()))
    [0, 1, 2, 3]
    """
    corners = vertices[faces]
    weighted = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])  # twice the area, outwards
    unit = weighted / np.maximum(np.linalg.norm(weighted, axis=1, keepdims=True), 1e-300)
    first, second = _neighbours(faces)
    smooth = np.sum(unit[first] * unit[second], axis=1) > np.cos(np.radians(CREASE))
    links = coo_matrix((np.ones(int(smooth.sum())), (first[smooth], second[smooth])), shape=(len(faces),) * 2)
    patch = connected_components(links, directed=False)[1].astype(np.int64)
    # a corner's normal is the mean over the faces of its patch that meet there
    _, shared = np.unique(np.stack([faces.ravel(), np.repeat(patch, 3)], axis=1), axis=0, return_inverse=True)
    shared = shared.ravel()
    total = np.stack([np.bincount(shared, np.repeat(weighted[:, k], 3)) for k in range(3)], axis=1)[shared]
    normals = total / np.maximum(np.linalg.norm(total, axis=1, keepdims=True), 1e-300)
    return Mesh(corners, normals.reshape(-1, 3, 3), patch, np.tile(rgb(colour), (len(faces), 1)))


def creases(vertices: FloatArray, faces: NDArray[np.int64]) -> FloatArray:
    """Edges (e, 2, 3) at which two faces of a closed mesh meet at more than `CREASE` degrees."""
    corners = vertices[faces]
    unit = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    unit = unit / np.maximum(np.linalg.norm(unit, axis=1, keepdims=True), 1e-300)
    first, second = _neighbours(faces)
    sharp = np.sum(unit[first] * unit[second], axis=1) < np.cos(np.radians(CREASE))
    edges = [np.intersect1d(faces[a], faces[b]) for a, b in zip(first[sharp], second[sharp], strict=True)]
    pairs = np.array([edge for edge in edges if len(edge) == 2], dtype=int).reshape(-1, 2)
    return np.asarray(vertices[pairs])


def _neighbours(faces: NDArray[np.int64]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Pairs of faces that share an edge."""
    edges = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    same = np.all(edges[order[1:]] == edges[order[:-1]], axis=1)
    return order[:-1][same] // 3, order[1:][same] // 3


def _prism(start: FloatArray, along: FloatArray, rim: FloatArray, way: FloatArray, colour: str) -> Mesh:
    """A convex outline start + rim (k, 3), with outward normals `way`, extruded along a vector; ends are flat."""
    low, high = start + rim, start + rim + along
    nxt = np.roll(np.arange(len(rim)), -1)
    side = np.concatenate([np.stack([low, low[nxt], high[nxt]], 1), np.stack([low, high[nxt], high], 1)])
    round_normals = np.concatenate([np.stack([way, way[nxt], way[nxt]], 1), np.stack([way, way[nxt], way], 1)])
    middle = rim.mean(axis=0)
    caps, cap_normals = [], []
    unit = along / max(float(np.linalg.norm(along)), 1e-300)
    # seen from outside both ends run counter-clockwise
    ends = ((low[nxt], low, start + middle, -unit), (high, high[nxt], start + middle + along, unit))
    for ring, following, centre, normal in ends:
        caps.append(np.stack([np.broadcast_to(centre, ring.shape), ring, following], 1))
        cap_normals.append(np.broadcast_to(normal, (len(ring), 3, 3)))
    patch = np.repeat([0, 1, 2], [len(side), len(rim), len(rim)])
    corners = np.concatenate([side, *caps])
    return Mesh(corners, np.concatenate([round_normals, *cap_normals]), patch, np.tile(rgb(colour), (len(corners), 1)))


def _flat(corners: FloatArray, normals: FloatArray, patch: NDArray[np.int64], colour: str) -> Mesh:
    return Mesh(corners, np.repeat(normals[:, None], 3, axis=1), patch, np.tile(rgb(colour), (len(corners), 1)))


def _ring(count: int) -> FloatArray:
    angles = 2 * np.pi * np.arange(count) / count
    return np.stack([np.cos(angles), np.sin(angles)], axis=1)


def _frame(along: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Two unit vectors across a direction and across one another."""
    helper = np.eye(3)[int(np.argmin(np.abs(along)))]
    across = np.cross(along, helper)
    across = across / np.linalg.norm(across)
    up = np.cross(along, across)
    return across, up / np.linalg.norm(up)
