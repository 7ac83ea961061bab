"""All roots: their number is known, they solve the equations, and curves of roots are noticed."""

import math

import numpy as np
import pytest

from assur.numerics.quadratic_systems import bilinear, quadratic


@pytest.mark.parametrize("loops", [1, 2, 3])
def test_bilinear_equations_have_binomially_many_roots(loops: int) -> None:
    forms = np.random.default_rng(loops).normal(size=(2 * loops, loops + 1, loops + 1)) + 0j
    found = bilinear(forms)
    assert found.isolated
    assert len(found.values) == found.count == math.comb(2 * loops, loops)
    x, y = (np.insert(part, 0, 1.0, axis=1) for part in np.split(found.values, 2, axis=1))
    assert np.max(np.abs(np.einsum("ni,kij,nj->nk", x, forms, y))) < 1e-9
    assert _apart(found.values) > 1e-3


@pytest.mark.parametrize("unknowns", [1, 2, 3, 4])
def test_quadratic_equations_have_a_power_of_two_roots(unknowns: int) -> None:
    forms = np.random.default_rng(unknowns).normal(size=(unknowns, unknowns + 1, unknowns + 1)) + 0j
    found = quadratic(forms)
    assert found.isolated
    assert len(found.values) == found.count == 2**unknowns
    x = np.insert(found.values, 0, 1.0, axis=1)
    assert np.max(np.abs(np.einsum("ni,kij,nj->nk", x, forms, x))) < 1e-9
    assert _apart(found.values) > 1e-3


def test_spheres_meet_in_two_points_though_they_share_a_curve_at_infinity() -> None:
    centres = np.array([[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 4.0, 0.0]])
    point = np.array([1.0, 2.0, 2.0])
    found = quadratic(_spheres(centres, np.linalg.norm(centres - point, axis=1)))
    assert found.count == 2
    expected = [[1.0, 2.0, -2.0], [1.0, 2.0, 2.0]]
    np.testing.assert_allclose(found.values[np.argsort(found.values[:, 2].real)], expected, atol=1e-9)


def test_a_double_root_comes_twice() -> None:
    centres = np.array([[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 4.0, 0.0]])
    found = quadratic(_spheres(centres, np.linalg.norm(centres - [1.0, 2.0, 0.0], axis=1)))
    np.testing.assert_allclose(found.values, [[1.0, 2.0, 0.0]] * 2, atol=1e-6)


def test_a_curve_of_roots_is_noticed() -> None:
    centres = np.array([[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [6.0, 0.0, 0.0]])  # three spheres through one circle
    assert not quadratic(_spheres(centres, np.linalg.norm(centres - [1.0, 2.0, 2.0], axis=1))).isolated
    twice = np.array([[[-1, 0], [0, 1]], [[-2, 0], [0, 2]]], dtype=complex)
    assert not bilinear(twice).isolated


def test_a_form_that_vanishes_leaves_a_curve_of_roots() -> None:
    """Rounding in its place would have roots of its own."""
    noise = 1e-17 * np.random.default_rng(0).normal(size=(2, 2))
    assert not bilinear(np.array([[[-1, 0], [0, 1]], noise], dtype=complex)).isolated
    circle = np.diag([-1.0, 1.0, 1.0])
    assert not quadratic(
        np.array([circle, 1e-17 * np.random.default_rng(1).normal(size=(3, 3))], dtype=complex)
    ).isolated


def _spheres(centres: np.ndarray, radii: np.ndarray) -> np.ndarray:
    forms = np.zeros((len(centres), 4, 4), dtype=complex)
    for form, centre, radius in zip(forms, centres, radii, strict=True):
        form[1:, 1:] = np.eye(3)
        form[0, 1:] = form[1:, 0] = -centre
        form[0, 0] = centre @ centre - radius**2
    return forms


def _apart(values: np.ndarray) -> float:
    gaps = np.linalg.norm(values[:, None] - values[None], axis=-1)
    return float(np.min(gaps + np.where(np.eye(len(values)) > 0, np.inf, 0.0)))
