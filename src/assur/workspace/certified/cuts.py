"""How much of a box lies on the positive side of a plane, with bounds on what rounding does."""

from __future__ import annotations

import itertools
import math

import numpy as np
from numpy.typing import NDArray

from assur.numerics.intervals.interval import Interval, as_interval

FloatArray = NDArray[np.float64]

FLATTEST = (1.0, 1e-4, 1e-3)
"""Slopes are at least this share of the greatest one, by dimension less one: below it the sum would cancel."""


def share(height: FloatArray, slopes: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Bounds (N,) of the share of the cube [-1, 1]^k in which height + slopes . t >= 0.

    Args:
        height: (N,) value at the middle.
        slopes: (k, N), by how much the value rises from the middle to each face; k from 1 to 3, not all zero.

    A slope that is small beside the greatest is made larger, and the height moved by the difference to stay a bound.

    >>> low, high = share(np.array([0.0, 1.0]), np.array([[1.0, 1.0], [0.5, 0.0]]))
    >>> low.round(3), high.round(3)
    (array([0.5, 1. ]), array([0.5, 1. ]))
    """
    rise = np.abs(slopes)
    least = FLATTEST[len(rise) - 1] * np.max(rise, axis=0)
    steep = np.maximum(rise, least)
    moved = np.sum(steep - rise, axis=0) * (1 + 1e-12)
    return _share(height - moved, steep)[0], _share(height + moved, steep)[1]


def _share(height: FloatArray, rise: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Bounds of the sum over corners of +- max(0, value)^k / (k! 2^k product of slopes)."""
    size = len(rise)
    total = as_interval(np.zeros(height.shape))
    for corner in itertools.product((-1.0, 1.0), repeat=size):
        value = as_interval(height)
        for sign, slope in zip(corner, rise, strict=True):
            value = value + as_interval(slope) * sign
        above = Interval(np.maximum(value.low, 0.0), np.maximum(value.high, 0.0), value.defined)
        power = above
        for _ in range(size - 1):
            power = power * above
        total = total + power if math.prod(corner) > 0 else total - power
    bottom = as_interval(np.full(height.shape, math.factorial(size) * 2.0**size))
    for slope in rise:
        bottom = bottom * slope
    found = total / bottom
    return np.clip(found.low, 0.0, 1.0), np.clip(found.high, 0.0, 1.0)
