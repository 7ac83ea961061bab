"""Slopes enclose what functions do over boxes: against exact rationals and many sampled points."""

from fractions import Fraction

import numpy as np
import pytest

from assur.numerics.intervals import rounding
from assur.numerics.intervals.interval import Interval
from assur.numerics.intervals.rates import ClampedIntervals
from assur.numerics.intervals.sloped import Sloped, SlopedNumbers, coordinate, ranged, turn

RNG = np.random.default_rng(11)
COUNT = 400


def boxes(low=-3.0, high=3.0):
    ends = np.sort(RNG.uniform(low, high, size=(2, 2, COUNT)), axis=0)
    middles = 0.5 * ends[0] + 0.5 * ends[1]
    numbers = [coordinate(Interval.of(ends[0, k], ends[1, k]), middles[k], k, 2) for k in range(2)]
    return ends, middles, numbers


def points(ends):
    """Points of the boxes, their corners among them (2, COUNT, samples)."""
    share = np.concatenate([RNG.uniform(size=(2, COUNT, 20)), np.zeros((2, COUNT, 1)), np.ones((2, COUNT, 1))], axis=2)
    return ends[0][..., None] + share * (ends[1] - ends[0])[..., None]


def clamped(value):
    return np.sqrt(np.maximum(value, 0.0))


FUNCTIONS = [
    (lambda x, y, _: x * y + 2 * x - y * y, lambda x, y: x * y + 2 * x - y * y),
    (lambda x, y, _: (x - y) * (x - y) - x * x * x, lambda x, y: (x - y) ** 2 - x**3),
    (lambda x, y, _: (x + 1) / (y * y + 1) - 1 / (x * x + 2), lambda x, y: (x + 1) / (y**2 + 1) - 1 / (x**2 + 2)),
    (lambda x, y, root: root(x * x + y * y + 1) * y, lambda x, y: np.sqrt(x**2 + y**2 + 1) * y),
    (lambda x, y, root: root(1 - x * y) + abs(x - y), lambda x, y: clamped(1 - x * y) + abs(x - y)),
    (lambda x, y, root: root(x) - x / 3 + 5 - y, lambda x, y: clamped(x) - x / 3 + 5 - y),
]


@pytest.mark.parametrize("index", range(len(FUNCTIONS)))
def test_every_value_lies_within_what_the_slopes_allow(index):
    kernel, plain = FUNCTIONS[index]
    ends, middles, numbers = boxes()
    found = kernel(*numbers, SlopedNumbers().sqrt)
    x = points(ends)
    values = plain(*x)
    away = x - middles[..., None]
    low, high = found.centre.low[:, None], found.centre.high[:, None]
    for slope, distance in zip(found.slopes, away, strict=True):
        one, two = slope.low[:, None] * distance, slope.high[:, None] * distance
        low, high = low + np.fmin(one, two), high + np.fmax(one, two)
    assert np.mean(np.isfinite(low) & np.isfinite(high)) > 0.5
    slack = 1e-12 * (1 + np.abs(values))
    assert not np.any(values < low - slack)
    assert not np.any(values > high + slack)
    offsets = [Interval.of(ends[0, k] - middles[k], ends[1, k] - middles[k]) for k in range(2)]
    over = ranged(found, offsets)
    assert np.all((over.low[:, None] - slack <= values) & (values <= over.high[:, None] + slack))
    assert np.all(over.low >= found.whole.low)
    assert np.all(over.high <= found.whole.high)


def test_slopes_of_rational_functions_hold_exactly():
    ends, middles, (x, y) = boxes()
    found = (x * y - 3) / (x * x + 1) - y * 7
    for k in range(COUNT):
        at = [Fraction(float(ends[RNG.integers(2), axis, k])) for axis in range(2)]
        value, centre = (_exact(*point) for point in (at, [Fraction(float(middles[axis, k])) for axis in range(2)]))
        bounds = []
        for slope, axis in zip(found.slopes, range(2), strict=True):
            away = at[axis] - Fraction(float(middles[axis, k]))
            bounds.append(sorted([Fraction(float(slope.low[k])) * away, Fraction(float(slope.high[k])) * away]))
        assert Fraction(float(found.centre.low[k])) <= centre <= Fraction(float(found.centre.high[k]))
        assert sum(pair[0] for pair in bounds) <= value - centre <= sum(pair[1] for pair in bounds)


