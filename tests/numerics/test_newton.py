"""Newton's steps from near starts: solutions, what is given up, derivatives, and redundant rows."""

import numpy as np

from assur.numerics.newton import BLOCK, STEPS, corrected, solved


def circle(radii):
    """x on a circle of each radius and on the line y = 0.5, one row twice."""

    def equations(x, rows):
        gaps = np.stack([np.sum(x**2, axis=1) - radii[rows] ** 2, x[:, 1] - 0.5, 2 * x[:, 1] - 1.0], axis=1)
        lower = np.broadcast_to([[0.0, 1.0], [0.0, 2.0]], (len(x), 2, 2))
        return gaps, np.concatenate([2 * x[:, None], lower], axis=1)

    return equations


def test_every_problem_of_several_blocks_meets_its_own_solution():
    radii = np.linspace(1.0, 2.0, 2 * BLOCK + 5)
    start = np.stack([radii, 0.6 * np.ones_like(radii)], axis=1)
    found = corrected(circle(radii), start)
    assert np.all(found.closed)
    np.testing.assert_allclose(found.values, np.stack([np.sqrt(radii**2 - 0.25), 0.5 + 0 * radii], axis=1), atol=1e-13)
    np.testing.assert_allclose(found.derivative[:, 0], 2 * found.values, atol=1e-4)


def test_what_has_no_solution_is_given_up_early_and_keeps_its_nearest_approach():
    seen = []

    def equations(x, rows):
        seen.append(len(rows))
        return circle(np.array([0.4, 1.0]))(x, rows)

    found = corrected(equations, np.array([[0.3, 0.5], [0.9, 0.5]]))
    assert found.closed.tolist() == [False, True]
    assert abs(np.sum(found.values[0] ** 2) - 0.16) <= 0.3**2 + 0.25 - 0.16
    assert sum(seen) < 2 * STEPS


def test_a_fold_is_met_slowly_but_met():
    found = corrected(lambda x, _: (x**2, 2 * x[:, :, None]), np.array([[0.05]]))
    assert found.closed[0]
    assert abs(found.values[0, 0]) < 1e-4


def test_free_unknowns_stay_and_redundant_rows_do_no_harm():
    matrix = np.array([[[1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]])
    np.testing.assert_allclose(solved(matrix, np.array([[[3.0], [6.0]]])), [[[3.0], [0.0], [0.0]]], atol=1e-9)
