"""Direct problems by one polynomial: the estimate of its rounding, and roots that nearly meet."""

import itertools
from types import SimpleNamespace

import numpy as np
import pytest

import assur
from assur.kinematics.closed_form import polynomials as polynomial_solver
from assur.kinematics.closed_form.roots import coefficients_of
from assur.kinematics.status import Status
from assur.model.closed_form import Eliminant
from assur.numerics import polynomials

RANDOM = np.random.default_rng(12)
HALF = (1, -1)
FIRST = np.array([1.0, 0.0, 0.0])


class Long:
    """NumPy's longest float."""

    def sqrt(self, radicand):
        return np.sqrt(np.asarray(radicand, dtype=np.longdouble))


def eliminants():
    forms = {name: assur.load(name).closed_form for name in assur.names()}
    return [name for name, form in forms.items() if form and isinstance(form.direct, Eliminant)]


def inputs_of_box(mechanism, count=60):
    low, high = np.array([mechanism.box[name] for name in mechanism.platform.pose]).T
    found = mechanism.inverse(RANDOM.uniform(low, high, size=(count, len(low))))
    return found.inputs[found.exists][:200]


def precise(mechanism, inputs):
    """Coefficients (*parts, N, d + 1) in the longest float."""
    eliminant = mechanism.closed_form.direct
    values = SimpleNamespace(**{name: np.longdouble(value) for name, value in vars(mechanism.values).items()})
    wide = inputs.astype(np.longdouble).T
    angular = [item.coordinate.kind == "angle" for item in mechanism.inputs]
    given = [(np.cos(row), np.sin(row)) if turns else row for row, turns in zip(wide, angular, strict=True)]
    parts = len(eliminant.signs)
    axes = {
        name: np.array(HALF, dtype=float).reshape([2 if k == place else 1 for k in range(parts)] + [1])
        for place, name in enumerate(eliminant.signs)
    }
    extra = (SimpleNamespace(**axes),) if parts else ()
    entries = eliminant.coefficients(Long(), values, given, *extra)
    return np.stack([np.broadcast_to(item, (*(2,) * parts, len(inputs))) for item in entries], axis=-1)


@pytest.mark.skipif(np.finfo(np.longdouble).eps > 1e-18, reason="this machine has no longer float than the usual one")
@pytest.mark.parametrize("name", eliminants())
def test_the_rounding_of_the_polynomial_is_within_its_estimate(name):
    """At any real point the polynomial is wrong by less than the estimate says, and that is not a wild one."""
    mechanism = assur.load(name)
    inputs = inputs_of_box(mechanism)
    found, rounding = coefficients_of(mechanism, mechanism.closed_form.direct, inputs)
    degree = found.shape[-1] - 1
    powers, angle = np.arange(degree + 1), RANDOM.uniform(-np.pi / 2, np.pi / 2, 40)[:, None]
    basis = np.cos(angle) ** (degree - powers) * np.sin(angle) ** powers  # (40, d + 1)
    error = np.abs((found - precise(mechanism, inputs)).astype(float) @ basis.T)
    share = error / (rounding @ np.abs(basis).T)
    assert np.max(share) < 1
    assert np.median(share) > 1e-4


@pytest.mark.parametrize("name", eliminants())
def test_random_problems_are_decided(name):
    mechanism = assur.load(name)
    found = mechanism.direct(inputs_of_box(mechanism))
    assert found.complete
    assert not np.any(found.unsure)


def border(mechanism, low, high):
    """Inputs between two, as near as floats come to where the number of poses first is another than at the first."""
    low, high = np.array(low, dtype=float), np.array(high, dtype=float)
    number = len(mechanism.direct(low, method="closed form"))
    while True:
        middle = (low + high) / 2
        if np.array_equal(middle, low) or np.array_equal(middle, high):
            return low
        low, high = (middle, high) if len(mechanism.direct(middle, method="closed form")) == number else (low, middle)


