"""Every form of a set's equations has the same roots, and what cannot be counted is refused."""

import numpy as np
import pytest

from assur.kinematics.loops import equations
from assur.kinematics.loops.equations import roots_of_set, without
from assur.kinematics.loops.hinges import NotCirclesError
from assur.kinematics.loops.unknowns import UnknownGroup
from assur.numerics.quadratic_systems import Roots

CIRCLES = [UnknownGroup("circle", 1 + 2 * k, 1 + 2 * k) for k in range(3)]
ROWS = np.random.default_rng(3).normal(size=(3, 7)) + 0j
ONE = np.eye(7, dtype=complex)[0]


def _checked(found: Roots, groups: list[UnknownGroup], rows: np.ndarray) -> None:
    whole = np.insert(found.values, 0, 1.0, axis=1)
    assert np.max(np.abs(whole @ rows.T)) < 1e-8
    for group in groups:
        for equation in group.quadratic:
            assert np.max(np.abs(sum(factor * whole[:, a] * whole[:, b] for factor, a, b in equation))) < 1e-8


def test_null_space_and_paths_give_three_circles_the_same_roots(monkeypatch: pytest.MonkeyPatch) -> None:
    small = roots_of_set(ROWS, ONE, CIRCLES)
    monkeypatch.setattr(equations, "MOST_QUADRATIC", 2)
    along = roots_of_set(ROWS, ONE, CIRCLES)
    for found in (small, along):
        assert len(found.values) == found.count == 8
        _checked(found, CIRCLES, ROWS)
    assert np.max(np.min(np.linalg.norm(along.values[:, None] - small.values, axis=-1), axis=0)) < 1e-7


def test_a_triangle_on_three_circles_has_16_roots() -> None:
    rng = np.random.default_rng(8)
    triangle = UnknownGroup("triangle", 7, 7, alone=True, sides=(1.0, 1.2, 0.9))
    rows = np.zeros((6, 13), dtype=complex)
    centres = rng.normal(size=(3, 3))
    frames = [np.linalg.qr(rng.normal(size=(3, 3)))[0] for _ in range(3)]
    points = [np.zeros((3, 13), dtype=complex) for _ in range(3)]
    for k, (point, centre, frame) in enumerate(zip(points, centres, frames, strict=True)):
        point[:, 0] = centre
        point[:, 1 + 2 * k] = (frame[:, 0] - 1j * frame[:, 1]) / 2
        point[:, 2 + 2 * k] = (frame[:, 0] + 1j * frame[:, 1]) / 2
    for k in (1, 2):
        own = slice(3 * k - 3, 3 * k)
        rows[own] = points[k] - points[0]
        rows[own, 4 + 3 * k : 7 + 3 * k] = -np.eye(3)
    groups = [*CIRCLES, triangle]
    found = roots_of_set(rows, np.eye(13, dtype=complex)[0], groups)
    assert (len(found.values), found.count) == (16, 16)
    _checked(found, groups, rows)


def test_a_set_that_cannot_be_counted_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    many = [UnknownGroup("circle", 1 + 2 * k, 1 + 2 * k) for k in range(8)]
    rows = np.random.default_rng(1).normal(size=(8, 17)) + 0j
    with pytest.raises(NotCirclesError, match="more than 7 quadratic equations"):
        roots_of_set(rows, np.eye(17, dtype=complex)[0], many)
    monkeypatch.setattr(equations, "MOST_QUADRATIC", 2)
    double = np.zeros((3, 7), dtype=complex)
    double[range(3), [1, 3, 5]] = double[range(3), [2, 4, 6]] = 1.0
    double[:, 0] = -2.0  # every angle is 0, twice
    with pytest.raises(NotCirclesError, match="not all 8 roots of 3 quadratic equations are regular"):
        roots_of_set(double, ONE, CIRCLES)


def test_rows_without_columns() -> None:
    left = without(ROWS, [3, 4])
    assert left.shape == (1, 7)
    np.testing.assert_allclose(left[:, 3:5], 0.0, atol=1e-12)
