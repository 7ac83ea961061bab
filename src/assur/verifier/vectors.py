"""Vectors and matrices of three over any number type. Integers 0, 1 and -1 stand for themselves."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

Vector = tuple[Any, Any, Any]
Matrix = tuple[Vector, Vector, Vector]
ONE: Matrix = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
ZERO: Vector = (0, 0, 0)


def is_zero(a: Any) -> bool:
    """Whether it is the integer that stands for nothing."""
    return type(a) is int and a == 0


def plus(a: Any, b: Any) -> Any:
    """Sum."""
    return b if is_zero(a) else a if is_zero(b) else a + b


def times(a: Any, b: Any) -> Any:
    """Product."""
    if is_zero(a) or is_zero(b):
        return 0
    return b if type(a) is int and a == 1 else a if type(b) is int and b == 1 else a * b


def dot(a: Vector, b: Vector) -> Any:
    """Scalar product."""
    return plus(plus(times(a[0], b[0]), times(a[1], b[1])), times(a[2], b[2]))


def scaled(a: Vector, factor: Any) -> Vector:
    """Multiple of a vector."""
    return times(a[0], factor), times(a[1], factor), times(a[2], factor)


def add(a: Vector, b: Vector) -> Vector:
    """Sum of vectors."""
    return plus(a[0], b[0]), plus(a[1], b[1]), plus(a[2], b[2])


def subtract(a: Vector, b: Vector) -> Vector:
    """Difference of vectors."""
    return add(a, scaled(b, -1))


def cross(a: Vector, b: Vector) -> Vector:
    """Vector product."""
    (u, v, w), (x, y, z), (p, q, r) = a, b, scaled(b, -1)
    return plus(times(v, z), times(w, q)), plus(times(w, x), times(u, r)), plus(times(u, y), times(v, p))


def transposed(a: Matrix) -> Matrix:
    """Rows for columns."""
    x, y, z = zip(*a, strict=True)
    return x, y, z


def apply(a: Matrix, b: Vector) -> Vector:
    """Matrix times vector."""
    return dot(a[0], b), dot(a[1], b), dot(a[2], b)


def product(a: Matrix, b: Matrix) -> Matrix:
    """Matrix times matrix."""
    columns = transposed(b)
    x, y, z = (apply(columns, row) for row in a)
    return x, y, z


def about(axis: Vector, cosine: Any, sine: Any) -> Matrix:
    """Turn about a unit vector: each axis e becomes e cos + (n x e) sin + n (n . e)(1 - cos)."""
    rest = plus(1, times(cosine, -1))

    def column(e: Vector) -> Vector:
        along = scaled(axis, times(dot(axis, e), rest))
        return add(add(scaled(e, cosine), scaled(cross(axis, e), sine)), along)

    return transposed((column(ONE[0]), column(ONE[1]), column(ONE[2])))


def taking(start: Vector, end: Vector) -> Matrix:
    """The smallest turn that takes one unit vector onto another."""
    across, size = cross(start, end), plus(1, dot(start, end))
    over = Fraction(1, size) if type(size) is int else 1 / size

    def column(e: Vector) -> Vector:
        once = cross(across, e)
        return add(add(e, once), scaled(cross(across, once), over))

    return transposed((column(ONE[0]), column(ONE[1]), column(ONE[2])))
