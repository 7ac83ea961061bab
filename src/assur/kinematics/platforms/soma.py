"""Poses as soma (Study) coordinates: a distance between a point of the base and one of the platform is quadratic.

R turns by the quaternion e, and p is the vector of g e* with a second quaternion g = p e. Times N(e) = e e*,

    |p + R b - a|^2 N(e) = N(g) + 2 b . vec(e* g) - 2 a . vec(g e*) + (a^2 + b^2) N(e) - 2 a . N(e) R b,    e . g = 0

(C. W. Wampler, Forward displacement analysis of general six-in-parallel SPS (Stewart) platform manipulators using soma
coordinates, Mech. Mach. Theory 31, 1996).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.numerics.rotations import from_quaternion
from assur.numerics.vectors import Vector, add, apply, cross, dot, scaled, subtract

FloatArray = NDArray[np.float64]


def equations(points: Sequence[Vector], others: Sequence[Vector], distances: Sequence[Any], soma: Any) -> list[Any]:
    """Study's quadric, and for each distance an equation: homogeneous of degree 2 in the eight unknowns.

    Args:
        points: of the base.
        others: of the platform, in its frame.
        distances: between them.
        soma: the unknowns e, g, of any number type.

    >>> pose = soma_of((1, 0, 0, 0), (1, 2, 2))
    >>> equations([(0, 0, 0)], [(0, 0, 0)], [3], pose)
    [0, 0]
    """
    e, g = tuple(soma[:4]), tuple(soma[4:])
    straight = subtract(scaled(g[1:], e[0]), scaled(e[1:], g[0]))
    turned = cross(g[1:], e[1:])
    on_base, on_platform = subtract(straight, turned), add(straight, turned)  # vec(g e*), vec(e* g)
    norm, square, rotation = _norm(e), _norm(g), _rotation(*e)
    rows = [
        square
        + 2 * dot(b, on_platform)
        - 2 * dot(a, on_base)
        + (dot(a, a) + dot(b, b) - distance * distance) * norm
        - 2 * dot(a, apply(rotation, b))
        for a, b, distance in zip(points, others, distances, strict=True)
    ]
    return [e[0] * g[0] + dot(e[1:], g[1:]), *rows]


def soma_of(quaternion: Sequence[Any], place: Sequence[Any]) -> tuple[Any, ...]:
    """The unknowns e and g of a pose.

    >>> soma_of((1, 0, 0, 0), (1, 2, 3))
    (1, 0, 0, 0, 0, 1, 2, 3)
    """
    (w, *vector), p = quaternion, (place[0], place[1], place[2])
    v = (vector[0], vector[1], vector[2])
    return (w, *v, -dot(p, v), *add(scaled(p, w), cross(p, v)))


def poses_of(soma: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Orientations (N, 3, 3) and places (N, 3) of soma (N, 8) with N(e) not zero.

    >>> poses_of(np.array([[2.0, 0, 0, 0, 0, 2, 4, 6]]))[1].tolist()
    [[1.0, 2.0, 3.0]]
    """
    e, g = soma[:, :4], soma[:, 4:]
    norm = np.sum(e**2, axis=1)
    place = e[:, :1] * g[:, 1:] - g[:, :1] * e[:, 1:] - np.cross(g[:, 1:], e[:, 1:])
    return from_quaternion(e / np.sqrt(norm)[:, None]), place / norm[:, None]


def norm_of(soma: NDArray[np.complex128]) -> NDArray[np.complex128]:
    """N(e) of soma (N, 8): no pose belongs to one where it is zero."""
    return np.asarray(np.sum(soma[:, :4] ** 2, axis=1))


def _norm(quaternion: Sequence[Any]) -> Any:
    w, x, y, z = quaternion
    return w * w + x * x + y * y + z * z


def _rotation(w: Any, x: Any, y: Any, z: Any) -> Any:
    """N(e) R: the rotation of a quaternion of any length, homogeneous."""
    return (
        (w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z),
    )
