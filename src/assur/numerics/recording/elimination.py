"""A sparse square system solved in a straight line: pivots chosen beforehand, at samples of the matrix.

A straight-line program cannot pivot. Here rows, columns and their order are chosen once: at every sample of the matrix
each pivot is large in its column, and among those the one that fills in least is taken (Markowitz). What vanishes at
all samples is left out. For Newton's method that is enough: its matrix must be right only where the samples are taken
from, on the solutions.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError

FloatArray = NDArray[np.float64]
Entries = dict[tuple[int, int], Any]

NOTHING = 1e-8
"""Share of the largest entry under which one counts as zero."""
LARGE = 0.1
"""A pivot is at least this share of the largest entry in its column, at every sample, if any is."""


def solved(entries: Mapping[tuple[int, int], Any], right: Sequence[Any], samples: FloatArray) -> dict[int, Any]:
    """Unknowns of as many independent equations as there are; the others are zero, and not among the answer.

    Args:
        entries: (row, column) -> number of any type that has + - * /; what is not named is zero.
        right: one number per row.
        samples: matrices (S, rows, columns) for the choice of pivots, in units that make their entries comparable: an
            entry may be scaled by its row and by its column.

    Returns:
        Unknowns by their columns, r of them where the samples have rank r.

    Errors:
        UsageError: what is left is neither zero at all samples nor has a pivot at all of them.

    Example: three equations of rank two.

    >>> matrix = np.array([[0.0, 2.0], [4.0, 1.0], [4.0, 3.0]])
    >>> entries = {(i, j): matrix[i, j] for i in range(3) for j in range(2) if matrix[i, j]}
    >>> found = solved(entries, [2.0, 9.0, 11.0], matrix[None])
    >>> float(found[0]), float(found[1])
    (2.0, 1.0)
    """
    work = _Work(dict(entries), list(right), np.array(samples, dtype=float))
    while work.choose():
        work.eliminate()
    return work.substituted()


class _Work:
    """The entries that are left, and the same at the samples."""

    def __init__(self, entries: Entries, right: list[Any], samples: FloatArray) -> None:
        self.entries, self.right, self.samples = entries, right, samples
        self.scale = float(np.abs(samples).max(initial=0.0))
        self.order: list[tuple[int, int]] = []
        self.upper: list[Entries] = []
        for place in list(entries):
            self._leave_out(place)

    def _leave_out(self, place: tuple[int, int]) -> None:
        """Leave an entry out that is zero at all samples."""
        values = self.samples[:, place[0], place[1]]
        if np.abs(values).max() <= NOTHING * self.scale:
            self.entries.pop(place, None)
            self.samples[:, place[0], place[1]] = 0.0

    def choose(self) -> bool:
        """The next pivot: the one that fills in least among the large ones; whether there is any."""
        if not self.entries:
            return False
        held = np.zeros(self.samples.shape[1:], dtype=bool)
        held[tuple(np.array(list(self.entries)).T)] = True
        rows, columns = held.sum(axis=1), held.sum(axis=0)
        size = np.abs(self.samples) * held
        with np.errstate(invalid="ignore", divide="ignore"):
            share = np.nan_to_num(size / size.max(axis=1, keepdims=True))
        least = share.min(axis=0)
        places = list(self.entries)
        bound = min(LARGE, max(least[place] for place in places))
        if bound <= NOTHING:
            raise UsageError(
                "no pivot is other than zero at every sample", hint="sample the matrix where it is regular"
            )
        fit = [place for place in places if least[place] >= bound]
        plain = {place: isinstance(self.entries[place], float) for place in fit}
        row, column = min(
            fit, key=lambda at: ((rows[at[0]] - 1) * (columns[at[1]] - 1), not plain[at], -round(least[at], 6), at)
        )
        self.order.append((row, column))
        return True

    def eliminate(self) -> None:
        """Take the pivot's row out, and its column from the other rows."""
        row, column = self.order[-1]
        share, at_samples = 1.0 / self.entries[row, column], self.samples[:, row, column].copy()
        upper = {place: value for place, value in self.entries.items() if place[0] == row}
        lower = [i for i, j in self.entries if j == column and i != row]
        beside = [j for _, j in upper if j != column]
        self.upper.append(upper)
        for i in lower:
            factor = self.entries[i, column] * share
            ratio = self.samples[:, i, column] / at_samples
            self.right[i] = self.right[i] - factor * self.right[row]
            for j in beside:
                self.samples[:, i, j] -= ratio * self.samples[:, row, j]
                self.entries[i, j] = self.entries.get((i, j), 0.0) - factor * upper[row, j]
                self._leave_out((i, j))
            del self.entries[i, column]
            self.samples[:, i, column] = 0.0
        for place in upper:
            del self.entries[place]
        self.samples[:, row, :] = 0.0

    def substituted(self) -> dict[int, Any]:
        """The unknowns, the last pivot's first."""
        found: dict[int, Any] = {}
        for (row, column), upper in zip(reversed(self.order), reversed(self.upper), strict=True):
            value = self.right[row]
            for (_, j), entry in upper.items():
                if j != column and j in found:
                    value = value - entry * found[j]
            found[column] = value * (1.0 / upper[row, column])
        return found
