"""Links that turn in space: each leg alone where the pose is given, and coupled sets whose axes turn."""

import itertools

import numpy as np
import pytest
import sympy

from assur.derivation.derivation import derive
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.solution import analytic_solution
from assur.kinematics.contract.check import problems
from assur.kinematics.contract.extent import IN_FULL
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_of
from assur.kinematics.position import inverse
from assur.model.pose import ANGLES
from assur.model.registry import load_record
from assur.synthesis.drafting.drafting import drafted
from assur.synthesis.drafting.repeating import repeated
from spherical import AGILE_EYE, OBLIQUE, QUATERNION, spherical

RSSR = """format = 1
name = "rssr"
unit = "mm"
angle = "deg"
base = "ground"
platform = { link = "rocker", pose = ["phi"] }
[parameters]
a = { value = 40 }
b = { value = 150 }
c = { value = 90 }
d = { value = 100 }
h = { value = 30, sign = "any" }
[links]
ground = {}
crank = {}
coupler = {}
rocker = {}
[joints]
A = { type = "revolute", parent = "ground", child = "crank", axis = "x" }
B = { type = "spherical", parent = "crank", child = "coupler", at = [0, "a", 0] }
C = { type = "spherical", parent = "coupler", child = "rocker", at = ["b", 0, 0], child_at = [0, "c", "h"] }
D = { type = "revolute", parent = "ground", child = "rocker", at = ["d", 0, 0], axis = "z" }
[inputs]
A = { name = "q" }
[home]
A = 20
D = -28.6
B = [0, 0, 17]
C = [0, 0, -45]
"""

LEGS = {
    "U P S": 64, "S P S": 64, "R[y] U[y,x] S": 64, "R[y] U[x,z] S": 64, "P[z] U[y,x] S": 64, "R[y] S S": 64,
}  # fmt: skip
"""Of a platform on six of them: branches of the inverse problem, two for each leg."""
TILTING = {"R[y] P[z] S": 16, "R[y] R[y] S": 16, "P[x] R[y] S": 16, "P[z] R[y] S": 16}
"""Of one on three of them, whose pose is z, theta and psi: two for each leg, and two operation modes."""


def draft(limb, count, folder):
    path = folder / "draft.toml"
    path.write_text(drafted(repeated(limb, count), path).text, encoding="utf-8")
    return load_record(path)


def numbers(solution, given, signs):
    """Every symbol of a branch in floats, from what is given."""
    turned = {root.symbol: sign for root, sign in zip(solution.roots, signs, strict=True)}
    values = dict(given)
    for own in (*solution.definitions, *solution.lengths):
        values[own.symbol] = turned.get(own.symbol, 1) * complex(sympy.N(own.formula, 20, subs=values)).real
    return values


def given_at(record, pose):
    """Dimensions and pose as symbols and numbers."""
    solution = analytic_solution(record, "inverse")
    values = {own: record.parameters[name].inside for name, own in solution.symbols.parameters.items()}
    for name, value in zip(record.platform.pose, pose, strict=True):
        if name in ANGLES:
            values |= {sympy.Symbol(f"cos_{name}", real=True): float(np.cos(value))}
            values |= {sympy.Symbol(f"sin_{name}", real=True): float(np.sin(value))}
        else:
            values[sympy.Symbol(name, real=True)] = float(value)
    return values


def inputs_of(record, values):
    """Inputs that are lengths, of a branch."""
    lengths = analytic_solution(record, "inverse").loops.lengths
    return [driven.printed(values[lengths[driven.coordinate.index]]) for driven in record.inputs]


def lengths_at_a_pose_near_home(record):
    home = pose_of(record, home_values(record))
    pose = home + 0.03 * np.linspace(-1.0, 1.0, len(home))
    if "qw" in record.platform.pose:
        pose[-4:] /= np.linalg.norm(pose[-4:])
    solution = analytic_solution(record, "inverse")
    signs = itertools.product((1, -1), repeat=len(solution.roots))
    derived = [inputs_of(record, numbers(solution, given_at(record, pose), own)) for own in signs]
    closed = [own.inputs for own in inverse(record, pose, method="search" if record.closed_form is None else "auto")]
    return derived, closed


