"""Formulas by the verifier's own reader: what they are, beside the other reader of the house, and what is none."""

import math
from fractions import Fraction

import pytest

from assur.model.formula import parse
from assur.verifier.formula import PI, RADIAN, AngleSum, FloatNumbers, number, value

NAMES = {"l": 7.25, "l'": -2.0, "tilt": AngleSum({PI: Fraction(2, 9)}), "twist": AngleSum({RADIAN: 0.3})}
PLAIN = {"l": 7.25, "l'": -2.0, "tilt": math.radians(40), "twist": 0.3}
TEXTS = [
    "l",
    "-l/2 - l'*3",
    "2*-l",
    "1 - 2 - 3/4/5",
    "(l + .5)*1e-2",
    "sqrt(l*l + 2)",
    "cos(tilt - 2*twist/3)",
    "sin(tilt/2 + 30 deg)*l",
    "cos(pi/4 + 1.5 rad)",
    "2*l*pi",
    "tilt/twist",
    "sin(l*twist)",
]


@pytest.mark.parametrize("text", TEXTS)
def test_both_readers_agree(text):
    other = float(parse(text).evaluate(PLAIN, math))
    assert float(number(text, NAMES, FloatNumbers())) == pytest.approx(other, rel=1e-14, abs=1e-14)


def test_rationals_and_angles_stay_exact():
    assert value("0.1 + 2/5", {}, FloatNumbers()) == Fraction(1, 2)
    assert value("2*pi/3 - 30 deg", {}, FloatNumbers()) == AngleSum({PI: Fraction(1, 2)})
    assert value(Fraction(1, 3), {}, FloatNumbers()) == Fraction(1, 3)
    assert type(number("3 - 2", {}, FloatNumbers())) is int


@pytest.mark.parametrize(
    "text", ["", "1 +", "(1", "1)", "2 l", "sin 3", "sin(3)", "l^2", "1,5", "é", True, None, [1], "1" * 2000]
)
def test_what_is_no_formula_is_refused(text):
    with pytest.raises(ValueError):
        value(text, NAMES, FloatNumbers())


@pytest.mark.parametrize(("text", "error"), [("unknown", KeyError), ("1/(2 - 2)", ZeroDivisionError)])
def test_what_has_no_value_is_refused(text, error):
    with pytest.raises(error):
        value(text, NAMES, FloatNumbers())


def test_sums_of_angles_and_numbers_are_those_of_radians():
    """The file's reader refuses them; here they are never anything else than what they say."""
    assert number("l + tilt", NAMES, FloatNumbers()) == pytest.approx(7.25 + math.radians(40))
