"""How much of a box lies where a function is not negative: bounds from its value in the middle and its slopes."""

from __future__ import annotations

import itertools
import math

import numpy as np
from numpy.typing import NDArray

from assur.numerics.intervals import rounding
from assur.numerics.intervals.sloped import Sloped

FloatArray = NDArray[np.float64]

FLATTEST = (1.0, 1e-7, 1e-4)
"""Rises are at least this share of their sum, by dimension less one: below it the volume's formula would cancel."""

UNIT = 2.0**-53
"""Largest relative error of one rounding."""


def shares(number: Sloped, reach: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Bounds (N,) of the share of boxes in which a number is not negative.

    Args:
        number: the number over boxes with its slopes.
        reach: (k, N) half extents of boxes of which the middle is exactly in the middle.

    In each of the 2^k parts that meet in the middle the number lies above the plane with the least slopes away from it,
    and below the one with the greatest. Where there is no bound they are 0 and 1.
    """
    own = [(slope, far) for slope, far in zip(number.slopes, reach, strict=True) if slope is not None]
    count = reach.shape[1]
    if not own:
        return np.zeros(count), np.ones(count)
    known = number.centre.defined & np.isfinite(number.centre.low) & np.isfinite(number.centre.high)
    for slope, _ in own:
        known = known & np.isfinite(slope.low) & np.isfinite(slope.high)
    least = [np.where(known, slope.low, 0.0) * far for slope, far in own]
    most = [np.where(known, slope.high, 0.0) * far for slope, far in own]
    parts = list(itertools.product((False, True), repeat=len(own)))
    shape = (len(own), len(parts), count)
    below, above = np.empty(shape), np.empty(shape)  # rises away from the middle over the whole part
    for k, part in itertools.product(range(len(own)), range(len(parts))):
        up = parts[part][k]
        below[k, part], above[k, part] = (least[k], most[k]) if up else (-most[k], -least[k])
    low = _mean(np.where(known, number.centre.low, 0.0), below, upper=False)
    high = _mean(np.where(known, number.centre.high, 0.0), above, upper=True)
    return np.where(known, low, 0.0), np.where(known, high, 1.0)


def _mean(start: FloatArray, rises: FloatArray, *, upper: bool) -> FloatArray:
    """A bound (N,) of the mean over parts (p) of the share above zero of start + rises . t, with t in [0, 1]^k.

    Args:
        start: (N,) value at the corner that all parts share.
        rises: (k, p, N) the rounded rises; what was lost by that is added here.
        upper: which bound.
    """
    lost = np.sum(np.abs(rises), axis=0) * 4 * UNIT + 1e-290
    middle = start + np.sum(rises, axis=0) / 2
    lost += np.abs(middle) * 8 * UNIT + np.abs(start) * 8 * UNIT
    bounds = share_bound(middle + lost if upper else middle - lost, rises / 2, upper=upper)
    size = bounds.shape[0] * 2 * UNIT
    return np.asarray(np.clip(np.mean(bounds, axis=0) + (size if upper else -size), 0.0, 1.0))


def share_bound(height: FloatArray, slopes: FloatArray, *, upper: bool) -> FloatArray:
    """A bound (...) of the share of the cube [-1, 1]^k in which height + slopes . t >= 0.

    Args:
        height: (...) value at the middle.
        slopes: (k, ...), by how much the value rises from the middle to each face; k from 1 to 3.
        upper: which bound.

    The share is the sum over corners of +- max(0, value there)^k, over k! 2^k times the product of the slopes. With
    A the sum of the slopes, |height| < A and u the rounding unit, a value is wrong by at most 2 k u A, its power by
    (k^2 + k) u (2 A)^k and the sum by less than 256 u (2 A)^k. A slope that is small beside A is made larger, and the
    height moved by the difference to stay a bound.

    >>> share_bound(np.array([0.0, 1.0]), np.array([[1.0, 1.0], [0.5, 0.0]]), upper=True).round(6)
    array([0.5, 1. ])
    """
    rise = np.abs(slopes)
    size = len(rise)
    least = np.maximum(FLATTEST[size - 1] * np.sum(rise, axis=0), 1e-90)
    steep = np.maximum(rise, least)
    moved = np.sum(steep - rise, axis=0) * (1 + 1e-12)
    height = rounding.up_sum(height + moved) if upper else rounding.down_sum(height - moved)
    share, wrong = _share(height, steep)
    whole = np.sum(steep, axis=0)
    far = whole * (1 + 16 * UNIT)
    above, below = (whole, far) if upper else (far, whole)
    inner = np.clip(share + (wrong if upper else -wrong), 0.0, 1.0)
    return np.where(height >= above, 1.0, np.where(height <= -below, 0.0, inner))


def _share(height: FloatArray, rise: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The share, rounded, and by how much it may be wrong."""
    size = len(rise)
    total: FloatArray = np.zeros(height.shape)
    with np.errstate(all="ignore"):  # what overflows is left out below
        for corner in itertools.product((-1.0, 1.0), repeat=size):
            value = height
            for sign, slope in zip(corner, rise, strict=True):
                value = value + slope if sign > 0 else value - slope
            power = value = np.maximum(value, 0.0)
            for _ in range(size - 1):
                power = power * value
            total = total + power if math.prod(corner) > 0 else total - power
        whole, product = np.sum(rise, axis=0), math.factorial(size) * np.prod(rise, axis=0)
        wrong = 256 * UNIT * whole**size / product + 16 * UNIT
        share = total / (product * 2.0**size)
    known = np.isfinite(wrong) & np.isfinite(share)
    return np.where(known, share, 0.5), np.where(known, wrong, 1.0)
