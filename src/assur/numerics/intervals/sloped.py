"""Numbers with slopes: by how much a function can differ from its value at the middle of a box, all over the box.

A `Sloped` number holds enclosures of f(c), of f(X) and of slopes S_k, so that for every x of the box X at which f has a
value, f(x) = f(c) + s_1 (x_1 - c_1) + ... with some s_k in S_k. Slopes need no derivative: that of a root stays bounded
where the radicand reaches zero, and its bounds are about half as wide as those of derivatives (R. Krawczyk, A.
Neumaier, Interval slopes for rational functions and associated centered forms, SIAM J. Numer. Anal. 22, 1985).

Where an operation has no value (a divisor that is zero) nothing is said of the result there; `whole.defined` tells.
A root is that of max(x, 0) everywhere. The enclosures may also be recorded numbers that stand for them: so a kernel is
read once, and what is left to do are operations on intervals.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from assur.numerics.intervals.functions import cosine_sine
from assur.numerics.intervals.interval import Interval, as_interval, common
from assur.numerics.intervals.rates import clamped_root, root_rate, sign_rate
from assur.numerics.intervals.shapes import broadcast
from assur.numerics.powers import whole_power
from assur.numerics.recording.tape import Recorded

FloatArray = NDArray[np.float64]
Slopes: TypeAlias = "tuple[Interval | None, ...]"
Constant: TypeAlias = "Interval | FloatArray | float"


@dataclass(frozen=True, eq=False)
class Sloped:
    """A function over boxes (N,) of k coordinates.

    Attributes:
        centre, whole: enclosures (N,) of its value at the middle, and of all its values over the box.
        slopes: k enclosures (N,); None where it does not depend on the coordinate.

    The square over [1, 3]: 4 in the middle, and (x^2 - 4) / (x - 2) = x + 2 lies in [3, 5].

    >>> x = coordinate(Interval.of([1.0], [3.0]), np.array([2.0]), 0, 1)
    >>> (x * x).slopes[0].low.round(6), (x * x).slopes[0].high.round(6)
    (array([3.]), array([5.]))
    """

    centre: Interval
    whole: Interval
    slopes: Slopes

    # an array on the left must leave the operator to the sloped number on the right
    __array_ufunc__ = None

    def of(self, rows: NDArray[np.intp], count: int) -> Sloped:
        """The same over some of so many boxes."""
        centre, whole = (broadcast(part, (count,))[rows] for part in (self.centre, self.whole))
        return Sloped(centre, whole, _each(lambda slope: broadcast(slope, (count,))[rows], self.slopes))

    def __neg__(self) -> Sloped:
        return Sloped(-self.centre, -self.whole, _each(lambda s: -s, self.slopes))

    def __abs__(self) -> Sloped:
        """Slopes of the magnitude are between -1 and 1, and one of both where the sign is certain."""
        rate = _applied("sign rate", sign_rate, self.whole)
        return Sloped(abs(self.centre), abs(self.whole), _each(lambda s: s * rate, self.slopes))

    def __add__(self, other: Sloped | Constant) -> Sloped:
        if not isinstance(other, Sloped):
            return Sloped(self.centre + other, self.whole + other, self.slopes)
        slopes = _both(lambda s: s, lambda s: s, self.slopes, other.slopes)
        return Sloped(self.centre + other.centre, self.whole + other.whole, slopes)

    def __sub__(self, other: Sloped | Constant) -> Sloped:
        return self + -other

    def __pow__(self, exponent: int) -> Any:
        return whole_power(self, exponent)

    def __mul__(self, other: Sloped | Constant) -> Sloped:
        """With f g - f(c) g(c) = (f - f(c)) g(c) + f (g - g(c)); of a square (f - f(c)) (f + f(c))."""
        if other is self:
            total = self.whole + self.centre
            slopes = _each(lambda s: s * total, self.slopes)
            return Sloped(self.centre * self.centre, self.whole * self.whole, slopes)
        if not isinstance(other, Sloped):
            return Sloped(self.centre * other, self.whole * other, _each(lambda s: s * other, self.slopes))
        slopes = _both(lambda s: s * other.centre, lambda s: self.whole * s, self.slopes, other.slopes)
        return Sloped(self.centre * other.centre, self.whole * other.whole, slopes)

    def __truediv__(self, other: Sloped | Constant) -> Sloped:
        """With q = f / g, q - q(c) = ((f - f(c)) - q(c) (g - g(c))) / g."""
        if not isinstance(other, Sloped):
            return Sloped(self.centre / other, self.whole / other, _each(lambda s: s / other, self.slopes))
        quotient = self.centre / other.centre
        slopes = _both(lambda s: s, lambda s: -(quotient * s), self.slopes, other.slopes)
        return Sloped(quotient, self.whole / other.whole, _each(lambda s: s / other.whole, slopes))

    def __radd__(self, other: Constant) -> Sloped:
        return self + other

    def __rsub__(self, other: Constant) -> Sloped:
        return -self + other

    def __rmul__(self, other: Constant) -> Sloped:
        return self * other

    def __rtruediv__(self, other: Constant) -> Sloped:
        quotient = other / self.centre
        slopes = _each(lambda s: -(quotient * s) / self.whole, self.slopes)
        return Sloped(quotient, other / self.whole, slopes)

    def sqrt(self) -> Sloped:
        """Root of max(x, 0), without a word about negative radicands."""
        centre, whole = (_applied("root", clamped_root, number) for number in (self.centre, self.whole))
        rate = _applied("root rate", root_rate, self.whole, self.centre)
        return Sloped(centre, whole, _each(lambda s: s * rate, self.slopes))


class SlopedNumbers:
    """Namespace for a kernel over sloped numbers."""

    def sqrt(self, radicand: Sloped | Constant, /) -> Sloped | Interval:
        """Root of max(radicand, 0)."""
        return radicand.sqrt() if isinstance(radicand, Sloped) else clamped_root(as_interval(radicand))


def coordinate(whole: Interval, centre: FloatArray, index: int, size: int) -> Sloped:
    """The coordinate of that number of boxes (N,) with given middles (N,)."""
    return Sloped(Interval.of(centre), whole, _alone(as_interval(np.ones(1)), index, size))


def turn(whole: Interval, centre: FloatArray, index: int, size: int, share: float = 1.0) -> tuple[Sloped, Sloped]:
    """Cosine and sine of a share of an angle over boxes (N,): their slopes are derivatives (mean value theorem)."""
    cosine, sine = cosine_sine(whole * share)
    cosine_at, sine_at = cosine_sine(Interval.of(centre) * share)
    return (
        Sloped(cosine_at, cosine, _alone(-sine * share, index, size)),
        Sloped(sine_at, sine, _alone(cosine * share, index, size)),
    )


def _applied(name: str, function: Callable[..., Any], *numbers: Any) -> Any:
    """A function of intervals, or the operation of that name on recorded ones."""
    first = numbers[0]
    return first.recorder.apply(name, *numbers) if isinstance(first, Recorded) else function(*numbers)


def _alone(slope: Interval, index: int, size: int) -> Slopes:
    return tuple(slope if k == index else None for k in range(size))


def _each(function: Callable[[Interval], Interval], slopes: Slopes) -> Slopes:
    return tuple(None if slope is None else function(slope) for slope in slopes)


def _both(
    of_first: Callable[[Interval], Interval], of_second: Callable[[Interval], Interval], first: Slopes, second: Slopes
) -> Slopes:
    """Sums of what two functions make of the slopes of two numbers."""
    sums: list[Interval | None] = []
    for a, b in zip(first, second, strict=True):
        if a is None or b is None:
            sums.append(of_first(a) if a is not None else of_second(b) if b is not None else None)
        else:
            sums.append(of_first(a) + of_second(b))
    return tuple(sums)


def ranged(number: Sloped, offsets: Sequence[Interval]) -> Interval:
    """Bounds (N,) over the box: those of `whole`, and what the slopes allow at offsets (N,) from the middle.

    >>> x = coordinate(Interval.of([0.0], [1.0]), np.array([0.5]), 0, 1)
    >>> found = ranged(x * (1 - x), [Interval.of([-0.5], [0.5])])  # natural: [0, 1]
    >>> abs(found.low).round(6), found.high.round(6)
    (array([0.]), array([0.5]))
    """
    total: Any = number.centre
    for slope, offset in zip(number.slopes, offsets, strict=True):
        if slope is not None:
            total = total + slope * offset
    usable = number.centre.defined & np.isfinite(total.low) & np.isfinite(total.high)
    low, high = np.where(usable, total.low, -np.inf), np.where(usable, total.high, np.inf)
    whole = number.whole
    narrowed = common(whole, Interval(low, high, whole.defined))[0]
    return Interval(narrowed.low, narrowed.high, whole.defined)
