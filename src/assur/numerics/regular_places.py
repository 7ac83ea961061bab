"""Regular places between two decimal numbers, each rounded once: parts of a grid have the places of the whole."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

EXACT = 2**53
"""Below, every whole number is a float, so that a quotient of two is rounded once."""


def regular_places(low: float, high: float, count: int) -> NDArray[np.float64]:
    """Low + k (high - low)/(count - 1) for k from 0 on, (count,): the nearest float to each.

    Both ends are taken as the decimal numbers that they are written as: a grid from 5.1 to 10 has the places that a
    grid from 0 to 10 has there, to the last bit. Of one place there is the middle.

    Example:
        >>> regular_places(0.0, 1.0, 11)[3], np.linspace(0.0, 1.0, 11)[3]
        (np.float64(0.3), np.float64(0.30000000000000004))
    """
    if count == 1:
        return np.array([0.5 * (low + high)])
    first, last = Fraction(repr(float(low))), Fraction(repr(float(high)))
    shared = math.lcm(first.denominator, last.denominator)
    a, b, under = int(first * shared), int(last * shared), shared * (count - 1)
    if max(abs(a), abs(b)) * (count - 1) < EXACT and under < EXACT:
        k = np.arange(count)
        return np.asarray((a * (count - 1 - k) + b * k) / float(under))
    return np.array([(a * (count - 1 - k) + b * k) / under for k in range(count)])  # Python rounds once at any size
