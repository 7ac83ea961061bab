"""Normal forms modulo an ideal over a prime field: how many solutions there are, without a Groebner basis.

Every monomial up to a degree d is a sum of standard ones. At first all are standard but those that lead a polynomial; a
monomial of the next degree that is a multiple of one that is not has the multiple of its form. Where it is one in two
ways, what these differ by vanishes: a standard monomial less. Where every monomial of some degree k <= d is none, the
standard ones of less degree span the quotient; multiplications by the unknowns take these to themselves, and where they
commute, these monomials are a basis of it (B. Mourrain, A new criterion for normal form algorithms, 1999).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations, combinations_with_replacement
from math import comb
from typing import Any

import numpy as np
from flint import nmod_mat
from numpy.typing import NDArray

Monomial = tuple[int, ...]
Rows = NDArray[np.int64]
NUMBERS = 4_000_000
"""Of all normal forms of a degree: they, and what is checked of them, take seconds."""
HALF = 16
"""Bits of half of a residue, of which products are summed exactly in floats."""


def solutions(
    prime: int,
    unknowns: int,
    polynomials: Sequence[Mapping[Monomial, int]],
    numbers: int = NUMBERS,
    *,
    even: bool = False,
) -> int | None:
    """How many solutions polynomials have in the closure of a field, with their multiplicities.

    Args:
        prime: modulo which, below 2^31.
        unknowns: how many there are.
        polynomials: powers of the unknowns -> coefficient.
        numbers: the most of all normal forms of a degree.
        even: the polynomials have even powers alone, and a solution and its negative are counted as one.

    Returns:
        None where no degree with at most so many numbers tells, as where solutions are infinitely many.

    >>> solutions(7, 2, [{(1, 1): 1, (0, 0): 6}, {(2, 0): 1, (0, 1): 6}])
    3
    >>> solutions(7, 2, [{(2, 0): 1, (0, 0): 6}, {(0, 2): 1, (0, 0): 6}], even=True)
    2
    """
    degrees = [max(map(sum, own)) for own in polynomials]
    step = 2 if even else 1
    forms: NormalForms | None = None
    # infinitely many solutions look like many up to any degree
    for degree in range(max(degrees), sum(degrees) - len(degrees) + 3 if len(degrees) >= unknowns else 0, step):
        monomials = comb(unknowns + degree, degree)
        if monomials * (monomials if forms is None else len(forms.standard)) > numbers:
            break
        forms = NormalForms.given(prime, unknowns, degree, polynomials, step) if forms is None else forms.further()
        if (count := forms.solutions) is not None:
            return count
    return None


@dataclass(frozen=True, eq=False)
class NormalForms:
    """Every monomial up to a degree as a sum of standard ones.

    Attributes:
        prime, unknowns: of the field, and how many there are.
        step: degree of the monomials that are multiplied by: 2 where all is even, else 1.
        monomials: all up to the degree, each after those that it is greater than.
        standard: places of those that are standard, in this order.
        forms: (M, S) of each monomial its coefficients of the standard ones.
    """

    prime: int
    unknowns: int
    step: int
    monomials: list[Monomial]
    standard: NDArray[np.intp]
    forms: Rows

    @classmethod
    def given(
        cls, prime: int, unknowns: int, degree: int, polynomials: Sequence[Mapping[Monomial, int]], step: int = 1
    ) -> NormalForms:
        """Those of polynomials up to their highest degree."""
        monomials = [own for k in range(0, degree + 1, step) for own in _of_degree(unknowns, k)]
        count = len(monomials)
        free = cls(prime, unknowns, step, monomials, np.arange(count), np.eye(count, dtype=np.int64))
        rows = np.zeros((len(polynomials), count), dtype=np.int64)
        for row, own in zip(rows, polynomials, strict=True):
            for powers, part in own.items():
                row[free.places[powers]] = part
        return free._under(free._echelon(rows))

    @cached_property
    def places(self) -> dict[Monomial, int]:
        """Monomial -> its place."""
        return {own: k for k, own in enumerate(self.monomials)}

    @cached_property
    def degrees(self) -> NDArray[np.int64]:
        """Of each monomial."""
        return np.array([sum(own) for own in self.monomials])

    @cached_property
    def multiples(self) -> Rows:
        """(F, L) for each factor the places to which it takes the monomials of less than the highest degree."""
        less = self.degrees < self.degrees[-1]
        weights = (1 + self.degrees[-1]) ** np.arange(self.unknowns)  # no two monomials have one sum
        numbers = np.array(self.monomials, dtype=np.int64) @ weights
        factors = np.array(_of_degree(self.unknowns, self.step), dtype=np.int64) @ weights
        order = np.argsort(numbers)
        return np.asarray(order[np.searchsorted(numbers[order], factors[:, None] + numbers[less])])

    @cached_property
    def is_standard(self) -> NDArray[np.bool_]:
        """Of each monomial."""
        own = np.zeros(len(self.monomials), dtype=bool)
        own[self.standard] = True
        return own

    def further(self) -> NormalForms:
        """Those up to the next degree, under all that follows from the polynomials up to there."""
        before, top = len(self.monomials), int(self.degrees[-1])
        monomials = [*self.monomials, *_of_degree(self.unknowns, top + self.step)]
        larger = NormalForms(self.prime, self.unknowns, self.step, monomials, self.standard, self.forms)
        ways = self._ways(larger)
        new = np.array([k for k in range(before, len(monomials)) if k not in ways], dtype=np.intp)
        forms = np.zeros((len(monomials), len(self.standard) + len(new)), dtype=np.int64)
        forms[:before, : len(self.standard)] = self.forms
        forms[new, len(self.standard) + np.arange(len(new))] = 1
        for place, (factor, other) in sorted(ways.items()):  # each after those that its form is a sum of
            used = np.flatnonzero(self.forms[other])
            taken = forms[larger.multiples[factor, self.standard[used]]]
            forms[place] = np.sum(self.forms[other, used, None] * taken % self.prime, axis=0) % self.prime
        whole = NormalForms(
            self.prime, self.unknowns, self.step, monomials, np.concatenate([self.standard, new]), forms
        )
        highest = np.flatnonzero(~self.is_standard & (self.degrees == top))
        return whole._under(whole._differences(highest, self.forms[highest]))

    def _ways(self, larger: NormalForms) -> dict[int, tuple[int, int]]:
        """Place of a monomial of the next degree -> a factor, and a monomial of this degree that is not standard."""
        highest = np.flatnonzero(~self.is_standard & (self.degrees == self.degrees[-1]))
        return {
            int(places[other]): (factor, int(other))
            for factor, places in enumerate(larger.multiples)
            for other in highest
        }

    def _differences(self, places: NDArray[np.intp], forms: Rows) -> Rows:
        """What multiples of monomials differ by from those of their forms; forms have the first standard ones."""
        rows = np.zeros((0, len(self.standard)), dtype=np.int64)
        lower = self.standard[: forms.shape[1]]
        for to in self.multiples if len(self.standard) else ():  # 1 vanishes, and all with it
            own = (self.forms[to[places]] - self._product(forms, self.forms[to[lower]])) % self.prime
            own = (own - self._product(own[:, _last(rows)], rows)) % self.prime
            if np.any(own):
                rows = self._echelon(np.concatenate([rows, own[np.any(own, axis=1)]]))
        return rows

    def _under(self, rows: Rows) -> NormalForms:
        """The same where sums (R, S) in reduced form vanish too, and all that follows from these."""
        own = self
        while len(rows):
            last = _last(rows)
            left = np.setdiff1d(np.arange(rows.shape[1]), last)
            forms = (own.forms[:, left] - own._product(own.forms[:, last], rows[:, left])) % own.prime
            places = own.standard[last]
            own = replace(own, standard=own.standard[left], forms=forms)
            lower = np.sum(own.degrees[own.standard] < own.degrees[-1])
            places = places[own.degrees[places] < own.degrees[-1]]
            rows = own._differences(places, own.forms[places, :lower])
        return own

    @property
    def solutions(self) -> int | None:
        """How many monomials are a basis of the quotient; None where this degree does not show it."""
        standard = self.degrees[self.standard]
        whole = next((k for k in range(0, self.degrees[-1] + 1, self.step) if not np.any(standard == k)), None)
        if whole is None:
            return None
        tables = self.forms[self.multiples[:, self.standard]]  # a factor, a standard monomial, and the form of both
        commute = all(np.array_equal(self._product(a, b), self._product(b, a)) for a, b in combinations(tables, 2))
        return len(standard) if commute else None

    def _echelon(self, rows: Rows) -> Rows:
        """The reduced form of rows, each with 1 at its last place."""
        matrix, rank = nmod_mat(*rows.shape, rows[:, ::-1].ravel().tolist(), self.prime).rref()
        entries: list[Any] = matrix.entries()[: rank * rows.shape[1]]
        return np.array([int(own) for own in entries], dtype=np.int64).reshape(rank, rows.shape[1])[:, ::-1]

    def _product(self, first: Rows, second: Rows) -> Rows:
        """Of matrices of residues, by halves whose products floats sum exactly."""
        low = (1 << HALF) - 1
        a, b = ((own >> HALF, own & low) for own in (first, second))
        (a1, a0), (b1, b0) = ([half.astype(float) for half in own] for own in (a, b))
        high, middle, last = (own.astype(np.int64) % self.prime for own in (a1 @ b1, a1 @ b0 + a0 @ b1, a0 @ b0))
        return np.asarray(((((high << HALF) + middle) % self.prime << HALF) + last) % self.prime)


def _last(rows: Rows) -> NDArray[np.intp]:
    """The last place of each row that is not zero."""
    return np.asarray(rows.shape[1] - 1 - np.argmax(rows[:, ::-1] != 0, axis=1))


def _of_degree(unknowns: int, degree: int) -> list[Monomial]:
    """Monomials, each after those that it is greater than."""
    chosen = combinations_with_replacement(range(unknowns), degree)
    return sorted(tuple(own.count(k) for k in range(unknowns)) for own in chosen)
