"""Rotations in batches: matrices and rotation vectors, (..., 3, 3) and (..., 3)."""

from __future__ import annotations

from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Vectors = TypeVar("Vectors", FloatArray, NDArray[np.complex128], NDArray[np.object_])
SMALL = 1e-2
"""Rotation vectors below this, in rad, have their left Jacobian by a series, where its closed expression cancels."""
SHORT = 1e-3
"""Rotation vectors below this, in rad, are taken by the first term of a series: the next is 1e-9 of it."""


def cross(a: Vectors, b: Vectors) -> Vectors:
    """Cross product (..., 3) of vectors (..., 3), real or complex, several times as fast as NumPy's on small batches.

    >>> cross(np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]))
    array([0., 0., 1.])
    """
    product = np.empty(np.broadcast_shapes(a.shape, b.shape), dtype=np.result_type(a, b, 1.0))
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        product[..., k] = a[..., i] * b[..., j] - a[..., j] * b[..., i]
    return product


def skew(vector: FloatArray) -> FloatArray:
    """Matrix (..., 3, 3) of the cross product with a vector (..., 3)."""
    matrix = np.zeros((*vector.shape, 3))
    matrix[..., 2, 1], matrix[..., 1, 2] = vector[..., 0], -vector[..., 0]
    matrix[..., 0, 2], matrix[..., 2, 0] = vector[..., 1], -vector[..., 1]
    matrix[..., 1, 0], matrix[..., 0, 1] = vector[..., 2], -vector[..., 2]
    return matrix


def about_axis(axis: FloatArray, angle: FloatArray) -> FloatArray:
    """Rotation (..., 3, 3) by angles (...) in rad about one unit axis (3,), by Rodrigues' formula.

    >>> about_axis(np.array([0.0, 0.0, 1.0]), np.array(np.pi / 2)).round(12) @ [1.0, 0.0, 0.0]
    array([0., 1., 0.])
    """
    return _combined(axis, np.sin(angle), 1.0 - np.cos(angle))


def from_vector(vector: FloatArray) -> FloatArray:
    """Rotation (..., 3, 3) of a rotation vector (..., 3) in rad."""
    angle = np.linalg.norm(vector, axis=-1)
    # np.sinc(x) = sin(pi x)/(pi x): both coefficients are exact at angle 0
    return _combined(vector, np.sinc(angle / np.pi), 0.5 * np.sinc(angle / (2 * np.pi)) ** 2)


def left_jacobian(vector: FloatArray) -> FloatArray:
    """Angular velocity per rate of each part of a rotation vector (..., 3), as the columns of (..., 3, 3).

    >>> left_jacobian(np.array([0.0, 0.0, np.pi])).round(3)
    array([[ 0.   , -0.637,  0.   ],
           [ 0.637,  0.   ,  0.   ],
           [ 0.   ,  0.   ,  1.   ]])
    """
    angle = np.linalg.norm(vector, axis=-1)
    square = angle**2
    with np.errstate(divide="ignore", invalid="ignore"):
        exact = (1.0 - np.sinc(angle / np.pi)) / square
    along = np.where(angle < SMALL, 1 / 6 - square / 120 + square**2 / 5040, exact)
    return _combined(vector, 0.5 * np.sinc(angle / (2 * np.pi)) ** 2, along)


def vector_rates(vector: FloatArray, angular: FloatArray) -> FloatArray:
    """Rates (..., 3) of rotation vectors (..., 3) at angular velocities (..., 3) in the frame that they turn from.

    The inverse of the left Jacobian: w - v x w / 2 + (1 - (r/2) cot(r/2)) / r^2 v x (v x w), r the vector's length. At
    whole turns no rates make every angular velocity; there they are large.

    >>> vector_rates(np.array([0.0, 0.0, np.pi]), np.array([0.0, 0.0, 1.0]))
    array([0., 0., 1.])
    """
    return np.asarray((vector_rates_matrix(vector) @ angular[..., None])[..., 0])


def vector_rates_matrix(vector: FloatArray) -> FloatArray:
    """The matrix (..., 3, 3) of `vector_rates`."""
    size = np.linalg.norm(vector, axis=-1)
    safe = np.maximum(size, SHORT)
    along = np.where(size < SHORT, 1 / 12, (1 - 0.5 * safe / np.tan(0.5 * safe)) / safe**2)
    return _combined(vector, -0.5, along)


