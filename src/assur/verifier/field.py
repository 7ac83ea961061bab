"""Numbers modulo a prime that is drawn anew: exact arithmetic for formulas, with roots and shares of a turn.

p + 1 is a multiple of 50 400. So -1 has no root modulo p, and a + b i are a field of p^2 numbers. Those with
a^2 + b^2 = 1 are a circle of p + 1 points, among them the cosines and sines of all multiples of a turn over 50 400.
"""

from __future__ import annotations

import copy
import math
import secrets
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Self

from flint import fmpz

from assur.verifier.formula import PI, AngleSum

ORDER, UNITS = 50_400, 11_520
"""Of the turns that have residues, and how many integers below it have no factor in common with it."""
LEAST, TRIES = 2**160, 20_000
"""Below the prime, and how many numbers are looked at for one."""
TRIED = 1000
"""Prime factors up to this are looked for under roots of rationals; what is left counts as one."""
SIMPLE = Fraction(1, 2**51)
FEW, SHORT = 1024, 999
"""The second: numerator and denominator of a rational whose root a decimal of fifteen digits is told by."""


class NoRootError(ArithmeticError):
    """A root of a root, or a quotient, that does not exist at a place."""


class NoExactError(ArithmeticError):
    """What this arithmetic cannot say."""


@dataclass(slots=True)
class Element:
    """a + b i modulo p."""

    p: int
    a: int
    b: int = 0

    def __add__(self, other: Any) -> Element:
        if not isinstance(other, (Element, int, Fraction)):
            return NotImplemented
        own = self.of(other)
        return Element(self.p, (self.a + own.a) % self.p, (self.b + own.b) % self.p)

    def __sub__(self, other: Any) -> Element:
        if not isinstance(other, (Element, int, Fraction)):
            return NotImplemented
        own = self.of(other)
        return Element(self.p, (self.a - own.a) % self.p, (self.b - own.b) % self.p)

    def __mul__(self, other: Any) -> Element:
        if not isinstance(other, (Element, int, Fraction)):
            return NotImplemented
        own, p = self.of(other), self.p
        if not self.b and not own.b:
            return Element(p, self.a * own.a % p)
        return Element(p, (self.a * own.a - self.b * own.b) % p, (self.a * own.b + self.b * own.a) % p)

    def __truediv__(self, other: Any) -> Element:
        if not isinstance(other, (Element, int, Fraction)):
            return NotImplemented
        own, p = self.of(other), self.p
        size = (own.a * own.a + own.b * own.b) % p
        if not size:
            raise NoRootError("a division by what is zero")
        over = pow(size, -1, p)
        return self * Element(p, own.a * over % p, -own.b * over % p)

    def __rtruediv__(self, other: Any) -> Element:
        return self.of(other) / self

    def __rsub__(self, other: Any) -> Element:
        return self.of(other) - self

    def __neg__(self) -> Element:
        return Element(self.p, -self.a % self.p, -self.b % self.p)

    __radd__ = __add__
    __rmul__ = __mul__

    def of(self, other: Any) -> Element:
        """A number of the field, or an integer or a rational as one."""
        if isinstance(other, Element):
            return other
        exact = Fraction(other)
        return Element(self.p, exact.numerator * pow(exact.denominator, -1, self.p) % self.p)

    @property
    def zero(self) -> bool:
        """Whether it is."""
        return not self.a and not self.b

    @property
    def square(self) -> bool:
        """Whether a number of F_p has a root there, or another one a root at all."""
        norm = self.a if not self.b else (self.a * self.a + self.b * self.b) % self.p
        return pow(norm, (self.p - 1) // 2, self.p) <= 1

    def root(self) -> Element:
        """A root of either sign."""
        p = self.p
        if not self.b:
            own = pow(self.a, (p + 1) // 4, p)
            return Element(p, own) if own * own % p == self.a else Element(p, 0, own)
        if not self.square:
            raise NoRootError("a root of a root")
        size = pow(self.a * self.a + self.b * self.b, (p + 1) // 4, p)
        for half in ((self.a + size) * pow(2, -1, p) % p, (self.a - size) * pow(2, -1, p) % p):
            own = pow(half, (p + 1) // 4, p)
            if own and own * own % p == half:
                return Element(p, own, self.b * pow(2 * own, -1, p) % p)
        raise NoRootError("a root of a root")


class CircleField:
    """A prime field with i, its circle, and roots of rationals; the number type of a mechanism's dimensions.

    Args:
        p: the prime; drawn if left out.

    >>> field = CircleField()
    >>> root = field.root(Fraction(3, 4))
    >>> cosine, sine = field.circle(AngleSum({PI: Fraction(1, 6)}))
    >>> (root - cosine).zero, (field.p + 1) % ORDER
    (True, 0)
    """

    rooted = False

    def __init__(self, p: int | None = None) -> None:
        self.p = p or prime()
        self._roots: dict[int, Element] = {}
        self._drawn: dict[tuple[str, int], tuple[Element, Element]] = {}
        self._turn = self._generator()

    def fresh(self) -> Self:
        """The same field, where other angles are drawn."""
        other = copy.copy(self)
        other._drawn = {}
        return other

    def number(self, value: Fraction) -> Element:
        """A rational; if `rooted`, of the digits of a root this root."""
        square = short_square(value) if self.rooted else None
        return Element(self.p, 0).of(value) if square is None else self.root(square) * (1 if value > 0 else -1)

    def uniform(self) -> Element:
        """Any number of F_p."""
        return Element(self.p, secrets.randbelow(self.p))

    def radians(self, angle: AngleSum) -> Element:
        """No number modulo p is an angle."""
        raise NoExactError(f"an angle as a plain number, of {', '.join(angle.shares)}")

    def root(self, value: Any) -> Element:
        """The root that stands for the positive one, of a rational; i times it of a negative one."""
        if not isinstance(value, (int, Fraction)):
            raise NoExactError("the root of a dimension that is drawn")
        rest, outer = abs(Fraction(value).numerator * Fraction(value).denominator), 1
        result = Element(self.p, 1)
        for small in range(2, TRIED):
            while rest % (small * small) == 0 and rest:
                rest, outer = rest // (small * small), outer * small
            if rest and rest % small == 0:
                rest, result = rest // small, result * self._prime_root(small)
        whole = math.isqrt(rest)
        result = result * (whole if whole * whole == rest else self._prime_root(rest))
        result = result * Fraction(outer, Fraction(value).denominator)
        return result * Element(self.p, 0, 1) if value < 0 else result

    def circle(self, angle: AngleSum) -> tuple[Element, Element]:
        """Cosine and sine: of shares of a turn those of the field, of any other angle some that are drawn once."""
        result = Element(self.p, 1)
        for name, share in angle.shares.items():
            result = result * self._part(name, share)
        return Element(self.p, result.a), Element(self.p, result.b)

    def _part(self, name: str, share: Any) -> Element:
        if not isinstance(share, (int, Fraction)):
            raise NoExactError("an angle times a number")
        turns = Fraction(share) / 2 * ORDER
        if name == PI and turns.denominator == 1:
            return _power(self._turn, turns.numerator % ORDER)
        halves = Fraction(share) * 2  # angles that have names are drawn as twice half of them
        key = name, halves.denominator
        if key not in self._drawn:
            t = self.uniform()
            self._drawn[key] = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
        cosine, sine = self._drawn[key]
        base = Element(self.p, cosine.a, sine.a if halves > 0 else -sine.a % self.p)
        return _power(base, abs(halves.numerator))

    def _generator(self) -> Element:
        while True:
            z = Element(self.p, secrets.randbelow(self.p), 1 + secrets.randbelow(self.p - 1))
            turn = _power(z / Element(self.p, z.a, -z.b % self.p), (self.p + 1) // ORDER)
            if all(_power(turn, ORDER // small) != Element(self.p, 1) for small in (2, 3, 5, 7)):
                return turn if _power(turn, ORDER // 4).b == 1 else Element(self.p, turn.a, -turn.b % self.p)

    def _prime_root(self, number: int) -> Element:
        if number not in self._roots:
            if number == 2:
                self._roots[2] = 2 * self.circle(AngleSum({PI: Fraction(1, 4)}))[0]
            elif number in (3, 5, 7):  # as sums of sines or cosines, after Gauss
                sine = number % 4 == 3
                total = Element(self.p, 0)
                for k in range(1, number):
                    sign = 1 if pow(k, (number - 1) // 2, number) == 1 else -1
                    total = total + sign * self.circle(AngleSum({PI: Fraction(2 * k, number)}))[sine]
                self._roots[number] = total
            else:
                self._roots[number] = Element(self.p, number % self.p).root()
        return self._roots[number]

    def missed(self, bits: float) -> float:
        """How likely the prime makes zero of an integer of algebra that is not, all of whose conjugates are so long.

        Its norm has fewer divisors than its length over that of p; each candidate was one with that share of all.
        """
        length = bits * UNITS * 2.0 ** len(self._roots)
        return min(1.0, TRIES * (length / math.log2(self.p) + 1) * ORDER / LEAST)


def prime() -> int:
    """A prime that is -1 modulo `ORDER`, drawn."""
    for _ in range(TRIES):
        p = ORDER * (LEAST // ORDER + 1 + secrets.randbelow(LEAST // ORDER - 1)) - 1
        if fmpz(p).is_prime():
            return p
    raise NoExactError("no prime")


def few_digits(number: Element) -> Fraction | None:
    """The positive rational of few digits that a number may stand for, by Euclid's algorithm."""
    (r, t), (s, u) = (number.p, 0), (number.a, 1)
    while s > FEW:
        quotient = r // s
        (r, t), (s, u) = (s, u), (r - quotient * s, t - quotient * u)
    return Fraction(s, u) if s > 0 and 0 < u <= FEW and not number.b else None


def simplest(number: float) -> Fraction:
    """The simplest rational that a float may stand for: the first of its continued fraction that is as near.

    >>> simplest(0.1), simplest(2 / 3)
    (Fraction(1, 10), Fraction(2, 3))
    """
    exact = Fraction(number)
    rest, before, last = exact, (0, 1), (1, 0)
    while True:
        whole = math.floor(rest)
        before, last = last, (whole * last[0] + before[0], whole * last[1] + before[1])
        if abs(Fraction(*last) - exact) <= abs(exact) * SIMPLE:
            return Fraction(*last)
        rest = 1 / (rest - whole)


def short_square(value: Fraction) -> Fraction | None:
    """The short rational whose root has the digits of a rational; else None.

    >>> short_square(Fraction("-0.8660254037844386")), short_square(Fraction("0.8660"))
    (Fraction(3, 4), None)
    """
    square = (value * value).limit_denominator(SHORT)
    return square if square.numerator <= SHORT and abs(value * value - square) <= 4 * SIMPLE * square else None


def _power(base: Element, exponent: int) -> Element:
    half = _power(base, exponent // 2) if exponent > 1 else Element(base.p, 1)
    return half * half * (base if exponent % 2 else 1)
