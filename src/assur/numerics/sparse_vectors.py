"""Vectors of three and matrices over any number type in which an integer 0 or 1 stays what it is.

Over intervals that is more than speed: a component that is zero for every configuration, as those across the plane of a
planar loop are, comes out as the integer 0, and not as bounds about it.
"""

from __future__ import annotations

from typing import Any

Vector = tuple[Any, Any, Any]
Matrix = tuple[Vector, Vector, Vector]


def times(a: Any, b: Any) -> Any:
    """Product; an integer 0 or +-1 is one exactly.

    >>> times(0, 2.5), times(2.5, -1), times(2.0, 2.5)
    (0, -2.5, 5.0)
    """
    for one, other in ((a, b), (b, a)):
        if type(one) is int and one in (0, 1, -1):
            return 0 if one == 0 else other if one == 1 else -other
    return a * b


def plus(a: Any, b: Any) -> Any:
    """Sum; an integer 0 adds nothing.

    >>> plus(0, 2.5), plus(2.5, 0)
    (2.5, 2.5)
    """
    if type(a) is int and a == 0:
        return b
    return a if type(b) is int and b == 0 else a + b


def minus(a: Any, b: Any) -> Any:
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


def scaled(a: Vector, factor: Any) -> Vector:
    """Product of a vector and a number."""
    return times(a[0], factor), times(a[1], factor), times(a[2], factor)


def dot(a: Vector, b: Vector) -> Any:
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
