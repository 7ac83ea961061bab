"""Least-squares steps in a straight line, over any number type: normal equations by a sparse L D L^T without pivots.

The matrix J^T J with a trace of damping is positive definite, so that any order of its rows is stable enough for steps
that are repeated until the residuals vanish; the order that fills in least is taken. Redundant rows and columns that
nothing moves do no harm, and no pivot is chosen at any one configuration.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from assur.numerics.vectors import minus, plus, times

Entries = Mapping[tuple[int, int], Any]


def least_squares_steps(
    entries: Entries, residuals: Sequence[Mapping[int, Any]], damping: float
) -> list[dict[int, Any]]:
    """For each r the change x of least |J x + r|^2 and damping times the mean of J's squared columns times |x|^2.

    Args:
        entries: (row, column) -> number of J; what is not named is zero.
        residuals: row -> number of each r; what is not named is zero.
        damping: a share, as large as rounding of J^T J at least.

    Returns:
        for each r column -> number, for all columns that have entries.

    >>> (step,) = least_squares_steps({(0, 0): 2.0, (1, 0): 0.0, (1, 1): 4.0}, [{0: -2.0, 1: 4.0}], 0.0)
    >>> step[0], step[1]
    (1.0, -1.0)
    """
    rows: dict[int, dict[int, Any]] = {}
    for (row, column), number in entries.items():
        rows.setdefault(row, {})[column] = number
    square: dict[int, dict[int, Any]] = {column: {} for _, column in entries}
    for numbers in rows.values():
        for i, first in numbers.items():
            for j, second in numbers.items():
                if j <= i:
                    _add(square, i, j, times(first, second))
    shift = _sum([square[i][i] for i in square]) * (damping / max(len(square), 1))
    for i in square:
        square[i][i] = square[i][i] + shift
    return _solved(square, [_right(rows, residual) for residual in residuals])


def _right(rows: Mapping[int, Mapping[int, Any]], residuals: Mapping[int, Any]) -> dict[int, Any]:
    """-J^T r."""
    right: dict[int, Any] = {}
    for row, residual in residuals.items():
        for i, number in rows.get(row, {}).items():
            _subtract(right, i, times(number, residual))
    return right


def _add(square: dict[int, dict[int, Any]], i: int, j: int, number: Any) -> None:
    """To both halves of a symmetric matrix."""
    for a, b in {(i, j), (j, i)}:
        square[a][b] = plus(square[a][b], number) if b in square[a] else number


def _sum(numbers: list[Any]) -> Any:
    total: Any = 0.0
    for number in numbers:
        total = total + number
    return total


def _subtract(numbers: dict[int, Any], i: int, number: Any) -> None:
    numbers[i] = numbers[i] - number if i in numbers else -number


def _solved(square: dict[int, dict[int, Any]], rights: list[dict[int, Any]]) -> list[dict[int, Any]]:
    """Unknowns of a positive definite system for several right sides, eliminated in the order that fills in least."""
    eliminated: list[tuple[int, Any, dict[int, Any]]] = []
    left = dict(square)
    while left:
        k = min(left, key=lambda i: (len(left[i]), i))
        column = left.pop(k)
        share = 1.0 / column.pop(k)
        factors = {i: number * share for i, number in column.items()}
        for i, factor in factors.items():
            del left[i][k]
            for j, number in column.items():
                if j <= i:
                    _add(left, i, j, -(factor * number))
            for right in rights:
                if k in right:
                    _subtract(right, i, factor * right[k])
        eliminated.append((k, share, factors))
    return [_substituted(eliminated, right) for right in rights]


def _substituted(eliminated: list[tuple[int, Any, dict[int, Any]]], right: dict[int, Any]) -> dict[int, Any]:
    unknowns: dict[int, Any] = {}
    for k, share, factors in reversed(eliminated):
        value = right[k] * share if k in right else 0
        for i, factor in factors.items():
            value = minus(value, times(factor, unknowns[i]))
        unknowns[k] = value
    return unknowns
