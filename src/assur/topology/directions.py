"""Directions of axes, and exact subspaces of directions: lines, planes and the space that they span.

A direction is a unit vector in the base frame, at the configuration as written. What is parallel or
perpendicular there decides what a chain can do, so nearly parallel is refused where a chain is read.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Vector = tuple[float, float, float]

EXACT = 1e-9
"""Sine (or cosine) below which two directions are parallel (or perpendicular)."""

NEARLY = 1e-3
"""Sine (or cosine) below which two directions that are not exactly so look like a slip of the pen."""

DUST = 1e-14
"""Components below this share of a vector's length are rounding errors of zero."""

NAMED: dict[str, Vector] = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


def unit(vector: Iterable[float]) -> Vector:
    """The vector with length one, rounding dust removed; the zero vector raises ZeroDivisionError.

    >>> unit((0, 3, 4))
    (0.0, 0.6, 0.8)
    """
    x, y, z = map(float, vector)
    length = math.hypot(x, y, z)
    x, y, z = (0.0 if abs(part) < DUST * length else part / length for part in (x, y, z))
    return (x, y, z)


def parallel(first: Vector, second: Vector, tolerance: float = EXACT) -> bool:
    """Whether two unit vectors lie along one line, in either sense."""
    return float(np.linalg.norm(np.cross(first, second))) < tolerance


def perpendicular(first: Vector, second: Vector, tolerance: float = EXACT) -> bool:
    """Whether two unit vectors are at a right angle."""
    return abs(float(np.dot(first, second))) < tolerance


def span(vectors: Iterable[Vector]) -> FloatArray:
    """Orthonormal basis (k, 3) of what some vectors span."""
    return _basis(np.array(list(vectors), dtype=float).reshape(-1, 3))


def complement(basis: FloatArray) -> FloatArray:
    """Orthonormal basis (3 - k, 3) of what is perpendicular to a basis (k, 3)."""
    if not len(basis):
        return np.eye(3)
    turned: FloatArray = np.linalg.svd(basis)[2][len(basis) :]
    return turned


def meet(first: FloatArray, second: FloatArray) -> FloatArray:
    """Orthonormal basis of what two subspaces have in common."""
    return complement(_basis(np.vstack([complement(first), complement(second)])))


def contains(basis: FloatArray, vector: Vector) -> bool:
    """Whether a unit vector lies in a subspace."""
    rest = np.asarray(vector) - np.asarray(vector) @ basis.T @ basis if len(basis) else np.asarray(vector)
    return float(np.linalg.norm(rest)) < EXACT


def near_slips(vectors: Iterable[Vector]) -> list[tuple[int, int, str]]:
    """Pairs (i, j, "parallel" or "perpendicular") that are nearly but not exactly so."""
    slips = []
    for (i, first), (j, second) in combinations(enumerate(vectors), 2):
        if parallel(first, second, NEARLY) and not parallel(first, second):
            slips.append((i, j, "parallel"))
        elif perpendicular(first, second, NEARLY) and not perpendicular(first, second):
            slips.append((i, j, "perpendicular"))
    return slips


def _basis(rows: FloatArray) -> FloatArray:
    if not len(rows):
        return np.zeros((0, 3))
    _, singular, turned = np.linalg.svd(rows, full_matrices=False)
    kept: FloatArray = turned[singular > EXACT]
    return kept
