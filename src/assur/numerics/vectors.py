"""Vectors and matrices of components for kernels: tuples of numbers of any type, with + - * / and `ns.sqrt` only.

A vector is a tuple (x, y, z), a matrix a tuple of rows, a direction in a plane a pair (cosine, sine).
"""

from __future__ import annotations

from typing import Any

Number = Any
Vector = tuple[Number, Number, Number]
Matrix = tuple[Vector, Vector, Vector]
Pair = tuple[Number, Number]


def add(a: Vector, b: Vector) -> Vector:
    """Sum a + b."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def subtract(a: Vector, b: Vector) -> Vector:
    """Difference a - b."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scaled(a: Vector, factor: Number) -> Vector:
    """Product factor a."""
    return (factor * a[0], factor * a[1], factor * a[2])


def dot(a: Vector, b: Vector) -> Number:
    """Inner product a . b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """Cross product a x b.

    >>> cross((1, 0, 0), (0, 1, 0))
    (0, 0, 1)
    """
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(ns: Any, a: Vector) -> Number:
    """Length |a|.

    >>> from assur.numerics.number_types import Floats
    >>> float(length(Floats(), (2, 3, 6)))
    7.0
    """
    return ns.sqrt(dot(a, a))


def triple(a: Vector, b: Vector, c: Vector) -> Number:
    """Triple product a . (b x c), the determinant of three rows."""
    return dot(a, cross(b, c))


def apply(matrix: Matrix, a: Vector) -> Vector:
    """Matrix times vector."""
    return (dot(matrix[0], a), dot(matrix[1], a), dot(matrix[2], a))


def transposed(matrix: Matrix) -> Matrix:
    """Rows for columns."""
    (a, b, c), (d, e, f), (g, h, i) = matrix
    return ((a, d, g), (b, e, h), (c, f, i))


def product(first: Matrix, second: Matrix) -> Matrix:
    """Matrix times matrix."""
    columns = transposed(second)
    a, b, c = ((dot(row, columns[0]), dot(row, columns[1]), dot(row, columns[2])) for row in first)
    return (a, b, c)


def about_z(turn: Pair) -> Matrix:
    """Rotation about Z by an angle given as (cosine, sine)."""
    cosine, sine = turn
    return ((cosine, -sine, 0), (sine, cosine, 0), (0, 0, 1))


def about_y(turn: Pair) -> Matrix:
    """Rotation about Y by an angle given as (cosine, sine)."""
    cosine, sine = turn
    return ((cosine, 0, sine), (0, 1, 0), (-sine, 0, cosine))


def about_x(turn: Pair) -> Matrix:
    """Rotation about X by an angle given as (cosine, sine)."""
    cosine, sine = turn
    return ((1, 0, 0), (0, cosine, -sine), (0, sine, cosine))


def of_quaternion(w: Number, x: Number, y: Number, z: Number) -> Matrix:
    """Rotation of a unit quaternion, scalar first.

    >>> of_quaternion(0, 0, 0, 1)
    ((-1, 0, 0), (0, -1, 0), (0, 0, 1))
    """
    return (
        (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
    )


def taking(start: Vector, end: Vector) -> Matrix:
    """The smallest rotation that takes one unit vector onto another, not its opposite.

    >>> apply(taking((0, 0, 1), (1, 0, 0)), (0, 0, 1))
    (1.0, 0.0, 0.0)
    """
    cosine, (x, y, z) = dot(start, end), cross(start, end)
    versine = 1 / (1 + cosine)  # over the square of the sine
    return (
        (cosine + versine * x * x, versine * x * y - z, versine * x * z + y),
        (versine * x * y + z, cosine + versine * y * y, versine * y * z - x),
        (versine * x * z - y, versine * y * z + x, cosine + versine * z * z),
    )


def opposite(angle: Pair) -> Pair:
    """(cosine, sine) of an angle the other way round.

    >>> opposite((0, 1))
    (0, -1)
    """
    return (angle[0], -angle[1])


def sum_of_angles(first: Pair, second: Pair) -> Pair:
    """(cosine, sine) of the sum of two angles."""
    return (first[0] * second[0] - first[1] * second[1], first[1] * second[0] + first[0] * second[1])


def difference_of_angles(first: Pair, second: Pair) -> Pair:
    """(cosine, sine) of the first angle less the second.

    >>> difference_of_angles((0, 1), (0, 1))
    (1, 0)
    """
    return (first[0] * second[0] + first[1] * second[1], first[1] * second[0] - first[0] * second[1])
