"""Terms: what vanishes exactly, and what is not divided by."""

from fractions import Fraction

import pytest

from assur.verifier.derivations.terms import Quotients, WrittenNumbers, divisors, symbol
from assur.verifier.formula import AngleSum, value

NAMES = {name: symbol(name) for name in "abcxy"}


def read(text, numbers):
    return value(text, {**NAMES, "alpha": AngleSum({"alpha": Fraction(1)})}, numbers)


@pytest.mark.parametrize(
    "text",
    [
        "(a + b)**2 - a**2 - 2*a*b - b**2",
        "a/(a*b + a**2)*(a + b) - 1",
        "sqrt(12)*a - 2*sqrt(3)*a",
        "sqrt(6)*a - sqrt(2)*sqrt(3)*a",
        "a*cos(pi/12) - a*(sqrt(6) + sqrt(2))/4",
        "a*sin(75 deg) - a*cos(15 deg)",
        "a*cos(2*pi/3) + a/2",
        "a*sin(-pi/3) + a*sqrt(3)/2",
        "a*(cos(alpha)**2 + sin(alpha)**2 - 1)",
        "a*cos(2*alpha) - a*cos(alpha)**2 + a*sin(alpha)**2",
        "a*cos(alpha + pi/2) + a*sin(alpha)",
        "sqrt(4*a**2 + 4*b**2) - 2*sqrt(a**2 + b**2)",
        "(a**2 + b**2)**(3/2) - (a**2 + b**2)*sqrt(a**2 + b**2)",
        "1/sqrt(a**2 + b**2) - sqrt(a**2 + b**2)/(a**2 + b**2)",
    ],
)
def test_identities_are_shown(text):
    numbers = WrittenNumbers()
    own = read(text, numbers)
    assert Quotients([own], numbers.squares).zero(own)


@pytest.mark.parametrize("text", ["a - b", "sqrt(2)*a - a", "a*cos(alpha) - a", "sqrt(a**2 + b**2) - a - b"])
def test_what_is_none_is_not(text):
    numbers = WrittenNumbers()
    own = read(text, numbers)
    assert not Quotients([own], numbers.squares).zero(own)


@pytest.mark.parametrize(
    ("text", "fine"),
    [("a*b", True), ("2*a**2*x", False),
     ("x*y", False), ("a + b", True), ("a - b", False), ("a**2 + x**2", True),
     ("x**2 + y**2", True), ("x**2 + c**2", False), ("(x - y)**2*a", True), ("sqrt(a**2 + x**2)", True),
     ("a + x", False)],
)  # fmt: skip
def test_divisors_do_not_vanish_where_that_is_said_or_sure(text, fine):
    """`a` and `b` are positive, and x - y is said not to vanish: so x and y do not both."""
    numbers = WrittenNumbers()
    own, condition = read(text, numbers), read("x - y", numbers)
    field = Quotients([own, condition], numbers.squares)
    assert field.never_zero(own, [condition], frozenset("ab")) is fine


def test_every_divisor_of_a_formula_is_told():
    numbers = WrittenNumbers()
    assert len([*divisors([read("a/x + b/(y + 1/c)", numbers)])]) == 3
