"""Arbitrary directions: fixed ones, in no special position to those that a chain already has."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from assur.topology.directions import EXACT, NAMED, Vector
from assur.topology.notation.brackets import direction

FloatArray = NDArray[np.float64]

_TRIED = 64
NEARLY_BEST = 0.5
"""Share of the best candidate's distance from special directions that is far enough."""

_PLASTIC = 1.32471795724474602596
_STEPS = (1 / _PLASTIC, 1 / _PLASTIC**2)


class Arbitrary:
    """A source of directions. The same questions in the same order have the same answers.

    Every answer is one of 64 candidates of a low-discrepancy sequence that is far from parallel and perpendicular to
    the directions in `others`, and from the planes of any two of those in `near`: the first that is nearly as far as
    the best. The best itself would be alike in every limb, at half a right angle from the base's axes.
    """

    def __init__(self) -> None:
        self._asked = 0

    def within(self, normals: Sequence[Vector], others: Sequence[Vector], near: Sequence[Vector]) -> Vector | None:
        """A direction perpendicular to all `normals`; None if there is none.

        What the normals force, such as a right angle to another direction in their plane, is not avoided.

        >>> Arbitrary().within([(0.0, 0.0, 1.0), (0.0, 1.0, 0.0)], [], [])
        (1.0, 0.0, 0.0)
        """
        basis = _perpendicular(normals)
        if len(basis) < 2:
            return direction(tuple(basis[0].tolist())) if len(basis) else None
        candidates = self._candidates(len(basis)) @ basis  # (64, 3)
        avoided = np.array([*NAMED.values(), *others])  # (n, 3)
        walls = np.vstack([avoided, _planes(near)])
        clearances = [_clearance(candidates, walls, basis), _sines(candidates, avoided)]
        far = np.min(np.hstack(clearances), axis=1)
        chosen = int(np.argmax(far >= NEARLY_BEST * np.max(far)))
        return direction(tuple(candidates[chosen].tolist()))

    def _candidates(self, dimension: int) -> FloatArray:
        """Unit vectors (64, k) of a plane or of space, other ones at every call."""
        steps = np.arange(1, _TRIED + 1) + _TRIED * self._asked
        self._asked += 1
        turn, height = (np.mod(steps * step, 1.0) for step in _STEPS)
        angle = 2 * np.pi * turn
        if dimension == 2:
            return np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        z = 2 * height - 1
        radius = np.sqrt(1 - z * z)
        return np.stack([radius * np.cos(angle), radius * np.sin(angle), z], axis=-1)


def _perpendicular(normals: Sequence[Vector]) -> FloatArray:
    """Orthonormal basis (k, 3) of what is perpendicular to all normals; exact where they lie along x, y, z."""
    if not normals:
        return np.eye(3)
    first = np.asarray(normals[0])
    crosses = [np.cross(first, normal) for normal in normals[1:]]
    longest = max(crosses, key=lambda cross: float(np.linalg.norm(cross)), default=np.zeros(3))
    if np.linalg.norm(longest) > EXACT:
        line = np.array(direction(tuple(longest.tolist())))
        line *= np.sign(line[int(np.argmax(abs(line)))])
        free = all(abs(float(np.dot(line, normal))) < EXACT for normal in normals)
        return line[None] if free else np.zeros((0, 3))
    across = np.cross(first, np.eye(3)[int(np.argmin(abs(first)))])
    across /= np.linalg.norm(across)
    return np.stack([across, np.cross(first, across)])


def _planes(directions: Sequence[Vector]) -> FloatArray:
    """Unit normals (n, 3) of the planes of any two directions."""
    rows = np.array(directions, dtype=float).reshape(-1, 3)
    first, second = np.triu_indices(len(rows), 1)
    normals = np.cross(rows[first], rows[second])
    lengths = np.linalg.norm(normals, axis=1)
    planes: FloatArray = normals[lengths > EXACT] / lengths[lengths > EXACT, None]
    return planes


def _clearance(candidates: FloatArray, walls: FloatArray, basis: FloatArray) -> FloatArray:
    """Sine (64, n) of the angle between candidates and walls, given by normals; forced contacts count as clear."""
    shadows = walls @ basis.T  # (n, k)
    lengths = np.linalg.norm(shadows, axis=1)
    free = lengths > 1e-3
    sines: FloatArray = abs(candidates @ basis.T @ (shadows[free] / lengths[free, None]).T)
    return sines if free.any() else np.ones((_TRIED, 1))


def _sines(candidates: FloatArray, avoided: FloatArray) -> FloatArray:
    """Sine (64, n) of the angle between candidates and directions."""
    sines: FloatArray = np.linalg.norm(np.cross(candidates[:, None], avoided), axis=-1)
    return sines
