"""Rates against differences of many pairs of numbers."""

import numpy as np
import pytest

from assur.numerics.intervals.interval import Interval
from assur.numerics.intervals.rates import ClampedIntervals, root_rate, sign_rate

RNG = np.random.default_rng(8)
LOW = RNG.uniform(-3.0, 3.0, 300)
HIGH = LOW + RNG.uniform(0.0, 4.0, 300)
CENTRE = LOW + RNG.random(300) * (HIGH - LOW)


@pytest.mark.parametrize(
    ("function", "rate"),
    [(np.abs, lambda whole, _: sign_rate(whole)), (lambda x: np.sqrt(np.maximum(x, 0.0)), root_rate)],
    ids=["magnitude", "root"],
)
def test_no_difference_quotient_is_outside(function, rate):
    found = rate(Interval.of(LOW, HIGH), Interval.of(CENTRE))
    for share in np.linspace(0.0, 1.0, 33):
        x = LOW + share * (HIGH - LOW)
        apart = np.where(np.abs(x - CENTRE) < 1e-9, np.nan, x - CENTRE)
        quotient = (function(x) - function(CENTRE)) / apart
        assert not np.any(quotient < found.low - 1e-6)
        assert not np.any(quotient > found.high + 1e-6)
    assert np.mean(np.isfinite(found.high) & (found.high - found.low < 2.5)) > 0.5


def test_the_rate_of_a_root_is_no_bound_where_both_may_be_zero():
    assert np.isinf(root_rate(Interval.of(-1.0, 1.0), Interval.of(0.0)).high)


def test_the_rate_of_a_magnitude_is_as_defined_as_its_argument():
    odd = Interval(np.array([-1.0, 1.0]), np.array([4.0, 4.0]), np.array([True, False]))
    assert sign_rate(odd).defined.tolist() == [True, False]


def test_a_root_below_zero_counts_as_defined_where_its_radicand_is():
    odd = Interval(np.array([-1.0, -1.0]), np.array([4.0, 4.0]), np.array([True, False]))
    assert ClampedIntervals().sqrt(odd).defined.tolist() == [True, False]
