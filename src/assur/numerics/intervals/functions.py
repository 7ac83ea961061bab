"""Cosine and sine of intervals: the library's values at the ends, and 1 or -1 where a peak may lie between them.

The library's functions are not proved, so their error is an assumption, stated here and tested against multiple
precision: at most `ERROR` times the value, for arguments of any size (the vectorised ones of NumPy promise 4 units in
the last place, which is at most half of that; the C library's are within one). Everything else is proved: a peak is
counted wherever the outward bounds of (angle / 2 pi) allow one.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.numerics.intervals import rounding
from assur.numerics.intervals.interval import Interval

ERROR = 2.0**-49
"""Assumed bound of the relative error of the library's cosine and sine."""

TURN = Interval.of(2 * 3.141592653589793, 2 * 3.1415926535897936)
"""2 pi lies between: twice the two floats next to pi = 3.14159265358979323846..., the first of which is below it."""


CONVERTED = Interval.of(1 - 2.0**-51, 1 + 2.0**-51)
"""An angle in degrees over its float in rad lies between: roundings of the degrees that were read, of pi / 180 and of
their product are at most 2^-53 each, and the float next to pi is off by less than half of that.
"""

FARTHEST = 2.0**20
"""Radians up to which the error of the library's cosine and sine is known to be below ERROR."""


def cosine_sine(angle: Interval) -> tuple[Interval, Interval]:
    """Bounds (...) of the cosine and the sine of angles (...) in radians, between -1 and 1.

    As wide as the exact range and at most 1e-14 more, relative to the bound; one after the other they are those of
    two independent numbers. An angle that is not within FARTHEST has [-1, 1]: the library errs more there.

    >>> cosine, sine = cosine_sine(Interval.of([0.0, -0.5], [0.0, 4.0]))
    >>> cosine.contains([1.0, -1.0]), float(sine.high[1]), bool(sine.low[1] < np.sin(4.0))
    (array([ True,  True]), 1.0, True)
    """
    bounded = angle.magnitude <= FARTHEST  # a NaN is not
    low, high = np.where(bounded, angle.low, 0.0), np.where(bounded, angle.high, 0.0)
    turns = Interval(low, high, bounded) / TURN
    cosine = _between(np.cos(low), np.cos(high), ~bounded | _whole(turns), ~bounded | _whole(turns + 0.5))
    sine = _between(np.sin(low), np.sin(high), ~bounded | _whole(turns - 0.25), ~bounded | _whole(turns + 0.25))
    return Interval(*cosine, angle.defined), Interval(*sine, angle.defined)


def from_degrees(angle: ArrayLike) -> Interval:
    """Bounds (...) of angles of which these floats in rad are the ones converted from degrees.

    >>> float(from_degrees(np.radians(180.0)).low) < np.pi < 3.1415926535897936 <= float(from_degrees(np.pi).high)
    True
    """
    wide = Interval.of(angle) * CONVERTED
    zero = np.equal(angle, 0)
    return Interval(np.where(zero, 0.0, wide.low), np.where(zero, 0.0, wide.high), wide.defined)


def _whole(number: Interval) -> NDArray[np.bool_]:
    """Where (...) a whole number may lie inside."""
    return np.asarray(np.floor(number.high) >= np.ceil(number.low))


def _between(
    start: NDArray[np.float64], end: NDArray[np.float64], top: NDArray[np.bool_], bottom: NDArray[np.bool_]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Bounds from the values at both ends, and from where the function may reach 1 or -1 between."""
    least, most = np.minimum(start, end), np.maximum(start, end)
    low = rounding.down(least - np.abs(least) * ERROR)
    high = rounding.up(most + np.abs(most) * ERROR)
    return np.where(bottom, -1.0, np.maximum(low, -1.0)), np.where(top, 1.0, np.minimum(high, 1.0))
