"""Rotations R under three linear conditions u . R w = c: eight at most, complex ones counted.

In a quaternion e of any length N(e) R is quadratic, so that the conditions are three quadrics of projective space.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.numerics.quadratic_systems import quadratic
from assur.numerics.rotations import from_quaternion

FloatArray = NDArray[np.float64]
REAL = 1e-6
"""Largest imaginary part of a quaternion that is tried as a real one, its largest coordinate being 1."""
DOUBTFUL = 1e-8
"""The same, above which it may be a real one or not."""
ACCURATE = 1e-9
"""Residual of the quadrics up to which their roots are believed."""


@dataclass(frozen=True, eq=False)
class RotationCondition:
    """sum of A_ij R_ij = c, with A (3, 3)."""

    matrix: FloatArray
    value: float


@dataclass(frozen=True, eq=False)
class Rotations:
    """Real rotations (K, 3, 3), how many there are with complex ones, and whether these are certainly all."""

    values: FloatArray
    complex: int
    sure: bool


def rotations_under(conditions: Sequence[RotationCondition]) -> Rotations:
    """All rotations under three conditions.

    >>> axes = np.eye(3)
    >>> conditions = [RotationCondition(np.outer(axes[k], axes[(k + 1) % 3]), 0.0) for k in range(3)]
    >>> found = rotations_under([*conditions[:2], RotationCondition(np.outer(axes[2], axes[2]), 0.5)])
    >>> bool(np.all(abs(found.values[:, 2, 2] - 0.5) < 1e-9)), found.complex
    (True, 8)
    """
    turn = np.linalg.qr(np.random.default_rng(0).normal(size=(4, 4)))[0]  # so that no root has a first coordinate 0
    forms = [
        turn.T @ (_quadric(own.matrix) / _size(own) - own.value / _size(own) * np.eye(4)) @ turn for own in conditions
    ]
    roots = quadratic(np.array(forms, dtype=complex))
    if not roots.isolated:
        return Rotations(np.zeros((0, 3, 3)), 0, sure=False)
    e = np.column_stack([np.ones(len(roots.values)), roots.values]) @ turn.T
    e = e / np.take_along_axis(e, np.argmax(np.abs(e), axis=1)[:, None], axis=1)
    off = np.max(np.abs(e.imag), axis=1)
    real = e[off <= REAL].real
    sure = roots.error < ACCURATE and len(e) == roots.count and not np.any((off > DOUBTFUL) & (off <= REAL))
    return Rotations(from_quaternion(real / np.linalg.norm(real, axis=1)[:, None]), len(e), sure)


def _size(condition: RotationCondition) -> float:
    return float(np.linalg.norm(condition.matrix)) + abs(condition.value)


def _quadric(matrix: FloatArray) -> FloatArray:
    """Q (4, 4) with e' Q e = N(e) sum of A_ij R_ij, by Davenport."""
    z = np.array([matrix[2, 1] - matrix[1, 2], matrix[0, 2] - matrix[2, 0], matrix[1, 0] - matrix[0, 1]])
    trace = np.trace(matrix)
    form = np.empty((4, 4))
    form[0, 0] = trace
    form[0, 1:] = form[1:, 0] = z
    form[1:, 1:] = matrix + matrix.T - trace * np.eye(3)
    return form