@pytest.mark.parametrize(("first", "before", "after"), [((380, 390, 400), 16, 12), ((300, 310, 290), 8, 4)], ids=str)
def test_poses_that_meet_are_there_on_one_side_and_not_on_the_other(first, before, after):
    mechanism = assur.load("three_rps")
    there = border(mechanism, first, (80.0, *first[1:]))
    for away in (1e-9, 1e-6, 1e-3):
        for sense, number in ((1, before), (-1, after)):
            found = mechanism.direct(there + sense * away * FIRST, method="closed form")
            assert (found.complete, len(found)) == (True, number)


def test_where_three_roots_meet_the_answer_is_right_or_undecided():
    """With two equal lengths three poses become one."""
    mechanism = assur.load("three_rps")
    there = border(mechanism, (380, 395, 395), (80, 395, 395))
    undecided = 0
    for away, number in ((-1e-2, 12), (-1e-6, 12), (0.0, 16), (1e-6, 16), (1e-2, 16)):
        found = mechanism.direct(there + away * FIRST, method="closed form")
        undecided += not found.complete
        assert (found.complete and len(found) == number) or (not found.complete and abs(away) < 5e-7)
    assert undecided > 0


def test_a_polynomial_that_is_not_finite_is_undecided():
    mechanism = assur.load("three_rps", R=60.0, r=120.0)
    found = mechanism.direct(np.array([250.0, 260.0, 275.0]), method="closed form")
    assert found.overall_status == Status.undecided


def test_signs_of_an_eliminant_make_one_polynomial_each():
    mechanism = assur.load("three_rps")
    eliminant = mechanism.closed_form.direct
    found, rounding = coefficients_of(mechanism, eliminant, np.array([[380.0, 390.0, 400.0], [300.0, 310.0, 290.0]]))
    assert found.shape == rounding.shape == (2, 2, 2, eliminant.roots + 1)
    assert np.array_equal(found[:, 0], found[:, 1])  # a pose and its mirror image have one root
    assert not np.allclose(found[0], found[1])
    answer = mechanism.direct([380.0, 390.0, 400.0])
    assert answer.right == "closed form, all roots of 2 polynomials of degree 4, with both signs of side"
    real = np.sum(polynomials.nearness(found[:, :, 0], polynomials.roots(found[:, :, 0]), rounding[:, :, 0])[0])
    assert len(answer) == real == 16


def cranks_near_flat(spread):
    return np.pi + np.radians(spread) * np.array([0.31, -0.74, 0.52])


@pytest.mark.parametrize("spread", [0.6, 0.1, 1e-2, 1e-3])
def test_two_fourfold_roots_of_the_3_rrc_that_nearly_meet(spread):
    """With R - r = l1 all cranks at 180 deg make the three cylinders touch in two points."""
    mechanism = assur.load("three_rrc", r=70.0)
    inputs = cranks_near_flat(spread)
    found = mechanism.direct(inputs)
    searched = mechanism.direct(inputs, method="search")
    assert found.complete
    assert len(found) >= len(searched)


@pytest.mark.parametrize("spread", [1e-6, 1e-7, 0.0])
def test_nearer_it_says_that_it_does_not_know(spread):
    found = assur.load("three_rrc", r=70.0).direct(cranks_near_flat(spread), method="closed form")
    assert found.overall_status == Status.undecided
    assert not found.complete


def alike(values, crank):
    """Poses (4, 4) of the H4 robot with all cranks at one angle: the four spheres have centres in one level plane.

    The pairs give x + h c = h and y = h s. So a sphere of each needs (2 h s + E)^2 = (2 h - 2 h c)^2, which has two
    real angles, with c + s = 1 - E/(2 h), and each of them a height on either side of the plane.
    """
    h, reach = values.h, values.R - values.r + values.L * np.cos(crank)
    turn = np.arccos((1 - values.E / (2 * h)) / np.sqrt(2))
    assert 1 + values.E / (2 * h) > np.sqrt(2)  # c - s is never so large
    phi = np.pi / 4 + np.array([turn, turn, -turn, -turn])
    aside = 2 * h * np.sin(phi) + values.E
    height = np.array([1, -1, 1, -1]) * np.sqrt(values.l**2 - reach**2 - aside**2) - values.L * np.sin(crank)
    return np.stack([h - h * np.cos(phi), h * np.sin(phi), height, phi], axis=-1)


