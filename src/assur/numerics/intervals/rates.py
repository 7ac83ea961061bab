"""Rates of functions that are not smooth: bounds of (f(u) - f(v)) / (u - v) for two arguments, without derivatives."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from assur.numerics.intervals.interval import Interval, as_interval


def clamped_root(radicand: Interval) -> Interval:
    """Bounds (...) of the root of max(x, 0), as defined as the radicand is.

    >>> root = clamped_root(Interval.of(-1.0, 4.0))
    >>> float(root.low), bool(root.contains(2.0)), bool(root.defined)
    (0.0, True, True)
    """
    root = radicand.sqrt()
    return Interval(root.low, root.high, radicand.defined)


def sign_rate(whole: Interval) -> Interval:
    """Bounds (...) of (|u| - |v|) / (u - v) for two numbers of an interval: one of -1 and 1 where the sign is certain.

    As defined as the interval is.

    >>> rate = sign_rate(Interval.of([-2.0, 1.0], [3.0, 3.0]))
    >>> rate.low, rate.high
    (array([-1.,  1.]), array([1., 1.]))
    """
    low = np.where(whole.low >= 0, 1.0, -1.0)
    high = np.where(whole.high <= 0, -1.0, 1.0)
    return Interval(np.minimum(low, high), np.maximum(low, high), whole.defined)


def root_rate(whole: Interval, centre: Interval) -> Interval:
    """Bounds (...) of (r(u) - r(v)) / (u - v) for u in `whole`, v in `centre` and r the root of max(x, 0).

    With both above zero it is 1 / (r(u) + r(v)). With one below it is r / (r^2 + depth) of the other one, which lies
    between zero and 1 / r; nothing bounds it where both may be zero.

    >>> rate = root_rate(Interval.of(1.0, 9.0), Interval.of(4.0))
    >>> float(rate.low.round(6)), float(rate.high.round(6))
    (0.2, 0.333333)
    """
    root, root_at = clamped_root(whole), clamped_root(centre)
    above = 1.0 / (root + root_at)  # no upper bound where both may be zero
    least, most = np.maximum(above.low, 0.0), above.high
    # u below zero, v above: root(v) / (v - u) is at most 1 / root(v), which is the bound above, and at least this
    finite = np.isfinite(whole.low) & np.isfinite(centre.high)
    start, end = np.where(finite, whole.low, 0.0), np.where(finite, centre.high, 1.0)
    slanted = (as_interval(root_at.low) / (as_interval(np.maximum(end, start)) - start)).low
    slanted = np.where(finite, slanted, 0.0)
    below = np.minimum(whole.low, centre.low) < 0
    least = np.where(below, np.minimum(least, np.where(slanted > 0, slanted, 0.0)), least)
    # v below zero, u above: root(u) / (u + depth) is at most 1 / (2 root(depth))
    most = np.where(centre.high < 0, (0.5 / clamped_root(-centre)).high, most)
    least = np.where(centre.low < 0, 0.0, least)
    return Interval(least, np.maximum(least, most), whole.defined & centre.defined)


class ClampedIntervals:
    """Namespace for a kernel over intervals; a root of a negative number is zero, and counts as defined.

    >>> root = ClampedIntervals().sqrt(Interval.of(-1.0, 4.0))
    >>> float(root.low), bool(root.contains(2.0)), bool(root.defined)
    (0.0, True, True)
    """

    def sqrt(self, radicand: Interval | ArrayLike, /) -> Interval:
        """Root of max(radicand, 0)."""
        return clamped_root(as_interval(radicand))
