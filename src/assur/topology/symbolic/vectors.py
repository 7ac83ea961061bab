"""Vector algebra on three numbers: what the symbolic rules need, without the cost of an array.

The same tolerance as `directions`: what is parallel or perpendicular is so exactly, or not at all.
"""

from __future__ import annotations

import math

from assur.topology.directions import EXACT, Vector, unit

AXES: tuple[Vector, Vector, Vector] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
"""The base frame's axes."""


def dot(first: Vector, second: Vector) -> float:
    """The scalar product."""
    return first[0] * second[0] + first[1] * second[1] + first[2] * second[2]


def cross(first: Vector, second: Vector) -> Vector:
    """The vector product."""
    a, b, c = first
    x, y, z = second
    return (b * z - c * y, c * x - a * z, a * y - b * x)


def aligned(first: Vector, second: Vector) -> bool:
    """Whether two unit vectors lie along one line, in either sense."""
    normal = cross(first, second)
    return dot(normal, normal) < EXACT * EXACT


def square(first: Vector, second: Vector) -> bool:
    """Whether two unit vectors are at a right angle."""
    return abs(dot(first, second)) < EXACT


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
