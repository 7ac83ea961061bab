"""Platforms on three balls whose pose leaves an angle out: its rate goes from the velocity equations."""

import numpy as np
import pytest
import sympy

from assur.cli.main import main
from assur.derivation.parasitic_rate import parasitic_circle
from assur.derivation.solution import analytic_solution
from assur.derivation.velocities import velocity_equations
from assur.kinematics.contract.check import problems
from assur.kinematics.contract.extent import IN_FULL
from assur.kinematics.position import direct
from assur.model.registry import load_record
from assur.synthesis.drafting.drafting import drafted
from assur.synthesis.drafting.repeating import repeated


def written(folder, text):
    (folder / "mechanism.toml").write_text(text, encoding="utf-8")
    assert main(["derive", str(folder), "-o", str(folder / "closed_form.py")]) == 0
    return load_record(folder)


@pytest.fixture(scope="module")
def inverse():
    return analytic_solution(load_record("three_rps"), "inverse")


def test_the_determinants_of_a_3_rps_are_the_products_of_their_factors(inverse):
    equations = velocity_equations(inverse)
    circles = [*inverse.symbols.circles, *(own.unknowns for own in inverse.loops.directions)]
    random = np.random.default_rng(0)
    values = {}
    for (cosine, sine), angle in zip(circles, random.uniform(-3, 3, len(circles)), strict=True):
        values |= {cosine: np.cos(angle), sine: np.sin(angle)}
    for matrix, factors in ((equations.jp, equations.parallel), (equations.jq, equations.serial)):
        symbols = sorted(matrix.free_symbols | {*values}, key=str)
        numbers = [values.get(symbol, 0.7) for symbol in symbols]
        product = sympy.prod([factor**power for factor, power in factors])
        own, whole = (sympy.lambdify(symbols, formula)(*numbers) for formula in (matrix, product))
        assert np.linalg.det(np.array(own, dtype=float)) == pytest.approx(float(whole), rel=1e-9)


def test_the_angle_is_unsaid_where_the_two_ways_of_the_platform_meet(inverse):
    """D of the module is the root by which the angle is found, so 1 + cos(theta) cos(psi) or its opposite."""
    equations, circle = velocity_equations(inverse), parasitic_circle(inverse)
    (root,) = next(part for part in inverse.sets if circle in part.directions).roots
    (under,) = [factor for factor, power in equations.parallel if power == 2]
    known = {own.symbol: own.formula for own in inverse.definitions if own.symbol not in circle.unknowns}
    quantity = root.quantity.xreplace(known)
    assert 0 in (sympy.expand(under - quantity), sympy.expand(under + quantity))
    assert (sympy.Symbol("cos_theta", real=True), 1) in equations.parallel


def test_a_pose_that_leaves_no_angle_out_has_no_such_circle():
    assert parasitic_circle(analytic_solution(load_record("planar_3rpr"), "inverse")) is None


@pytest.mark.deep
def test_the_derived_form_of_the_3_rps_agrees_with_that_by_hand(tmp_path):
    by_hand = load_record("three_rps")
    record = written(tmp_path, by_hand.file.read_text(encoding="utf-8"))
    assert problems(record, IN_FULL)[0] == ()
    assert (record.closed_form.direct.roots, len(record.closed_form.direct.signs)) == (4, 2)
    given = np.random.default_rng(2).uniform(190, 310, size=(60, 3))
    first, second = (direct(own, given, method="closed form") for own in (by_hand, record))
    sure = (first.overall_status != 9) & (second.overall_status != 9)
    assert np.sum(sure) > 30
    for row in np.flatnonzero(sure):
        poses, others = (own.poses[row][own.exists[row]] for own in (first, second))
        assert len(poses) == len(others)
        assert np.max(np.min(np.max(np.abs(poses[:, None] - others), axis=-1), axis=1), initial=0.0) < 1e-7


@pytest.mark.deep
@pytest.mark.parametrize("limb", ["P[z] R[y] S", "R[y] R[y] S"])
def test_drafts_on_three_balls_have_closed_forms(limb, tmp_path):
    record = written(tmp_path, drafted(repeated(limb, 3), tmp_path / "mechanism.toml").text)
    assert record.closed_form.direct.degree == 16
