"""Intervals over arrays: lower and upper bounds that enclose the exact result of + - * / and the functions of kernels.

Every operation is total: where it has no value for part of its arguments (division by an interval with zero, the root
of a negative number) it returns bounds of all values it does have, and `defined` turns False there and stays so.
Nothing is ever proved by a number that is not defined. NaN and infinity are no numbers: as an operand they are the
whole line, not defined; an infinite bound only says that there is none.

Where the same letter occurs twice the bounds are those of two independent numbers, with one exception: `x * x` with
one and the same object is its square. So two numbers that may differ need two objects, even if their bounds agree.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import reduce, wraps
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UsageError
from assur.numerics.intervals import rounding
from assur.numerics.powers import whole_power

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
Real: TypeAlias = "FloatArray | float | int"
Ends: TypeAlias = "tuple[FloatArray, ...]"
NUMBERS = (np.ndarray, np.generic, float, int)


def _between_numbers(operation: Callable[[Any, Any], Interval]) -> Callable[[Any, Any], Interval]:
    """An operator that leaves other number types, which hold intervals themselves (a dual, a polynomial), to those."""

    @wraps(operation)
    def checked(number: Interval, other: Any) -> Interval:
        known = isinstance(other, (Interval, *NUMBERS))
        return operation(number, other) if known else NotImplemented

    return checked


@dataclass(frozen=True, eq=False)
class Interval:
    """All numbers from `low` to `high`, elementwise over arrays that broadcast against each other.

    Attributes:
        low, high: (...) bounds, in any unit; low <= high, the infinite ones allowed.
        defined: (...) False where an operation on the way had no value for part of its arguments.

    A float, an integer up to 2^53 or an array may stand on either side of an operator; it counts as exact. `x * x`
    with one and the same object is its square, not the product of two independent numbers: never pass one object for
    two coordinates.

    >>> x = Interval.of([-1.0, 2.0], [1.0, 3.0])
    >>> (x * x).contains(0.0), (x - x).contains(0.0), (1 / x).defined
    (array([ True, False]), array([ True,  True]), array([False,  True]))
    """

    low: FloatArray
    high: FloatArray
    defined: BoolArray

    def __post_init__(self) -> None:
        rounding.check_nearest()

    # An array on the left must leave the operator to the interval on the right.
    __array_ufunc__ = None

    @classmethod
    def of(cls, low: ArrayLike, high: ArrayLike | None = None) -> Interval:
        """From bounds (...), or exact numbers where only one is given.

        Errors:
            UsageError: NaN, low above high, or low infinite upwards, or high downwards: such a set is empty.
        """
        below = np.asarray(low, dtype=float)
        above = below if high is None else np.asarray(high, dtype=float)
        below, above = np.broadcast_arrays(below, above)
        wrong = ~((below <= above) & (below < np.inf) & (above > -np.inf))
        if np.any(wrong):
            offending = f"[{below[wrong][0]:.17g}, {above[wrong][0]:.17g}]"
            raise UsageError(
                f"an interval holds numbers: low <= high, neither NaN, not both the same infinity; found {offending}",
                hint="swap the bounds, or leave out what is empty",
            )
        return cls(below, above, np.ones(below.shape, dtype=bool))

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the array."""
        return self.low.shape

    @property
    def middle(self) -> FloatArray:
        """A float (...) inside: the middle, or a finite number where a bound is infinite."""
        half = _quiet(np.add, 0.5 * self.low, 0.5 * self.high)
        if not np.isfinite(half).all():
            half = 0.5 * np.nan_to_num(self.low) + 0.5 * np.nan_to_num(self.high)
        return np.asarray(np.minimum(np.maximum(half, self.low), self.high))

    @property
    def width(self) -> FloatArray:
        """Upper bound (...) of the distance of the bounds: 0 of an exact number, infinity where there is no bound."""
        return rounding.up_sum(_quiet(np.subtract, self.high, self.low))

    @property
    def magnitude(self) -> FloatArray:
        """Largest absolute value (...)."""
        return np.maximum(-self.low, self.high)

    @property
    def positive(self) -> BoolArray:
        """Where (...) every number is certainly above zero, and defined."""
        return (self.low > 0) & self.defined

    @property
    def negative(self) -> BoolArray:
        """Where (...) every number is certainly below zero, and defined."""
        return (self.high < 0) & self.defined

    @property
    def nonzero(self) -> BoolArray:
        """Where (...) zero is certainly not inside."""
        return self.positive | self.negative

    def contains(self, number: ArrayLike) -> BoolArray:
        """Where (...) a number lies inside."""
        value = np.asarray(number, dtype=float)
        return np.asarray((self.low <= value) & (value <= self.high))

    def within(self, other: Interval) -> BoolArray:
        """Where (...) it is defined and lies in the interior of another, bounds left out."""
        return (other.low < self.low) & (self.high < other.high) & self.defined

    def __getitem__(self, index: Any) -> Interval:
        defined = self.defined
        if defined.shape != self.low.shape:
            defined = np.broadcast_to(defined, self.low.shape)
        return Interval(self.low[index], self.high[index], defined[index])

    def __pos__(self) -> Interval:
        return self

    def __neg__(self) -> Interval:
        return Interval(-self.high, -self.low, self.defined)

    def __abs__(self) -> Interval:
        least = np.maximum(np.maximum(self.low, -self.high), 0.0)
        return Interval(least, self.magnitude, self.defined)

    @_between_numbers
    def __add__(self, other: Interval | Real) -> Interval:
        low, high, defined = _parts(other)
        least, most = _quiet(np.add, self.low, low), _quiet(np.add, self.high, high)
        return Interval(rounding.down_sum(least), rounding.up_sum(most), self.defined & defined)

    @_between_numbers
    def __sub__(self, other: Interval | Real) -> Interval:
        low, high, defined = _parts(other)
        least, most = _quiet(np.subtract, self.low, high), _quiet(np.subtract, self.high, low)
        return Interval(rounding.down_sum(least), rounding.up_sum(most), self.defined & defined)

    def __pow__(self, exponent: int) -> Any:
        return whole_power(self, exponent)

    @_between_numbers
    def __mul__(self, other: Interval | Real) -> Interval:
        if other is self:
            return self.square()
        low, high, defined = _parts(other)
        least, most = _corners(np.multiply, (self.low, self.high), (low,) if low is high else (low, high))
        if low is high and np.any(low == 0):  # any number times an exact zero is an exact zero
            least, most = np.where(low == 0, 0.0, least), np.where(low == 0, 0.0, most)
        return Interval(least, most, self.defined & defined)

    def square(self) -> Interval:
        """The squares of all its numbers: never below zero."""
        size = abs(self)
        least, most = _quiet(np.multiply, size.low, size.low), _quiet(np.multiply, size.high, size.high)
        return Interval(np.maximum(rounding.down(least), 0.0), rounding.up(most), self.defined)

    @_between_numbers
    def __truediv__(self, other: Interval | Real) -> Interval:
        low, high, defined = _parts(other)
        around = (low <= 0) & (high >= 0)
        if not np.any(around):
            ends = (low,) if low is high else (low, high)
            return Interval(*_corners(np.divide, (self.low, self.high), ends), self.defined & defined)
        # a divisor with zero for a bound has numbers on one side of it only, and 1/0 is the infinity of that side
        ends = (np.where(low == 0, 0.0, low), np.where(high == 0, -0.0, high))
        least, most = _corners(np.divide, (self.low, self.high), ends)
        # with zero inside, or nothing else, there is no bound at all, unless of 0/y
        inside = (((low < 0) & (high > 0)) | ((low == 0) & (high == 0))) & ((self.low != 0) | (self.high != 0))
        least, most = np.where(inside, -np.inf, least), np.where(inside, np.inf, most)
        return Interval(least, most, self.defined & defined & ~around)

    def __radd__(self, other: Real) -> Interval:
        return self + other

    def __rsub__(self, other: Real) -> Interval:
        return -self + other

    def __rmul__(self, other: Real) -> Interval:
        return self * other

    def __rtruediv__(self, other: Real) -> Interval:
        return as_interval(other) / self

    def sqrt(self) -> Interval:
        """Root of max(x, 0), as `Floats` has it; not defined where part of it is negative."""
        low, high = np.sqrt(np.maximum(self.low, 0.0)), np.sqrt(np.maximum(self.high, 0.0))
        return Interval(rounding.down_sum(low), rounding.up_sum(high), self.defined & (self.low >= 0))

    def __repr__(self) -> str:
        return f"Interval(low={self.low!r}, high={self.high!r}, defined={self.defined!r})"


