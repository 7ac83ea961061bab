"""Singular values of 2 x 2 and 3 x 3 matrices as straight-line algebra, without a library's decomposition.

The largest eigenvalue of a symmetric 3 x 3 matrix S with mean eigenvalue q and size p is q + 2 p cos(t/3), t an angle
whose cosine and sine are known: the cosine is half the determinant of (S - q)/p, the sine the root of its
discriminant, a sum of squares that does not cancel where two eigenvalues meet (Cauchy and Binet, applied to the Gram
determinant of I, S and S^2). cos(t/3), as a function of cos(t/2), is analytic on [0, 1]: a polynomial replaces acos.

The functions read over every number type that has + - * / abs and a root. Over floats the largest singular value has
a relative error of at most 2e-14; a test compares it with LAPACK's.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from assur.errors import UsageError
from assur.numerics.number_types import Floats
from assur.numerics.small_matrices import adjugate, by_cofactors, product

Rows = Sequence[Sequence[Any]]

DEGREE = 21
"""Of the polynomial: its error is below the last digit."""
TINY = 1e-290
"""Keeps 0/0 away, where it is added to a number that may vanish; next to any other number it is nothing."""
SIZES = (1, 2, 3)
"""Matrices with closed forms here."""


def largest_singular_value(ns: Any, rows: Rows) -> Any:
    """s1 = ||A||_2 of a k x k matrix, k = 1, 2 or 3, whose entries are numbers that broadcast.

    Args:
        ns: the namespace of the number type (`assur.numerics.number_types`), for its root.
        rows: entries; a plain 0 costs nothing.

    Errors:
        UsageError: a matrix of another size.

    Example:
        >>> from assur.numerics.number_types import Floats
        >>> round(float(largest_singular_value(Floats(), [[3.0, 0, 0], [0, 0, -4.0], [0, 1.0, 0]])), 12)
        4.0
    """
    _check(rows)
    if len(rows) == 1:
        return abs(rows[0][0] + 0.0)
    if len(rows) == 2:  # half the sum of the sizes of the parts that turn, and that reflect
        (a, b), (c, d) = rows
        return (_hypotenuse(ns, a + d, c - b) + _hypotenuse(ns, a - d, b + c)) * 0.5
    return ns.sqrt(largest_eigenvalue(ns, _gram(rows)))


def condition_index(ns: Any, first: Rows, second: Rows) -> tuple[Any, Any]:
    """1 / cond(J), and the smallest singular value, of J = A^-1 B for two k x k matrices, k = 1, 2 or 3.

    With J = adj(A) B / det A and J^-1 = adj(B) A / det B, each is a largest singular value and determinants:
    sk = |det B| / ||adj(B) A|| and s1 = ||adj(A) B|| / |det A|. Both are 0 where B is singular, the index where A is.

    Example:
        >>> from assur.numerics.number_types import Floats
        >>> index, smallest = condition_index(Floats(), [[2.0, 0], [0, 1.0]], [[2.0, 0], [0, 4.0]])
        >>> float(index), float(smallest)
        (0.25, 1.0)
    """
    _check(first)
    size_a, size_b = abs(by_cofactors(first) + 0.0), abs(by_cofactors(second) + 0.0)
    largest_inverse = largest_singular_value(ns, product(adjugate(first), second))
    back = largest_singular_value(ns, product(adjugate(second), first))
    smallest = size_b / (back + TINY)
    return smallest * (size_a / (largest_inverse + TINY)), smallest


def largest_eigenvalue(ns: Any, entries: Sequence[Any]) -> Any:
    """The largest eigenvalue of a symmetric 3 x 3 matrix with entries 11, 22, 33, 12, 13, 23.

    Its error is a few last digits of the largest magnitude of an eigenvalue.

    Example: eigenvalues 1, 3 and 3.

        >>> from assur.numerics.number_types import Floats
        >>> round(float(largest_eigenvalue(Floats(), [2.0, 2.0, 3.0, 1.0, 0.0, 0.0])), 12)
        3.0
    """
    a, b, c, d, e, f = entries
    mean = (a + b + c) * (1 / 3)
    x, y, z = a - mean, b - mean, c - mean
    size = ns.sqrt((x * x + y * y + z * z + 2.0 * (d * d + e * e + f * f)) * (1 / 6))
    share = 1.0 / (size + TINY)
    x, y, z, d, e, f = (number * share for number in (x, y, z, d, e, f))
    cosine = (x * (y * z - f * f) - d * (d * z - f * e) + e * (d * f - y * e)) * 0.5
    sine = ns.sqrt(_discriminant(x - z, y - z, d, e, f) * (1 / 108))
    return mean + 2.0 * size * _third(_cosine_of_half(ns, cosine, sine))


def _discriminant(x: Any, y: Any, d: Any, e: Any, f: Any) -> Any:
    """((a - b)(b - c)(c - a))^2 of the eigenvalues of [[x, d, e], [d, y, f], [e, f, 0]]: squared minors of I S S^2."""
    dd, ee, ff = d * d, e * e, f * f
    square = (x * x + dd + ee, y * y + dd + ff, ee + ff)
    off = ((d, d * (x + y) + e * f), (e, e * x + d * f), (f, f * y + d * e))
    gaps = ((x - y, square[0] - square[1]), (x, square[0] - square[2]), (y, square[1] - square[2]))
    three = gaps[1][0] * gaps[2][1] - gaps[2][0] * gaps[1][1]
    two = _sum_of_squares(p * v - u * w for p, w in off for u, v in gaps)
    one = _sum_of_squares(off[j][0] * off[k][1] - off[k][0] * off[j][1] for j, k in ((0, 1), (0, 2), (1, 2)))
    return three * three + 2.0 * two + 12.0 * one


def _cosine_of_half(ns: Any, cosine: Any, sine: Any) -> Any:
    """cos(t/2) for t in [0, pi]: the larger of it and sin(t/2) by a root, the other by division: both are sharp."""
    size = abs(cosine)
    large = ns.sqrt((1.0 + size) * 0.5)
    small = 0.5 * sine / large
    side = cosine / (size + TINY)  # 1 or -1, or 0 where both are equal
    return ((large + small) + side * (large - small)) * 0.5


def _third(half: Any) -> Any:
    """cos(t/3) from cos(t/2) in [0, 1], by Horner's rule."""
    place = 2.0 * half - 1.0
    coefficients = _coefficients()
    value = coefficients[-1] * place + coefficients[-2]
    for coefficient in coefficients[-3::-1]:
        value = value * place + coefficient
    return value