def to_vector(rotation: FloatArray) -> FloatArray:
    """Rotation vector (..., 3) in rad, of length at most pi, of a rotation (..., 3, 3).

    It vanishes at the identity only; the skew part alone would vanish at half turns too.

    >>> half_turn = np.diag([1.0, -1.0, -1.0])
    >>> float(np.linalg.norm(to_vector(half_turn)).round(12))
    3.14159265359
    """
    sine_axis = 0.5 * np.stack(
        [
            rotation[..., 2, 1] - rotation[..., 1, 2],
            rotation[..., 0, 2] - rotation[..., 2, 0],
            rotation[..., 1, 0] - rotation[..., 0, 1],
        ],
        axis=-1,
    )  # (..., 3)
    cosine = 0.5 * (np.trace(rotation, axis1=-2, axis2=-1) - 1.0)
    sine = np.linalg.norm(sine_axis, axis=-1)
    angle = np.arctan2(sine, cosine)
    ratio = np.where(sine > 1e-8, angle / np.where(sine > 1e-8, sine, 1.0), 1.0)
    vector: FloatArray = ratio[..., None] * sine_axis
    near_half_turn = (sine <= 1e-4) & (cosine < 0.0)
    if np.any(near_half_turn):
        vector[near_half_turn] = _near_half_turn(
            rotation[near_half_turn], sine_axis[near_half_turn], angle[near_half_turn]
        )
    return vector


def _near_half_turn(rotation: FloatArray, sine_axis: FloatArray, angle: FloatArray) -> FloatArray:
    """Axis from the symmetric part, its sense from the skew part where that says one."""
    symmetric = 0.5 * (rotation + np.swapaxes(rotation, -1, -2))
    cosine = np.cos(angle)[..., None, None]
    outer = (symmetric - cosine * np.eye(3)) / (1.0 - cosine)  # n n^T, (..., 3, 3)
    largest = np.argmax(np.einsum("...ii->...i", outer), axis=-1)
    column = np.take_along_axis(outer, largest[..., None, None], axis=-1)[..., 0]
    axis = column / np.linalg.norm(column, axis=-1, keepdims=True)
    sense = np.where(np.einsum("...i,...i->...", axis, sine_axis) < 0.0, -1.0, 1.0)
    return np.asarray((angle * sense)[..., None] * axis)


def nearest_turn(angle: FloatArray) -> FloatArray:
    """Angles (...) in rad less whole turns, at most half a turn: -pi up to but not pi.

    >>> nearest_turn(np.array([6.0, -4.0])).round(4)
    array([-0.2832,  2.2832])
    """
    return np.asarray(np.remainder(angle + np.pi, 2 * np.pi) - np.pi)


def shortest(vector: FloatArray) -> FloatArray:
    """Rotation vectors (..., 3) of the same rotations, none longer than half a turn.

    >>> round(float(shortest(np.array([0.0, 0.0, 1.5 * np.pi]))[2]), 4)
    -1.5708
    """
    angle = np.linalg.norm(vector, axis=-1, keepdims=True)
    turns = np.ceil(angle / (2 * np.pi) - 0.5)
    return np.asarray(vector * (1.0 - 2 * np.pi * turns / np.where(angle > 0.0, angle, 1.0)))


def taking(start: FloatArray, end: FloatArray) -> FloatArray:
    """The smallest rotations (..., 3, 3) that take a unit vector (3,) onto others (..., 3), not its opposite.

    >>> taking(np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0])) @ [1.0, 0.0, 0.0]
    array([0., 1., 0.])
    """
    return _combined(cross(start, end), 1.0, 1.0 / (1.0 + end @ start))


def from_quaternion(quaternion: FloatArray) -> FloatArray:
    """Rotation (..., 3, 3) of unit quaternions (..., 4), scalar first; q and -q give the same one.

    >>> from_quaternion(np.array([0.0, 0.0, 0.0, 1.0])).round(12) + 0.0
    array([[-1.,  0.,  0.],
           [ 0., -1.,  0.],
           [ 0.,  0.,  1.]])
    """
    return _combined(quaternion[..., 1:], 2.0 * quaternion[..., 0], 2.0)


