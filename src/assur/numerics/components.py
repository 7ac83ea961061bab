"""Components: small matrices in batches whose memory runs over the batch first: every operation is one long pass.

Shapes are as everywhere, (..., 3) and (..., 3, 3); only the order in memory differs. What NumPy computes from such
arrays keeps it; its matrix product is the exception, and several times slower than `product` here.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
SMALL = 1e-2
"""Angles below this, in rad, are taken by series where closed expressions cancel."""


def by_components(values: FloatArray) -> FloatArray:
    """The same numbers (..., n), each of the n components in one piece.

    >>> by_components(np.zeros((4, 3))).T.flags.c_contiguous
    True
    """
    return np.moveaxis(np.ascontiguousarray(np.moveaxis(values, -1, 0)), 0, -1)


def zeros(batch: tuple[int, ...], *sizes: int) -> FloatArray:
    """Zeros (*batch, *sizes) with the batch last in memory.

    >>> zeros((5,), 6, 2).shape
    (5, 6, 2)
    """
    return _batch_first(np.zeros((*sizes, *batch)), len(sizes))


def product(first: FloatArray, second: FloatArray) -> FloatArray:
    """Matrix product (..., 3, 3), of (3, 3) too."""
    return np.asarray(np.einsum("...ij,...jk->...ik", first, second))


def product_turned_back(first: FloatArray, second: FloatArray) -> FloatArray:
    """Matrix product (..., 3, 3) with the transpose of the second."""
    return np.asarray(np.einsum("...ij,...kj->...ik", first, second))


def applied(matrix: FloatArray, vector: FloatArray) -> FloatArray:
    """Matrices (..., 3, 3) times vectors (..., 3), or one vector (3,).

    >>> applied(about_axis(np.array([0.0, 0.0, 1.0]), np.array([0.0, np.pi])), np.array([1.0, 0.0, 0.0])).round(12)
    array([[ 1.,  0.,  0.],
           [-1.,  0.,  0.]])
    """
    return np.asarray(np.einsum("...ij,...j->...i", matrix, vector))


def crossed(vectors: FloatArray, point: FloatArray) -> FloatArray:
    """Cross products (..., 3, k) of the columns of vectors (..., 3, k) with points (..., 3).

    >>> crossed(np.eye(3)[:, :1], np.array([0.0, 1.0, 0.0]))[:, 0]
    array([0., 0., 1.])
    """
    result = np.empty_like(vectors)
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        result[..., k, :] = vectors[..., i, :] * point[..., j, None] - vectors[..., j, :] * point[..., i, None]
    return result


def about_axis(axis: FloatArray, angle: FloatArray) -> FloatArray:
    """Rotation (..., 3, 3) by angles (...) in rad about one unit axis (3,): as `rotations.about_axis`."""
    return _combined(axis, np.cos(angle), 1.0 - np.cos(angle), np.sin(angle), np.shape(angle))


def from_vector(vector: FloatArray) -> FloatArray:
    """Rotation (..., 3, 3) of a rotation vector (..., 3) in rad: as `rotations.from_vector`."""
    square, angle = _angle(vector)
    # np.sinc(x) = sin(pi x) / (pi x): exact at angle 0
    versine = 0.5 * np.sinc(angle / (2 * np.pi)) ** 2
    return _combined(vector, 1.0 - versine * square, versine, np.sinc(angle / np.pi), angle.shape)


def left_jacobian(vector: FloatArray) -> FloatArray:
    """Angular velocity per rate of each part of a rotation vector (..., 3), as the columns of (..., 3, 3).

    >>> left_jacobian(np.array([0.0, 0.0, np.pi])).round(3)
    array([[ 0.   , -0.637,  0.   ],
           [ 0.637,  0.   ,  0.   ],
           [ 0.   ,  0.   ,  1.   ]])
    """
    square, angle = _angle(vector)
    sine = np.sinc(angle / np.pi)
    small = angle < SMALL
    with np.errstate(divide="ignore", invalid="ignore"):
        exact = (1.0 - sine) / square
    along = np.where(small, 1 / 6 - square / 120 + square**2 / 5040, exact)
    return _combined(vector, sine, along, 0.5 * np.sinc(angle / (2 * np.pi)) ** 2, angle.shape)


def _angle(vector: FloatArray) -> tuple[FloatArray, FloatArray]:
    square = np.asarray(vector[..., 0] ** 2 + vector[..., 1] ** 2 + vector[..., 2] ** 2)
    return square, np.sqrt(square)


def _combined(
    vector: FloatArray, identity: FloatArray, outer: FloatArray, cross: FloatArray, batch: tuple[int, ...]
) -> FloatArray:
    """`identity` times the unit matrix, `outer` times v v^T and `cross` times the matrix of v x, each factor (...)."""
    result = np.empty((3, 3, *batch))
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        result[k, k] = identity + outer * vector[..., k] ** 2
        symmetric, skew = outer * vector[..., i] * vector[..., j], cross * vector[..., k]
        result[i, j], result[j, i] = symmetric - skew, symmetric + skew
    return _batch_first(result, 2)


def _batch_first(values: FloatArray, count: int) -> FloatArray:
    return np.moveaxis(values, range(count), range(-count, 0))
