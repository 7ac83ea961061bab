"""Identities of a coupled set: its lines, its polynomial, and what follows of a root, as sums of multiples.

All of them hold modulo the circle that is taken as known. The determinant times an unknown of Cramer's rule, less what
that says, is a sum of lines by cofactors; so the quadric at these values, times the determinant's square, is the
quadric less multiples of lines. Nothing is divided by the determinant there: the polynomial vanishes at every solution.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import sympy

from assur.derivation.angle_eliminant import AngleEliminant
from assur.derivation.elimination import SolvedSet
from assur.derivation.identities import SetIdentities, stroke_identities
from assur.derivation.linear import ONE, Form, form_of, value_of
from assur.derivation.linear_span import ZERO, LinearSpan, Multipliers, NoIdentityError, times, total_of, unit
from assur.derivation.reduced_quadrics import product_symbol, reduced_quadric
from assur.derivation.strokes import StrokeVector
from assur.derivation.trigonometric import trigonometric_terms
from assur.derivation.unknown_directions import UnknownDirection
from assur.derivation.witness import ModularWitness


@dataclass(frozen=True)
class PolynomialIdentities(SetIdentities):
    """Of a coupled set also why its quadric and its polynomial vanish.

    Attributes:
        quadric: in linear equations and quadrics of directions; {} where none is left.
        polynomial: in lines and the quadric, `q`.
    """

    quadric: Multipliers
    polynomial: Multipliers


def polynomial_identities(
    part: SolvedSet,
    eliminant: AngleEliminant,
    loops: LinearSpan,
    vectors: Sequence[StrokeVector],
    witness: ModularWitness,
) -> PolynomialIdentities:
    """The identities of a set that a polynomial solves. Errors: NoIdentityError."""
    return CoupledSet(part, eliminant, loops, vectors, witness).identities()


class CoupledSet:
    """A set that one polynomial solves, and its identities."""

    def __init__(
        self,
        part: SolvedSet,
        eliminant: AngleEliminant,
        loops: LinearSpan,
        vectors: Sequence[StrokeVector],
        witness: ModularWitness,
    ) -> None:
        self.part, self.eliminant, self.loops, self.witness = part, eliminant, loops, witness
        self.base, *self.others = part.directions
        self.vectors = [vector for vector in vectors if vector.direction in part.directions]
        formulas = {own.symbol: own.formula for own in part.definitions}
        self.unknowns = [unknown for direction in self.others for unknown in direction.unknowns]
        self.values: dict[sympy.Symbol, Form] = {
            unknown: {unknown: ONE}
            if unknown in eliminant.unknowns
            else form_of(formulas[unknown], eliminant.unknowns, witness)
            for unknown in self.unknowns
        }
        rows = {f"e{k}": form for k, form in enumerate(part.equations, start=1)}
        turning = {*self.base.unknowns}
        if any(share.free_symbols & turning for form in rows.values() for share in form.values()):
            self.linear = self.unknowns
            rows = {name: form_of(value_of(form), self.linear, witness) for name, form in rows.items()}
        else:
            self.linear = [*self.base.unknowns, *self.unknowns]
        self.given = LinearSpan(rows, self.linear, witness)
        self.following = {unknown: self._following(unknown) for unknown in self.unknowns}
        self.keys: dict[tuple[sympy.Expr, int, int], sympy.Symbol] = {}
        self.quadrics = {unit(own): self._reduced(own) for own in self.others if own.kind != "stroke"}

    def identities(self) -> PolynomialIdentities:
        """All of them."""
        flat = {name: self._flat(form) for name, form in self.quadrics.items()}
        targets = [self._flat(form) for form in (*self._lines, self.eliminant.quadric)]
        span = LinearSpan(flat, [*self.keys.values()], self.witness)
        *lines, quadric = (self._curved(span, form, target) for form, target in self._pairs(targets))
        formulas: dict[sympy.Symbol, Multipliers] = {}
        for vector in self.vectors:
            formulas |= stroke_identities(self.part, vector, self.witness)
        formulas |= self.following | self._by_cramer()
        equations = tuple(self.loops.multipliers(form) for form in self.part.equations)
        return PolynomialIdentities(equations, tuple(lines), formulas, quadric or self._quadric(), self._polynomial())

    def _quadric(self) -> Multipliers:
        """Of a quadric that is none of the quadrics of directions."""
        return {}

    def _pairs(self, targets: Sequence[Form]) -> Iterator[tuple[Form, Form]]:
        return zip((*self._lines, self.eliminant.quadric), targets, strict=True)

    @property
    def _lines(self) -> Sequence[Form]:
        """The lines with coefficients written out."""
        return self.part.lines

    def _following(self, unknown: sympy.Symbol) -> Multipliers:
        """What an unknown is less its form, of linear equations."""
        if unknown in self.eliminant.unknowns:
            return {}
        gap = unknown - value_of(self.values[unknown])
        return self.given.multipliers(form_of(gap, self.linear, self.witness))

    def _reduced(self, direction: UnknownDirection) -> Form:
        return reduced_quadric(direction, self.values, self.base, self.eliminant.unknowns, self.witness)

    def _flat(self, form: Form) -> Form:
        """A symbol for each product of unknowns with powers of the circle's cosine and sine."""
        flat: Form = {}
        for key, share in form.items():
            for (i, j), factor in trigonometric_terms(share, self.base.unknowns, self.witness).items():
                flat[self.keys.setdefault((key, i, j), sympy.Symbol(f"{key} {i} {j}"))] = factor
        return flat

    def _curved(self, span: LinearSpan, form: Form, target: Form) -> Multipliers:
        """A line, or the quadric, of the quadrics of directions, where these hold at the values of linear equations."""
        if not form:
            return {}
        try:
            shares = span.multipliers(target)
        except NoIdentityError:
            return self.given.multipliers(form_of(value_of(form), self.linear, self.witness))
        parts = [shares]
        for direction in self.others:
            share = shares.get(unit(direction), ZERO)
            if share != 0:
                both = ((own, own + value_of(self.values[own])) for own in direction.unknowns)
                parts += [times(self.following[own], -share * total) for own, total in both]
        return total_of(*parts)

    def _rows(self) -> sympy.Matrix:
        keys = (*self.eliminant.unknowns, ONE)
        return sympy.Matrix([[line.get(key, ZERO) for key in keys] for line in self.part.lines])

    def _cramer(self) -> Iterator[tuple[sympy.Symbol, Multipliers]]:
        """The determinant times an unknown, less what Cramer's rule says, of lines."""
        count = len(self.eliminant.unknowns)
        adjugate = self._rows()[:count, :count].adjugate()
        for k, unknown in enumerate(self.eliminant.unknowns):
            yield unknown, {f"l{j + 1}": adjugate[k, j] for j in range(count)}

    def _by_cramer(self) -> dict[sympy.Symbol, Multipliers]:
        determinant = self.eliminant.steps[0].symbol
        return {unknown: times(shares, 1 / determinant) for unknown, shares in self._cramer()}

    def _polynomial(self) -> Multipliers:
        unknowns, steps, quadric = self.eliminant.unknowns, self.eliminant.steps, self.eliminant.quadric
        if not quadric:
            rows, last = self._rows(), len(unknowns)
            return {f"l{j + 1}": rows.cofactor(j, last) for j in range(last + 1)}
        if not unknowns:
            return {"q": ONE}
        one, over = steps[0].symbol, {own: steps[k].symbol for k, own in enumerate(unknowns, start=1)}
        factors = {own: one * quadric.get(own, ZERO) for own in unknowns}
        for k, a in enumerate(unknowns):
            for b in unknowns[k:]:
                share = quadric.get(product_symbol(a, b), ZERO)
                factors[b] += share * one * a
                factors[a] += share * over[b]
        return total_of({"q": one**2}, *(times(shares, -factors[own]) for own, shares in self._cramer()))
