"""The verifier's numbers modulo a prime: the field, roots of rationals, and shares of a turn."""

import math
from fractions import Fraction

import pytest

from assur.numerics import prime_field
from assur.verifier.field import (
    LEAST,
    ORDER,
    UNITS,
    CircleField,
    Element,
    NoExactError,
    NoRootError,
    few_digits,
    prime,
    simplest,
)
from assur.verifier.formula import PI, RADIAN, AngleSum


@pytest.fixture(scope="module")
def field():
    return CircleField()


def turn(*shares):
    return AngleSum({PI: 2 * Fraction(*shares)})


def test_primes_are_drawn_from_those_that_have_the_turns():
    primes = {prime() for _ in range(5)}
    assert len(primes) == 5
    assert all((p + 1) % ORDER == 0 and LEAST < p < 2 * LEAST for p in primes)
    assert sum(math.gcd(k, ORDER) == 1 for k in range(ORDER)) == UNITS


def test_it_is_a_field(field):
    a, b, c = (Element(field.p, 5, 7), Element(field.p, 11), Element(field.p, 0, 3))
    for x in (a, b, c):
        assert (x / x - 1).zero
        assert (1 / x * x - 1).zero
        assert ((a + b) * x - a * x - b * x).zero
        assert (x + (2 - x) - Fraction(4, 2)).zero
    with pytest.raises(NoRootError):
        a / (b - 11)


@pytest.mark.parametrize("number", [2, 3, 5, 7, 30, 11, Fraction(1, 2), Fraction(18, 25), 10403, -3, 0])
def test_a_root_of_a_rational_has_its_square(field, number):
    root = field.root(Fraction(number))
    assert (root * root - Fraction(number)).zero


def test_roots_of_rationals_are_what_cosines_are_made_of(field):
    cosine, sine = field.circle(turn(1, 12))
    assert (2 * cosine - field.root(3)).zero
    assert (2 * sine - 1).zero
    assert (field.circle(turn(1, 8))[1] * 2 - field.root(2)).zero
    assert (4 * field.circle(turn(1, 5))[0] + 1 - field.root(5)).zero
    assert (2 * (field.circle(turn(1, 7))[1] + field.circle(turn(2, 7))[1] + field.circle(turn(4, 7))[1])
            - field.root(7)).zero  # fmt: skip
    assert (field.circle(turn(1, 4))[1] - 1).zero


@pytest.mark.parametrize("angle", [turn(1, 11), AngleSum({"tilt": Fraction(1)}), AngleSum({RADIAN: Fraction(1, 3)})])
def test_other_angles_are_drawn_once(field, angle):
    cosine, sine = field.circle(angle)
    assert (cosine * cosine + sine * sine - 1).zero
    assert field.circle(angle) == (cosine, sine)
    double = field.circle(angle.times(2))
    assert (double[0] - cosine * cosine + sine * sine).zero
    assert (field.circle(angle.times(-1))[1] + sine).zero
    assert field.fresh().circle(angle) != (cosine, sine)


def test_roots_in_the_field_and_above(field):
    for k in range(20):
        number = Element(field.p, 1 + k, k)
        if number.square or not number.b:
            assert (number.root() * number.root() - number).zero
        else:
            with pytest.raises(NoRootError):
                number.root()


def test_what_is_not_exact_is_refused(field):
    with pytest.raises(NoExactError):
        field.radians(turn(1, 3))
    with pytest.raises(NoExactError):
        field.circle(AngleSum({PI: field.uniform()}))
    with pytest.raises(NoExactError):
        field.root(field.uniform())


@pytest.mark.parametrize("number", [1 / 3, 2 / 7, 0.1, 1e20, 1e-30, -0.75, 0.1 + 0.2, 3.0, 0.0])
def test_the_simplest_rational_is_that_of_the_other_program(number):
    assert simplest(number) == (prime_field.simplest(number) if number else 0)


def test_few_digits_are_told_from_many(field):
    assert few_digits(field.number(Fraction(22, 7))) == Fraction(22, 7)
    assert few_digits(field.number(Fraction(-22, 7))) is None
    assert few_digits(field.uniform()) is None
    assert few_digits(Element(field.p, 1, 1)) is None


def test_the_bound_for_the_prime_is_that_of_the_other_program(field):
    assert field.missed(1e6) < 1e-25
    assert field.missed(1e60) == 1.0
