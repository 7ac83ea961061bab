"""Linear equations in a straight line, over any number type: by pivots that were chosen at examples.

Rows that say nothing new have no pivot and take no part; columns without one are free. The pivots are good at the
examples: elsewhere whoever solves looks at what the rows leave.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from assur.numerics.vectors import minus, times

FloatArray = NDArray[np.float64]
Entries = Mapping[tuple[int, int], Any]
Pivots = tuple[tuple[int, int], ...]

LARGE = 0.3
"""Share of the largest number of its row that a pivot has at least, at every example."""
ZERO = 1e-7
"""Rows whose numbers are all below this are left without a pivot; given rows are of the order of 1."""


def chosen_pivots(examples: FloatArray, groups: Sequence[range]) -> tuple[Pivots, ...]:
    """Pivots (row, column) for matrices (s, r, n) of one structure, group of rows by group.

    Of those that are large at every example that is taken which fills in least.

    >>> matrix = np.array([[[1.0, 1.0, 0.0], [2.0, 2.0, 0.0], [0.0, 1.0, 1.0]]])
    >>> chosen_pivots(matrix, [range(0, 2), range(2, 3)])
    (((0, 0),), ((2, 1),))
    """
    left, waiting = examples.copy(), set(range(examples.shape[1]))
    used = np.max(np.abs(left), axis=0) > 0.0
    free = np.ones(left.shape[2], dtype=bool)
    chosen = []
    for group in groups:
        rows, own = list(group), []
        while pivot := _next(left[:, rows][:, :, free], used[rows][:, free]):
            row, column = rows[pivot[0]], int(np.flatnonzero(free)[pivot[1]])
            own.append((row, column))
            rows.remove(row)
            waiting.remove(row)
            free[column] = False
            others = [k for k in waiting if used[k, column]]
            left[:, others] -= (left[:, others, column] / left[:, None, row, column])[..., None] * left[:, None, row]
            left[:, others, column] = 0.0
            used[others] |= used[row]
            used[others, column] = False
        chosen.append(tuple(own))
    return tuple(chosen)


def independent_columns(matrix: FloatArray) -> NDArray[np.intp]:
    """Places (r,), growing, of columns that span those of a matrix (r, n) of full rank: the largest of what is left.

    >>> independent_columns(np.array([[1.0, 3.0, 3.0], [0.0, 1.0, 2.0]])).tolist()
    [1, 2]
    """
    left, chosen = matrix.copy(), []
    for _ in range(len(matrix)):
        chosen.append(int(np.argmax(np.sum(left * left, axis=0))))
        own = left[:, chosen[-1]] / np.linalg.norm(left[:, chosen[-1]])
        left = left - np.outer(own, own @ left)
        left[:, chosen] = 0.0
    return np.sort(np.array(chosen, dtype=np.intp))


def _next(left: FloatArray, used: NDArray[np.bool_]) -> tuple[int, int] | None:
    """Row and column of the next pivot among what is left (s, r, n)."""
    sizes = np.abs(left)
    largest = np.max(sizes, axis=2, initial=0.0)  # (s, r)
    alive = np.min(largest, axis=0, initial=np.inf) > ZERO
    if not left.size or not np.any(alive):
        return None
    share = np.min(sizes / np.where(largest > ZERO, largest, 1.0)[..., None], axis=0) * alive[:, None]
    fit = share >= min(LARGE, float(share.max()))
    filled = (used.sum(axis=1)[:, None] - 1) * (used.sum(axis=0)[None] - 1)
    cost = np.where(fit, filled - 0.5 * share, np.inf)
    row, column = np.unravel_index(int(np.argmin(cost)), cost.shape)
    return int(row), int(column)


class _Step(NamedTuple):
    row: int
    column: int
    share: Any
    below: dict[int, Any]
    beside: dict[int, Any]


class Elimination:
    """Equations of which those with pivots are brought to a triangle, to be solved for any right side.

    >>> triangle = Elimination({(0, 0): 2.0, (1, 0): 4.0, (1, 1): 1.0, (1, 2): 3.0}, ((0, 0), (1, 1)))
    >>> triangle.solved({0: 2.0, 1: 5.0}, {2: 1.0})
    {2: 1.0, 1: -2.0, 0: 1.0}
    """

    def __init__(self, entries: Entries, pivots: Pivots) -> None:
        left: dict[int, dict[int, Any]] = {row: {} for row, _ in pivots}
        for (row, column), number in entries.items():
            if row in left and not nothing(number):
                left[row][column] = number
        self._steps: list[_Step] = []
        for row, column in pivots:
            beside = left.pop(row)
            share = _reciprocal(beside.pop(column))
            below: dict[int, Any] = {}
            for other, numbers in left.items():
                if column in numbers:
                    below[other] = times(numbers.pop(column), share)
                    for k, number in beside.items():
                        numbers[k] = minus(numbers.get(k, 0), times(below[other], number))
            self._steps.append(_Step(row, column, share, below, beside))

    def solved(
        self, right: Mapping[int, Any], free: Mapping[int, Any] | None = None, count: int | None = None
    ) -> dict[int, Any]:
        """Unknowns by column for a right side by row and the free ones; those that are nothing are left out.

        Of the first `count` pivots alone, if that is said.
        """
        sides = dict(right)
        steps = self._steps[:count]
        for step in steps:
            if step.row in sides:
                for other, factor in step.below.items():
                    sides[other] = minus(sides.get(other, 0), times(factor, sides[step.row]))
        unknowns = dict(free or {})
        for step in reversed(steps):
            value = sides.get(step.row, 0)
            for k, number in step.beside.items():
                value = minus(value, times(number, unknowns.get(k, 0)))
            if not nothing(value):
                unknowns[step.column] = times(value, step.share)
        return unknowns


def nothing(number: Any) -> bool:
    """Whether a number is the integer 0, which no configuration changes."""
    return type(number) is int and number == 0


def _reciprocal(number: Any) -> Any:
    return number if type(number) is int and number in (1, -1) else 1 / number
