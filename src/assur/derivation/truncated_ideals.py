"""Ideals modulo a prime up to some degree, by linear algebra: how many solutions there are, without a Groebner basis.

Where no solution is at infinity their number is the product of the degrees. Else all multiples of the polynomials up to
a degree d are rows of a matrix with a column for each monomial, those of higher degree first. What is of less degree
after elimination is multiplied again until nothing is new. Where every monomial of some degree k <= d leads a row, the
monomials of less degree that lead none span the quotient; multiplications by the unknowns take these to themselves, and
where they commute, these monomials are a basis of it (B. Mourrain, A new criterion for normal form algorithms, 1999).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, combinations_with_replacement
from math import comb, prod
from typing import Any

import numpy as np
from flint import nmod_mat
from numpy.typing import NDArray

Monomial = tuple[int, ...]
Rows = NDArray[np.int64]
COLUMNS = 2_000
"""Monomials of a matrix; its elimination takes seconds."""


def solutions(
    prime: int, unknowns: int, polynomials: Sequence[Mapping[Monomial, int]], columns: int = COLUMNS
) -> int | None:
    """How many solutions polynomials have in the closure of a field, with their multiplicities.

    Args:
        prime: modulo which.
        unknowns: how many there are.
        polynomials: powers of the unknowns -> coefficient.
        columns: the most monomials of a matrix.

    Returns:
        None where no degree with at most so many monomials tells, as where solutions are infinitely many.

    >>> solutions(7, 2, [{(1, 1): 1, (0, 0): 6}, {(2, 0): 1, (0, 1): 6}])
    3
    """
    if (count := _all_finite(prime, unknowns, polynomials, columns)) is not None:
        return count
    degrees = [max(map(sum, own)) for own in polynomials]
    before: _Truncated | None = None
    # infinitely many solutions look like many up to any degree
    for degree in range(max(degrees), sum(degrees) - len(degrees) + 3 if len(degrees) >= unknowns else 0):
        if comb(unknowns + degree, unknowns) > columns:
            break
        before = _Truncated(prime, unknowns, degree, polynomials, before)
        if (count := before.solutions()) is not None:
            return count
    return None


def _all_finite(prime: int, unknowns: int, polynomials: Sequence[Mapping[Monomial, int]], columns: int) -> int | None:
    """The product of the degrees where no solution is at infinity: there the highest parts have zero alone in common.

    They have it where their multiples are all forms of the degree of F. S. Macaulay (1902), one more than the sum of
    their degrees less one each.
    """
    degrees = [max(map(sum, own)) for own in polynomials]
    whole = sum(degrees) - len(degrees) + 1
    if len(degrees) != unknowns or comb(unknowns - 1 + whole, whole) > columns:
        return None
    places = {own: k for k, own in enumerate(_of_degree(unknowns, whole))}
    rows = []
    for own, degree in zip(polynomials, degrees, strict=True):
        for factor in _of_degree(unknowns, whole - degree):
            row = [0] * len(places)
            for powers, part in own.items():
                if sum(powers) == degree:
                    row[places[tuple(a + b for a, b in zip(powers, factor, strict=True))]] = part
            rows.append(row)
    matrix = nmod_mat(rows, prime)
    return prod(degrees) if matrix.rank() == len(places) else None


@dataclass(frozen=True, eq=False)
class _Truncated:
    """What is known of an ideal up to a degree."""

    prime: int
    unknowns: int
    degree: int
    polynomials: Sequence[Mapping[Monomial, int]]
    before: _Truncated | None = None

    @cached_property
    def monomials(self) -> list[Monomial]:
        """Columns, those of higher degree first."""
        return [own for degree in range(self.degree, -1, -1) for own in _of_degree(self.unknowns, degree)]

    @cached_property
    def places(self) -> dict[Monomial, int]:
        """Monomial -> its column."""
        return {own: k for k, own in enumerate(self.monomials)}

    @cached_property
    def degrees(self) -> NDArray[np.int64]:
        """Of each column."""
        return np.array([sum(own) for own in self.monomials])

    @cached_property
    def products(self) -> list[NDArray[np.int64]]:
        """For each unknown the columns to which it takes those of less than the highest degree."""
        less = [own for own in self.monomials if sum(own) < self.degree]
        return [np.array([self.places[_times(own, k)] for own in less]) for k in range(self.unknowns)]

    def multiples(self, rows: Rows) -> Rows:
        """Of rows of less than the highest degree by each unknown."""
        first = len(self.monomials) - len(self.products[0])
        whole = np.zeros((self.unknowns, *rows.shape), dtype=np.int64)
        for own, places in zip(whole, self.products, strict=True):
            own[:, places] = rows[:, first:]
        return whole.reshape(-1, rows.shape[1])

    @cached_property
    def rows(self) -> Rows:
        """The reduced echelon form of all that is known."""
        # leading monomials of rows whose multiples are there
        multiplied = np.zeros(len(self.monomials), dtype=bool)
        if self.before is None:
            rows = self._reduced(self._given())
        else:
            known = self.before.rows
            rows = np.pad(known, ((0, 0), (len(self.monomials) - known.shape[1], 0)))
            leading = np.argmax(rows != 0, axis=1)
            multiplied[leading] = self.degrees[leading] < self.degree - 1
        while True:
            leading = np.argmax(rows != 0, axis=1)
            new = (self.degrees[leading] < self.degree) & ~multiplied[leading]
            if not np.any(new):
                return rows
            multiplied[leading[new]] = True
            rows = self._reduced(np.concatenate([rows, self.multiples(rows[new])]))

    def _given(self) -> Rows:
        rows = np.zeros((len(self.polynomials), len(self.monomials)), dtype=np.int64)
        for row, own in zip(rows, self.polynomials, strict=True):
            for powers, part in own.items():
                row[self.places[powers]] = part
        return rows

    def solutions(self) -> int | None:
        """How many monomials are a basis of the quotient; None where this degree does not show it."""
        leading = np.argmax(self.rows != 0, axis=1)
        leads = np.zeros(len(self.monomials), dtype=bool)
        leads[leading] = True
        whole = next((k for k in range(self.degree + 1) if np.all(leads[self.degrees == k])), None)
        if whole is None:
            return None
        basis = np.flatnonzero(~leads & (self.degrees < whole))
        forms = dict(zip(leading.tolist(), (-self.rows[:, basis] % self.prime).tolist(), strict=True))
        forms |= {int(k): [int(k == other) for other in basis] for k in basis}
        images = [[forms[self.places[_times(self.monomials[k], x)]] for k in basis] for x in range(self.unknowns)]
        tables = [nmod_mat(own, self.prime) for own in images] if len(basis) else []
        return len(basis) if all(one * other == other * one for one, other in combinations(tables, 2)) else None

    def _reduced(self, rows: Rows) -> Rows:
        matrix, rank = nmod_mat(*rows.shape, rows.ravel().tolist(), self.prime).rref()
        entries: list[Any] = matrix.entries()[: rank * rows.shape[1]]
        return np.array([int(own) for own in entries], dtype=np.int64).reshape(rank, rows.shape[1])


def _of_degree(unknowns: int, degree: int) -> list[Monomial]:
    return [
        tuple(chosen.count(k) for k in range(unknowns))
        for chosen in combinations_with_replacement(range(unknowns), degree)
    ]


def _times(monomial: Monomial, place: int) -> Monomial:
    return (*monomial[:place], monomial[place] + 1, *monomial[place + 1 :])
