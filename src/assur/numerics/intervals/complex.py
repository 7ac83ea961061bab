"""Complex numbers made of two numbers of any real type: intervals, or duals of them.

So a kernel that adds and multiplies can be read over complex unknowns whose parts have bounds and derivatives.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from assur.numerics.powers import whole_power


@dataclass(frozen=True, eq=False)
class Complex:
    """real + i imaginary; a number of another type on either side of + - * counts as real.

    >>> from assur.numerics.intervals.interval import Interval
    >>> square = Complex(Interval.of(1.0), Interval.of(2.0)) * Complex(1.0, 2.0)
    >>> bool(square.real.contains(-3.0)), bool(square.imaginary.contains(4.0))
    (True, True)
    """

    real: Any
    imaginary: Any

    # an array on the left must leave the operator to the complex number on the right
    __array_ufunc__ = None

    def __neg__(self) -> Complex:
        return Complex(-self.real, -self.imaginary)

    def __pos__(self) -> Complex:
        return self

    def __add__(self, other: Any) -> Complex:
        if isinstance(other, Complex):
            return Complex(self.real + other.real, self.imaginary + other.imaginary)
        return Complex(self.real + other, self.imaginary)

    def __sub__(self, other: Any) -> Complex:
        return Complex.__add__(self, -other)

    def __pow__(self, exponent: int) -> Any:
        return whole_power(self, exponent)

    def __mul__(self, other: Any) -> Complex:
        if not isinstance(other, Complex):
            return Complex(self.real * other, self.imaginary * other)
        crossed = self.real * other.imaginary + self.imaginary * other.real
        return Complex(self.real * other.real - self.imaginary * other.imaginary, crossed)

    def __radd__(self, other: Any) -> Complex:
        return Complex.__add__(self, other)

    def __rsub__(self, other: Any) -> Complex:
        return Complex.__add__(-self, other)

    def __rmul__(self, other: Any) -> Complex:
        return Complex.__mul__(self, other)