@lru_cache(maxsize=1)
def _coefficients() -> tuple[float, ...]:
    """Of cos(2/3 acos((1 + x)/2)) on [-1, 1], the constant term first: interpolated at Chebyshev's points."""
    chebyshev = np.polynomial.chebyshev
    places = chebyshev.chebpts1(DEGREE + 1)
    values = np.cos(2 / 3 * np.arccos((1 + places) / 2))
    coefficients = chebyshev.cheb2poly(chebyshev.chebfit(places, values, DEGREE))
    return tuple(float(number) for number in coefficients)


def _gram(rows: Rows) -> list[Any]:
    """Entries 11, 22, 33, 12, 13, 23 of A^T A."""
    columns = list(zip(*rows, strict=True))
    return [product([columns[j]], [[entry] for entry in columns[k]])[0][0] for j, k in _PAIRS]


_PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))


def _hypotenuse(ns: Any, a: Any, b: Any) -> Any:
    return ns.sqrt(a * a + b * b)


def _sum_of_squares(numbers: Any) -> Any:
    total: Any = 0.0
    for number in numbers:
        total = total + number * number
    return total


def _check(rows: Rows) -> None:
    if len(rows) not in SIZES or any(len(row) != len(rows) for row in rows):
        lengths = " and ".join(str(len(row)) for row in rows) or "no"
        raise UsageError(
            f"closed forms of singular values: {len(rows)} rows of {lengths} entries",
            hint="1 x 1, 2 x 2 and 3 x 3 have one; numpy.linalg.svd takes every size",
        )


def float_condition_index(first: Rows, second: Rows) -> tuple[Any, Any]:
    """`condition_index` over float arrays that broadcast, for matrices of any size: LAPACK beyond 3 x 3.

    Example:
        >>> index, smallest = float_condition_index(np.diag([1.0, 1.0, 1.0, 2.0]), np.eye(4))
        >>> float(index), float(smallest)
        (0.5, 0.5)
    """
    if len(first) in SIZES:
        return condition_index(Floats(), first, second)
    a, b = (_stacked(rows) for rows in (first, second))
    regular = np.linalg.det(b) != 0
    back = np.linalg.solve(np.where(regular[..., None, None], b, np.eye(len(first))), a)  # J^-1 = B^-1 A
    sizes = np.linalg.svd(back, compute_uv=False)
    with np.errstate(divide="ignore", invalid="ignore"):
        index, smallest = sizes[..., -1] / sizes[..., 0], 1.0 / sizes[..., 0]
    return np.where(regular, index, 0.0), np.where(regular, smallest, 0.0)


def _stacked(rows: Rows) -> np.ndarray[Any, np.dtype[np.float64]]:
    entries = np.broadcast_arrays(*(np.asarray(entry, dtype=float) for row in rows for entry in row))
    return np.stack(entries, axis=-1).reshape(*entries[0].shape, len(rows), len(rows))
