"""Quotients of polynomials whose numerator and denominator share no factor: by python-flint, in SymPy's formulas.

What is no symbol counts as one: the cosine of an angle, the root of 3, of which higher powers are written out.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property, reduce
from typing import Any

import sympy
from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx

from assur.derivation.patience import check_patience

Fraction = tuple[fmpq_mpoly, fmpq_mpoly]


def cancelled(formula: sympy.Expr) -> sympy.Expr:
    """A formula over one denominator, without the factors that both share.

    >>> x, y = sympy.symbols("x y")
    >>> cancelled(x / (x * y + x**2) + y / (x + y))
    (y + 1)/(x + y)
    >>> cancelled((x * sympy.cos(y) ** 2 + x * sympy.sin(y) ** 2) / sympy.sin(y))
    x/sin(y)
    >>> cancelled(sympy.sqrt(3) * x / (2 * sympy.sqrt(3)) + sympy.sqrt(3) ** 3)
    x/2 + 3*sqrt(3)
    """
    field = RationalFunctions.of([formula])
    return field.formula(field.fraction(formula))


def primitive(formulas: Sequence[sympy.Expr]) -> list[sympy.Expr]:
    """Formulas times their denominators, without the factor that all of them share.

    >>> a, y = sympy.symbols("a y")
    >>> primitive([2 * a / y, a])
    [2, y]
    >>> primitive([a * y + sympy.sqrt(3) * y**2, a**2 - 3 * y**2])
    [y, a - sqrt(3)*y]
    """
    field = RationalFunctions.of(formulas)
    fractions = [field.fraction(formula) for formula in formulas]
    scale = reduce(_common_multiple, (under for _, under in fractions))
    whole = [field.reduced(over * (scale / under)) for over, under in fractions]
    shared = reduce(lambda a, b: a.gcd(b), whole)
    parts = field.without_shared([part / shared for part in whole]) if shared != 0 else whole
    factor = _content(coefficient for part in parts for coefficient in part.coeffs())
    return [field.polynomial(part / factor) for part in parts]


def _common_multiple(a: fmpq_mpoly, b: fmpq_mpoly) -> fmpq_mpoly:
    return a * (b / a.gcd(b))


def _content(coefficients: Iterable[fmpq]) -> fmpq:
    """The largest rational of which all are whole multiples; 1 of none."""
    over, under = 0, 1
    for own in coefficients:
        over, under = int(sympy.igcd(over, int(own.p))), int(sympy.ilcm(under, int(own.q)))
    return fmpq(over, under) if over else fmpq(1)


@dataclass(frozen=True, eq=False)
class RationalFunctions:
    """Quotients of polynomials in some formulas that count as symbols."""

    generators: tuple[sympy.Expr, ...]
    ring: Any

    @staticmethod
    def of(formulas: Iterable[sympy.Expr]) -> RationalFunctions:
        """The smallest one that has these."""
        generators = sorted({own for formula in formulas for own in _generators(sympy.sympify(formula))}, key=str)
        names = tuple(f"g{k}" for k in range(len(generators))) or ("g0",)
        return RationalFunctions(tuple(generators), fmpq_mpoly_ctx.get(names, Ordering.lex))

    def fraction(self, formula: sympy.Expr) -> Fraction:
        """Numerator and denominator, without the factors that both share."""
        over, under = self._worked_out(sympy.sympify(formula))
        return self._lowest(over, under)

    def formula(self, fraction: Fraction) -> sympy.Expr:
        """A fraction as a formula."""
        over, under = fraction
        if under.is_constant():
            return self.polynomial(over / under.coeffs()[0])
        factor = _content(under.coeffs()) * (-1 if under.leading_coefficient() < 0 else 1)
        over, under = over / factor, under / factor
        outer = _content(over.coeffs())
        over, under = over * int(outer.q), under * int(outer.q)
        return self.polynomial(over) / self.polynomial(under)

    def polynomial(self, own: fmpq_mpoly) -> sympy.Expr:
        """A polynomial as a formula."""
        terms = []
        for powers, factor in own.to_dict().items():
            parts = [
                generator ** int(power) for generator, power in zip(self.generators, powers, strict=False) if power
            ]
            terms.append(sympy.Mul(sympy.Rational(int(factor.p), int(factor.q)), *parts))
        return sympy.Add(*terms)

    def reduced(self, own: fmpq_mpoly) -> fmpq_mpoly:
        """A polynomial with squares of roots of numbers written out, and of sines or cosines where it is shorter so."""
        check_patience()
        for sine, cosine in self._angles:
            other = self._without_square(own, sine, cosine), self._without_square(own, cosine, sine)
            own = min(own, *other, key=len)
        for k, generator in enumerate(self.generators):
            if generator.is_Pow and generator.base.is_Rational and own.degrees()[k] > 1:
                square = fmpq(int(generator.base.p), int(generator.base.q))
                terms: dict[tuple[int, ...], fmpq] = {}
                for powers, factor in own.to_dict().items():
                    count, left = divmod(int(powers[k]), 2)
                    key = (*powers[:k], left, *powers[k + 1 :])
                    terms[key] = terms.get(key, fmpq(0)) + factor * square**count
                own = self.ring.from_dict(terms)
        return own

    @cached_property
    def _angles(self) -> list[tuple[int, int]]:
        """Places of the sine and the cosine of each angle that both are there of."""
        places = {generator: k for k, generator in enumerate(self.generators)}
        pairs = ((k, places.get(sympy.cos(own.args[0]))) for own, k in places.items() if isinstance(own, sympy.sin))
        return [(sine, cosine) for sine, cosine in pairs if cosine is not None]

    def _without_square(self, own: fmpq_mpoly, sine: int, cosine: int) -> fmpq_mpoly:
        """A polynomial modulo cos^2 + sin^2 = 1, the first of the two to the power of 1 at most."""
        square = self.ring.constant(1) - self.ring.gen(cosine) ** 2
        parts: dict[int, dict[tuple[int, ...], fmpq]] = {}
        for powers, factor in own.to_dict().items():
            count, left = divmod(int(powers[sine]), 2)
            parts.setdefault(count, {})[(*powers[:sine], left, *powers[sine + 1 :])] = factor
        return sum((self.ring.from_dict(part) * square**count for count, part in parts.items()), self.ring.constant(0))

    def without_shared(self, parts: Sequence[fmpq_mpoly]) -> list[fmpq_mpoly]:
        """Polynomials without factors with roots of numbers in them that all share, as a short one of them shows."""
        left = [*parts]
        short = min((part for part in left if self._roots(part)), key=len, default=None)
        for factor, _ in short.factor()[1] if short is not None else ():
            while self._roots(factor) and not self._is_number(factor):
                shorter = [self._divided(part, factor) for part in left]
                if any(part is None for part in shorter):
                    break
                left = [part for part in shorter if part is not None]
        return left

    def _roots(self, own: fmpq_mpoly) -> list[int]:
        """Places of the roots of numbers that occur in a polynomial."""
        powers = own.degrees()
        places = (k for k, generator in enumerate(self.generators) if powers[k])
        return [k for k in places if self.generators[k].is_Pow and self.generators[k].base.is_Rational]

    def _is_number(self, own: fmpq_mpoly) -> bool:
        return sum(map(bool, own.degrees())) == len(self._roots(own))

    def _divided(self, own: fmpq_mpoly, factor: fmpq_mpoly) -> fmpq_mpoly | None:
        """A polynomial over another, where that divides it: both times the conjugates, which have no roots below."""
        over, under = own, factor
        while roots := self._roots(under):
            place = roots[0]
            terms = {powers: part * (-1) ** int(powers[place]) for powers, part in under.to_dict().items()}
            other = self.ring.from_dict(terms)
            over, under = self.reduced(over * other), self.reduced(under * other)
        return over / under if over.gcd(under) * under.leading_coefficient() == under else None

    def _lowest(self, over: fmpq_mpoly, under: fmpq_mpoly) -> Fraction:
        over, under = self.reduced(over), self.reduced(under)
        shared = over.gcd(under)
        return over / shared, under / shared

    def _worked_out(self, formula: sympy.Expr) -> Fraction:
        one = self.ring.constant(1)
        if formula in self.generators:
            return self.ring.gen(self.generators.index(formula)), one
        if formula.is_Rational:
            return self.ring.constant(fmpq(int(formula.p), int(formula.q))), one
        if formula.is_Add:
            over, under = self.ring.constant(0), one
            for part in formula.args:
                a, b = self._worked_out(part)
                if b == under:
                    over = over + a
                else:
                    shared = b.gcd(under)
                    over, under = over * (b / shared) + a * (under / shared), under * (b / shared)
            return over, under
        if formula.is_Mul:
            over, under = one, one
            for part in formula.args:
                a, b = self._worked_out(part)
                over, under = over * a, under * b
            return self._lowest(over, under)
        base, power = (sympy.sqrt(formula.base), 2 * formula.exp) if formula.exp.q == 2 else formula.as_base_exp()
        over, under = self._worked_out(base)
        if power < 0:
            over, under = under, over
        return over ** abs(int(power)), under ** abs(int(power))


def _generators(formula: sympy.Expr) -> set[sympy.Expr]:
    if formula.is_Rational:
        return set()
    if formula.is_Pow and formula.exp.is_Rational:
        if formula.exp.q == 1:
            return _generators(formula.base)
        return {sympy.sqrt(formula.base)} if formula.exp.q == 2 else {formula}
    if formula.is_Add or formula.is_Mul:
        return {own for part in formula.args for own in _generators(part)}
    return {formula}
