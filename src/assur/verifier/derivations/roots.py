"""All roots of a polynomial at once: numbers modulo a prime and modulo the polynomial, with roots of such beside it.

What vanishes there vanishes at every root, for either sign of each root of a number. No root need be found.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from flint import fmpz_mod_ctx, fmpz_mod_poly, fmpz_mod_poly_ctx

from assur.verifier.field import Element, NoRootError
from assur.verifier.reading import RefusedError, require


def interpolated(value: Callable[[Element, Element], Any], degree: int, p: int) -> fmpz_mod_poly:
    """A polynomial in t of so low a degree over (1 + t^2)^(degree / 2), from its values at cosines and sines.

    Errors:
        NoRootError: a value is no residue.
        RefusedError: it is another function, or one of less degree, or with multiple roots.

    >>> own = interpolated(lambda c, s: c * c - s, 4, 10007)
    >>> own.degree(), int(own(0))
    (4, 1)
    """
    ring = fmpz_mod_poly_ctx(fmpz_mod_ctx(p))
    total, places = ring([0]), range(2, degree + 4)  # one more than it needs, which tells whether the degree is less
    values = {t: _at(value, t, degree, p) for t in places}
    whole = ring([1])
    for t in places:
        whole = whole * ring([-t, 1])
    for t, own in values.items():
        basis = whole // ring([-t, 1])
        total = total + basis * ring([own * pow(int(basis(t)), -1, p) % p])
    if total.degree() != degree or total.gcd(ring([1, 0, 1])).degree() > 0:
        raise RefusedError(f"the polynomial is not of degree {degree} at what is drawn")
    require(total.gcd(total.derivative()).degree() <= 0, "the polynomial has multiple roots")
    return total


def _at(value: Callable[[Element, Element], Any], t: int, degree: int, p: int) -> int:
    size = (1 + t * t) % p
    over = pow(size, -1, p)
    own = Element(p, 0).of(value(Element(p, (1 - t * t) * over % p), Element(p, 2 * t * over % p)))
    return _residue(own) * pow(size, degree // 2, p) % p


def _residue(own: Element) -> int:
    if own.b:
        raise NoRootError("a number that is no residue")
    return own.a


@dataclass(frozen=True, slots=True)
class RootNumber:
    """A polynomial in t modulo another, or a + b r with r^2 such a number."""

    first: Any
    modulus: fmpz_mod_poly
    second: RootNumber | None = None
    square: RootNumber | None = None

    @property
    def zero(self) -> bool:
        """Whether it vanishes at every root."""
        if self.second is None:
            return bool(self.first == 0)
        return bool(self.first.zero and self.second.zero)

    @property
    def level(self) -> int:
        """How many roots of numbers it may have in it."""
        return 0 if self.second is None else 1 + self.second.level

    def of(self, other: Any) -> RootNumber:
        """A number of the field as one of these."""
        if isinstance(other, RootNumber):
            return other
        p = int(self.modulus.modulus())
        own = _residue(Element(p, 0).of(other))
        return RootNumber(self.modulus * 0 + own, self.modulus)

    def _raised(self, like: RootNumber) -> RootNumber:
        """The same with as many roots as another."""
        if self.level == like.level or like.second is None:
            return self
        return RootNumber(self._raised(like.second), self.modulus, like.second * 0, like.square)

    def _pair(self, other: Any) -> tuple[RootNumber, RootNumber]:
        own = self.of(other)
        return (self._raised(own), own) if self.level < own.level else (self, own._raised(self))

    def __add__(self, other: Any) -> RootNumber:
        a, b = self._pair(other)
        if a.second is None or b.second is None:
            return RootNumber(a.first + b.first, a.modulus)
        return RootNumber(a.first + b.first, a.modulus, a.second + b.second, a.square)

    def __mul__(self, other: Any) -> RootNumber:
        a, b = self._pair(other)
        if a.second is None or b.second is None or a.square is None:
            return RootNumber(a.first * b.first % a.modulus, a.modulus)
        first = a.first * b.first + a.second * b.second * a.square
        return RootNumber(first, a.modulus, a.first * b.second + a.second * b.first, a.square)

    __radd__, __rmul__ = __add__, __mul__

    def __neg__(self) -> RootNumber:
        return self * -1

    def __sub__(self, other: Any) -> RootNumber:
        return self + -self.of(other)

    def __rsub__(self, other: Any) -> RootNumber:
        return self.of(other) + -self

    def __truediv__(self, other: Any) -> RootNumber:
        return self * self.of(other).inverse()

    def __rtruediv__(self, other: Any) -> RootNumber:
        return self.of(other) * self.inverse()

    def inverse(self) -> RootNumber:
        """One over it. Errors: RefusedError, where it vanishes at a root."""
        if self.second is None or self.square is None:
            shared, factor, _ = self.first.xgcd(self.modulus)
            require(shared.degree() == 0, "a formula divides by what vanishes at a root of the polynomial")
            return RootNumber(factor, self.modulus)  # the divisor that xgcd gives is 1
        norm = (self.first * self.first - self.second * self.second * self.square).inverse()
        return RootNumber(self.first * norm, self.modulus, -self.second * norm, self.square)

    def root(self, last: RootNumber | None = None) -> RootNumber:
        """A root of it, of either sign whatever those of the roots up to the last one are.

        Errors:
            RefusedError: it vanishes at a root of the polynomial, where both signs are one.
        """
        square = self if last is None else self._raised(last)
        square.inverse()
        return RootNumber(square * 0, self.modulus, square * 0 + 1, square)


def circle_at_roots(polynomial: fmpz_mod_poly) -> tuple[RootNumber, RootNumber]:
    """Cosine and sine of the angle the tangent of whose half is a root."""
    t = RootNumber((polynomial * 0 + 1).left_shift(1) % polynomial, polynomial)
    return (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
