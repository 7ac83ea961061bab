"""Rotations in batches: matrices and rotation vectors, (..., 3, 3) and (..., 3)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


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
    cross = skew(axis)
    sine = np.sin(angle)[..., None, None]
    versine = (1.0 - np.cos(angle))[..., None, None]
    return np.asarray(np.eye(3) + sine * cross + versine * (cross @ cross))


def from_vector(vector: FloatArray) -> FloatArray:
    """Rotation (..., 3, 3) of a rotation vector (..., 3) in rad."""
    angle = np.linalg.norm(vector, axis=-1)
    cross = skew(vector)
    # np.sinc(x) = sin(pi x)/(pi x): both coefficients are exact at angle 0
    first = np.sinc(angle / np.pi)[..., None, None]
    second = (0.5 * np.sinc(angle / (2 * np.pi)) ** 2)[..., None, None]
    return np.asarray(np.eye(3) + first * cross + second * (cross @ cross))


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


def taking(start: FloatArray, end: FloatArray) -> FloatArray:
    """The smallest rotation (3, 3) that takes one unit vector onto another, not its opposite.

    >>> taking(np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0])) @ [1.0, 0.0, 0.0]
    array([0., 1., 0.])
    """
    cross = skew(np.cross(start, end))
    result: FloatArray = np.eye(3) + cross + cross @ cross / (1.0 + float(start @ end))
    return result