@pytest.mark.parametrize("crank", [-60.0, 0.0, 30.0, 45.0, 89.0])
def test_poses_that_share_phi_are_told_apart(crank):
    mechanism = assur.load("h4_robot")
    found = mechanism.direct(np.radians([crank] * 4))
    wanted = alike(mechanism.values, np.radians(crank))
    assert found.complete
    assert len(found) == 4
    gaps = np.abs(found.poses[found.exists][:, None] - wanted).max(axis=-1)
    assert np.all(gaps.min(axis=0) < 1e-7)


def test_alike_cranks_of_the_h4_are_undecided_only_where_two_knees_coincide():
    """Then two of the four spheres are one, and nothing but a curve or no pose at all can be left."""
    degrees = np.array(list(itertools.product((-60, 0, 30, 45, 120, 180), repeat=4)))
    found = assur.load("h4_robot").direct(np.radians(degrees))
    together = np.all(degrees[:, :2] == 180, axis=1) | np.all(degrees[:, 2:] == 180, axis=1)
    assert np.array_equal(found.overall_status == Status.undecided, together)


def test_the_leading_coefficient_of_the_h4_is_as_said():
    mechanism = assur.load("h4_robot", h=35.0)
    values, cranks = mechanism.values, RANDOM.uniform(-3, 3, size=(20, 4))
    out, down = values.R - values.r + values.L * np.cos(cranks), values.L * np.sin(cranks)
    a, b = ((out[:, k] + out[:, k + 1], down[:, k + 1] - down[:, k]) for k in (0, 2))
    slopes = a[1] / a[0], b[1] / b[0]
    upright = 1 / (1 + slopes[0] ** 2 + slopes[1] ** 2)  # n_z^2
    coefficients, _ = coefficients_of(mechanism, mechanism.closed_form.direct, cranks)
    np.testing.assert_allclose(coefficients[:, -1], -16 * (2 * values.h / values.l) ** 8 * upright**2, rtol=1e-9)


@pytest.mark.parametrize("apart", [1.0, 0.03, 1e-4])
def test_roots_that_go_to_infinity_leave_no_doubt(apart):
    """Where two knees of the H4 nearly meet, four of the eight roots do; no pose is that far away."""
    found = assur.load("h4_robot").direct(np.radians([180 - apart, 180 + 0.3 * apart, 30, 40]))
    assert (len(found), found.complete) == (2, True)
    assert np.all(found.residuals[found.exists] < 1e-6)


@pytest.mark.deep
def test_where_roots_leave_a_problem_open_the_loops_are_held_to_the_model_of_the_form(monkeypatch):
    """Of an H4 the loops find assemblies with one bar turned half round against the other, as its file lets it."""
    mechanism = assur.load("h4_robot")
    inputs = np.full(4, 0.8382)
    by_form = mechanism.direct(inputs)
    assert len(mechanism.direct(inputs, method="loops")) == 6
    monkeypatch.setattr(polynomial_solver, "roots_of", lambda *_: SimpleNamespace(complete=False))
    by_loops = mechanism.direct(inputs)
    assert "2 beside the model of the closed form left out" in by_loops.right
    assert (by_loops.complete, by_loops.complete_for) == (by_form.complete, by_form.complete_for)
    assert len(by_form) == 4
    poses, others = (np.array([own.pose for own in found]) for found in (by_form, by_loops))
    assert np.allclose(poses[np.argsort(poses[:, 2])], others[np.argsort(others[:, 2])], rtol=0, atol=1e-6)
