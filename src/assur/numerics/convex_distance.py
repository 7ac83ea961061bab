"""Distance of two convex bodies, given by points whose convex hulls they are, at many relative places at once.

After Gilbert, Johnson and Keerthi (1988): the least vector of the set of differences, by simplices of at most four of
its corners; the support in the direction of the least vector says how far it can still be from the least one.
"""

from __future__ import annotations

from itertools import combinations

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import nnls

FloatArray = NDArray[np.float64]
STEPS = 60
TOLERANCE = 1e-6
WEIGHT = 1e4
"""How much more the sums of the weights count in `nearest_points` than the distance, in sizes of the bodies."""

FACES = [list(corners) for size in (1, 2, 3, 4) for corners in combinations(range(4), size)]


def convex_distance(
    first: FloatArray, second: FloatArray, rotation: FloatArray, origin: FloatArray, tolerance: float = TOLERANCE
) -> FloatArray:
    """Distances (k,) of the hulls of points (a, 3) and (b, 3), the second placed by (k, 3, 3) and (k, 3).

    Args:
        first: points in the first body's frame.
        second: points in the second body's frame.
        rotation: orientations of the second body's frame in the first's.
        origin: its origins there.
        tolerance: share of a distance within which it is right; distances below this share of the bodies' size are 0.

    >>> cube = np.array([[x, y, z] for x in (0.0, 1) for y in (0.0, 1) for z in (0.0, 1)])
    >>> convex_distance(cube, cube, np.eye(3)[None], np.array([[4.0, 5.0, 0.5]])).round(6)
    array([5.])
    """
    count = len(origin)
    size = float(np.linalg.norm(np.ptp(first, axis=0)) + np.linalg.norm(np.ptp(second, axis=0)))
    corner = _support(first, second, rotation, origin, origin - first.mean(axis=0))
    simplex = np.repeat(corner[:, None], 4, axis=1)  # (k, 4, 3), corners may be there more than once
    least, distance = corner.copy(), np.linalg.norm(corner, axis=1)
    busy = np.arange(count)
    for _ in range(STEPS):
        busy = busy[distance[busy] > tolerance * size]
        if not len(busy):
            break
        vector = least[busy]
        corner = _support(first, second, rotation[busy], origin[busy], vector)
        room = np.sum(vector * (vector - corner), axis=1)
        open_ = room > tolerance * distance[busy] ** 2
        busy, corner = busy[open_], corner[open_]
        if not len(busy):
            break
        vectors, kept = _least(simplex[busy], corner)
        nearer = np.linalg.norm(vectors, axis=1) < distance[busy]  # rounding may stop it a little before
        busy = busy[nearer]
        least[busy], simplex[busy] = vectors[nearer], kept[nearer]
        distance[busy] = np.linalg.norm(least[busy], axis=1)
    distance[distance <= tolerance * size] = 0.0
    return np.asarray(distance)


def nearest_points(first: FloatArray, second: FloatArray) -> FloatArray:
    """A point of each of the hulls of points (a, 3) and (b, 3) in one frame, next to one another: (2, 3).

    The weights of the corners that are positive, have the sum 1 in each body and make the difference least are those
    of a least-squares problem without negative unknowns (Lawson and Hanson 1974, chapter 23).

    >>> cube = np.array([[x, y, z] for x in (0.0, 1) for y in (0.0, 1) for z in (0.0, 1)])
    >>> nearest_points(cube, cube + [3.0, 2.0, 1.5]).round(6).tolist()
    [[1.0, 1.0, 1.0], [3.0, 2.0, 1.5]]
    """
    middle = (first.mean(axis=0) + second.mean(axis=0)) / 2
    size = float(np.max(np.abs(np.concatenate([first, second]) - middle)))
    matrix = np.zeros((5, len(first) + len(second)))
    matrix[:3, : len(first)] = (first - middle).T / size
    matrix[:3, len(first) :] = -(second - middle).T / size
    matrix[3, : len(first)] = matrix[4, len(first) :] = WEIGHT
    weights, _ = nnls(matrix, np.array([0.0, 0.0, 0.0, WEIGHT, WEIGHT]))
    of_first, of_second = weights[: len(first)], weights[len(first) :]
    return np.array([of_first @ first / of_first.sum(), of_second @ second / of_second.sum()])


def _support(
    first: FloatArray, second: FloatArray, rotation: FloatArray, origin: FloatArray, way: FloatArray
) -> FloatArray:
    """The corner (k, 3) of the differences second - first that lies least far along ways (k, 3)."""
    far = first[np.argmax(way @ first.T, axis=1)]
    back = np.einsum("kij,ki->kj", rotation, way)
    near = second[np.argmin(back @ second.T, axis=1)]
    return np.asarray(np.einsum("kij,kj->ki", rotation, near) + origin - far)


def _least(simplex: FloatArray, corner: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The least vector (k, 3) of the hulls of at most three corners and a new one, and a simplex (k, 4, 3) that has it.

    A simplex has its corners first and repeats the first one in the places that are left.
    """
    points = simplex.copy()
    points[:, 3] = corner
    best = np.full(len(points), np.inf)
    vectors, kept = np.zeros((len(points), 3)), points.copy()
    for face in FACES:
        corners = points[:, face]
        weights, regular = _weights(corners)
        vector = np.einsum("kf,kfi->ki", weights, corners)
        size = np.where(regular & np.all(weights >= -1e-12, axis=1), np.linalg.norm(vector, axis=1), np.inf)
        take = size < best
        best[take], vectors[take] = size[take], vector[take]
        filled = np.concatenate([corners, np.repeat(corners[:, :1], 4 - len(face), axis=1)], axis=1)
        kept[take] = filled[take]
    return vectors, kept


def _weights(corners: FloatArray) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Weights (k, f) of the corners (k, f, 3) for the point of their affine hull next to zero; which are sound."""
    count = corners.shape[1]
    if count == 1:
        return np.ones((len(corners), 1)), np.ones(len(corners), dtype=bool)
    edges = corners[:, 1:] - corners[:, :1]
    gram = np.einsum("kai,kbi->kab", edges, edges)
    scale = np.maximum(np.einsum("kaa->k", gram), 1e-300)
    regular = np.linalg.det(gram / scale[:, None, None]) > 1e-14
    safe = np.where(regular[:, None, None], gram, np.eye(count - 1))
    rest = np.linalg.solve(safe, -np.einsum("kai,ki->ka", edges, corners[:, 0])[..., None])[..., 0]
    return np.concatenate([1 - rest.sum(axis=1, keepdims=True), rest], axis=1), regular
