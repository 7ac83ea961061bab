import numpy as np

from assur.numerics.least_squares import minimise


def _circles(x, rows):
    """Two circles that meet; the third row repeats the first, so the system is redundant."""
    first = x[:, 0] ** 2 + x[:, 1] ** 2 - 1.0
    second = (x[:, 0] - 1.0) ** 2 + x[:, 1] ** 2 - 1.0
    residual = np.stack([first, second, first], axis=1)
    one = np.stack([2 * x[:, 0], 2 * x[:, 1]], axis=1)
    two = np.stack([2 * (x[:, 0] - 1.0), 2 * x[:, 1]], axis=1)
    return residual, np.stack([one, two, one], axis=1)


def test_redundant_rows_do_no_harm():
    found = minimise(_circles, np.random.default_rng(0).normal(size=(200, 2)), tolerance=1e-13)
    assert np.all(found.converged)
    np.testing.assert_allclose(np.abs(found.x), np.broadcast_to([0.5, np.sqrt(0.75)], (200, 2)), atol=1e-12)


def test_a_problem_without_a_root_is_reported_and_does_not_disturb_the_others():
    def system(x, rows):
        target = np.array([4.0, -1.0, 9.0])[rows]
        return x**2 - target[:, None], 2 * x[:, :, None]

    found = minimise(system, np.ones((3, 1)), tolerance=1e-12)
    assert found.converged.tolist() == [True, False, True]
    np.testing.assert_allclose(found.x[[0, 2], 0], [2.0, 3.0], atol=1e-12)


def test_an_underdetermined_system_moves_little():
    def system(x, rows):
        return x.sum(axis=1, keepdims=True) - 3.0, np.ones((len(x), 1, 3))

    found = minimise(system, np.array([[1.0, 0.0, 0.0]]), tolerance=1e-13)
    np.testing.assert_allclose(found.x[0], [5 / 3, 2 / 3, 2 / 3], atol=1e-6)


def test_damping_that_is_lost_in_rounding_does_no_harm():
    """Two long columns of forty: the damping is a share of the mean square, too little to change 100."""

    def system(x, rows):
        row = np.zeros((len(x), 1, 40))
        row[:, 0, :2] = 10.0
        return 10.0 * x[:, :1] + 10.0 * x[:, 1:2] - 1.0, row

    found = minimise(system, np.zeros((2, 40)), tolerance=1e-14, damping=1e-15)
    assert found.converged.all()
    np.testing.assert_allclose(found.x[:, :2], 0.05, rtol=1e-12)


def test_an_empty_batch_is_an_empty_answer():
    found = minimise(_circles, np.empty((0, 2)), tolerance=1e-12)
    assert found.x.shape == (0, 2)


def test_a_valley_that_ends_above_zero_is_left_and_a_double_root_is_not():
    calls = []

    def system(x, rows):
        calls.append(len(rows))
        above = np.array([1.0, 0.0])[rows]
        residual = np.stack([x[:, 0], x[:, 1] ** 2 + above], axis=1)
        slope = np.zeros((len(x), 2, 2))
        slope[:, 0, 0], slope[:, 1, 1] = 1.0, 2.0 * x[:, 1]
        return residual, slope

    found = minimise(system, np.full((2, 2), 0.7), tolerance=1e-13)
    assert found.converged.tolist() == [False, True]
    assert abs(found.x[0, 1]) < 1e-3, "at the lowest place of the valley"
    assert calls.count(2) < 20  # of 60


def test_other_unknowns_for_the_same_may_be_taken_at_every_step():
    angle = minimise(
        lambda x, _: (np.sin(x), np.cos(x)[:, :, None]),
        np.array([[20.0]]),
        tolerance=1e-13,
        same=lambda x: np.remainder(x + np.pi, 2 * np.pi) - np.pi,
    )
    assert angle.converged.all()
    assert np.abs(angle.x).max() <= np.pi
