"""Numbers as a reader sees them: bounds stay bounds."""

from fractions import Fraction

import numpy as np

from assur.results.typeset_text import NOTHING, bounds, with_error


def read(text):
    return [Fraction(part.replace("\u202f", "").replace("\N{MINUS SIGN}", "-")) for part in text.split(" to ")]


def test_bounds_that_are_shown_hold_those_that_are_proved():
    rng = np.random.default_rng(3)
    for _ in range(500):
        low = float(rng.normal() * 10.0 ** rng.integers(-6, 15))
        high = float(np.nextafter(low, np.inf)) + float(rng.exponential() * 10.0 ** rng.integers(-25, 9))
        shown = read(bounds(low, high))
        assert shown[0] <= Fraction(low) < Fraction(high) <= shown[1]


def test_bounds_that_are_none():
    assert bounds(float("nan"), 1.0) == bounds(0.0, float("inf")) == NOTHING
    assert bounds(0.5, 0.5) == "0.5"


def test_an_error_that_is_only_rounding_is_not_shown():
    assert with_error(95000.000007, 0.000011) == "95\u202f000"
    assert with_error(1.0, 1e-8) == "1.000000000 ± 0.000000010"
