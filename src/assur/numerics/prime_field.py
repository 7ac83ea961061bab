"""Prime fields F_p whose quadratic extension F_p(i) holds roots of all residues, and the usual roots of unity.

The prime is drawn, so that no number of a formula can be written to vanish modulo it; p + 1 is a multiple of `ORDER`.
So -1 has no root in F_p, every residue has one in F_p(i), and the unit circle a^2 + b^2 = 1 of F_p holds the cosines
and sines of all multiples of a turn over `ORDER`. Roots of rationals are made of these (Gauss sums), as over real
numbers: the root of 3 is twice the cosine of 30 deg.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, lru_cache

import numpy as np
from flint import fmpz

ORDER = 50_400
"""2^5 3^2 5^2 7: shares of a turn with which tenths and quarters of degrees, and regular polygons, are written."""
UNITS = 11_520
"""Of the integers below `ORDER` so many have no factor in common with it: the degree of the field of its roots."""
SMALL, LARGE = 2**30, 2**160
"""Least primes that are drawn. Below twice the first the sum of two products of residues is an integer of 64 bits. Of
the large ones there are so many that hardly any is a divisor of a given number, however long that is."""
TRIES = 20_000
"""Numbers that are looked at for a prime; one in some sixteen is one of a large field, one in four of a small one."""
SIMPLE = 2.0**-51
"""Share of a float within which it may be another number, rounded once or twice, as 0.1 + 0.2 is."""
TRIED = 1000
"""Prime factors of a radicand up to this are looked for; what is left is taken as one."""


class NoResidueError(ArithmeticError):
    """A number that has no residue: its denominator is a multiple of the prime."""


@lru_cache(maxsize=4096)
def simplest(number: float) -> Fraction:
    """The simplest rational that a float may stand for, among its continued fraction's convergents.

    >>> simplest(6 / 7), simplest(0.1 + 0.2), simplest(-0.5)
    (Fraction(6, 7), Fraction(3, 10), Fraction(-1, 2))
    """
    exact = Fraction(number)
    allowed = abs(exact) * Fraction(SIMPLE)
    rest, before, last = exact, (0, 1), (1, 0)
    while True:
        whole = math.floor(rest)
        before, last = last, (whole * last[0] + before[0], whole * last[1] + before[1])
        convergent = Fraction(*last)
        if abs(convergent - exact) <= allowed:
            return convergent
        rest = 1 / (rest - whole)


@dataclass(frozen=True, eq=False)
class PrimeField:
    """A prime p, and a residue of the unit circle whose multiples are the turns over `ORDER`.

    Attributes:
        p: the prime.
        turn: cosine and sine of a turn over `ORDER`.
    """

    p: int
    turn: tuple[int, int]

    @staticmethod
    def drawn(random: np.random.Generator, least: int = SMALL) -> PrimeField:
        """One of the primes between a bound and twice it; some four thousand between `SMALL` and twice that.

        >>> field = PrimeField.drawn(np.random.default_rng(0))
        >>> (field.p + 1) % ORDER, field.cosine_and_sine(Fraction(1, 4))
        (0, (0, 1))
        """
        first, last = least // ORDER + 1, 2 * least // ORDER
        numbers = (ORDER * below(random, first, last) - 1 for _ in range(TRIES))
        p = next(number for number in numbers if fmpz(number).is_prime())
        while True:
            a, b = below(random, 1, p), below(random, 1, p)
            size = pow(a * a + b * b, -1, p)
            on_circle = (a * a - b * b) * size % p, 2 * a * b * size % p  # z / conjugate of z
            turn = multiple(on_circle, (p + 1) // ORDER, p)
            if all(multiple(turn, ORDER // prime, p) != (1, 0) for prime in (2, 3, 5, 7)):
                quarter = multiple(turn, ORDER // 4, p)[1]  # 1 or -1: a quarter of a turn is to have the sine 1
                return PrimeField(p, (turn[0], turn[1] * quarter % p))

    def cosine_and_sine(self, turns: Fraction) -> tuple[int, int]:
        """Of an angle that is a multiple of a turn over `ORDER`, given in turns."""
        share = turns * ORDER
        if share.denominator != 1:
            raise NoResidueError(f"an angle of {turns} turns")
        return multiple(self.turn, share.numerator % ORDER, self.p)

    def missed(self, bits: float) -> float:
        """How likely a large prime that is drawn divides a number of the field that is not zero, modulo a prime of it.

        The number is an algebraic integer whose conjugates have magnitudes below 2 to the power of `bits`: of a norm
        below 2^(bits degree) fewer than bits degree / log2(p) primes are divisors. Each of `TRIES` candidates is one
        of them with that share of all candidates, however many of these are primes.

        >>> PrimeField.drawn(np.random.default_rng(0), LARGE).missed(1e9) < 1e-20
        True
        """
        degree = UNITS * 2.0 ** len(self._roots)
        return min(1.0, TRIES * (bits * degree / math.log2(self.p) + 1) * 2 * ORDER / self.p)

    def residue(self, number: Fraction) -> int:
        """The residue of a rational."""
        if number.denominator % self.p == 0:
            raise NoResidueError(str(number))
        return number.numerator * pow(number.denominator, -1, self.p) % self.p

    def root(self, number: Fraction) -> tuple[int, int]:
        """The root of a rational: what stands for the positive one, i times it where the rational is negative."""
        rest, real, imaginary = abs(number.numerator * number.denominator), 1, 0
        outer = 1
        for prime in range(2, TRIED):
            while rest % (prime * prime) == 0:
                rest, outer = rest // (prime * prime), outer * prime
            if rest % prime == 0:
                rest //= prime
                real, imaginary = self._times((real, imaginary), self._prime_root(prime))
        whole = math.isqrt(rest)
        if whole * whole == rest:
            outer *= whole
        else:
            real, imaginary = self._times((real, imaginary), self._prime_root(rest))
        factor = self.residue(Fraction(outer, number.denominator))
        real, imaginary = real * factor % self.p, imaginary * factor % self.p
        return (-imaginary % self.p, real) if number < 0 else (real, imaginary)

    def _times(self, a: tuple[int, int], b: tuple[int, int]) -> tuple[int, int]:
        return _product(a, b, self.p)

    def _prime_root(self, prime: int) -> tuple[int, int]:
        p = self.p
        if prime not in self._roots:
            if prime == 2:
                root = 2 * self.cosine_and_sine(Fraction(1, 8))[0] % p, 0
            elif prime in (3, 5, 7):  # Gauss sums
                part = 1 if prime % 4 == 3 else 0
                characters = {a: 1 if pow(a, (prime - 1) // 2, prime) == 1 else -1 for a in range(1, prime)}
                terms = (sign * self.cosine_and_sine(Fraction(a, prime))[part] for a, sign in characters.items())
                root = sum(terms) % p, 0
            else:
                own = pow(prime, (p + 1) // 4, p)
                root = (own, 0) if own * own % p == prime % p else (0, own)
            self._roots[prime] = root
        return self._roots[prime]

    @cached_property
    def _roots(self) -> dict[int, tuple[int, int]]:
        return {}


def _product(a: tuple[int, int], b: tuple[int, int], p: int) -> tuple[int, int]:
    return (a[0] * b[0] - a[1] * b[1]) % p, (a[0] * b[1] + a[1] * b[0]) % p


def multiple(angle: tuple[int, int], count: int, p: int) -> tuple[int, int]:
    """Cosine and sine, modulo p, of a multiple of an angle that is given by its own.

    >>> multiple((3 * pow(5, -1, 101), 4 * pow(5, -1, 101)), 0, 101)
    (1, 0)
    """
    result = (1, 0)
    for digit in bin(count)[2:]:
        result = _product(result, result, p)
        if digit == "1":
            result = _product(result, angle, p)
    return result


def below(random: np.random.Generator, low: int, high: int) -> int:
    """An integer of any size, low <= it < high, every one but for 2^-64 as likely as another."""
    size = (high - low).bit_length() + 64
    return low + int.from_bytes(random.bytes(-(-size // 8))) % (high - low)
