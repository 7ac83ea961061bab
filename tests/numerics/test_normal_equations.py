"""Least-squares steps without pivots, against the singular value decomposition."""

import numpy as np
import pytest

from assur.numerics.normal_equations import least_squares_steps

RNG = np.random.default_rng(5)


def dense(step, count):
    return np.array([step.get(column, 0.0) for column in range(count)])


@pytest.mark.parametrize("rows", [4, 9])
@pytest.mark.parametrize("share", [1.0, 0.4])
def test_the_least_change_that_undoes_residuals(rows, share):
    for _ in range(20):
        matrix = RNG.normal(size=(rows, 4)) * (RNG.random((rows, 4)) < share)
        residual = RNG.normal(size=rows)
        entries = {(i, j): matrix[i, j] for i in range(rows) for j in range(4) if matrix[i, j]}
        moving = sorted({j for _, j in entries})
        if np.linalg.matrix_rank(matrix) < len(moving):
            continue
        step = dense(least_squares_steps(entries, [dict(enumerate(residual))], 0.0)[0], 4)
        expected = np.linalg.lstsq(matrix, -residual, rcond=None)[0]
        np.testing.assert_allclose(step, expected, atol=1e-9 * (1 + np.linalg.cond(matrix[:, moving]) ** 2))


def test_redundant_rows_and_free_columns_do_no_harm():
    """What nothing tells stays where it is, up to rounding; the rest is solved."""
    matrix = RNG.normal(size=(5, 3)) @ RNG.normal(size=(3, 6))
    residual = matrix @ RNG.normal(size=6)
    entries = {(i, j): matrix[i, j] for i in range(5) for j in range(6)}
    step = dense(least_squares_steps(entries, [dict(enumerate(residual))], 1e-14)[0], 6)
    np.testing.assert_allclose(matrix @ step, -residual, atol=1e-6)
    expected = np.linalg.lstsq(matrix, -residual, rcond=None)[0]
    np.testing.assert_allclose(step, expected, atol=0.3 * np.linalg.norm(expected))


def test_whole_numbers_stay_whole_and_missing_residuals_are_nothing():
    entries = {(0, 0): 1, (1, 1): -1}
    assert least_squares_steps(entries, [{1: 3}, {}], 0.0) == [{0: 0, 1: 3.0}, {0: 0, 1: 0}]
