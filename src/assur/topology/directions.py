"""Directions of axes: vector algebra on three numbers, without the cost of an array, and what directions span.

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

AXES: tuple[Vector, Vector, Vector] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
"""The base frame's axes."""

NAMED: dict[str, Vector] = dict(zip("xyz", AXES, strict=True))


def unit(vector: Iterable[float]) -> Vector:
    """The vector with length one, rounding dust removed; the zero vector raises ZeroDivisionError.

    >>> unit((0, 3, 4))
    (0.0, 0.6, 0.8)
    """
    x, y, z = map(float, vector)
    length = math.hypot(x, y, z)
    x, y, z = (0.0 if abs(part) < DUST * length else part / length for part in (x, y, z))
    return (x, y, z)


def dot(first: Vector, second: Vector) -> float:
    """The scalar product."""
    return first[0] * second[0] + first[1] * second[1] + first[2] * second[2]


def cross(first: Vector, second: Vector) -> Vector:
    """The vector product."""
    a, b, c = first
    x, y, z = second
    return (b * z - c * y, c * x - a * z, a * y - b * x)


def parallel(first: Vector | None, second: Vector | None, tolerance: float = EXACT) -> bool:
    """Whether two unit vectors lie along one line, in either sense; not where one is any direction (None)."""
    if first is None or second is None:
        return False
    normal = cross(first, second)
    return dot(normal, normal) < tolerance * tolerance


def perpendicular(first: Vector, second: Vector, tolerance: float = EXACT) -> bool:
    """Whether two unit vectors are at a right angle."""
    return abs(dot(first, second)) < tolerance


def coplanar(first: Vector, second: Vector, third: Vector) -> bool:
    """Whether three unit vectors lie in one plane."""
    return abs(dot(first, cross(second, third))) < EXACT


def normal(first: Vector, second: Vector) -> Vector:
    """Unit normal of the plane of two directions that are not parallel."""
    return unit(cross(first, second))


def plane_basis(axis: Vector) -> tuple[Vector, Vector]:
    """Two unit vectors at right angles, perpendicular to a unit vector: base axes where they can be.

    >>> plane_basis((0.0, 0.0, 1.0))
    ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    """
    near = min(AXES, key=lambda direction: abs(dot(direction, axis)))
    first = unit(tuple(a - dot(near, axis) * b for a, b in zip(near, axis, strict=True)))
    second = unit(cross(axis, first))
    return first, second


def rotated(vector: Vector, axis: Vector, angle: float) -> Vector:
    """A unit vector turned about a unit axis by an angle (rad)."""
    cosine, sine = math.cos(angle), math.sin(angle)
    aside, along = cross(axis, vector), dot(axis, vector) * (1 - cosine)
    return unit(v * cosine + w * sine + u * along for v, w, u in zip(vector, aside, axis, strict=True))


def span(vectors: Iterable[Vector]) -> FloatArray:
    """Orthonormal basis (k, 3) of what some vectors span."""
    _, singular, turned = np.linalg.svd(np.array(list(vectors), dtype=float).reshape(-1, 3), full_matrices=False)
    basis: FloatArray = turned[singular > EXACT]
    return basis


def near_slips(vectors: Iterable[Vector]) -> list[tuple[int, int, str]]:
    """Pairs (i, j, "parallel" or "perpendicular") that are nearly but not exactly so."""
    slips = []
    for (i, first), (j, second) in combinations(enumerate(vectors), 2):
        if parallel(first, second, NEARLY) and not parallel(first, second):
            slips.append((i, j, "parallel"))
        elif perpendicular(first, second, NEARLY) and not perpendicular(first, second):
            slips.append((i, j, "perpendicular"))
    return slips
