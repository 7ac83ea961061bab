"""Cycle types against groups that are known, and against polynomials whose roots are square roots."""

from itertools import permutations

import pytest
from flint import nmod_poly

from assur.derivation.cycle_types import findings


def cycle_types(coefficients, primes):
    """Of a polynomial with whole coefficients, where it has no double factor."""
    types = {}
    for prime in primes:
        own = nmod_poly(coefficients, prime)
        if own.degree() == len(coefficients) - 1 and own.gcd(own.derivative()).degree() == 0:
            types.setdefault(tuple(sorted((factor.degree() for factor, _ in own.factor()[1]), reverse=True)), prime)
    return types


PRIMES = (101, 103, 107, 109, 113, 127, 131, 137, 139, 149, 151, 157, 163, 167, 173, 179, 181, 191, 193, 197, 199, 211,
          223, 227, 229, 233, 239, 241, 251, 257, 263, 269, 271, 277, 281, 283, 293, 307, 311, 313)  # fmt: skip


def test_a_polynomial_with_the_symmetric_group_has_no_roots_of_any_kind():
    own = findings(5, cycle_types([-1, -1, 0, 0, 0, 1], PRIMES))
    assert (own.irreducible, own.no_tower, own.insoluble) == (True, True, True)


def test_a_cubic_has_no_tower_and_is_soluble():
    own = findings(3, cycle_types([-2, 0, 0, 1], PRIMES))
    assert (own.irreducible, own.no_tower, own.insoluble) == (True, True, False)


@pytest.mark.parametrize("coefficients", [[-2, 0, 0, 0, 1], [2, 0, -4, 0, 1], [1, 0, 0, 0, 1]])
def test_of_roots_of_roots_nothing_is_denied(coefficients):
    own = findings(4, cycle_types(coefficients, PRIMES))
    assert not own.no_tower
    assert not own.insoluble


def test_a_product_is_not_called_irreducible():
    own = findings(5, cycle_types([2, 0, -2, -1, 0, 1], PRIMES))  # (x^2 - 2) (x^3 - 1) has a factor of degree 1
    assert not own.irreducible


def test_of_the_whole_group_of_five_all_is_found_and_of_its_cycles_alone_what_is_true():
    def lengths(permutation):
        left, own = set(range(5)), []
        while left:
            start, count = min(left), 0
            while start in left:
                left.remove(start)
                start, count = permutation[start], count + 1
            own.append(count)
        return tuple(sorted(own, reverse=True))

    symmetric = {lengths(own): 2 for own in permutations(range(5))}
    assert findings(5, symmetric).insoluble
    cyclic = {lengths([(k + shift) % 5 for k in range(5)]): 2 for shift in range(5)}
    assert findings(5, cyclic).irreducible
    assert not findings(5, cyclic).insoluble
