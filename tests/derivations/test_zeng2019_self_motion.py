"""Zeng et al. (2019) at B = 0: the platform moves along a curve while every input stands still."""

from types import SimpleNamespace

import numpy as np
import pytest
import sympy as sp

from assur.numerics.dual import Dual, Duals

E2, E3 = MODE = sp.symbols("e2 e3")
ANY_MODE = SimpleNamespace(e2=E2, e3=E3)


@pytest.fixture(scope="module")
def locked(model):
    """Inputs with B = 0."""
    y_a1, _, y_a3 = model.inputs
    return (y_a1, y_a1 - model.p.l3, y_a3)


@pytest.fixture(scope="module")
def curve(model, locked):
    """The kernel at a symbolic cos(gamma); sin(gamma) is the first root."""
    roots = model.Roots()
    cosine = sp.Symbol("cos_gamma")
    gamma = (cosine, roots.sqrt(1 - cosine**2))
    return model.kernels.self_motion(roots, model.p, locked, gamma, ANY_MODE), roots, gamma


def test_every_point_of_the_curve_closes_the_mechanism(model, locked, curve):
    branch, roots, _ = curve
    joints = model.kernel_joints(model.p, branch.core)
    for name, gap in model.closure(model.p, locked, branch.pose, joints).items():
        assert roots.vanishes(gap, MODE), name


def test_off_B_zero_the_curve_does_not_close(model, curve):
    """The test above can fail."""
    branch, roots, _ = curve
    joints = model.kernel_joints(model.p, branch.core)
    gaps = model.closure(model.p, model.inputs, branch.pose, joints)
    assert [name for name, gap in gaps.items() if not roots.vanishes(gap, MODE)] == ["via_B2_y"]


def test_the_curve_is_all_of_B_zero(model, locked):
    """At B = 0 the closure says u1 = u2 and w1 = w2 and leaves gamma free; the rest is loop 2 as ever."""
    gaps = model.closure(model.p, locked, model.pose, model.joints)
    first, second = model.angles["B1"], model.angles["B2"]
    for axis, function in (("y", sp.cos), ("z", sp.sin)):
        difference = gaps[f"via_B1_{axis}"] - gaps[f"via_B2_{axis}"]
        assert sp.expand(difference - model.p.l2 * (function(first) - function(second))) == 0


def test_its_signs_are_those_of_v_and_of_sin_beta_minus_alpha(model, curve):
    branch, roots, _ = curve
    _, (v_root, _), (meeting_root, _) = roots.radicands
    assert roots.vanishes(branch.core.v - E2 * v_root, MODE)
    scale = 2 * model.p.l4 * model.p.l6
    assert roots.vanishes(scale * branch.core.sin_beta_minus_alpha - E3 * meeting_root, MODE)


def test_the_pose_moves_along_the_curve(curve):
    branch, _, gamma = curve
    assert gamma[0] in branch.pose[1].free_symbols


def test_det_jp_vanishes_all_along_it(model, curve):
    branch, roots, _ = curve
    jp, _ = model.kernels.jacobians(roots, model.p, branch.core)
    assert sp.Matrix(jp).row(0).is_zero_matrix


def test_the_direct_formulas_would_return_one_sample_of_it(model, locked, curve):
    """At B = 0 they put B1C1 upright: gamma = 90 or -90 degrees by e1 (E5)."""
    branch, _, (cosine, sine) = curve
    e1 = sp.Symbol("e1")
    sample = model.kernels.direct(model.Roots(), model.p, locked, SimpleNamespace(e1=e1, e2=E2, e3=E3))
    assert sample.margins["B"] == 0
    assert sp.expand(sample.pose[1] - branch.pose[1].subs(cosine, 0)) == 0
    assert sp.expand(sample.core.u1) == 0
    assert sample.margins["w2"] == model.p.l2**2
    assert branch.core.w == model.p.l2 * sine


@pytest.mark.parametrize(("e2", "e3"), [(1, 1), (1, -1), (-1, 1), (-1, -1)])
@pytest.mark.parametrize("gamma", [-0.4, -0.2, 0.2, 0.4])
def test_its_tangent_is_a_motion_that_jp_does_not_see(model, gamma, e2, e3):
    """Jp v = 0 for v = d(pose)/d(gamma), by dual numbers through the kernel."""
    p = SimpleNamespace(**{name: float(value) for name, value in vars(model.sizes).items()})
    angle = (Dual(np.cos(gamma), -np.sin(gamma)), Dual(np.sin(gamma), np.cos(gamma)))
    branch = model.kernels.self_motion(Duals(), p, (0.0, -140.0, 100.0), angle, SimpleNamespace(e2=e2, e3=e3))
    assert all(branch.margins[name].value > 0 for name in ("v2", "meeting"))
    jp, _ = model.kernels.jacobians(Duals(), p, branch.core)
    speed = np.array([coordinate.derivative for coordinate in branch.pose])
    assert np.linalg.norm(speed) > 1.0
    matrix = np.array([[getattr(entry, "value", entry) for entry in row] for row in jp])
    np.testing.assert_allclose(matrix @ speed, 0.0, atol=1e-9 * np.linalg.norm(speed) * 280.0)
    assert np.linalg.matrix_rank(matrix, tol=1e-6) == 2
