"""Discs that hold the roots of a polynomial whose coefficients are only known to lie in intervals.

For any d distinct points z_i all roots lie in the discs about z_i of radius d |p(z_i)| / |a_d prod (z_i - z_j)|, and a
group of k discs that meets no other holds k roots (B. T. Smith, Error bounds for zeros of a polynomial based upon
Gerschgorin's theorems, J. ACM 17, 1970). The points are roots found in floats; the radii are worked out over
intervals, so the statement holds for every polynomial within the coefficients' bounds. Coefficients are real: where a
disc that stands alone has a real centre, its root is its own conjugate, and real.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.numerics import polynomials
from assur.numerics.intervals.interval import Interval

FloatArray = NDArray[np.float64]
NEARLY_REAL = 1e-6
"""Imaginary part, against 1 + |z|, below which a root in floats is tried as a real one."""


@dataclass(frozen=True, eq=False)
class RootDiscs:
    """Where the roots of a real polynomial are.

    Attributes:
        real: (k,) bounds of simple real roots, rising.
        undecided: (u,) stretches of the real line that may hold other real roots, more or fewer.
        decided: whether the discs say anything: the leading coefficient is not zero, and everything is finite.
    """

    real: Interval
    undecided: Interval
    decided: bool


def root_discs(coefficients: Interval) -> RootDiscs:
    """The real roots of a polynomial with coefficients (d + 1,), the constant term first.

    Outside `real` and `undecided` there is certainly no real root.

    Example: x^3 - 2 x has three; x^2 - 2 x + 1 with coefficients that are not exact has two, or none.

    >>> found = root_discs(Interval.of([0.0, -2.0, 0.0, 1.0]))
    >>> found.real.middle.round(6).tolist(), len(found.undecided.low)
    ([-1.414214, 0.0, 1.414214], 0)
    >>> blurred = root_discs(Interval.of([1 - 1e-9, -2.0, 1.0], [1 + 1e-9, -2.0, 1.0]))
    >>> len(blurred.real.low), bool(blurred.undecided.contains(1.0)[0])
    (0, True)
    """
    degree = len(coefficients.low) - 1
    nothing = Interval.of(np.zeros(0))
    leading = coefficients[degree]
    if not (np.all(coefficients.defined) and np.all(np.isfinite(coefficients.width)) and leading.nonzero):
        return RootDiscs(nothing, nothing, decided=False)
    points = polynomials.roots(coefficients.middle)
    points = np.where(np.abs(points.imag) <= NEARLY_REAL * (1 + np.abs(points)), points.real, points)
    if not np.all(np.isfinite(points)):
        return RootDiscs(nothing, nothing, decided=False)
    points = _apart(points)
    radius = _radii(coefficients, points)
    if not np.all(np.isfinite(radius)):
        return RootDiscs(nothing, nothing, decided=False)
    x, y = Interval.of(points.real), Interval.of(points.imag)
    touching = ~_less_than(radius, abs(y))
    gap = _distance(x, y)
    alone = np.all(
        _less_than((Interval.of(radius[:, None]) + Interval.of(radius)).high, gap) | np.eye(degree, dtype=bool), -1
    )
    sure = alone & (points.imag == 0)
    doubtful = touching & ~sure
    low, high = (x - Interval.of(radius)).low, (x + Interval.of(radius)).high
    rows = np.flatnonzero(sure)
    rows = rows[np.argsort(points.real[rows])]
    return RootDiscs(Interval.of(low[rows], high[rows]), Interval.of(low[doubtful], high[doubtful]), decided=True)


def _apart(points: NDArray[np.complex128]) -> NDArray[np.complex128]:
    """The same points, equal ones moved from each other: any distinct points will do."""
    points = points.copy()
    for k in range(1, len(points)):
        while np.any(points[:k] == points[k]):
            points[k] += 1e-9 * (1 + abs(points[k]))
    return points


def _radii(coefficients: Interval, points: NDArray[np.complex128]) -> FloatArray:
    """Upper bounds (d,) of Smith's radii."""
    degree = len(points)
    x, y = Interval.of(points.real), Interval.of(points.imag)
    real, imaginary = coefficients[degree] + 0 * x, 0 * x
    for k in range(degree - 1, -1, -1):
        real, imaginary = real * x - imaginary * y + coefficients[k], real * y + imaginary * x
    product = abs(coefficients[degree]) + 0 * x
    gap = _distance(x, y)
    for j in range(degree):
        itself = np.arange(degree) == j
        column = gap[:, j]
        product = product * Interval(
            np.where(itself, 1.0, column.low), np.where(itself, 1.0, column.high), column.defined
        )
    bound = degree * (real.square() + imaginary.square()).sqrt() / product
    return np.where(bound.defined & np.isfinite(bound.high), bound.high, np.inf)


def _distance(x: Interval, y: Interval) -> Interval:
    """Distances (d, d) between the points."""
    dx, dy = x[:, None] - x[None, :], y[:, None] - y[None, :]
    return (dx.square() + dy.square()).sqrt()


def _less_than(number: FloatArray, bounds: Interval) -> NDArray[np.bool_]:
    """Where an upper bound is certainly smaller than a number."""
    return np.asarray((number < bounds.low) & bounds.defined)