def test_without_rounding_outwards_the_exact_test_fails(monkeypatch):
    for name in ("down", "up", "down_sum", "up_sum"):
        monkeypatch.setattr(rounding, name, np.asarray)
    with pytest.raises(AssertionError):
        test_slopes_of_rational_functions_hold_exactly()


def _exact(x, y):
    return (x * y - 3) / (x * x + 1) - 7 * y


def test_slopes_of_a_square_are_half_as_wide_as_derivatives():
    x = coordinate(Interval.of([1.0], [3.0]), np.array([2.0]), 0, 1)
    slope = (x * x).slopes[0]
    assert np.all(slope.contains([3.0]))  # derivatives: [2, 6]
    assert np.all(slope.contains([5.0]))
    np.testing.assert_allclose(slope.width, 2.0, rtol=1e-12)


def test_the_slope_of_a_root_is_bounded_where_the_radicand_reaches_zero():
    x = coordinate(Interval.of([0.0], [4.0]), np.array([1.0]), 0, 1)
    slope = SlopedNumbers().sqrt(x).slopes[0]
    np.testing.assert_allclose([slope.low[0], slope.high[0]], [1 / 3, 1.0], rtol=1e-12)


@pytest.mark.parametrize(("low", "high", "centre"), [(-4.0, -1.0, -2.0), (-4.0, 9.0, -1.0), (-1.0, 4.0, 0.25)])
def test_slopes_of_a_root_hold_below_zero_too(low, high, centre):
    x = coordinate(Interval.of([low], [high]), np.array([centre]), 0, 1)
    slope = SlopedNumbers().sqrt(x).slopes[0]
    sample = np.linspace(low, high, 1001)
    sample = sample[sample != centre]
    rate = (clamped(sample) - clamped(centre)) / (sample - centre)
    assert np.all((slope.low[0] <= rate + 1e-12) & (rate - 1e-12 <= slope.high[0]))
    assert np.isfinite(slope.high[0])


def test_a_root_that_is_zero_in_the_middle_has_no_bound():
    x = coordinate(Interval.of([-1.0], [1.0]), np.array([0.0]), 0, 1)
    assert np.isinf(SlopedNumbers().sqrt(x).slopes[0].high[0])


def test_a_divisor_that_may_be_zero_is_not_defined():
    x = coordinate(Interval.of([-1.0, 1.0], [1.0, 2.0]), np.array([0.5, 1.5]), 0, 1)
    assert (1 / x).whole.defined.tolist() == [False, True]
    assert (x / x).whole.defined.tolist() == [False, True]
    assert not np.isfinite((1 / x).slopes[0].low[0])


@pytest.mark.parametrize("share", [1.0, 0.5])
def test_cosines_and_sines_of_turns(share):
    low = RNG.uniform(-7.0, 7.0, size=COUNT)
    high = low + RNG.uniform(0.0, 3.0, size=COUNT)
    middle = 0.5 * low + 0.5 * high
    angle = low[:, None] + RNG.uniform(size=(COUNT, 20)) * (high - low)[:, None]
    pair = turn(Interval.of(low, high), middle, 0, 1, share)
    for number, function in zip(pair, (np.cos, np.sin), strict=True):
        rate = (function(share * angle) - function(share * middle)[:, None]) / (angle - middle[:, None])
        slope = number.slopes[0]
        assert np.all((slope.low[:, None] <= rate + 1e-9) & (rate - 1e-9 <= slope.high[:, None]))
        assert np.all(number.centre.contains(function(share * middle)))


def test_no_slope_where_nothing_depends_on_the_coordinate():
    _, _, (x, y) = boxes()
    assert (x * x + 1).slopes[1] is None
    assert all(slope is not None for slope in (x * y).slopes)
    assert isinstance(3 - y, Sloped)


def test_a_clamped_root_is_defined_below_zero():
    root = ClampedIntervals().sqrt(Interval.of(-4.0, -1.0))
    assert (float(root.low), float(root.high), bool(root.defined)) == (0.0, 0.0, True)
    assert not bool(ClampedIntervals().sqrt(1 / Interval.of(-1.0, 1.0)).defined)


def test_what_has_no_bound_has_none_afterwards_and_raises_nothing():
    x = coordinate(Interval.of([-1.0], [1.0]), np.array([0.5]), 0, 1)
    root = SlopedNumbers().sqrt(1 / x)
    assert not root.whole.defined[0]
    assert np.isinf(root.whole.high[0])
    assert np.isfinite(SlopedNumbers().sqrt(x * x * x + 0.1).slopes[0].high[0])