def quaternion_rates(quaternion: NDArray[Any], angular: NDArray[Any]) -> NDArray[Any]:
    """Rates (..., 4) of quaternions (..., 4) at angular velocities (..., 3) in the base frame: q' = (0, w) q / 2.

    >>> quaternion_rates(np.array([1.0, 0.0, 0.0, 0.0]), np.array([0.0, 0.0, 2.0]))
    array([-0.,  0.,  0.,  1.])
    """
    scalar, vector = quaternion[..., :1], quaternion[..., 1:]
    along = -np.sum(angular * vector, axis=-1, keepdims=True)
    return np.asarray(0.5 * np.concatenate([along, scalar * angular + cross(angular, vector)], axis=-1))


def to_quaternion(rotation: FloatArray) -> FloatArray:
    """Unit quaternion (..., 4), scalar first and not negative, of a rotation (..., 3, 3).

    >>> to_quaternion(np.diag([1.0, -1.0, -1.0])).tolist()
    [0.0, 1.0, 0.0, 0.0]
    """
    trace = np.trace(rotation, axis1=-2, axis2=-1)
    # 4 q q^T; its column with the largest diagonal entry is 4 q_k q
    outer = np.empty((*trace.shape, 4, 4))
    outer[..., 0, 0] = 1.0 + trace
    outer[..., 1:, 1:] = rotation + np.swapaxes(rotation, -1, -2) + (1.0 - trace)[..., None, None] * np.eye(3)
    skewed = [(2, 1), (0, 2), (1, 0)]
    for k, (i, j) in enumerate(skewed, 1):
        outer[..., 0, k] = outer[..., k, 0] = rotation[..., i, j] - rotation[..., j, i]
    largest = np.argmax(np.einsum("...ii->...i", outer), axis=-1)
    column = np.take_along_axis(outer, largest[..., None, None], axis=-1)[..., 0]
    unit = column / np.linalg.norm(column, axis=-1, keepdims=True)
    return np.asarray(np.where(unit[..., :1] < 0.0, -unit, unit)) + 0.0


NEARLY_UPRIGHT = 1e-4
"""Cosine of theta below which psi is told from what phi leaves, so that psi -+ phi is not lost in rounding."""


def to_angles(rotation: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Angles (...) phi, theta, psi in rad of rotations (..., 3, 3) = Rz(phi) Ry(theta) Rx(psi).

    Theta is between -90 and 90 deg. Where it is one of these, phi is 0.

    >>> turned = about_axis(np.array([0.0, 0.0, 1.0]), np.array(0.5)) @ about_axis(np.eye(3)[0], np.array(0.25))
    >>> [round(float(angle), 12) + 0.0 for angle in to_angles(turned)]
    [0.5, 0.0, 0.25]
    """
    across = np.hypot(rotation[..., 0, 0], rotation[..., 1, 0])
    theta = np.arctan2(-rotation[..., 2, 0], across)
    upright = across <= 1e-15
    phi = np.where(upright, 0.0, np.arctan2(rotation[..., 1, 0], rotation[..., 0, 0]))
    level = np.arctan2(rotation[..., 2, 1], rotation[..., 2, 2])
    # near a right angle rounding decides phi; what is left after it, Ry(theta) Rx(psi), tells psi as well as anywhere
    cosine, sine = np.cos(phi), np.sin(phi)
    middle = [cosine * rotation[..., 1, k] - sine * rotation[..., 0, k] for k in (1, 2)]
    psi = np.where(across < NEARLY_UPRIGHT, np.arctan2(-middle[1], middle[0]), level)
    return phi, theta, psi


def from_angles(phi: FloatArray, theta: FloatArray, psi: FloatArray) -> FloatArray:
    """Rotation (..., 3, 3) = Rz(phi) Ry(theta) Rx(psi) of angles (...) in rad."""
    x, y, z = np.eye(3)
    return np.asarray(about_axis(z, phi) @ about_axis(y, theta) @ about_axis(x, psi))


def _combined(vector: FloatArray, once: FloatArray | float, twice: FloatArray | float) -> FloatArray:
    """1 + a [v x] + b [v x]^2 (..., 3, 3), of vectors v (..., 3) and factors a and b (...)."""
    matrix = np.empty((*np.broadcast_shapes(vector.shape[:-1], np.shape(once), np.shape(twice)), 3, 3))
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        matrix[..., k, k] = 1.0 - twice * (vector[..., i] ** 2 + vector[..., j] ** 2)
        even, odd = twice * (vector[..., i] * vector[..., j]), once * vector[..., k]
        matrix[..., i, j], matrix[..., j, i] = even - odd, even + odd
    return matrix
