"""Zeros of more quadrics than unknowns: against points they were made from, beside curves of zeros at infinity."""

import numpy as np
import pytest

from assur.numerics.overdetermined_quadrics import zeros_apart


def _through(points, rng):
    """A basis of all real quadrics through points (k, n), mixed by chance."""
    first, second = np.triu_indices(points.shape[1])
    values = points[:, first] * points[:, second] * np.where(first == second, 1, 2)
    values = np.concatenate([values.real, values.imag])
    left = np.linalg.svd(values)[2][np.linalg.matrix_rank(values) :]
    forms = np.zeros((len(left), points.shape[1], points.shape[1]))
    forms[:, first, second] = rng.normal(size=(len(left), len(left))) @ left
    forms[:, second, first] = forms[:, first, second]
    return forms


def _distances(points, zeros):
    points, zeros = (own / np.linalg.norm(own, axis=1, keepdims=True) for own in (points, zeros))
    return 1 - np.max(np.abs(np.conj(points) @ zeros.T), axis=1)


@pytest.mark.parametrize(("size", "count"), [(4, 1), (4, 4), (6, 5), (8, 4), (8, 8)])
def test_points_by_chance_are_met_again(size, count):
    rng = np.random.default_rng(size + count)
    points = rng.normal(size=(count, size))
    zeros = zeros_apart(_through(points, rng), np.diag([1.0] * 2 + [0.0] * (size - 2)))
    assert len(zeros) == count
    assert np.max(_distances(points, zeros)) < 1e-12


def test_complex_points_are_met_in_pairs():
    rng = np.random.default_rng(2)
    points = rng.normal(size=(2, 7)) + 1j * rng.normal(size=(2, 7))
    points = np.concatenate([points, np.conj(points)])
    zeros = zeros_apart(_through(points, rng), np.diag([1.0] * 7))
    assert np.max(_distances(points, zeros)) < 1e-12
    assert len(zeros) == 4


def test_a_line_of_zeros_where_the_other_vanishes_is_left_out():
    """Quadrics through three points of a line have all of it among their zeros."""
    rng = np.random.default_rng(3)
    points = rng.normal(size=(3, 6))
    line = rng.normal(size=(3, 2)) @ np.eye(6)[4:]
    zeros = zeros_apart(_through(np.concatenate([points, line]), rng), np.diag([1.0, 1, 1, 1, 0, 0]))
    assert np.max(_distances(points, zeros)) < 1e-12
    assert len(zeros) == 3


def test_points_that_meet_are_not_told():
    """x^2 = 0, y = 0 beside it: a point twice."""
    forms = np.zeros((3, 3, 3))
    forms[0, 1, 1] = forms[1, 2, 2] = 1
    forms[2, 0, 2] = forms[2, 2, 0] = 1
    assert zeros_apart(forms, np.diag([1.0, 0, 0])) is None


def test_without_zeros_there_are_none():
    forms = np.array([np.diag(row) for row in ([1.0, 0, 0], [0, 1.0, 0], [0, 0, 1.0])])
    assert len(zeros_apart(forms, np.diag([1.0, 1, 1]))) == 0
