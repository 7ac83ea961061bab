"""Monodromy: every root of a generic polynomial from one of them."""

import numpy as np

from assur.numerics.expanded import expand, unknowns
from assur.numerics.homotopy import distinct
from assur.numerics.monodromy import all_solutions, random_complex


def quintic(first, last):
    x, y, t = unknowns(3)
    total, power = 0, [y * y * y * y * y, x * y * y * y * y, x * x * y * y * y, x * x * x * y * y, x * x * x * x * y]
    for a, b, monomial in zip(first, last, power, strict=True):
        total = monomial * (b + (a - b) * t) + total
    return expand([x * x * x * x * x + total])


def test_one_root_of_a_quintic_leads_to_all_five():
    rng = np.random.default_rng(2)
    parameters = random_complex(rng, 5)
    roots = np.roots([1, *parameters[::-1]])
    found = all_solutions(quintic, parameters, np.array([roots[0], 1]), 5, rng)
    assert len(found) == len(distinct(found)) == 5
    ratio = found[:, 0] / found[:, 1]
    assert max(np.min(np.abs(ratio - root)) for root in roots) < 1e-9


def test_a_family_that_falls_apart_gives_what_can_be_reached():
    """(x - q y)(x + y) has two roots, but no loop of q takes one to the other."""

    def family(first, last):
        x, y, t = unknowns(3)
        return expand([(x - (last[0] + (first[0] - last[0]) * t) * y) * (x + y)])

    found = all_solutions(family, np.array([0.3 + 0.4j]), np.array([-1, 1 + 0j]), 2, np.random.default_rng(0))
    assert len(found) == 1


def test_random_complex_numbers_are_of_size_one():
    numbers = random_complex(np.random.default_rng(0), 4000)
    assert abs(np.mean(np.abs(numbers) ** 2) - 1) < 0.05
