"""All solutions by homotopy: against numpy's roots, at infinity, where solutions meet, and through near misses."""

import numpy as np
import pytest

from assur.numerics.expanded import expand, unknowns
from assur.numerics.homotopy import PathEnd, distinct, rank_gap, solve

WAY = np.exp(0.7j)
"""Turns the start off the real numbers, so that no path meets another one."""


def from_roots_of_unity(coefficients):
    """x^d = 1 at t = 1, a polynomial (constant term first, d + 1 numbers, each may be a batch) at t = 0."""
    x, y, t = unknowns(3)
    degree = len(coefficients) - 1

    def power(k):
        product = 1
        for factor in [x] * k + [y] * (degree - k):
            product = factor * product
        return product

    target = sum((c * power(k) for k, c in enumerate(coefficients)), start=0 * power(0))
    start = (power(degree) - power(0)) * WAY
    unity = np.exp(2j * np.pi * np.arange(degree) / degree)
    return expand([start * t + target * (1 - t)]), np.stack([unity, np.ones(degree)], axis=-1)


def values(ends):
    return ends.x[:, 0] / ends.x[:, 1]


def nearest(found, wanted):
    return max(np.min(np.abs(found - root)) for root in wanted)


@pytest.mark.parametrize("seed", range(5))
def test_roots_of_a_polynomial_of_degree_nine(seed):
    coefficients = np.random.default_rng(seed).normal(size=10)
    ends = solve(*from_roots_of_unity(coefficients))
    assert np.all(ends.end == PathEnd.regular)
    assert nearest(values(ends), np.roots(coefficients[::-1])) < 1e-9


def test_a_batch_is_the_same_as_its_problems_one_by_one():
    coefficients = np.random.default_rng(0).normal(size=(5, 7))
    together = solve(*from_roots_of_unity(coefficients)).x.reshape(7, 4, 2)
    for k, one in enumerate(coefficients.T):
        alone = solve(*from_roots_of_unity(one)).x
        np.testing.assert_allclose(np.abs(np.sum(together[k].conj() * alone, axis=1)), 1.0, atol=1e-12)


@pytest.mark.parametrize("order", [2, 3, 4])
def test_solutions_that_meet_are_found_by_the_end_game_and_called_singular(order):
    coefficients = np.polynomial.polynomial.polyfromroots([0.5] * order + [2.0, -1.0])
    ends = solve(*from_roots_of_unity(coefficients))
    assert sorted(ends.end.tolist()) == [PathEnd.regular] * 2 + [PathEnd.singular] * order
    np.testing.assert_allclose(values(ends)[ends.end == PathEnd.singular], 0.5, rtol=0, atol=1e-6)
    assert nearest(values(ends)[ends.end == PathEnd.regular], [2.0, -1.0]) < 1e-9


def test_solutions_that_meet_beside_another_one_are_met_within_smaller_circles():
    """The larger circles go round all three."""
    ends = solve(*from_roots_of_unity(np.polynomial.polynomial.polyfromroots([0.5, 0.5, 0.51, 2.0, -1.0])))
    assert sorted(ends.end.tolist()) == [PathEnd.regular] * 3 + [PathEnd.singular] * 2
    np.testing.assert_allclose(values(ends)[ends.end == PathEnd.singular], 0.5, rtol=0, atol=1e-8)


def test_where_all_ends_should_be_regular_one_that_is_singular_is_enough():
    system, starts = from_roots_of_unity(np.polynomial.polynomial.polyfromroots([0.5] * 3 + [2.0] * 3 + [-1.0]))
    whole, ends = solve(system, starts), solve(system, starts, all_regular=True)
    assert np.sum(whole.end == PathEnd.singular) == 6
    assert np.sum(ends.end == PathEnd.singular) <= 4 < np.sum(ends.end != PathEnd.regular)
    assert np.any(ends.end == PathEnd.singular)
    regular = whole.end == PathEnd.regular
    np.testing.assert_array_equal(ends.end == PathEnd.regular, regular)
    np.testing.assert_array_equal(ends.x[regular], whole.x[regular])


@pytest.mark.parametrize("seed", range(2))
def test_where_all_ends_are_regular_nothing_is_left_out(seed):
    problem = from_roots_of_unity(np.random.default_rng(seed).normal(size=6))
    whole, ends = solve(*problem), solve(*problem, all_regular=True)
    np.testing.assert_array_equal(ends.end, whole.end)
    np.testing.assert_array_equal(ends.x, whole.x)


def test_a_solution_at_infinity_is_a_point_as_any_other():
    ends = solve(*from_roots_of_unity([-6.0, 11.0, -6.0, 1.0, 0.0]))
    assert np.all(ends.end == PathEnd.regular)
    far = np.abs(ends.x[:, 1]) < 1e-9
    assert np.sum(far) == 1
    assert nearest(values(ends)[~far], [1.0, 2.0, 3.0]) < 1e-9


def test_two_conics_meet_in_four_points_or_in_two_and_two_at_infinity():
    x, y, z, t = unknowns(4)
    start = [(x * x - z * z) * WAY, (y * y - z * z) * WAY]
    starts = np.array([[a, b, 1] for a in (1, -1) for b in (1, -1)], dtype=complex)
    ellipses = [x * x + 4 * y * y - 4 * z * z, 4 * x * x + y * y - 4 * z * z]
    ends = solve(expand([a * t + b * (1 - t) for a, b in zip(start, ellipses, strict=True)]), starts)
    assert np.all(ends.end == PathEnd.regular)
    np.testing.assert_allclose(np.abs(ends.x[:, :2] / ends.x[:, 2:]), np.sqrt(0.8), rtol=1e-12)
    circles = [x * x + y * y - z * z, (x - z) * (x - z) + y * y - z * z]
    ends = solve(expand([a * t + b * (1 - t) for a, b in zip(start, circles, strict=True)]), starts)
    finite = np.abs(ends.x[:, 2]) > 1e-9
    assert finite.sum() == 2
    np.testing.assert_allclose((ends.x[finite, 0] / ends.x[finite, 2]), 0.5, atol=1e-12)


def test_close_solutions_stay_apart():
    roots = np.array([1.0, 1.0 + 1e-4, -0.5, 2.0])
    ends = solve(*from_roots_of_unity(np.polynomial.polynomial.polyfromroots(roots)))
    assert np.all(ends.end == PathEnd.regular)
    assert nearest(values(ends), roots) < 1e-9
    assert len(distinct(ends.x)) == 4


def test_rank_gap_is_zero_where_solutions_meet():
    system, _ = from_roots_of_unity(np.polynomial.polynomial.polyfromroots([0.5, 0.5, 2.0]))
    points = np.array([[0.5, 1.0], [2.0, 1.0]], dtype=complex) / np.sqrt([[1.25], [5.0]])
    double, single = rank_gap(system, points, np.zeros(2, dtype=int))
    assert double < 1e-12 < 0.01 < single
