"""Degrees and heights of formulas: a number type that tells how large the polynomial is that a formula being zero is.

A number is P / (n D1^a D2^b ..) with an integer n and polynomials P, Dk of what is drawn and of roots, whose
coefficients are algebraic integers. The product of a polynomial over all signs of its roots is a polynomial of what is
drawn alone, 2^r times as large: one that is not zero everywhere vanishes at no more than its degree over p of all draws
(Schwartz 1980, Zippel 1979), and is zero modulo p for few primes p alone, those that divide a norm of a coefficient.
The height is the binary logarithm of the sum of the magnitudes of the coefficients, where a root counts as the root of
that of its radicand.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from assur.numerics.drawn_angles import DrawnAngles
from assur.numerics.powers import whole_power
from assur.numerics.prime_field import simplest


@dataclass(frozen=True, eq=False)
class Degree:
    """Of a number: the degree of its numerator, the divisors below it with their powers, and the roots in it.

    Attributes:
        over: degree of the numerator.
        under: divisor -> its power.
        roots: those that occur.
        height: of the numerator.
        denominator: an integer below it, beside the divisors.
    """

    over: float = 0
    under: Mapping[Degree, int] = field(default_factory=dict)
    roots: frozenset[object] = frozenset()
    height: float = 0
    denominator: int = 1

    __array_ufunc__ = None

    @property
    def bound(self) -> float:
        """Degree of what is zero wherever the number is, in what is drawn alone."""
        return self.over * 2.0 ** len(self.roots)

    @property
    def bits(self) -> float:
        """Height of the same."""
        return self.height * 2.0 ** len(self.roots)

    def __neg__(self) -> Degree:
        return self

    __pos__ = __neg__

    def __add__(self, other: Any) -> Any:
        return _sum(self, _degree(other)) if _known(other) else NotImplemented

    __radd__ = __sub__ = __rsub__ = __add__

    def __mul__(self, other: Any) -> Any:
        if not _known(other):
            return NotImplemented
        b, under = _degree(other), dict(self.under)
        for divisor, power in b.under.items():
            under[divisor] = power + under.get(divisor, 0)
        height, denominator = self.height + b.height, self.denominator * b.denominator
        return Degree(self.over + b.over, under, self.roots | b.roots, height, denominator)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Any:
        if not _known(other):
            return NotImplemented
        return self * (_reciprocal(other) if isinstance(other, Degree) else 1 / _rational(other))

    def __rtruediv__(self, other: Any) -> Any:
        return _reciprocal(self) * other if _known(other) else NotImplemented

    def __pow__(self, exponent: int) -> Any:
        return whole_power(self, exponent)


def _degree(number: Any) -> Degree:
    """That of a rational."""
    if isinstance(number, Degree):
        return number
    exact = _rational(number)
    return Degree(height=math.log2(abs(exact.numerator) or 1), denominator=exact.denominator)


def _rational(number: Any) -> Fraction:
    return simplest(number) if isinstance(number, float) else Fraction(number)


def _under(number: Degree) -> tuple[float, float]:
    """Degree and height of the product of the divisors of a number."""
    pairs = [(divisor.over * power, divisor.height * power) for divisor, power in number.under.items()]
    return sum(degree for degree, _ in pairs), sum(height for _, height in pairs)


def _reciprocal(number: Degree) -> Degree:
    """One over a number: its numerator becomes a divisor, known again by the number."""
    degree, height = _under(number)
    if not (number.over or number.roots or number.height):
        return Degree(height=math.log2(number.denominator))
    return Degree(degree, {number: 1}, number.roots, height + math.log2(number.denominator))


def _sum(a: Degree, b: Degree) -> Degree:
    under = dict(a.under)
    for divisor, power in b.under.items():
        under[divisor] = max(power, under.get(divisor, 0))
    denominator = math.lcm(a.denominator, b.denominator)
    common = Degree(under=under)
    whole, parts = _under(common), []
    for number in (a, b):
        own = _under(number)
        factor = math.log2(denominator // number.denominator)
        parts.append((number.over + whole[0] - own[0], number.height + whole[1] - own[1] + factor))
    over, height = (max(values) for values in zip(*parts, strict=True))
    return Degree(over, under, a.roots | b.roots, height + 1, denominator)


def _known(other: Any) -> bool:
    return isinstance(other, (Degree, int, float, Fraction))


class Degrees(DrawnAngles):
    """The namespace of degrees: what is drawn has degree 1, cosine and sine of a drawn angle are quotients of degree 2.

    Args:
        roots: what each call of `sqrt` gives, in their order, as `assur.numerics.residues.Draws.roots` has noted it: a
            root by its name, or None, and a rational whose root it is multiplied by.

    >>> ns = Degrees([("root", Fraction(1))])
    >>> x = ns.uniform()
    >>> number = ns.sqrt(x * x + 1) / x - 1
    >>> number.bound, number.bits
    (2.0, 3.0)
    """

    def __init__(self, roots: Sequence[tuple[object, Fraction]]) -> None:
        self._roots, self._calls, self._drawn_numbers = roots, 0, 0
        self._first: dict[object, Degree] = {}
        self.positive: list[Degree] = []

    def number(self, value: Any) -> Fraction:
        """A constant."""
        return Fraction(value)

    def vanishes(self, _number: Any, /) -> bool:
        """Whether a number may be zero everywhere."""
        return True

    def uniform(self) -> Degree:
        """What is drawn."""
        self._drawn_numbers += 1
        return Degree(1)

    def circle(self) -> tuple[Degree, Degree]:
        """Cosine and sine of a drawn angle: 1 - t^2 and 2 t over 1 + t^2."""
        self._drawn_numbers += 1
        size = Degree(2, height=1)
        return Degree(2, {size: 1}, height=1), Degree(2, {size: 1}, height=1)

    def signs(self) -> Degree:
        """1 or -1."""
        return Degree()

    def multiple(self, _turns: Fraction) -> tuple[Degree, Degree]:
        """Cosine and sine of a share of a turn: twice them are algebraic integers."""
        return Degree(height=1, denominator=2), Degree(height=1, denominator=2)

    def sqrt(self, radicand: Any, /) -> Degree:
        """A root."""
        name, share = self._roots[self._calls]
        self._calls += 1
        number = _degree(radicand)
        if name in self._first:
            bits = math.log2(share.numerator * share.denominator) / 2
            multiple: Degree = self._first[name] * Degree(height=bits, denominator=share.denominator)
            return multiple
        degree, height = _under(number)
        own = (number.over + degree) / 2
        half = (number.height + height + math.log2(number.denominator)) / 2
        if name is None:  # a polynomial, by its square: Mahler's measure is that of a product
            return Degree(own, number.under, number.roots, half + own * self._drawn_numbers, number.denominator)
        self._first[name] = Degree(own, number.under, number.roots | {name}, half, number.denominator)
        return self._first[name]
