from fractions import Fraction

import numpy as np
import pytest

from assur.figures.written import at_least, times_ten, units
from assur.results.typeset_text import minus


def test_what_is_said_to_be_the_least_is_no_more_and_nearly_all():
    for value in [*np.random.default_rng(3).uniform(1.0, 10.0, 40) * 10.0 ** np.arange(-20, 20), 0.001, 1e5, 99999.0]:
        digits, _, power = at_least(float(value)).partition("·10$^{")
        said = Fraction(digits) * Fraction(10) ** int(power.rstrip("}$") or 0)
        assert Fraction(99, 100) * Fraction(value) <= said <= Fraction(value)


@pytest.mark.parametrize(
    ("unit", "text"),
    [("", ""), ("m", "m"), ("rad^2", "rad$^2$"), ("mm rad", "mm rad"), ("mm^2 rad", "mm$^2$ rad"), ("m/rad", "m/rad")],
)
def test_units_are_upright(unit, text):
    assert units(unit) == text


def test_signs_and_powers():
    assert minus("-1.5") == "\N{MINUS SIGN}1.5"
    assert times_ten("2", -3) == "2·10$^{-3}$"
