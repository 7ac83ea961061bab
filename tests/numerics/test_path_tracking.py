"""Following one path after another: it stays on its solution, and says where it cannot go on."""

import numpy as np
import pytest

from assur.numerics.expanded import expand, unknowns
from assur.numerics.path_tracking import along, polished

ONE = np.zeros(1, dtype=int)


def ellipse_and_line():
    """x^2 + 2 y^2 = 3 z^2 and x = (1 + t) y: closed-form solutions to compare with."""
    x, y, z, t = unknowns(4)
    return expand([x * x + 2 * y * y - 3 * z * z, x - (1 + t) * y])


def exact(t):
    y = np.sqrt(3 / ((1 + t) ** 2 + 2))
    return np.array([(1 + t) * y, y, 1.0])


def affine(x):
    return x / x[..., -1:]


@pytest.mark.parametrize("close", [1e-3, 1e-6])
def test_a_path_ends_on_the_closed_form(close):
    end, arrived, _ = along(ellipse_and_line(), exact(1.0)[None].astype(complex), ONE, np.ones(1), np.zeros(1), close)
    assert arrived.all()
    assert np.linalg.norm(end) == pytest.approx(1.0, abs=1e-9)
    np.testing.assert_allclose(affine(end)[0], exact(0.0), rtol=0, atol=1e-8)


def test_t_may_be_complex_and_its_way_does_not_matter():
    system = ellipse_and_line()
    corner = np.array([0.5 + 0.7j])
    there, first, _ = along(system, exact(1.0)[None].astype(complex), ONE, np.ones(1), corner, 1e-5)
    end, second, _ = along(system, there, ONE, corner, np.zeros(1), 1e-5)
    assert (first & second).all()
    np.testing.assert_allclose(affine(end)[0], exact(0.0), rtol=0, atol=1e-9)


def test_a_path_into_a_double_root_does_not_arrive_and_says_so():
    x, y, t = unknowns(3)
    system = expand([x * x - t * y * y])
    end, arrived, _ = along(system, np.array([[1, 1]], dtype=complex), ONE, np.ones(1), np.zeros(1), 1e-4)
    assert not arrived[0]
    assert abs(affine(end)[0, 0]) < 1e-3


def test_each_path_of_a_batch_has_its_own_step():
    x, y, t = unknowns(3)
    system = expand([x * x - (np.array([1e-6, 1.0]) * (1 - t) + t) * y * y])
    start, both = np.array([[1, 1], [1, 1]], dtype=complex), np.arange(2)
    together, arrived, most = along(system, start, both, np.ones(2), np.zeros(2), 1e-5)
    assert arrived.all()
    np.testing.assert_allclose(affine(together)[:, 0], [1e-3, 1.0], rtol=1e-7)
    assert along(system, start[1:], both[1:], np.ones(1), np.zeros(1), 1e-5)[2] < most


def test_polishing_reaches_rounding_and_says_where_it_does_not(monkeypatch):
    system = ellipse_and_line()
    rough = exact(0.0) + np.array([1e-3, -2e-3, 0])
    found, good = polished(system, rough[None].astype(complex), np.zeros(1), ONE)
    assert good[0]
    np.testing.assert_allclose(affine(found)[0], exact(0.0), rtol=0, atol=1e-14)
    monkeypatch.setattr("assur.numerics.path_tracking.POLISHINGS", 1)
    _, good = polished(system, rough[None].astype(complex), np.zeros(1), ONE)
    assert not good[0]
