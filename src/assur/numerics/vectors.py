"""Vectors and matrices of components over any number type: tuples of numbers, with + - * / and `ns.sqrt` only.

A vector is a tuple (x, y, z), a matrix a tuple of rows, a direction in a plane a pair (cosine, sine). An integer 0 or 1
stays what it is. Over intervals that is more than speed: a component that is zero for every configuration, as those
across the plane of a planar loop are, comes out as the integer 0, and not as bounds about it.
"""

from __future__ import annotations

from typing import Any

Number = Any
Vector = tuple[Number, Number, Number]
Matrix = tuple[Vector, Vector, Vector]
Pair = tuple[Number, Number]


def times(a: Number, b: Number) -> Number:
    """Product; an integer 0 or +-1 is one exactly.

    >>> times(0, 2.5), times(2.5, -1), times(2.0, 2.5)
    (0, -2.5, 5.0)
    """
    if type(a) is int and -1 <= a <= 1:
        return 0 if a == 0 else b if a == 1 else -b
    if type(b) is int and -1 <= b <= 1:
        return 0 if b == 0 else a if b == 1 else -a
    return a * b


def plus(a: Number, b: Number) -> Number:
    """Sum; an integer 0 adds nothing.

    >>> plus(0, 2.5), plus(2.5, 0)
    (2.5, 2.5)
    """
    if type(a) is int and a == 0:
        return b
    return a if type(b) is int and b == 0 else a + b


def minus(a: Number, b: Number) -> Number:
    """Difference.

    >>> minus(0, 2.5), minus(2.5, 0)
    (-2.5, 2.5)
    """
    if type(a) is int and a == 0:
        return times(-1, b)
    return a if type(b) is int and b == 0 else a - b


def add(a: Vector, b: Vector) -> Vector:
    """Sum of two vectors."""
    return plus(a[0], b[0]), plus(a[1], b[1]), plus(a[2], b[2])


def subtract(a: Vector, b: Vector) -> Vector:
    """Difference of two vectors."""
    return minus(a[0], b[0]), minus(a[1], b[1]), minus(a[2], b[2])


def scaled(a: Vector, factor: Number) -> Vector:
    """Product of a vector and a number."""
    return times(a[0], factor), times(a[1], factor), times(a[2], factor)


def dot(a: Vector, b: Vector) -> Number:
    """Scalar product."""
    return plus(plus(times(a[0], b[0]), times(a[1], b[1])), times(a[2], b[2]))


def cross(a: Vector, b: Vector) -> Vector:
    """Vector product.

    >>> cross((1, 0, 0), (0, 2.0, 0))
    (0, 0, 2.0)
    """
    return (
        minus(times(a[1], b[2]), times(a[2], b[1])),
        minus(times(a[2], b[0]), times(a[0], b[2])),
        minus(times(a[0], b[1]), times(a[1], b[0])),
    )


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
    """A matrix, by its rows, times a vector."""
    return dot(matrix[0], a), dot(matrix[1], a), dot(matrix[2], a)


def transposed(matrix: Matrix) -> Matrix:
    """The matrix with rows and columns exchanged."""
    first, second, third = zip(*matrix, strict=True)
    return first, second, third


def product(first: Matrix, second: Matrix) -> Matrix:
    """Product of two matrices.

    >>> product(((0, -1, 0), (1, 0, 0), (0, 0, 1)), ((0, -1, 0), (1, 0, 0), (0, 0, 1)))
    ((-1, 0, 0), (0, -1, 0), (0, 0, 1))
    """
    columns = transposed(second)
    rows = [(dot(row, columns[0]), dot(row, columns[1]), dot(row, columns[2])) for row in first]
    return rows[0], rows[1], rows[2]


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
