"""A witness: values of all symbols modulo a large prime, at which formulas are told from zero.

A formula that vanishes there is an identity, but for a probability of its degree over 2^160. Dimensions and inputs are
drawn; what is derived of them has a value by its formula. Where a radicand has no root, all is drawn anew.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from typing import Any

import mpmath
import numpy as np
import sympy

from assur.numerics.prime_field import LARGE, ORDER, PrimeField, below, multiple

Element = tuple[int, int]
"""An element of F_p(i): real and imaginary part."""
FINEST = 360 * 10**12
"""Shares of a turn that angles are counted in that are no root of unity of the field, as those of drawn directions: one
unit for all, so that sums of decimals stay what they are."""
PRIMES = 64
"""Primes that are tried for roots of numbers; of k roots one prime in 2^k has them all."""
TRIES = 200
"""Draws after which a root is taken not to exist; of k roots of roots one draw in 2^k has them all."""


DIGITS = 30
"""Of what is at home."""


class NoResidueRootError(ArithmeticError):
    """A radicand that has no root at what was drawn."""


class ModularWitness:
    """Values of symbols in F_p(i), for a prime between a bound and twice it.

    >>> x, y = sympy.symbols("x y")
    >>> ModularWitness(1).is_zero((x + y) ** 2 - x**2 - 2 * x * y - y**2)
    True
    """

    def __init__(self, seed: int = 0, least: int = LARGE) -> None:
        self._random, self._least = np.random.default_rng(seed), least
        self.field = PrimeField.drawn(self._random, least)
        self._circles: list[tuple[sympy.Symbol, sympy.Symbol]] = []
        self._definitions: list[tuple[Sequence[sympy.Symbol], Callable[[], Sequence[Element]]]] = []
        self._values: dict[Any, Element] = {}
        self.home: dict[sympy.Symbol, float] = {}
        """What symbols are at home, where that is known."""
        self.sizes: tuple[sympy.Expr, ...] = ()
        """Sums of squares of dimensions that are the square of an axis' length."""
        self.dimensions: frozenset[sympy.Symbol] = frozenset()

    def with_roots(self, radicands: Sequence[Fraction]) -> None:
        """Another prime, if need be, modulo which these numbers have roots; before anything has a value."""
        for _ in range(PRIMES):
            p = self.field.p
            if all(pow(own.numerator * own.denominator, (p - 1) // 2, p) == 1 for own in radicands):
                return
            self.field = PrimeField.drawn(self._random, self._least)

    @property
    def circles(self) -> tuple[tuple[sympy.Symbol, sympy.Symbol], ...]:
        """Cosine and sine of each angle that has a value."""
        return tuple(self._circles)

    def on_circle(self, cosine: sympy.Symbol, sine: sympy.Symbol) -> None:
        """Two symbols are cosine and sine of one angle."""
        self._circles.append((cosine, sine))
        self._draw_circle(cosine, sine)

    def on_sphere(self, symbols: Sequence[sympy.Symbol]) -> None:
        """The squares of some symbols add up to 1."""
        self.drawn(symbols, lambda: self._on_sphere(len(symbols)))

    def define(self, symbol: sympy.Symbol, formula: sympy.Expr) -> None:
        """A symbol stands for a formula of symbols that have a value."""
        self.drawn((symbol,), lambda: (self.value(formula),))

    def drawn(self, symbols: Sequence[sympy.Symbol], values: Callable[[], Sequence[Element]]) -> None:
        """What a function works out of values that are known. It may raise NoResidueRootError: all is drawn anew."""
        self._definitions.append((symbols, values))
        if any(symbol in self._values for symbol in symbols):
            self._values = {key: own for key, own in self._values.items() if not key.has(*symbols)}
        try:
            self._values |= dict(zip(symbols, values(), strict=True))
        except NoResidueRootError:
            self.draw_again()

    def is_zero(self, formula: Any) -> bool:
        """Whether a formula vanishes identically."""
        return self.value(sympy.sympify(formula)) == (0, 0)

    def vanishes(self, a: Any, b: Any, c: Any, d: Any) -> bool:
        """Whether a b - c d vanishes identically."""
        first, second = (self._times(self.value(x), self.value(y)) for x, y in ((a, b), (c, d)))
        return self._minus(first, second) == (0, 0)

    def value(self, formula: sympy.Expr) -> Element:
        """The value of a formula. Errors: NoResidueRootError."""
        if formula not in self._values:
            self._values[formula] = self._worked_out(formula)
        return self._values[formula]

    def at_home(self, formula: Any) -> float:
        """The value of a formula at home; not a number where it divides by what vanishes there."""
        with mpmath.workdps(DIGITS):
            try:
                number = _number(sympy.sympify(formula), dict(self.home))
            except ZeroDivisionError:
                return math.nan
            return float(number)

    def rank(self, rows: list[list[sympy.Expr]]) -> int:
        """The rank of a matrix of formulas."""
        left = [[self.value(entry) for entry in row] for row in rows]
        count = 0
        for column in range(len(left[0]) if left else 0):
            pivot = next((row for row in left[count:] if row[column] != (0, 0)), None)
            if pivot is None:
                continue
            left.remove(pivot)
            left.insert(count, pivot)
            factor = self._inverse(pivot[column])
            for k in range(count + 1, len(left)):
                share = self._times(left[k][column], factor)
                if share != (0, 0):
                    left[k] = [self._minus(a, self._times(share, b)) for a, b in zip(left[k], pivot, strict=True)]
            count += 1
        return count

    def draw_again(self) -> None:
        """Other values of everything. Errors: NoResidueRootError, where too few draws have all roots."""
        for _ in range(TRIES):
            self._values = {}
            for cosine, sine in self._circles:
                self._draw_circle(cosine, sine)
            try:
                for symbols, values in self._definitions:
                    self._values |= dict(zip(symbols, values(), strict=True))
            except NoResidueRootError:
                continue
            return
        raise NoResidueRootError("no draw at which every radicand has a root")

    def _draw_circle(self, cosine: sympy.Symbol, sine: sympy.Symbol) -> None:
        p, t = self.field.p, below(self._random, 1, self.field.p)
        size = pow(1 + t * t, -1, p)
        self._values[cosine], self._values[sine] = ((1 - t * t) * size % p, 0), (2 * t * size % p, 0)

    def _on_sphere(self, count: int) -> list[Element]:
        """Seen from a pole: (1 - u^2, 2 u) / (1 + u^2)."""
        p = self.field.p
        seen = [below(self._random, 1, p) for _ in range(count - 1)]
        square = sum(own * own for own in seen) % p
        size = pow(1 + square, -1, p)
        return [((1 - square) * size % p, 0), *((2 * own * size % p, 0) for own in seen)]

    def _worked_out(self, formula: sympy.Expr) -> Element:
        p = self.field.p
        if formula.is_Rational:
            return self.field.residue(Fraction(int(formula.p), int(formula.q))), 0
        if formula.is_Symbol:
            return below(self._random, 1, p), 0
        if formula.is_Add:
            parts = list(self._parts(formula))
            return sum(a for a, _ in parts) % p, sum(b for _, b in parts) % p
        if formula.is_Mul:
            result = 1, 0
            for part in self._parts(formula):
                result = self._times(result, part)
            return result
        if formula.is_Pow:
            return self._power(formula.base, sympy.Rational(formula.exp))
        if isinstance(formula, (sympy.cos, sympy.sin)):
            return self._circle(formula.args[0])[isinstance(formula, sympy.sin)]
        raise TypeError(f"no value of {formula}")

    def _parts(self, formula: sympy.Expr) -> Iterator[Element]:
        return (self.value(part) for part in formula.args)

    def _power(self, base: sympy.Expr, exponent: sympy.Rational) -> Element:
        own = self._root(base) if exponent.q == 2 else self.value(base)
        if exponent.p < 0:
            own = self._inverse(own)
        result = 1, 0
        for _ in range(abs(int(exponent.p))):
            result = self._times(result, own)
        return result

    def _root(self, radicand: sympy.Expr) -> Element:
        key = sympy.Function("root")(radicand)
        if key not in self._values:
            self._values[key] = (
                self.field.root(Fraction(int(radicand.p), int(radicand.q)))
                if radicand.is_Rational
                else self._root_of(*self.value(radicand))
            )
        return self._values[key]

    def _root_of(self, a: int, b: int) -> Element:
        p = self.field.p
        if b == 0:
            root = pow(a, (p + 1) // 4, p)
            return (root, 0) if root * root % p == a else (0, root)
        norm = (a * a + b * b) % p
        size = pow(norm, (p + 1) // 4, p)
        if size * size % p != norm:
            raise NoResidueRootError("a radicand without a root")
        half = pow(2, -1, p)
        for square in ((a + size) * half % p, (a - size) * half % p):
            real = pow(square, (p + 1) // 4, p)
            if real and real * real % p == square:
                return real, b * half * pow(real, -1, p) % p
        raise NoResidueRootError("a radicand without a root")

    def _circle(self, angle: sympy.Expr) -> tuple[Element, Element]:
        """Cosine and sine of a sum of multiples of angles."""
        cosine, sine = (1, 0), (0, 0)
        for part, factor in angle.as_coefficients_dict().items():
            own = self._angle(part, sympy.Rational(factor))
            cosine, sine = (
                self._minus(self._times(cosine, own[0]), self._times(sine, own[1])),
                self._plus(self._times(sine, own[0]), self._times(cosine, own[1])),
            )
        return cosine, sine

    def _angle(self, angle: sympy.Expr, factor: sympy.Rational) -> tuple[Element, Element]:
        """Of a multiple of an angle; of a number of turns that are no root of unity of the field, as of an angle."""
        count, share = int(factor.p), angle * sympy.Rational(1, factor.q)  # the angle whose whole multiple is meant
        if angle == sympy.pi:
            turns = Fraction(int(factor.p), 2 * int(factor.q))
            if ORDER % turns.denominator == 0:
                real, imaginary = self.field.cosine_and_sine(turns)
                return (real, 0), (imaginary, 0)
            unit = Fraction(1, FINEST if FINEST % turns.denominator == 0 else turns.denominator)
            count, share = int(turns / unit), 2 * sympy.pi * sympy.Rational(unit.numerator, unit.denominator)
        symbols = sympy.Function("circle_cos")(share), sympy.Function("circle_sin")(share)
        if symbols[0] not in self._values:
            self._draw_circle(*symbols)
        own = self._values[symbols[0]][0], self._values[symbols[1]][0]
        cosine, sine = multiple(own, abs(count), self.field.p)
        return (cosine, 0), (sine if count > 0 else -sine % self.field.p, 0)

    def _times(self, a: Element, b: Element) -> Element:
        p = self.field.p
        return (a[0] * b[0] - a[1] * b[1]) % p, (a[0] * b[1] + a[1] * b[0]) % p

    def _plus(self, a: Element, b: Element) -> Element:
        return (a[0] + b[0]) % self.field.p, (a[1] + b[1]) % self.field.p

    def _minus(self, a: Element, b: Element) -> Element:
        return (a[0] - b[0]) % self.field.p, (a[1] - b[1]) % self.field.p

    def _inverse(self, a: Element) -> Element:
        size = pow(a[0] * a[0] + a[1] * a[1], -1, self.field.p)
        return a[0] * size % self.field.p, -a[1] * size % self.field.p


def _number(formula: sympy.Expr, known: dict[sympy.Expr, Any]) -> Any:
    """The value of a formula by those of its symbols; each part that it has several times once."""
    if formula not in known:
        parts = [_number(part, known) for part in formula.args]
        if formula.is_Add:
            known[formula] = mpmath.fsum(parts)
        elif formula.is_Mul:
            known[formula] = mpmath.fprod(parts)
        elif formula.is_Pow:
            known[formula] = parts[0] ** parts[1]
        else:
            value = formula.func(*map(sympy.Float, parts)) if parts else formula
            known[formula] = mpmath.mpmathify(sympy.N(value, DIGITS))
    return known[formula]