def as_interval(number: Interval | ArrayLike) -> Interval:
    """An interval as it is; a number as the exact interval of it."""
    return number if isinstance(number, Interval) else Interval(*_parts(number))


def common(a: Interval, b: Interval) -> tuple[Interval, BoolArray]:
    """What two intervals have in common, and where (...) that is certainly nothing; there the first one is returned.

    Where one of them is not defined, having nothing in common proves nothing.
    """
    low, high = np.maximum(a.low, b.low), np.minimum(a.high, b.high)
    defined, apart = a.defined & b.defined, low > high
    return Interval(np.where(apart, a.low, low), np.where(apart, a.high, high), defined), apart & defined


def _parts(number: Interval | ArrayLike) -> tuple[FloatArray, FloatArray, BoolArray]:
    """Bounds and definedness of a number; the bounds of an exact one are the same object."""
    if isinstance(number, Interval):
        return number.low, number.high, number.defined
    value = np.asarray(number, dtype=float)
    known = np.isfinite(value)
    if known.all():
        return value, value, known
    return np.where(known, value, -np.inf), np.where(known, value, np.inf), known


def _quiet(operation: Callable[..., Any], a: FloatArray, b: FloatArray) -> FloatArray:
    """A float operation whose overflow, 0/0 and the like are handled by who asks."""
    with np.errstate(all="ignore"):
        return np.asarray(operation(a, b))


def _corners(operation: Callable[..., Any], ends: Ends, others: Ends) -> tuple[FloatArray, FloatArray]:
    """Outward bounds of a product or quotient, which lie at ends of both; 0 inf, 0/0 and inf/inf have the limit 0."""
    with np.errstate(all="ignore"):
        products = [operation(a, b) for a in ends for b in others]
    least, most = reduce(np.minimum, products), reduce(np.maximum, products)
    if np.isnan(least).any():
        products = [np.where(np.isnan(corner), 0.0, corner) for corner in products]
        least, most = reduce(np.minimum, products), reduce(np.maximum, products)
    return rounding.down(least), rounding.up(most)
