"""Determinants of batches of small matrices whose entries are separate component arrays."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError

FloatArray = NDArray[np.float64]
LARGEST_BY_COFACTORS = 3


def determinant(rows: Sequence[Sequence[Any]]) -> FloatArray:
    """Determinant (...) of a k x k matrix whose entries are numbers or arrays (...) that broadcast.

    Up to 3 x 3 by cofactors: every element is then rounded alike, wherever it stands in its array. Entries that
    are the plain number 0 cost nothing. Larger matrices go to LAPACK.

    Errors:
        UsageError: no rows, or not square.

    Example:
        >>> determinant([[2.0, 0, 0], [5.0, np.array([3.0, 4.0]), 1.0], [7.0, 2.0, 6.0]])
        array([32., 44.])
    """
    size = len(rows)
    if size == 0 or any(len(row) != size for row in rows):
        lengths = " and ".join(str(len(row)) for row in rows) or "no"
        raise UsageError(f"a determinant needs a square matrix, not {size} rows of {lengths} entries")
    if size > LARGEST_BY_COFACTORS:
        return _by_elimination(rows)
    shape = np.broadcast_shapes(*(np.shape(entry) for row in rows for entry in row))
    return np.broadcast_to(np.asarray(by_cofactors(rows), dtype=float), shape)


def by_cofactors(rows: Sequence[Sequence[Any]]) -> Any:
    """Determinant over any number type, by expansion along the row with the most plain zeros.

    >>> by_cofactors([[2, 0], [5, 3]])
    6
    """
    if len(rows) == 1:
        return rows[0][0]
    best = max(range(len(rows)), key=lambda r: sum(map(_is_zero, rows[r])))
    others = [row for r, row in enumerate(rows) if r != best]
    total: Any = 0
    for k, entry in enumerate(rows[best]):
        minor = 0 if _is_zero(entry) else by_cofactors([[*row[:k], *row[k + 1 :]] for row in others])
        if _is_zero(minor):
            continue
        term = entry * minor
        if (best + k) % 2:
            total = -term if _is_zero(total) else total - term
        else:
            total = term if _is_zero(total) else total + term
    return total


def adjugate(rows: Sequence[Sequence[Any]]) -> list[list[Any]]:
    """Adjugate of a k x k matrix over any number type: A adj(A) = det A. A plain 0 stays one.

    >>> adjugate([[1, 2], [3, 4]])
    [[4, -2], [-3, 1]]
    """
    if len(rows) == 1:
        return [[1.0]]
    size = range(len(rows))
    return [[_cofactor(rows, r, c) for r in size] for c in size]


def product(first: Sequence[Sequence[Any]], second: Sequence[Sequence[Any]]) -> list[list[Any]]:
    """Matrix product over any number type; entries that are the plain number 0 cost nothing.

    >>> product([[1, 0], [0, 2]], [[0, 3], [4, 0]])
    [[0, 3], [8, 0]]
    """
    return [[_inner(row, column) for column in zip(*second, strict=True)] for row in first]


def _cofactor(rows: Sequence[Sequence[Any]], row: int, column: int) -> Any:
    others = [[*line[:column], *line[column + 1 :]] for r, line in enumerate(rows) if r != row]
    minor = by_cofactors(others)
    return minor if (row + column) % 2 == 0 or _is_zero(minor) else -minor


def _inner(first: Sequence[Any], second: Sequence[Any]) -> Any:
    total: Any = 0
    for a, b in zip(first, second, strict=True):
        if not (_is_zero(a) or _is_zero(b)):
            total = a * b if _is_zero(total) else total + a * b
    return total


def _is_zero(entry: Any) -> bool:
    """Whether an entry is the plain number 0, not an array that may hold zeros."""
    return isinstance(entry, int | float) and entry == 0


def _by_elimination(rows: Sequence[Sequence[Any]]) -> FloatArray:
    entries = np.broadcast_arrays(*(entry for row in rows for entry in row))
    stacked = np.stack(entries, axis=-1)
    matrices = stacked.reshape(*stacked.shape[:-1], len(rows), len(rows))  # (..., k, k)
    return np.asarray(np.linalg.det(matrices))
