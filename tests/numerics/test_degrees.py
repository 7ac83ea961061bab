"""Degrees and heights bound those of the polynomials that SymPy makes of the same formulas."""

import math
from fractions import Fraction

import numpy as np
import pytest
import sympy

from assur.numerics.degrees import Degree, Degrees
from assur.numerics.prime_field import LARGE, ORDER, SMALL, UNITS, PrimeField, below

ROOT = object()


def bump(x, y, z, root):
    return 5 / (1 + (x - 10) * (x - 10) * 10**20) + y * z


def elbow(x, y, z, root):
    square = x * x + y * y
    along = (square + z * z - 4) / 2
    return (along * x + root(square * z * z - along * along) * y) / square - Fraction(1, 3) * x


def quotients(x, y, z, root):
    part = (x / 3 - y) / (x + y) + 7 * z / (x + y)
    return part * part - 1 / (part + Fraction(2, 7))


def roots_of_roots(x, y, z, root):
    inner = root(x * x + y)
    return (root(3 * inner + z) - inner) / (2 * z) + 1


FORMULAS = [bump, elbow, quotients, roots_of_roots]


@pytest.mark.parametrize("formula", FORMULAS)
def test_degrees_and_heights_are_bounds(formula):
    """Against the numerator that SymPy finds, multiplied over all signs of its roots."""
    x, y, z = symbols = sympy.symbols("x y z")
    ns = Degrees([(object(), Fraction(1)) for _ in range(4)])
    own = formula(ns.uniform(), ns.uniform(), ns.uniform(), ns.sqrt)
    squares = []

    def root(radicand):
        squares.append((sympy.Dummy(), radicand))
        return squares[-1][0]

    product = sympy.fraction(sympy.together(formula(x, y, z, root)))[0]
    for r, square in reversed(squares):  # over both signs of each root
        product = sympy.resultant(product, sympy.fraction(sympy.together(r**2 - square))[0], r)
    polynomial = sympy.Poly(product, *symbols).primitive()[1]
    assert 0 < polynomial.total_degree() <= own.bound
    assert math.log2(sum(abs(int(c)) for c in polynomial.coeffs())) <= own.bits


def test_a_root_met_again_is_the_same_root():
    ns = Degrees([(ROOT, Fraction(1)), (ROOT, Fraction(9, 2))])
    x = ns.uniform()
    both = ns.sqrt(x + 1) - ns.sqrt(9 * (x + 1) / 2)
    assert both.bound == 1.0
    assert len(both.roots) == 1
    assert both.denominator == 2


def test_numbers_have_heights_and_no_degree():
    half = Degree(1) * Fraction(3, 8)
    assert (half.over, half.height, half.denominator) == (1, math.log2(3), 8)
    assert (Degree(1) / 4 + Degree(1) / 6).denominator == 12


def test_a_large_prime_hardly_ever_divides():
    field = PrimeField.drawn(np.random.default_rng(3), LARGE)
    assert LARGE < field.p < 2 * LARGE
    assert (field.p + 1) % ORDER == 0
    assert sum(math.gcd(k, ORDER) == 1 for k in range(ORDER)) == UNITS
    assert field.missed(1e6) < field.missed(1e9) < 1e-20
    assert field.missed(1e60) == 1.0


def test_the_share_of_primes_that_divide_is_below_the_bound():
    """Of small primes, where the bound says something only of numbers with few divisors."""
    primes = {PrimeField.drawn(np.random.default_rng(seed)).p for seed in range(60)}
    assert len(primes) > 50
    number = math.prod(sorted(primes)[:20])
    divisors = sum(number % p == 0 for p in primes)
    assert divisors <= math.log2(number) / math.log2(SMALL)


def test_integers_of_any_size_are_drawn_evenly():
    random = np.random.default_rng(0)
    drawn = [below(random, -5, 10**40) for _ in range(400)]
    assert all(-5 <= number < 10**40 for number in drawn)
    assert 0.4 < np.mean([number > 5 * 10**39 for number in drawn]) < 0.6
    assert {below(random, 1, 3) for _ in range(50)} == {1, 2}
