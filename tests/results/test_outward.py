"""Bounds stay bounds when they are printed."""

from fractions import Fraction

import numpy as np
import pytest

from assur.results.outward import outward


def test_bounds_that_are_printed_hold_those_that_are_proved():
    rng = np.random.default_rng(3)
    for _ in range(2000):
        low = float(rng.normal() * 10.0 ** rng.integers(-20, 20))
        high = max(low + float(rng.exponential() * 10.0 ** rng.integers(-30, 20)), float(np.nextafter(low, np.inf)))
        shown = [Fraction(text) for text in outward(low, high)]
        assert shown[0] <= Fraction(low) < Fraction(high) <= shown[1]
        assert shown[1] - shown[0] <= (Fraction(high) - Fraction(low)) * Fraction(6, 5)


@pytest.mark.parametrize("value", [0.1, -1e300, 5e-324])
def test_a_single_number_reads_back_as_it_is(value):
    assert [float(text) for text in outward(value, value)] == [value, value]