@pytest.mark.parametrize("limb", [pytest.param(own, marks=pytest.mark.deep) for own in LEGS])
def test_each_of_six_legs_is_solved_alone(limb, tmp_path):
    solution = analytic_solution(draft(limb, 6, tmp_path), "inverse")
    assert solution.branches == LEGS[limb]
    assert [part.count for part in solution.sets] == [2] * 6
    assert solution.closes()


@pytest.mark.parametrize(
    "limb", [own if own == "P[z] R[y] S" else pytest.param(own, marks=pytest.mark.deep) for own in TILTING]
)
def test_a_pose_that_leaves_an_angle_out_has_two_operation_modes(limb, tmp_path):
    solution = analytic_solution(draft(limb, 3, tmp_path), "inverse")
    assert solution.branches == TILTING[limb]
    assert solution.closes()


def test_the_legs_of_a_tilting_platform_are_those_of_its_joint_graph():
    """The 3-RPS: of both operation modes, by formulas that are derived and by those that were found by hand."""
    derived, closed = lengths_at_a_pose_near_home(load_record("three_rps"))
    for own in closed:
        assert min(np.max(np.abs(np.array(own) - other)) for other in np.array(derived)) < 1e-9


def test_no_condition_of_a_tilting_platform_fails_where_it_is_level():
    solution = analytic_solution(load_record("three_rps"), "inverse")
    level = {sympy.Symbol(f"{part}_{name}", real=True): part == "cos" for part in ("cos", "sin") for name in ANGLES}
    known = {own.symbol: own.formula for own in solution.definitions}
    for part in solution.sets:
        assert all(sympy.sympify(known.get(own, own)).subs(level) != 0 for own in part.conditions)


@pytest.mark.deep
def test_six_legs_are_as_long_as_those_of_the_joint_graph():
    derived, closed = lengths_at_a_pose_near_home(load_record("gough_stewart"))
    assert len(closed) == 1
    assert min(np.max(np.abs(np.array(closed[0]) - own)) for own in np.array(derived)) < 1e-12


def test_a_single_loop_in_space_is_a_square_root_either_way(tmp_path):
    path = tmp_path / "rssr.toml"
    path.write_text(RSSR)
    for problem in ("direct", "inverse"):
        solution = analytic_solution(load_record(path), problem)
        assert solution.branches == 2
        assert solution.closes()


def test_axes_that_meet_in_a_point_give_eight_branches_and_a_polynomial_of_degree_eight(tmp_path):
    """Three quadrics in a quaternion have eight common points (Gosselin, Sefrioui, Richard 1994)."""
    record = load_record(spherical(tmp_path, QUATERNION, OBLIQUE))
    solution = analytic_solution(record, "inverse")
    assert solution.branches == 8
    assert solution.closes()
    solution = analytic_solution(record, "direct")
    assert (solution.branches, solution.eliminant.degree) == (8, 8)
    assert solution.closes()


def test_a_spherical_mechanism_whose_polynomial_has_multiple_roots_is_not_derived(tmp_path):
    with pytest.raises(NotDerivedError, match="multiple roots"):
        analytic_solution(load_record(spherical(tmp_path, axes=AGILE_EYE)), "direct")


def test_a_wrong_formula_of_a_link_on_an_axis_that_turns_is_noticed(tmp_path):
    solution = analytic_solution(load_record(spherical(tmp_path, axes=OBLIQUE)), "direct")
    wrong = solution.sets[-1].definitions[-1]
    object.__setattr__(wrong, "formula", wrong.formula * 2)
    assert not solution.closes()


@pytest.mark.deep
def test_the_derived_form_of_the_h4_closes_its_joint_graph(tmp_path):
    record = load_record("h4_robot")
    (tmp_path / "mechanism.toml").write_text(record.file.read_text(encoding="utf-8"), encoding="utf-8")
    (tmp_path / "closed_form.py").write_text(derive(record).closed_form())
    assert problems(load_record(tmp_path), IN_FULL)[0] == ()


def test_a_pose_that_leaves_two_angles_out_says_too_little(tmp_path):
    record = load_record(spherical(tmp_path, '["phi"]', OBLIQUE))
    with pytest.raises(NotDerivedError, match="the platform turns by theta and psi too"):
        analytic_solution(record, "inverse")
