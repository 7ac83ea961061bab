"""Numbers of F_p(i) at many random draws at once, with + - * / and roots: exact arithmetic for formulas.

A formula that holds for real numbers by algebra alone holds for residues too, and one that does not fails at nearly
every draw (`assur.numerics.degrees`).
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np
from flint import fmpz
from numpy.typing import NDArray

from assur.numerics.drawn_angles import DrawnAngles
from assur.numerics.powers import whole_power
from assur.numerics.prime_field import ORDER, PrimeField, below, simplest

IntArray = NDArray[np.int64]
"""Of residues modulo a large prime, integers of any size."""
BoolArray = NDArray[np.bool_]


GUARD = Fraction(1, 10**25)
"""A number that is added and smaller than this only keeps a divisor from being zero, as 1e-30 does."""
SMALL_ENOUGH = 2**31
"""Below it the sum of two products of residues is an integer of 64 bits."""
PRODUCTS = 2
"""A root may be a positive number times as many known ones."""


class Residues:
    """Numbers of F_p(i), one for each draw, with + - * /; integers, fractions and floats may stand on either side.

    Attributes:
        draws: whose numbers they are.
        exact: the rational that they stand for, if that is known.
    """

    __slots__ = ("_im", "_kept", "_re", "draws", "exact")
    __array_ufunc__ = None

    def __init__(self, draws: Draws, re: IntArray, im: IntArray | None = None, exact: Fraction | None = None) -> None:
        self.draws, self._re, self._im, self.exact = draws, re, im, exact
        self._kept = len(draws.kept)

    @property
    def re(self) -> IntArray:
        """Residues (N,), or (1,) of what is the same at every draw."""
        if self._kept < len(self.draws.kept):
            self._leave_out()
        return self._re

    @property
    def im(self) -> IntArray | None:
        """The same of the imaginary part; None where all are in F_p."""
        if self._kept < len(self.draws.kept):
            self._leave_out()
        return self._im

    def _leave_out(self) -> None:
        """Of the draws that are no longer kept there are no numbers."""
        for kept in self.draws.kept[self._kept :]:
            self._re = self._re[kept] if len(self._re) > 1 else self._re
            self._im = self._im[kept] if self._im is not None and len(self._im) > 1 else self._im
        self._kept = len(self.draws.kept)

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.exact if self.exact is not None else len(self.re)}>"

    def zero(self) -> BoolArray:
        """Whether they are zero (N,)."""
        zero = self.re == 0
        return np.asarray(zero if self.im is None else zero & (self.im == 0))

    def inverse(self) -> Residues:
        """Reciprocals; a draw at which there is none is given up."""
        draws, p = self.draws, self.draws.p
        if self.exact:
            return draws.number(1 / self.exact)
        draws.give_up(self.zero())
        if self.im is None:
            return Residues(draws, inverted(self.re, p))
        size = inverted((self.re * self.re + self.im * self.im) % p, p)
        return Residues(draws, self.re * size % p, -self.im * size % p)

    def __pos__(self) -> Residues:
        return self

    def __neg__(self) -> Residues:
        p = self.draws.p
        exact = None if self.exact is None else -self.exact
        return Residues(self.draws, -self.re % p, None if self.im is None else -self.im % p, exact)

    def __add__(self, other: Any) -> Any:
        return self._with(other, _added)

    def __sub__(self, other: Any) -> Any:
        return self._with(other, _subtracted)

    def __mul__(self, other: Any) -> Any:
        return self._with(other, _multiplied)

    def __truediv__(self, other: Any) -> Any:
        return self._with(other, _divided)

    def __radd__(self, other: Any) -> Any:
        return self._with(other, _added)

    def __rmul__(self, other: Any) -> Any:
        return self._with(other, _multiplied)

    def __rsub__(self, other: Any) -> Any:
        return self._with(other, lambda a, b: _subtracted(b, a))

    def __rtruediv__(self, other: Any) -> Any:
        return self._with(other, lambda a, b: _divided(b, a))

    def __pow__(self, exponent: int) -> Any:
        return whole_power(self, exponent)

    def _with(self, other: Any, operation: Callable[[Residues, Residues], Residues]) -> Any:
        if not isinstance(other, Residues):
            if not isinstance(other, (int, float, Fraction, np.floating, np.integer)):
                return NotImplemented
            other = self.draws.number(other)
        return operation(self, other)


def _added(a: Residues, b: Residues) -> Residues:
    if _guards(b, a):
        return a
    if _guards(a, b):
        return b
    p = a.draws.p
    exact = None if a.exact is None or b.exact is None else a.exact + b.exact
    im = b.im if a.im is None else a.im if b.im is None else (a.im + b.im) % p
    return Residues(a.draws, (a.re + b.re) % p, im, exact)


def _guards(number: Residues, beside: Residues) -> bool:
    """Whether a number only keeps another from being zero; it is then left out, and that is noted."""
    if number.exact is None or beside.exact is not None or not 0 < abs(number.exact) < GUARD:
        return False
    number.draws.guarded = True
    return True


def _subtracted(a: Residues, b: Residues) -> Residues:
    p = a.draws.p
    exact = None if a.exact is None or b.exact is None else a.exact - b.exact
    im = a.im if b.im is None else -b.im % p if a.im is None else (a.im - b.im) % p
    return Residues(a.draws, (a.re - b.re) % p, im, exact)


def _multiplied(a: Residues, b: Residues) -> Residues:
    p = a.draws.p
    exact = None if a.exact is None or b.exact is None else a.exact * b.exact
    if a.im is None or b.im is None:
        im = b.im if a.im is None else a.im
        along = a if a.im is None else b
        return Residues(a.draws, a.re * b.re % p, None if im is None else along.re * im % p, exact)
    return Residues(a.draws, (a.re * b.re - a.im * b.im) % p, (a.re * b.im + a.im * b.re) % p, exact)


def _divided(a: Residues, b: Residues) -> Residues:
    if b.exact == 0:
        raise ZeroDivisionError("a division by zero")
    return _multiplied(a, b.inverse())


class Draws(DrawnAngles):
    """Random draws of numbers of a prime field; a namespace for kernels and formulas.

    A root is drawn with either sign. Each new radicand is looked at: whether it, times some of those before, is a
    square of a formula; its root then has a sign of its own, which no change of the other roots brings about.

    Attributes:
        field, random: where numbers come from.
        p: the prime, as a number like the residues.
        count: how many draws, two or more.
        kept: each time that draws were left out for good, which of those before are kept.
        sound: draws (N,) at which everything that was asked for exists.
        tied: how many roots are tied to others, or to none: their radicands are squares of formulas.
        guarded: whether a number was left out that only keeps a divisor from being zero.
        roots: what each call of `sqrt` gave: a root of its own, or one again, or None for a formula without one; and
            the rational by whose root it was multiplied.
        positive: numbers that are never negative; the root of the square of their product is the product.

    >>> draws = Draws(PrimeField.drawn(np.random.default_rng(0)), 8, np.random.default_rng(1))
    >>> x = draws.uniform()
    >>> bool(np.all(((x + 1) / x - 1 / x - 1).zero())), draws.sqrt(x * x).zero().any(), draws.tied
    (True, np.False_, 1)
    """

    def __init__(self, field: PrimeField, count: int, random: np.random.Generator) -> None:
        self.field, self.count, self.random = field, count, random
        self.p: Any = field.p if field.p < SMALL_ENOUGH else fmpz(field.p)
        self.kept: list[NDArray[np.intp]] = []
        self.sound: BoolArray = np.ones(count, dtype=bool)
        self.tied = 0
        self.guarded = False
        self.positive: list[Residues] = []
        self.roots: list[tuple[object, Fraction]] = []
        self._known: list[tuple[Residues, Residues]] = []
        self._characters: list[BoolArray] = []

    def number(self, value: Any) -> Residues:
        """A rational, a float as the simplest one that it may stand for, or the text of a decimal."""
        exact = simplest(float(value)) if isinstance(value, (float, np.floating)) else Fraction(value)
        return Residues(self, self._array(self.field.residue(exact)), None, exact)

    def uniform(self) -> Residues:
        """A number of F_p at each draw."""
        if isinstance(self.p, int):
            return Residues(self, self.random.integers(self.p, size=self.count))
        return Residues(self, self._array(*(below(self.random, 0, self.field.p) for _ in range(self.count))))

    def circle(self) -> tuple[Residues, Residues]:
        """Cosine and sine of an angle at each draw."""
        t = self.uniform()
        square = t * t
        size = (1 + square).inverse()
        return (1 - square) * size, 2 * t * size

    def multiple(self, _turns: Fraction) -> tuple[Residues, Residues] | None:
        """Cosine and sine of a share of a turn, where the field holds them."""
        if (_turns * ORDER).denominator != 1:
            return None
        cosine, sine = self.field.cosine_and_sine(_turns)
        return self._same(cosine), self._same(sine)

    def signs(self) -> Residues:
        """1 or -1 at each draw."""
        return Residues(self, np.where(self.random.random(self.count) < 0.5, self._array(1), self._array(self.p - 1)))

    def give_up(self, where: BoolArray) -> None:
        """Leave draws out."""
        self.sound &= ~where

    def keep(self, places: NDArray[np.intp]) -> None:
        """Go on at some of the draws alone, at two or more; what is known of the others is left out for good."""
        if len(places) < 2:
            raise ValueError(f"{len(places)} draws; two or more are kept")
        self.kept.append(places)
        self.count = len(places)
        self.sound = self.sound[places]
        self._characters = [row[places] for row in self._characters]

    def sqrt(self, radicand: Any, /) -> Residues:
        """A root; the same one wherever the radicand is the same, or a rational times it."""
        root, name, share = self._known_root(radicand if isinstance(radicand, Residues) else self.number(radicand))
        self.roots.append((name, share))
        return root

    def _known_root(self, value: Residues) -> tuple[Residues, object, Fraction]:
        exact = self._rational(value, self.number(1)) if value.exact is None else value.exact
        if exact is not None:
            return self._of_rational(exact), None, Fraction(1)
        for inverse, known in self._known:
            share = self._rational(value, inverse)
            if share is not None:
                return self._of_rational(share) * known, known, share
        tied = self.tied
        root = self._root(value) * self.signs()
        product = self._product_under(value) if self.tied > tied else None
        if product is not None:
            self.tied, root = tied, product
        self._known.append((value.inverse(), root))
        return root, root if product is None else None, Fraction(1)

    def _of_rational(self, value: Fraction) -> Residues:
        re, im = self.field.root(value)
        root = Fraction(math.isqrt(max(value.numerator, 0)), math.isqrt(value.denominator))
        exact = root if root * root == value else None
        return Residues(self, self._array(re), self._array(im) if im else None, exact)

    def vanishes(self, number: Any, /) -> bool:
        """Whether a number is zero at every draw."""
        if not isinstance(number, Residues):
            return bool(number == 0)
        zero = np.broadcast_to(number.zero(), (self.count,))
        return bool(np.all(zero[self.sound]))

    def _product_under(self, value: Residues) -> Residues | None:
        """The root of a radicand that is a rational, or a known radicand, times the square of positive numbers."""
        known = [(self.number(1), self.number(1)), *self._known]
        for count in range(1, PRODUCTS + 1):
            for factors in itertools.combinations_with_replacement(self.positive, count):
                product: Residues = math.prod(factors[1:], start=factors[0])
                square = (product * product).inverse()
                for inverse, root in known:
                    share = self._rational(value, square * inverse)
                    if share is not None:
                        positive: Residues = self._of_rational(share) * product * root
                        return positive
        return None

    def _array(self, *residues: int) -> IntArray:
        if isinstance(self.p, int):
            return np.array(residues, dtype=np.int64)
        return np.array([fmpz(residue) for residue in residues], dtype=object)

    def _same(self, residue: int) -> Residues:
        """One residue at every draw; small ones stand for themselves."""
        p = self.field.p
        exact = {0: Fraction(0), 1: Fraction(1), p - 1: Fraction(-1), (p + 1) // 2: Fraction(1, 2)}.get(residue)
        exact = Fraction(-1, 2) if residue == (p - 1) // 2 else exact
        return Residues(self, self._array(residue), None, exact)

    def _rational(self, value: Residues, inverse: Residues) -> Fraction | None:
        """A positive rational of few digits that one number is of another, given by its reciprocal, at every draw."""
        ratio = value * inverse
        sound = self.sound if len(ratio.re) == self.count else np.array([True])
        parts = [part[sound] for part in (ratio.re, ratio.im) if part is not None]
        if not all(len(part) and np.all(part == part[0]) for part in parts) or (len(parts) > 1 and parts[1][0]):
            return None
        return _few_digits(int(parts[0][0]), self.field.p)

    def _root(self, value: Residues) -> Residues:
        p = self.p
        if value.im is None or not np.any(value.im[self.sound if len(value.im) == self.count else slice(None)]):
            own = raised(value.re, (p + 1) // 4, p)
            square = own * own % p == value.re
            self._weigh(np.broadcast_to(square, (self.count,)), len(value.re) == 1)
            zero = np.zeros_like(own)
            return Residues(self, np.where(square, own, zero), np.where(square, zero, own))
        re, im = (np.broadcast_to(part, (self.count,)) for part in (value.re, value.im))
        norm = (re * re + im * im) % p
        square = is_square(norm, p)
        self.tied += len(np.unique(square[self.sound])) < 2
        self.give_up(~square)
        size, half = np.zeros_like(norm), (p + 1) // 2
        size[square] = raised(norm[square], (p + 1) // 4, p)
        above, below = (re + size) % p * half % p, (re - size) % p * half % p
        along = np.zeros_like(norm)
        along[square] = raised(np.where(is_square(above, p), above, below)[square], (p + 1) // 4, p)
        self.give_up(along == 0)
        return Residues(self, along, im * inverted(2 * along % p, p) % p)

    def _weigh(self, square: BoolArray, constant: bool) -> None:
        """Whether a radicand in F_p is tied to others: a product of them has a root in F_p always or never."""
        rows = [*self._characters, square]
        if constant or _rank([np.ones_like(square), *rows], self.sound) <= len(rows):
            self.tied += 1
        else:
            self._characters.append(square)


def _rank(rows: list[BoolArray], among: BoolArray) -> int:
    """Rank over F_2 of rows of truths, at some of their places."""
    left = [int("".join("1" if bit else "0" for bit in row[among]) or "0", 2) for row in rows]
    rank = 0
    while left:
        pivot = left.pop()
        if pivot:
            rank += 1
            lowest = pivot & -pivot
            left = [row ^ pivot if row & lowest else row for row in left]
    return rank


def _few_digits(residue: int, p: int) -> Fraction | None:
    """The positive rational n/d of a residue with n d below some 10^6, by the Euclidean algorithm."""
    bound = 1024
    (r, t), (s, u) = (p, 0), (residue, 1)
    while s > bound:
        quotient = r // s
        (r, t), (s, u) = (s, u), (r - quotient * s, t - quotient * u)
    return Fraction(s, u) if s > 0 and 0 < u <= bound else None


def raised(base: IntArray, exponent: Any, p: Any) -> IntArray:
    """Powers modulo p."""
    if base.dtype == object:
        return np.frompyfunc(lambda number: pow(number, exponent, p), 1, 1)(base)  # type: ignore[no-any-return]
    result = np.ones_like(base)
    for digit in bin(exponent)[2:]:
        result = result * result % p
        if digit == "1":
            result = result * base % p
    return result


def is_square(numbers: IntArray, p: Any) -> BoolArray:
    """Whether numbers have a root modulo p; zero has one."""
    return np.array([fmpz(int(number)).jacobi(p) >= 0 for number in numbers], dtype=bool)


def inverted(base: IntArray, p: Any) -> IntArray:
    """Reciprocals modulo p, and 0 of 0."""
    if base.dtype == object:  # by Euclid's algorithm
        return np.frompyfunc(lambda number: pow(number, -1, p) if number else 0, 1, 1)(base)  # type: ignore[no-any-return]
    return raised(base, p - 2, p)
