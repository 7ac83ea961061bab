"""Degrees of formulas: a number type that tells how large the polynomial is that a formula being zero amounts to.

A number is P / (D1^a D2^b ..) with polynomials P, Dk of what is drawn and of roots. The product of a polynomial over
all signs of its roots is a polynomial of what is drawn alone, 2^r times as large: one that is not zero everywhere
vanishes at no more than its degree over p of all draws (Schwartz 1980, Zippel 1979).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from assur.numerics.drawn_angles import DrawnAngles
from assur.numerics.powers import whole_power


@dataclass(frozen=True, eq=False)
class Degree:
    """Of a number: the degree of its numerator, the divisors below it with their powers, and the roots in it.

    Attributes:
        over: degree of the numerator.
        under: divisor -> its degree and its power.
        roots: those that occur.
    """

    over: float = 0
    under: Mapping[Degree, tuple[float, int]] = field(default_factory=dict)
    roots: frozenset[object] = frozenset()

    __array_ufunc__ = None

    @property
    def bound(self) -> float:
        """Degree of what is zero wherever the number is, in what is drawn alone."""
        return self.over * 2.0 ** len(self.roots)

    @property
    def below(self) -> float:
        """Degree of the denominator."""
        return sum(degree * power for degree, power in self.under.values())

    def __neg__(self) -> Degree:
        return self

    __pos__ = __neg__

    def __add__(self, other: Any) -> Any:
        return _sum(self, other) if _known(other) else NotImplemented

    __radd__ = __sub__ = __rsub__ = __add__

    def __mul__(self, other: Any) -> Any:
        if not _known(other):
            return NotImplemented
        if not isinstance(other, Degree):
            return self
        under = dict(self.under)
        for name, (degree, power) in other.under.items():
            under[name] = (degree, power + under.get(name, (degree, 0))[1])
        return Degree(self.over + other.over, under, self.roots | other.roots)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Any:
        if not _known(other):
            return NotImplemented
        return self * reciprocal(other) if isinstance(other, Degree) else self

    def __rtruediv__(self, other: Any) -> Any:
        return reciprocal(self) if _known(other) else NotImplemented

    def __pow__(self, exponent: int) -> Any:
        return whole_power(self, exponent)


def reciprocal(number: Degree) -> Degree:
    """One over a number: its numerator becomes a divisor, known again by the number."""
    under = {number: (number.over, 1)} if number.over or number.roots else {}
    return Degree(number.below, under, number.roots)


def _sum(a: Degree, b: Any) -> Degree:
    if not isinstance(b, Degree):
        return a if a.over >= a.below else Degree(a.below, a.under, a.roots)
    under = dict(a.under)
    for name, (degree, power) in b.under.items():
        under[name] = (degree, max(power, under.get(name, (degree, 0))[1]))
    whole = sum(degree * power for degree, power in under.values())
    return Degree(max(a.over + whole - a.below, b.over + whole - b.below), under, a.roots | b.roots)


def _known(other: Any) -> bool:
    return isinstance(other, (Degree, int, float, Fraction))


class Degrees(DrawnAngles):
    """The namespace of degrees: what is drawn has degree 1, cosine and sine of a drawn angle are quotients of degree 2.

    Args:
        roots: what each call of `sqrt` gives, in their order, as `assur.numerics.residues.Draws.roots` has noted it: a
            root by its name, or None.

    >>> ns = Degrees(["root"])
    >>> x = ns.uniform()
    >>> (ns.sqrt(x * x + 1) / x - 1).bound
    2.0
    """

    def __init__(self, roots: Sequence[object]) -> None:
        self._roots, self._calls = roots, 0
        self.positive: list[Degree] = []

    def number(self, value: Any) -> Fraction:
        """A constant."""
        return Fraction(value)

    def vanishes(self, _number: Any, /) -> bool:
        """Whether a number may be zero everywhere."""
        return True

    def uniform(self) -> Degree:
        """What is drawn."""
        return Degree(1)

    def circle(self) -> tuple[Degree, Degree]:
        """Cosine and sine of a drawn angle."""
        half = Degree(2)
        return Degree(2, {half: (2, 1)}), Degree(2, {half: (2, 1)})

    def signs(self) -> Degree:
        """1 or -1."""
        return Degree()

    def multiple(self, _turns: Fraction) -> tuple[Degree, Degree]:
        """Cosine and sine of a share of a turn."""
        return Degree(), Degree()

    def sqrt(self, radicand: Any, /) -> Degree:
        """A root."""
        name = self._roots[self._calls]
        self._calls += 1
        if not isinstance(radicand, Degree):
            return Degree()
        own = (radicand.over + radicand.below) / 2
        return Degree(own, radicand.under, radicand.roots | ({name} if name is not None else frozenset()))
