"""Components of the solutions of an eliminant: its factors over dimensions and inputs, found exactly.

Where the cosine of its angle occurs in even powers alone, 1 - sin^2 put for its square leaves a polynomial in the sine
of half of the degree: with a solution its mirror image is one. Else it is one in the tangent of half the angle. Angles
that are given are rational in tangents of their halves too. What it is a product of are operation modes. A product is
one everywhere, and a factor is irreducible over the field of what is given (Gauss).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import sympy
from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx, fmpz_mod_ctx, fmpz_mod_poly_ctx

from assur.derivation.angle_eliminant import AngleEliminant
from assur.derivation.cycle_types import CycleType, GroupFindings, of_irreducible
from assur.numerics.prime_field import SMALL, PrimeField

MOST = 20_000_000
"""Products of terms that are written out at a time; a larger polynomial is not factored."""
PRIMES = 40
"""Modulo which a factor is looked at."""
FUNCTIONS = {"cos": "cosine", "sin": "sine"}


class _NotWrittenOutError(ArithmeticError):
    """A polynomial that is too long, or has roots in it."""


@dataclass(frozen=True)
class Components:
    """The factors of an eliminant in one function of its angle.

    Attributes:
        unknown: the cosine or the sine, of each of whose values two angles are solutions; None for the tangent of half.
        angle: its name.
        parts: of each factor what is proved of its roots.
        polynomials: of each factor the coefficients, the constant term first; none where angles are given.
    """

    unknown: sympy.Symbol | None
    angle: str
    parts: tuple[GroupFindings, ...]
    polynomials: tuple[tuple[sympy.Expr, ...], ...] = ()

    @property
    def solutions(self) -> int:
        """Of a root."""
        return 1 if self.unknown is None else 2

    @property
    def count(self) -> int:
        """How many solutions there are."""
        return self.solutions * sum(part.degree for part in self.parts)

    @property
    def no_tower(self) -> bool:
        """Whether some roots are in no tower of square roots."""
        return any(part.no_tower for part in self.parts)

    @property
    def total(self) -> str:
        """The sum of degrees times solutions a root, in numbers."""
        own = " + ".join(str(part.degree) for part in self.parts)
        own = f"({own})" if len(self.parts) > 1 and self.solutions > 1 else own
        return f"{own} x {self.solutions}" if self.solutions > 1 else own

    @property
    def sentence(self) -> str:
        """In words."""
        function = "tangent of half the angle"
        if self.unknown is not None:
            function = FUNCTIONS[self.unknown.name.partition("_")[0]]
        degrees = [part.degree for part in self.parts]
        many = f"the product of {len(degrees)} irreducible polynomials" if len(degrees) > 1 else "an irreducible one"
        size = f"of degree {degrees[0]}" if len({*degrees}) == 1 else f"of degrees {', '.join(map(str, degrees))}"
        tower = ", whose groups are no 2-groups: no tower of square roots gives their roots"
        whole = "what is left over" if self.solutions > 1 else f"the polynomial of degree {self.count}"
        two = ", and a sign tells each solution from its mirror image" if self.solutions > 1 else ""
        return (
            f"{whole} is {many} {size} in the {function} of {self.angle}"
            f"{tower if all(part.no_tower for part in self.parts) else ''}{two}: {self.total} = {self.count}"
        )


def components(eliminant: AngleEliminant) -> Components | None:
    """The components; None where they are not written out.

    >>> from assur.derivation.solution import analytic_solution
    >>> from assur.model.registry import load_record
    >>> own = components(analytic_solution(load_record("three_rps"), "direct").eliminant)
    >>> own.total, own.unknown
    ('(4 + 4) x 2', sin_leg2_cylinder)
    """
    cosine, sine = eliminant.direction.unknowns
    try:
        for kept in (sine, cosine, None):
            whole = _WrittenOut(eliminant, kept)
            if factors := whole.factors():
                written = () if whole.circles else tuple(map(whole.coefficients, factors))
                return Components(kept, eliminant.direction.name, tuple(map(whole.findings, factors)), written)
    except _NotWrittenOutError:
        return None
    return None


@dataclass(frozen=True)
class _Scaled:
    """A polynomial over powers of what cosines and sines of angles are divided by."""

    over: Any
    powers: tuple[int, ...]


class _WrittenOut:
    """An eliminant in cosine or sine of its angle, else in the tangent of its half."""

    def __init__(self, eliminant: AngleEliminant, kept: sympy.Symbol | None) -> None:
        self.eliminant, self.kept = eliminant, kept
        self.definitions = (*eliminant.known, *eliminant.entries, *eliminant.steps)
        defined = {own.symbol for own in self.definitions}
        atoms = {part for own in self.definitions for part in own.formula.atoms(sympy.Symbol, sympy.Function)}
        turning = {own for part in atoms if part.is_Function for own in part.atoms(sympy.Symbol)}
        symbols = {own for own in atoms if own.is_Symbol} - defined - turning
        self.own = {*eliminant.direction.unknowns}
        angles = {own.name[4:] for own in symbols if own.name.startswith(("cos_", "sin_"))}
        self.circles = [
            (sympy.Symbol(f"cos_{name}", real=True), sympy.Symbol(f"sin_{name}", real=True)) for name in sorted(angles)
        ]
        self.circles += [(sympy.cos(own), sympy.sin(own)) for own in sorted(turning, key=str)]
        if kept is not None:
            self.circles = [own for own in self.circles if not self.own & {*own}]
        self.plain = sorted(symbols - {part for own in self.circles for part in own}, key=str)
        names = [*map(str, self.plain), *(f"half {own[0]}" for own in self.circles)]
        self.ring = fmpq_mpoly_ctx.get(names, Ordering.lex)
        plain = {own: self._number(self.ring.gen(k)) for k, own in enumerate(self.plain)}
        self.values: dict[sympy.Expr, _Scaled] = plain
        for k, (cosine, sine) in enumerate(self.circles):
            half = self.ring.gen(len(self.plain) + k)
            powers = tuple(int(k == place) for place in range(len(self.circles)))
            self.values |= {cosine: _Scaled(1 - half**2, powers), sine: _Scaled(2 * half, powers)}

    @cached_property
    def _unknown(self) -> int:
        """The place of what the factors are in."""
        if self.kept is not None:
            return self.plain.index(self.kept)
        return len(self.plain) + next(k for k, own in enumerate(self.circles) if self.own & {*own})

    def factors(self) -> list[fmpq_mpoly]:
        """Factors with the unknown in them; none where another function of the angle is left beside it."""
        gone = next((own for own in self.own if own != self.kept), None)
        place = self.plain.index(gone) if self.kept is not None and gone in self.plain else None
        if self.kept is not None and self.kept not in self.plain:
            return []
        for own in self.definitions:
            value = self._value(sympy.sympify(own.formula))
            over = value.over if place is None else self._on_circle(value.over, place)
            self.values[own.symbol] = _Scaled(over, value.powers)
        last = self.values[self.definitions[-1].symbol].over
        if place is not None and last.degrees()[place]:
            return []
        factors = (part for part, power in last.factor()[1] for _ in range(power))
        return [part for part in factors if part.degrees()[self._unknown] and not self._divides_circle(part)]

    def coefficients(self, part: fmpq_mpoly) -> tuple[sympy.Expr, ...]:
        """Of a factor in the unknown, the constant term first."""
        rows: list[list[sympy.Expr]] = [[] for _ in range(int(part.degrees()[self._unknown]) + 1)]
        for powers, factor in part.to_dict().items():
            others = (own ** int(power) for k, (own, power) in enumerate(zip(self.plain, powers, strict=True))
                      if k != self._unknown)  # fmt: skip
            rows[int(powers[self._unknown])].append(sympy.Rational(int(factor.p), int(factor.q)) * sympy.prod(others))
        return tuple(sympy.Add(*row) for row in rows)

    def _divides_circle(self, part: fmpq_mpoly) -> bool:
        """Whether a factor is 1 + t^2, which is no root's."""
        circle = self.ring.gen(self._unknown) ** 2 + 1
        return self.kept is None and bool(part.gcd(circle) != 1)

    def _number(self, own: Any) -> _Scaled:
        return _Scaled(own, (0,) * len(self.circles))

    def _value(self, formula: sympy.Expr) -> _Scaled:
        if formula in self.values:
            return self.values[formula]
        if formula.is_Rational:
            return self._number(self.ring.constant(fmpq(int(formula.p), int(formula.q))))
        if formula.is_Pow and formula.exp.is_Integer and formula.exp > 0:
            parts = [self._value(formula.base)] * int(formula.exp)
        elif formula.is_Add or formula.is_Mul:
            parts = [self._value(part) for part in formula.args]
        else:
            raise _NotWrittenOutError
        return self._sum(parts) if formula.is_Add else self._product(parts)

    def _sum(self, parts: Sequence[_Scaled]) -> _Scaled:
        powers = tuple(map(max, zip(*(part.powers for part in parts), strict=True)))
        total = self.ring.constant(0)
        for part in parts:
            missing = (high - low for high, low in zip(powers, part.powers, strict=True))
            circles = (1 + self.ring.gen(len(self.plain) + k) ** 2 for k in range(len(powers)))
            whole = part.over
            for circle, power in zip(circles, missing, strict=True):
                whole = whole * circle**power
            total = total + whole
        return _Scaled(total, powers)

    def _product(self, parts: Sequence[_Scaled]) -> _Scaled:
        whole, *others = parts
        for part in others:
            if len(whole.over) * len(part.over) > MOST:
                raise _NotWrittenOutError
            powers = tuple(a + b for a, b in zip(whole.powers, part.powers, strict=True))
            whole = _Scaled(whole.over * part.over, powers)
        return whole

    def _on_circle(self, own: fmpq_mpoly, place: int) -> fmpq_mpoly:
        """A polynomial with one function's square written by the other's."""
        circle = 1 - self.ring.gen(self._unknown) ** 2
        parts: dict[int, dict[tuple[int, ...], fmpq]] = {}
        for powers, factor in own.to_dict().items():
            half, left = divmod(int(powers[place]), 2)
            key = (*powers[:place], left, *powers[place + 1 :])
            parts.setdefault(half, {})[key] = factor
        total = self.ring.constant(0)
        for half, part in parts.items():
            total = total + self.ring.from_dict(part) * circle**half
        return total

    def findings(self, part: fmpq_mpoly) -> GroupFindings:
        """What cycle types at drawn dimensions and inputs prove of an irreducible factor."""
        place = self._unknown
        degree, types, random = int(part.degrees()[place]), dict[CycleType, int](), np.random.default_rng(1)
        terms = part.to_dict()
        for _ in range(PRIMES):
            p = PrimeField.drawn(random, SMALL).p
            at = [int(number) for number in random.integers(1, p, len(part.degrees()))]
            at[place] = 1
            row = [0] * (degree + 1)
            for powers, factor in terms.items():
                share = int(factor.p) * pow(int(factor.q), -1, p)
                for base, power in zip(at, powers, strict=True):
                    share = share * pow(base, int(power), p) % p
                row[int(powers[place])] += share
            own = fmpz_mod_poly_ctx(fmpz_mod_ctx(p))(row)
            if own.degree() == degree and own.gcd(own.derivative()).degree() == 0:
                lengths = sorted((int(factor.degree()) for factor, _ in own.factor()[1]), reverse=True)
                types.setdefault(tuple(lengths), p)
        return of_irreducible(degree, types)
