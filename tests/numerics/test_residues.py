"""Numbers modulo a prime: roots, angles, and what is seen of squares of formulas."""

import math
from fractions import Fraction

import numpy as np
import pytest

from assur.numerics.prime_field import ORDER, PrimeField, simplest
from assur.numerics.residues import Draws


@pytest.fixture(params=range(4))
def draws(request):
    random = np.random.default_rng(request.param)
    return Draws(PrimeField.drawn(random), 200, random)


@pytest.mark.parametrize("number", [2, 3, 5, 7, 6, 11, Fraction(1, 2), Fraction(18, 25), 10403, -3, -4])
def test_a_root_of_a_rational_has_its_square(draws, number):
    root = draws.sqrt(Fraction(number))
    assert draws.vanishes(root * root - Fraction(number))


def test_roots_of_rationals_are_the_positive_ones(draws):
    """As over real numbers: they multiply, and are what cosines of angles are made of."""
    pi = draws.pi
    assert draws.vanishes(draws.sqrt(6) - draws.sqrt(2) * draws.sqrt(3))
    assert draws.vanishes(draws.cos(pi * Fraction(1, 6)) - draws.sqrt(3) / 2)
    assert draws.vanishes(draws.cos(pi * Fraction(1, 4)) - draws.sqrt(2) / 2)
    assert draws.vanishes(draws.cos(pi * Fraction(1, 5)) - (1 + draws.sqrt(5)) / 4)
    assert draws.vanishes(draws.sin(pi * Fraction(1, 2)) - 1)
    assert draws.vanishes(draws.sqrt((draws.sqrt(3) / 2) * (draws.sqrt(3) / 2) + Fraction(1, 4)) - 1)
    assert draws.vanishes(draws.sqrt(draws.sqrt(2) * draws.sqrt(2)) - draws.sqrt(2))
    sevenths = [draws.sin(pi * Fraction(2 * k, 7)) for k in (1, 2, 4)]
    assert math.isclose(sum(math.sin(2 * math.pi * k / 7) for k in (1, 2, 4)), math.sqrt(7) / 2)
    assert draws.vanishes(sum(sevenths) - draws.sqrt(7) / 2)


def test_every_angle_lies_on_the_unit_circle(draws):
    for cosine, sine in (draws.circle(), draws.pair(draws.pi * Fraction(1, 7)), draws.pair(draws.pi * Fraction(1, 11))):
        assert draws.vanishes(cosine * cosine + sine * sine - 1)
    assert (draws.field.p + 1) % ORDER == 0


def test_roots_of_independent_radicands_are_not_tied(draws):
    x, y = draws.uniform(), draws.uniform()
    first, second = draws.sqrt(x), draws.sqrt(y)
    assert draws.vanishes(draws.sqrt(4 * x) - 2 * first)
    assert draws.tied == 0
    third = draws.sqrt(x * y)
    assert draws.tied == 1
    assert 0 < np.mean((third - first * second).zero()) < 1


def test_a_root_of_a_root_exists_at_half_of_the_draws(draws):
    x = draws.uniform()
    root = draws.sqrt(1 + draws.sqrt(x))
    assert draws.vanishes((root * root - 1) * (root * root - 1) - x)
    assert 60 < np.sum(draws.sound) < 140


def test_a_square_of_a_positive_number_has_the_positive_root(draws):
    x, y = draws.uniform(), draws.uniform()
    draws.positive.append(x)
    assert draws.vanishes(draws.sqrt(3 * x * x) - draws.sqrt(3) * x)
    root = draws.sqrt(y)
    assert draws.vanishes(draws.sqrt(x * x * y) - x * root)
    assert draws.tied == 0
    assert not draws.vanishes(draws.sqrt((y + 1) * (y + 1)) - y - 1)


@pytest.mark.parametrize("number", [1 / 3, 2 / 7, 0.1, 1e20, 1e-30, -0.75, 0.1 + 0.2, 3.0])
def test_the_simplest_rational_is_the_float_again(number):
    assert math.isclose(float(simplest(number)), number, rel_tol=2.0**-51)
    assert simplest(number).denominator <= 10**30
