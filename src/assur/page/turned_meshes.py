"""Meshes of layers: profiles turned about an axis, tubes along curves, and several of them as one."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Faces = NDArray[np.int64]
Mesh: TypeAlias = tuple[FloatArray, Faces]
"""Vertices (n, 3) and triangles (k, 3)."""
SIDES, AROUND = 7, 5
"""Of an arrow, and of a tube, as a page has many."""


def joined(meshes: Sequence[Mesh]) -> Mesh:
    """Meshes as one, in their order."""
    starts = np.cumsum([0, *(len(vertices) for vertices, _ in meshes[:-1])])
    faces = [own + start for (_, own), start in zip(meshes, starts, strict=True)]
    return np.concatenate([vertices for vertices, _ in meshes]), np.concatenate(faces)


def turned(profile: Sequence[tuple[float, float]], start: FloatArray, along: FloatArray) -> Mesh:
    """A profile of places along an axis and radii about it, turned about the axis.

    >>> vertices, faces = turned([(0.0, 0.0), (0.0, 1.0), (2.0, 1.0), (2.0, 0.0)], np.zeros(3), np.array([0.0, 0, 1]))
    >>> vertices.shape, faces.shape
    ((28, 3), (28, 3))
    """
    across = np.cross(along, np.eye(3)[int(np.argmin(np.abs(along)))])
    across /= np.linalg.norm(across)
    angles = 2.0 * np.pi * np.arange(SIDES) / SIDES
    ring = np.cos(angles)[:, None] * across + np.sin(angles)[:, None] * np.cross(along, across)
    vertices = np.concatenate([start + place * along + radius * ring for place, radius in profile])
    low = np.arange(SIDES)
    after, faces = np.roll(low, -1), []
    for k, ((_, near), (_, far)) in enumerate(pairwise(profile)):
        first, second = (
            np.stack(corners, 1) for corners in ((low, after, after + SIDES), (low, after + SIDES, low + SIDES))
        )
        faces += [triangles + k * SIDES for triangles, radius in ((first, near), (second, far)) if radius]
    return vertices, np.concatenate(faces)


def tube(curve: FloatArray, radius: float) -> Mesh:
    """A tube about a curve (n, 3) without corners, no two points in the same place, closed at its ends.

    >>> vertices, faces = tube(np.array([[0.0, 0, 0], [0, 0, 1], [0, 0.1, 2]]), 0.1)
    >>> vertices.shape, faces.shape
    ((15, 3), (26, 3))
    """
    ways = np.diff(curve, axis=0)
    ways /= np.linalg.norm(ways, axis=1)[:, None]
    along = np.concatenate([ways[:1], ways[:-1] + ways[1:], ways[-1:]])
    along /= np.linalg.norm(along, axis=1)[:, None]
    angles = 2.0 * np.pi * np.arange(AROUND) / AROUND
    across = np.eye(3)[int(np.argmin(np.abs(along[0])))]
    rings = []
    for point, way in zip(curve, along, strict=True):
        across = across - (across @ way) * way  # carried on, so that the tube is not wrung
        across /= np.linalg.norm(across)
        rings.append(
            point + radius * (np.cos(angles)[:, None] * across + np.sin(angles)[:, None] * np.cross(way, across))
        )
    low = np.arange(AROUND)
    quads = np.stack([low, np.roll(low, -1), np.roll(low, -1) + AROUND, low + AROUND], axis=1)
    sides = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    fan = np.stack([np.zeros(AROUND - 2, dtype=np.int64), low[1:-1], low[2:]], axis=1)
    last = AROUND * (len(curve) - 1)
    faces = [sides + AROUND * k for k in range(len(curve) - 1)]
    return np.concatenate(rings), np.concatenate([fan[:, ::-1], *faces, fan + last])
