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
    return np.broadcast_to(np.asarray(_by_cofactors(rows), dtype=float), shape)


def _by_cofactors(rows: Sequence[Sequence[Any]]) -> Any:
    """Expansion along the row with the most plain zeros."""
    if len(rows) == 1:
        return rows[0][0]
    best = max(range(len(rows)), key=lambda r: sum(map(_is_zero, rows[r])))
    others = [row for r, row in enumerate(rows) if r != best]
    total: Any = 0
    for k, entry in enumerate(rows[best]):
        minor = 0 if _is_zero(entry) else _by_cofactors([[*row[:k], *row[k + 1 :]] for row in others])
        if _is_zero(minor):
            continue
        term = entry * minor
        if (best + k) % 2:
            total = -term if _is_zero(total) else total - term
        else:
            total = term if _is_zero(total) else total + term
    return total


def _is_zero(entry: Any) -> bool:
    """Whether an entry is the plain number 0, not an array that may hold zeros."""
    return isinstance(entry, int | float) and entry == 0


def _by_elimination(rows: Sequence[Sequence[Any]]) -> FloatArray:
    entries = np.broadcast_arrays(*(entry for row in rows for entry in row))
    stacked = np.stack(entries, axis=-1)
    matrices = stacked.reshape(*stacked.shape[:-1], len(rows), len(rows))  # (..., k, k)
    return np.asarray(np.linalg.det(matrices))
