"""Identities of a pair of circles: why conic and eliminant vanish, and the circles are what they are said to be.

With a line x c + y s + d = 0 of the first circle and A c + B s + C = 0 of both, D = x B - y A has D c - M and D s - N
as sums of multiples of both. So M^2 + N^2 - D^2, the conic, is one of these and of the first circle. What line, conic
and last circle say together has multipliers of its own.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import sympy

from assur.derivation.circle_pairs import CirclePair, PairEliminant, Triple
from assur.derivation.elimination import SolvedSet
from assur.derivation.line_and_conic import LineAndConic, line_and_conic
from assur.derivation.linear import Form
from assur.derivation.linear_span import LinearSpan, Multipliers, times, total_of, unit
from assur.derivation.polynomial_identities import CoupledSet, PolynomialIdentities
from assur.derivation.strokes import StrokeVector
from assur.derivation.witness import ModularWitness

CONIC = "q"


def pair_identities(
    part: SolvedSet,
    eliminant: PairEliminant,
    pair: CirclePair,
    loops: LinearSpan,
    vectors: Sequence[StrokeVector],
    witness: ModularWitness,
) -> PolynomialIdentities:
    """The identities of a set of three circles. Errors: NoIdentityError."""
    return _PairSet(part, eliminant, pair, loops, vectors, witness).identities()


class _PairSet(CoupledSet):
    def __init__(
        self,
        part: SolvedSet,
        eliminant: PairEliminant,
        pair: CirclePair,
        loops: LinearSpan,
        vectors: Sequence[StrokeVector],
        witness: ModularWitness,
    ) -> None:
        super().__init__(part, eliminant, loops, vectors, witness)
        self.own, self.pair = eliminant, pair
        self.first, self.last = pair.circles

    @property
    def _lines(self) -> Sequence[Form]:
        return self.pair.lines

    def _at_last(self, form: Triple) -> sympy.Expr:
        cosine, sine = self.last.unknowns
        return form[0] * cosine + form[1] * sine + form[2]

    @cached_property
    def _meeting(self) -> LineAndConic:
        return line_and_conic().at(self.own.last, self.own.conic, self.last.unknowns)

    @cached_property
    def _by_determinant(self) -> tuple[Multipliers, Multipliers]:
        """The determinant times cosine and sine of the first circle, less what is said of these."""
        (x, y, _), (a, b, _) = self.own.first, map(self._at_last, self.own.both)
        return {"l1": b, "l3": -y}, {"l1": -a, "l3": x}

    def _quadric(self) -> Multipliers:
        """Why the conic vanishes."""
        cosine, sine = self.first.unknowns
        under, m, n = map(self._at_last, self.own.across)
        of_cosine, of_sine = self._by_determinant
        (d1, *_), (m1, *_), (n1, *_) = self.own.across
        return total_of(
            {unit(self.first): under**2, unit(self.last): d1**2 - m1**2 - n1**2},
            times(of_cosine, -(under * cosine + m)),
            times(of_sine, -(under * sine + n)),
        )

    def _why(self, place: int) -> Multipliers:
        line, circle, conic = self._meeting.why[place]
        return {"l2": line, unit(self.last): circle, CONIC: conic}

    def _polynomial(self) -> Multipliers:
        return self._why(0)

    def _by_cramer(self) -> dict[sympy.Symbol, Multipliers]:
        under, _, _, det, _, _ = (own.symbol for own in self.own.backward)
        (g1, g2, _), *rest = self.own.across
        last = dict(zip(self.last.unknowns, (self._why(1), self._why(2)), strict=True))
        formulas = {unknown: times(shares, 1 / under) for unknown, shares in last.items()}
        of_cosine, of_sine = last.values()
        for unknown, shares, (m1, m2, _) in zip(self.first.unknowns, self._by_determinant, rest, strict=True):
            whole = total_of(
                times(shares, under), times(of_cosine, m1 - g1 * unknown), times(of_sine, m2 - g2 * unknown)
            )
            formulas[unknown] = times(whole, 1 / det)
        return formulas
