"""How large polynomials are that formulas amount to: a number type of degrees and heights.

A number is P / (n D1^a D2^b ..) with an integer n and polynomials in what is drawn and in roots, whose coefficients are
algebraic integers. The height is the binary logarithm of the sum of their magnitudes; a root counts as that of its
radicand's.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from assur.verifier.field import ORDER
from assur.verifier.formula import PI, AngleSum


@dataclass(frozen=True, eq=False)
class Size:
    """Degree and height of the numerator; divisors with their powers, the integer below, and the roots."""

    degree: float = 0
    height: float = 0
    under: Mapping[Size, int] = field(default_factory=dict)
    integer: int = 1
    roots: frozenset[int] = frozenset()

    def __add__(self, other: Any) -> Size:
        a, b = self, size(other)
        under = {divisor: max(a.under.get(divisor, 0), b.under.get(divisor, 0)) for divisor in {**a.under, **b.under}}
        integer, whole = math.lcm(a.integer, b.integer), Size(under=under)
        degree = max(part.degree + whole.below[0] - part.below[0] for part in (a, b))
        heights = (x.height + whole.below[1] - x.below[1] + math.log2(integer // x.integer) for x in (a, b))
        return Size(degree, max(heights) + 1, under, integer, a.roots | b.roots)

    __radd__ = __sub__ = __rsub__ = __add__

    def __neg__(self) -> Size:
        return self

    def __mul__(self, other: Any) -> Size:
        b = size(other)
        under = {k: self.under.get(k, 0) + b.under.get(k, 0) for k in {**self.under, **b.under}}
        degree, height = self.degree + b.degree, self.height + b.height
        return Size(degree, height, under, self.integer * b.integer, self.roots | b.roots)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Size:
        if not isinstance(other, Size):
            return self * (1 / Fraction(other))
        degree, height = other.below
        return self * Size(degree, height + math.log2(other.integer), {other: 1}, 1, other.roots)

    def __rtruediv__(self, other: Any) -> Size:
        return size(other) / self

    @property
    def below(self) -> tuple[float, float]:
        """Degree and height of the product of the divisors."""
        pairs = [(divisor.degree * power, divisor.height * power) for divisor, power in self.under.items()]
        return sum(degree for degree, _ in pairs), sum(height for _, height in pairs)

    @property
    def whole(self) -> tuple[float, float]:
        """Degree and height over all signs of its roots: of a polynomial of what is drawn alone."""
        return self.degree * 2.0 ** len(self.roots), self.height * 2.0 ** len(self.roots)

    def root(self, name: int | None, drawn: int) -> Size:
        """Its root, by a name; of a square, which needs none, after Mahler's measure, with so many numbers drawn."""
        degree, height = self.below
        own = (self.degree + degree) / 2
        half = (self.height + height + math.log2(self.integer)) / 2 + (0 if name is not None else own * drawn)
        return Size(own, half, self.under, self.integer, self.roots | (frozenset() if name is None else {name}))


CIRCLE = Size(2, 1)
"""1 + t^2."""


def size(number: Any) -> Size:
    """That of a number; of an integer or a rational, too."""
    if isinstance(number, Size):
        return number
    exact = Fraction(number)
    return Size(0, math.log2(abs(exact.numerator) or 1), {}, exact.denominator)


def circle(angle: AngleSum) -> tuple[Size, Size]:
    """Of cosine and sine: twice those of a share of a turn are integers; of half an angle 1 - t^2 over 1 + t^2."""
    result = Size()
    for name, share in angle.shares.items():
        halves = abs(Fraction(share) * 2).numerator
        fixed = name == PI and (Fraction(share) / 2 * ORDER).denominator == 1
        part = Size(0, 1, {}, 2) if fixed else Size(2 * halves, 2 * halves, {CIRCLE: halves})
        result = result * part + result * part
    return result, result
