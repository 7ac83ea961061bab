"""Followed roots are those of the null space; where roots meet, that is said."""

import numpy as np
import pytest

from assur.kinematics.loops.followed import followed
from assur.numerics.quadratic_systems import quadratic


@pytest.mark.parametrize("unknowns", [1, 3, 4])
def test_both_ways_find_the_same_roots(unknowns: int) -> None:
    forms = np.random.default_rng(unknowns).normal(size=(unknowns, unknowns + 1, unknowns + 1)) + 0j
    ours, theirs = followed(forms), quadratic(forms)
    assert ours.isolated
    assert ours.error < 1e-12
    assert len(ours.values) == ours.count == 2**unknowns
    gaps = np.linalg.norm(ours.values[:, None] - theirs.values, axis=-1)
    assert np.max(np.min(gaps, axis=0)) < 1e-8
    assert np.max(np.min(gaps, axis=1)) < 1e-8


def test_six_equations_have_64_roots() -> None:
    forms = np.random.default_rng(6).normal(size=(6, 7, 7)) + 0j
    found = followed(forms)
    assert found.isolated
    x = np.insert(found.values, 0, 1.0, axis=1)
    x /= np.linalg.norm(x, axis=1, keepdims=True)
    assert np.max(np.abs(np.einsum("ni,kij,nj->nk", x, forms, x))) < 1e-10
    overlap = np.abs(x.conj() @ x.T) - 2 * np.eye(64)
    assert np.max(overlap) < 1 - 1e-6


def test_a_double_root_and_a_curve_are_not_called_isolated() -> None:
    double = np.zeros((2, 3, 3), dtype=complex)
    double[0, [1, 2, 0], [1, 2, 0]] = 1, 1, -2  # x^2 + y^2 = 2
    double[1, [1, 0], [2, 0]] = 1, -1  # x y = 1
    assert not followed(double).isolated
    double[1] = 2 * double[0]
    assert not followed(double).isolated
