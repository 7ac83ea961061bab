"""Refining: faces of a surface on which a field vanishes, cut in parts that lie on it, and rims without teeth."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Faces = NDArray[np.int64]
BoolArray = NDArray[np.bool_]
Values = Callable[[FloatArray], FloatArray]
SECANTS = 4
"""Steps of the secant in which a vertex is brought to the surface, at most."""

ZERO = 1e-3
"""It is there at this share of the largest value on the way."""

STROKES = 8
"""How often a rim is combed."""

FAR = 0.35
"""A vertex moves by no more than this share of the edge that it halves."""


def refined(vertices: FloatArray, faces: Faces, values: Values, most: int) -> tuple[FloatArray, Faces]:
    """The mesh with every face in parts, as often as leaves at most `most` of them.

    Args:
        vertices: (n, d) on the surface, d 2 or 3.
        faces: (k, 3) triangles, each cut in four, or (k, 2) segments, each in two.
        values: of the field (m,) at points (m, d); NaN where it is not known: there a new vertex stays on its edge.
        most: faces, at most.

    >>> square = np.array([[1.0, 0], [0, 1], [-1, 0], [0, -1]])
    >>> ring = np.column_stack([np.arange(4), (np.arange(4) + 1) % 4])
    >>> vertices, faces = refined(square, ring, lambda points: np.sum(points**2, axis=1) - 1.0, 32)
    >>> len(faces), float(np.max(np.abs(np.linalg.norm(vertices, axis=1) - 1.0)).round(4))
    (32, 0.0)
    """
    parts = 4 if faces.shape[1] == 3 else 2
    while len(faces) and parts * len(faces) <= most:
        vertices, faces = _halved(vertices, faces, values)
    return vertices, faces


def combed(vertices: FloatArray, faces: Faces, far: float, fixed: BoolArray) -> FloatArray:
    """Vertices (n, d) of triangles whose rims have lost their teeth: each moved to between its neighbours on its rim.

    Args:
        vertices: (n, d).
        faces: (k, 3).
        far: no vertex moves further.
        fixed: (n,) those that stay.

    >>> strip = np.array([[0.0, 0], [1, 0], [2, 0], [3, 0], [0, 1], [1, 1.4], [2, 1], [3, 1]])
    >>> faces = np.array([[0, 1, 4], [1, 5, 4], [1, 2, 5], [2, 6, 5], [2, 3, 6], [3, 7, 6]])
    >>> found = combed(strip, faces, 0.3, np.array([1, 1, 1, 1, 1, 0, 1, 1], dtype=bool))
    >>> found[5].round(2).tolist(), found[0].tolist()
    ([1.0, 1.1], [0.0, 0.0])
    """
    edges = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    edges, count = np.unique(edges, axis=0, return_counts=True)
    rim = edges[count == 1]
    degree = np.bincount(rim.ravel(), minlength=len(vertices))
    loose = np.flatnonzero((degree == 2) & ~fixed)
    moved = vertices.copy()
    for _ in range(STROKES):
        total = np.zeros_like(vertices)
        for first, second in ((0, 1), (1, 0)):
            np.add.at(total, rim[:, first], moved[rim[:, second]])
        moved[loose] += 0.5 * (total[loose] / 2 - moved[loose])
        away = moved[loose] - vertices[loose]
        size = np.linalg.norm(away, axis=1, keepdims=True)
        moved[loose] = vertices[loose] + away * np.minimum(1.0, far / np.maximum(size, 1e-300))
    return moved


def _halved(vertices: FloatArray, faces: Faces, values: Values) -> tuple[FloatArray, Faces]:
    sides = [[0, 1], [1, 2], [2, 0]] if faces.shape[1] == 3 else [[0, 1]]
    pairs = np.sort(faces[:, sides].reshape(-1, 2), axis=1)
    edges, numbers = np.unique(pairs, axis=0, return_inverse=True)
    numbers = len(vertices) + numbers.reshape(len(faces), len(sides))
    middles = _onto(vertices[edges], _across(vertices, faces)[edges], values)
    points = np.concatenate([vertices, middles])
    if faces.shape[1] == 2:
        return points, np.concatenate(
            [np.column_stack([faces[:, 0], numbers[:, 0]]), np.column_stack([numbers[:, 0], faces[:, 1]])]
        )
    (a, b, c), (ab, bc, ca) = faces.T, numbers.T
    corners = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return points, np.concatenate([np.column_stack(corner) for corner in corners])


def _across(vertices: FloatArray, faces: Faces) -> FloatArray:
    """Unit normals (n, d) of the surface at its vertices: means over the faces there, large ones for more."""
    corners = vertices[faces]
    way = corners[:, 1] - corners[:, 0]
    if faces.shape[1] == 3:
        normal = np.cross(way, corners[:, 2] - corners[:, 0])
    else:
        normal = np.zeros_like(way)
        normal[:, :2] = np.column_stack([-way[:, 1], way[:, 0]])
    total = np.zeros_like(vertices)
    np.add.at(total, faces.ravel(), np.repeat(normal, faces.shape[1], axis=0))
    return np.asarray(total / np.maximum(np.linalg.norm(total, axis=1, keepdims=True), 1e-300))


def _onto(ends: FloatArray, normals: FloatArray, values: Values) -> FloatArray:
    """Middles (m, d) of edges (m, 2, d), moved along the normals at their ends to where the field is zero."""
    middle, length = ends.mean(axis=1), np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    way = normals.sum(axis=1)
    way = way / np.maximum(np.linalg.norm(way, axis=1, keepdims=True), 1e-300)
    far = FAR * length
    before, shift = np.zeros(len(middle)), 0.25 * far
    last, now = values(middle), values(middle + shift[:, None] * way)
    best, least = np.zeros(len(middle)), np.abs(last)
    most = float(np.max(np.abs([last, now]), initial=0.0, where=np.isfinite([last, now])))
    for _ in range(SECANTS):
        better = np.abs(now) < least
        best[better], least[better] = shift[better], np.abs(now[better])
        with np.errstate(divide="ignore", invalid="ignore"):
            ahead = np.clip(shift - now * (shift - before) / (now - last), -far, far)
        rows = np.flatnonzero(np.isfinite(ahead) & (least > ZERO * most))
        if not len(rows):
            break
        before, last, shift, now = shift.copy(), last.copy(), shift.copy(), now.copy()
        before[rows], last[rows], shift[rows] = shift[rows], now[rows], ahead[rows]
        now[rows] = values(middle[rows] + ahead[rows, None] * way[rows])
    better = np.abs(now) < least
    best[better] = shift[better]
    return np.asarray(middle + best[:, None] * way)
