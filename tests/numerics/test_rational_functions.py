"""Rational functions are told from their values; what has branches is none, however far away these are."""

import numpy as np
import pytest

from assur.numerics.rational_functions import rational_degree, scattered

PLACES = scattered(np.random.default_rng(7), 80)


@pytest.mark.parametrize("degree", [0, 1, 3, 8, 15, 24])
@pytest.mark.parametrize("size", [0.3, 1.0, 3.0])
def test_the_degree_is_that_of_the_function(degree, size):
    rng = np.random.default_rng(degree)
    zeros, poles = size * (rng.normal(size=(2, degree)) + 1j * rng.normal(size=(2, degree)))
    values = np.prod((PLACES[:, None] - zeros) / (PLACES[:, None] - poles), axis=1)
    assert rational_degree(PLACES, values) == degree


@pytest.mark.parametrize("place", [0.2, 0.9, 1.1, 2.0, 20.0, 200.0])
def test_branches_that_are_taken_by_chance_are_no_function(place):
    signs = np.random.default_rng(0).choice([-1.0, 1.0], len(PLACES))
    assert rational_degree(PLACES, signs * np.sqrt(PLACES - place)) is None


@pytest.mark.parametrize("place", [0.0, 0.1, 1.0, 5.0, 7.0, 9.0])
@pytest.mark.parametrize("count", [36, 80, 150])
def test_one_branch_is_no_function(place, count):
    places = scattered(np.random.default_rng(count), count)
    assert rational_degree(places, np.sqrt(places - place)) is None


@pytest.mark.parametrize("count", [20, 48, 80, 200])
def test_numbers_without_a_law_are_no_function(count):
    rng = np.random.default_rng(count)
    places = scattered(rng, count)
    assert rational_degree(places, rng.normal(size=count) + 1j * rng.normal(size=count)) is None
