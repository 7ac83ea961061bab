"""Poses as soma (Study) coordinates, in which what limbs hold the platform to is quadratic.

R turns by the quaternion e, and p is the vector of g e* with a second quaternion g = p e: eight homogeneous coordinates
(e, g) on Study's quadric e . g = 0, no pose where N(e) = e e* is zero. Times N(e), these are quadrics:

    |p|^2 = N(g),    p = vec(g e*),    R' p = vec(e* g),    R,    1 = N(e)

(E. Study 1903; C. W. Wampler, Mech. Mach. Theory 31, 1996).
"""

from __future__ import annotations

from functools import cache
from itertools import combinations_with_replacement
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import Frame
from assur.numerics.rotations import cross, from_quaternion, to_quaternion

FloatArray = NDArray[np.float64]
Array = TypeVar("Array", FloatArray, NDArray[np.complex128], NDArray[np.object_])

SIZE = 8
PAIRS = np.array([*combinations_with_replacement(range(SIZE), 2)])
"""The products (36, 2) of two coordinates: a quadric is given by its coefficients (36,) of these."""
STUDY = np.array([(second - first == SIZE // 2) / 2 for first, second in PAIRS])
"""Study's quadric, of length 1."""


def soma_of(frames: Frame) -> FloatArray:
    """Coordinates (N, 8), of length 1, of rotations (N, 3, 3) and places (N, 3).

    >>> (soma_of((np.eye(3)[None], np.array([[0.0, 2.0, 2.0]]))).round(6) + 0.0).tolist()
    [[0.333333, 0.0, 0.0, 0.0, 0.0, 0.0, 0.666667, 0.666667]]
    """
    e, p = to_quaternion(frames[0]), frames[1]
    w, v = e[:, :1], e[:, 1:]
    soma = np.concatenate([e, -np.sum(p * v, axis=1, keepdims=True), w * p + cross(p, v)], axis=1)
    return np.asarray(soma / np.linalg.norm(soma, axis=1, keepdims=True))


def frames_of(soma: FloatArray) -> Frame:
    """Rotations (N, 3, 3) and places (N, 3) of coordinates (N, 8) with N(e) not zero.

    >>> frames_of(np.array([[2.0, 0, 0, 0, 0, 2, 4, 6]]))[1].tolist()
    [[1.0, 2.0, 3.0]]
    """
    norm = norm_of(soma)[:, None]
    return from_quaternion(soma[:, :4] / np.sqrt(norm)), _straight(soma)[0] / norm


def composed_soma(first: Array, second: Array) -> Array:
    """Coordinates (N, 8) of displacements one after another, the second first; complex ones too.

    >>> shift = np.array([[1.0, 0, 0, 0, 0, 1, 2, 3]])
    >>> frames_of(composed_soma(shift, shift))[1].tolist()
    [[2.0, 4.0, 6.0]]
    """
    return np.concatenate(
        [
            _product(first[:, :4], second[:, :4]),
            _product(first[:, :4], second[:, 4:]) + _product(first[:, 4:], second[:, :4]),
        ],
        axis=1,
    )


def norm_of(soma: Array) -> Array:
    """N(e) of coordinates (N, 8), without the conjugate of complex ones."""
    total: Array = np.sum(soma[:, :4] ** 2, axis=1)
    return total


def products(soma: Array) -> Array:
    """Values (N, 36) of `PAIRS`."""
    values: Array = soma[:, PAIRS[:, 0]] * soma[:, PAIRS[:, 1]]
    return values


@cache
def spheres() -> FloatArray:
    """The quadrics (17, 36) of |p|^2, p, R' p, R and 1: sums of them say spheres, planes and angles.

    >>> soma = soma_of((np.eye(3)[None], np.array([[0.0, 2.0, 2.0]])))
    >>> (products(soma) @ spheres().T / norm_of(soma)).round(9).tolist()[0][:7]
    [8.0, 0.0, 2.0, 2.0, 0.0, 2.0, 2.0]
    """
    soma = np.random.default_rng(0).normal(size=(2 * len(PAIRS), SIZE))
    on_base, on_platform = _straight(soma)
    norm = norm_of(soma)[:, None]
    rotation = norm[..., None] * from_quaternion(soma[:, :4] / np.sqrt(norm))
    square = np.sum(soma[:, 4:] ** 2, axis=1, keepdims=True)
    values = np.concatenate([square, on_base, on_platform, rotation.reshape(-1, 9), norm], axis=1)
    return np.asarray(np.rint(np.linalg.lstsq(products(soma), values, rcond=None)[0].T))  # all are whole


def _product(first: Array, second: Array) -> Array:
    """Of quaternions (N, 4)."""
    a, b = first[:, 1:], second[:, 1:]
    scalar = first[:, :1] * second[:, :1] - np.sum(a * b, axis=1, keepdims=True)
    return np.concatenate([scalar, first[:, :1] * b + second[:, :1] * a + cross(a, b)], axis=1)


def _straight(soma: FloatArray) -> Frame:
    """vec(g e*) and vec(e* g), each (N, 3)."""
    e, g = soma[:, :4], soma[:, 4:]
    even, odd = e[:, :1] * g[:, 1:] - g[:, :1] * e[:, 1:], cross(g[:, 1:], e[:, 1:])
    return even - odd, even + odd
