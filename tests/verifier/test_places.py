"""Drawn places: rates are derivatives, and roots that are tied to others are seen."""

from fractions import Fraction

import pytest

from assur.model.registry import load_record
from assur.verifier.field import CircleField, NoExactError, NoRootError
from assur.verifier.mechanism import mechanism
from assur.verifier.places import DrawnPlace, FormulaTape, RatedNumber, RootPlan

FIVEBAR = mechanism(load_record("fivebar").file.read_text(encoding="utf-8"))


def test_rates_are_derivatives():
    x = RatedNumber(Fraction(3), Fraction(1))
    assert (x * x * x).rate == 27
    assert (RatedNumber(Fraction(1)) / (x * x)).rate == Fraction(-2, 27)
    assert (-(x - RatedNumber(Fraction(1))) / (x + x)).rate == Fraction(-1, 18)
    assert (RatedNumber(Fraction(2)) * RatedNumber(Fraction(5))).rate == 0


def tied(program, count=80):
    """How many roots of a program over x and y seem tied, the plan of its roots, and its last values."""
    tape, plan, field = FormulaTape(program, [len(program) - 1]), RootPlan(), CircleField()
    for number in range(count):
        place = DrawnPlace(number, FIVEBAR, field, plan, True)
        try:
            values = tape.values(place, FIVEBAR, frozenset())
        except NoRootError:
            continue
    return plan.tied, plan.plan, values


X, Y = ["coordinate", "x"], ["coordinate", "y"]
LENGTH = ["number", (1.0).hex(), (1.0).hex(), "l1"]
PROGRAMS = {
    "independent radicands": ([X, Y, ["root", 0], ["root", 1], ["*", 2, 3]], 0, 2),
    "a product of two": ([X, Y, ["root", 0], ["root", 1], ["*", 0, 1], ["root", 4], ["+", 2, 3], ["+", 5, 6]], 1, 3),
    "a square": ([X, ["*", 0, 0], ["root", 1]], 1, 1),
    "one met again": ([X, ["root", 0], ["+", 0, 0], ["root", 2], ["+", 1, 3]], 0, 1),
    "a root of a root": ([X, Y, ["root", 0], ["+", 1, 2], ["root", 3]], 0, 2),
    "a root of a root squared": ([X, ["root", 0], ["+", 0, 1], ["*", 2, 2], ["root", 3]], 1, 2),
    "the square of a length": ([X, LENGTH, ["*", 1, 1], ["*", 0, 2], ["root", 0], ["root", 3], ["+", 4, 5]], 0, 1),
}


@pytest.mark.parametrize("what", PROGRAMS)
def test_roots_that_are_tied_are_counted(what):
    program, count, own = PROGRAMS[what]
    found, plan, _ = tied(program)
    assert found == count
    assert sum(root.own for root in plan) == own


def test_roots_have_rates():
    """2 r r' = x' of r * r = x."""
    field, plan = CircleField(), RootPlan()
    place = DrawnPlace(0, FIVEBAR, field, plan, True)
    values = FormulaTape([X, ["root", 0]], [1]).values(place, FIVEBAR, frozenset())
    x, root = values[0], values[1]
    assert (root.value * root.value - x.value).zero
    assert (2 * root.value * root.rate - x.rate).zero


@pytest.mark.parametrize(
    "program", [[X, ["magnitude", 0]], [X, ["cosine", 0]], [["number", "0x0.0p+0", "0x0.0p+0", "?"]]]
)
def test_what_is_not_exact_is_refused(program):
    with pytest.raises(NoExactError):
        tied(program, 1)
