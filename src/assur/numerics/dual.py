"""Dual numbers: a value and its derivative along one direction, carried through + - * / and sqrt.

With eps * eps = 0, f(a + a' eps) = f(a) + f'(a) a' eps, so a kernel that is read over duals returns exact
derivatives (forward-mode differentiation) without a step size.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from assur.numerics.intervals.interval import Interval, as_interval
from assur.numerics.powers import whole_power

Real: TypeAlias = "NDArray[np.float64] | float | Any"  # or an interval


@dataclass(frozen=True, eq=False)
class Dual:
    """value + derivative * eps, elementwise over arrays that broadcast against each other.

    Python scalars and arrays may stand on either side of an operator; they count as constants.

    Attributes:
        value: (...) the number, in any unit.
        derivative: (...) its derivative along the direction, in that unit per unit of the parameter.

    The area w * h of a rectangle whose width grows at the rate 1:

    >>> Dual(3.0, 1.0) * 2.0
    Dual(value=6.0, derivative=2.0)
    >>> 1 / Dual(2.0, 1.0)
    Dual(value=0.5, derivative=-0.25)
    """

    value: Real
    derivative: Real

    # An array on the left must leave the operator to the dual on the right.
    __array_ufunc__ = None

    def __neg__(self) -> Dual:
        return Dual(-self.value, -self.derivative)

    def __pos__(self) -> Dual:
        return self

    def __abs__(self) -> Dual:
        """At zero, where the magnitude has no derivative, it is 0; over an interval with zero in it, between both.

        >>> float(abs(Dual(-3.0, 2.0)).derivative)
        -2.0
        """
        value, derivative = self.value, self.derivative
        if isinstance(value, Interval):
            sign = Interval(np.where(value.low > 0, 1.0, -1.0), np.where(value.high < 0, -1.0, 1.0), value.defined)
            return Dual(abs(value), as_interval(derivative) * sign)
        return Dual(abs(value), np.sign(value) * derivative)

    def __add__(self, other: Dual | Real) -> Dual:
        value, derivative = _parts(other)
        return Dual(self.value + value, self.derivative + derivative)

    def __sub__(self, other: Dual | Real) -> Dual:
        value, derivative = _parts(other)
        return Dual(self.value - value, self.derivative - derivative)

    def __pow__(self, exponent: int) -> Any:
        return whole_power(self, exponent)

    def __mul__(self, other: Dual | Real) -> Dual:
        value, derivative = _parts(other)
        return Dual(self.value * value, self.derivative * value + self.value * derivative)

    def __truediv__(self, other: Dual | Real) -> Dual:
        value, derivative = _parts(other)
        quotient = self.value / value
        return Dual(quotient, (self.derivative - quotient * derivative) / value)

    def __radd__(self, other: Real) -> Dual:
        return self + other

    def __rsub__(self, other: Real) -> Dual:
        return -self + other

    def __rmul__(self, other: Real) -> Dual:
        return self * other

    def __rtruediv__(self, other: Real) -> Dual:
        quotient = other / self.value
        return Dual(quotient, -quotient * self.derivative / self.value)


class Duals:
    """Namespace for a kernel over dual numbers; a plain number is a constant.

    >>> Duals().sqrt(Dual(9.0, 1.0)).derivative.round(6)
    np.float64(0.166667)
    """

    def sqrt(self, radicand: Dual | Real, /) -> Dual:
        """Root of max(radicand, 0), as `Floats` has it.

        The derivative is r' / (2 sqrt r). Where the radicand is not positive there is none and it is NaN:
        at zero two branches merge and their slope is infinite, below zero the branch does not exist. The
        margins say which of the two it is.
        """
        value, derivative = _parts(radicand)
        root = np.sqrt(np.maximum(value, 0.0))
        slope = 0.5 / np.where(root > 0.0, root, np.nan)
        return Dual(root, slope * derivative)


class DualIntervals:
    """Namespace for a kernel over dual numbers whose parts are intervals: derivatives bounded over a box.

    >>> from assur.numerics.intervals.interval import Interval
    >>> slope = DualIntervals().sqrt(Dual(Interval.of(4.0, 9.0), Interval.of(1.0))).derivative
    >>> float(slope.low.round(6)), float(slope.high.round(6))
    (0.166667, 0.25)
    """

    def sqrt(self, radicand: Dual | Real, /) -> Dual:
        """Root of max(radicand, 0); its derivative is not defined where the radicand may be zero or negative."""
        value, derivative = _parts(radicand)
        root = as_interval(value).sqrt()
        return Dual(root, derivative * (0.5 / root))


def _parts(number: Dual | Real) -> tuple[Real, Real]:
    return (number.value, number.derivative) if isinstance(number, Dual) else (number, 0.0)
