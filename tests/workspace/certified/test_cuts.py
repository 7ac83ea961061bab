"""Shares of boxes above planes: against exact rationals, areas known by hand, and counting."""

import itertools
import math
from fractions import Fraction

import numpy as np
import pytest

from assur.numerics.intervals.interval import Interval
from assur.numerics.intervals.sloped import SlopedNumbers, coordinate
from assur.workspace.certified import cuts
from assur.workspace.certified.cuts import share_bound, shares

RNG = np.random.default_rng(5)


def bounds(height, slopes):
    return [share_bound(height, slopes, upper=upper) for upper in (False, True)]


def exact(height, slopes):
    """The share in rationals, by the formula that sums over corners."""
    total = Fraction(0)
    for corner in itertools.product((-1, 1), repeat=len(slopes)):
        value = height + sum(sign * slope for sign, slope in zip(corner, slopes, strict=True))
        total += math.prod(corner) * max(value, Fraction(0)) ** len(slopes)
    return total / (math.factorial(len(slopes)) * 2 ** len(slopes) * math.prod(slopes))


@pytest.mark.parametrize("size", [1, 2, 3])
def test_the_exact_share_lies_within_the_bounds(size):
    slopes = 10.0 ** RNG.uniform(-6, 0, size=(size, 300))
    height = RNG.uniform(-1.3, 1.3, size=300) * np.sum(slopes, axis=0)
    low, high = bounds(height, slopes)
    for k in range(300):
        wanted = exact(Fraction(float(height[k])), [Fraction(float(row[k])) for row in slopes])
        wanted = min(max(wanted, Fraction(0)), Fraction(1))
        assert Fraction(float(low[k])) <= wanted <= Fraction(float(high[k]))
    assert np.median(high - low) < 1e-9
    assert np.max(high - low) < (1e-12, 1e-6, 1e-3)[size - 1]


def test_shares_known_by_hand():
    low, high = bounds(np.array([0.0, -1.0, 2.1, -2.1]), np.ones((2, 4)))
    np.testing.assert_allclose(low, [0.5, 0.125, 1.0, 0.0], atol=1e-12)
    np.testing.assert_allclose(high, [0.5, 0.125, 1.0, 0.0], atol=1e-12)


def test_slopes_that_vanish_or_overflow_say_nothing_wrong():
    low, high = bounds(np.array([0.0, 1e-3, 1e200]), np.array([[0.0, 0.0, 1e200], [0.0, 1.0, 1e200]]))
    assert np.all((low >= 0) & (low <= high) & (high <= 1))
    assert low[1] < 0.5005 < high[1] + 1e-9


def disc(low, high):
    """Where 1 - x^2 - y^2 is not negative in boxes of equal size: bounds of the area."""
    middles = 0.5 * low + 0.5 * high
    x, y = (coordinate(Interval.of(low[k], high[k]), middles[k], k, 2) for k in range(2))
    reach = np.maximum(high - middles, middles - low) * (1 + 1e-15)
    return shares(1 - x * x - y * y, reach)


def test_the_area_of_a_quarter_of_a_disc_lies_within_the_bounds_which_close_quadratically():
    gaps = []
    for count in (8, 16, 32):
        edges = np.arange(count + 1) / count
        low = np.stack([grid.ravel() for grid in np.meshgrid(edges[:-1], edges[:-1])])
        high = low + 1 / count
        least, most = disc(low, high)
        area = math.fsum(least) / count**2, math.fsum(most) / count**2
        assert area[0] < math.pi / 4 < area[1]
        gaps.append(area[1] - area[0])
    assert gaps[0] / gaps[1] > 3.5
    assert gaps[1] / gaps[2] > 3.5


def test_no_bound_where_a_slope_has_none():
    x = coordinate(Interval.of([-1.0], [1.0]), np.array([0.0]), 0, 1)
    low, high = shares(SlopedNumbers().sqrt(x) - 0.5, np.ones((1, 1)))
    assert (low[0], high[0]) == (0.0, 1.0)
    low, high = shares(1 - x * 0, np.ones((1, 1)))
    assert 1 - 1e-14 < low[0] <= high[0] == 1.0


def test_corners_are_gone_through_once_for_each_bound(monkeypatch):
    calls, own = [], cuts._share
    monkeypatch.setattr(cuts, "_share", lambda *given: calls.append(1) or own(*given))
    x = coordinate(Interval.of([0.0], [1.0]), np.array([0.5]), 0, 1)
    shares(x * x - 0.3, np.array([[0.5]]))
    assert len(calls) == 2
