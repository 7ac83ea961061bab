"""All assemblies of platforms on serial limbs: those of closed forms, of loops in turn, and all that a search meets."""

import dataclasses

import numpy as np
import pytest

import assur
from assur.cli.main import main
from assur.kinematics.closure import closure_error
from assur.kinematics.configurations import distinct
from assur.kinematics.home import home_values
from assur.kinematics.loops.loops import solve_by_loops
from assur.kinematics.loops.parallelograms import crossed_parallelograms
from assur.kinematics.platforms.direct import direct_by_conditions
from assur.kinematics.pose import pose_of
from assur.kinematics.search import search
from assur.model.registry import load_record


def test_the_poses_are_those_of_the_closed_form():
    record = assur.load("gough_stewart")
    legs = np.array([1.02, 0.64, 1.06, 1.48, 1.34, 0.77])
    known = record.direct(legs)
    solutions = direct_by_conditions(record, legs)
    assert (known.complete, solutions.complete) == (True, True)
    poses = pose_of(record, solutions.joints)
    assert len(poses) == len(known) == 18
    for pose in [own.pose for own in known]:
        assert np.min(np.max(np.abs(poses - pose), axis=1)) < 1e-6


ARRANGEMENTS = {
    "6-RUS": ("6-RUS",),
    "6-UPS": ("6-UPS",),
    "6-PUS": ("6-PUS",),
    "3-RPS": ("3-RPS",),
    "3-SPR": ("3-SPR",),
    "3-RRS": ("3-RRS",),
    "3-PRS": ("3-PRS", "upright rails"),
    "3UPS&UP": ("3UPS&UP",),
    "2UPR-SPR": ("2UPR-SPR",),
    "2UPR-RPU": ("2UPR-RPU",),
    "3-RRR": ("3-RRR", "spherical"),
    "3-UPS/S": ("3-UPS/S",),
    "ball screws in legs": ("--limb", "U[x,y] {R[z]@O H[z]@O | P[z]} S", "--count", "3"),
}
QUICK = ("3-SPR", "2UPR-SPR")


@pytest.fixture(
    scope="module",
    params=[name if name in QUICK else pytest.param(name, marks=pytest.mark.deep) for name in ARRANGEMENTS],
)
def drafted(request, tmp_path_factory):
    path = tmp_path_factory.mktemp("platforms") / "mine.toml"
    assert main(["new", str(path), *ARRANGEMENTS[request.param]]) == 0
    return load_record(path)


def beside_home(record, seed):
    home = home_values(record)
    inputs = np.array([driven.printed(home[driven.coordinate.index]) for driven in record.inputs])
    rng = np.random.default_rng(seed)
    return inputs + rng.uniform(-0.05, 0.05, len(inputs)) * np.where(np.abs(inputs) > 10, inputs, 1.0)


def test_a_draft_has_all_that_a_search_meets(drafted):
    inputs = beside_home(drafted, 3)
    solutions = direct_by_conditions(drafted, inputs)
    assert solutions.complete
    assert np.max(closure_error(drafted, solutions.joints)) < 1e-9
    met = search(drafted, "direct", inputs).joints
    assert len(met) > 0
    assert len(distinct(drafted, np.concatenate([solutions.joints, met]))) == len(solutions.joints)


@pytest.mark.parametrize(
    "name", ["three_rps", "planar_3rrr", "planar_3rpr", "tripteron", "tsai_platform", "linear_delta_4r", "orthoglide"]
)
def test_the_loops_in_turn_give_the_same(name):
    """Another way to all roots, which shares no equation: points on circles, eliminated one after another."""
    record = load_record(name)
    for seed in range(2):
        inputs = beside_home(record, seed)
        loops, solutions = solve_by_loops(record, inputs), direct_by_conditions(record, inputs)
        assert (loops.complete, solutions.complete) == (True, True)
        assert len(distinct(record, np.concatenate([loops.joints, solutions.joints]))) == len(loops.joints)
        assert len(loops.joints) == len(solutions.joints)


@pytest.mark.parametrize("size", [1e-2, *(pytest.param(size, marks=pytest.mark.deep) for size in (1e-3, 1e-4))])
def test_a_3_upu_has_seventy_eight_poses_near_equal_legs_too(size, tmp_path):
    """With axes along radii (D. R. Walter, M. L. Husty 2011). With legs more equal six are far away, or nearly so."""
    path = tmp_path / "mine.toml"
    assert main(["new", str(path), "3-UPU", "radial"]) == 0
    record = load_record(path)
    rng = np.random.default_rng(2)
    for _ in range(2 if size == 1e-2 else 10):
        inputs = home_values(record)[record.input_indices,] * (1.0 + size * rng.uniform(-1.0, 1.0, 3))
        solutions = direct_by_conditions(record, inputs)
        assert (solutions.complete, len(distinct(record, solutions.joints))) == (True, len(solutions.joints))
        assert (78 if size == 1e-2 else 72) <= solutions.searched <= 78
        assert np.max(closure_error(record, solutions.joints)) < 1e-9


def test_forty_real_poses_are_all_found():
    """Of Dietmaier's legs."""
    solutions = direct_by_conditions(
        assur.load("gough_stewart"), np.array([1, 0.645275, 1.086284, 1.503439, 1.281933, 0.771071])
    )
    assert (len(solutions.joints), solutions.complete) == (40, True)


def test_rods_that_form_parallelograms_may_cross():
    """Those of the Delta robot: among all assemblies are the two of the closed form, with no rod crossed."""
    record = load_record("delta_4s")
    inputs = np.radians([10.0, 20.0, 30.0])
    solutions = direct_by_conditions(record, inputs)
    assert solutions.complete
    uncrossed = [row for row in solutions.joints if not crossed_parallelograms(record, row)]
    assert len(uncrossed) == len(assur.load("delta_4s").direct(inputs)) == 2
    met = search(record, "direct", inputs).joints
    assert len(met) == len(solutions.joints) > 2
    assert len(distinct(record, np.concatenate([solutions.joints, met]))) == len(met)


def test_parallelograms_of_hinges_are_left_to_others():
    solutions = direct_by_conditions(load_record("zeng2019"), np.full(3, 10.0))
    assert solutions is None or not solutions.complete


def test_a_platform_that_drives_leave_free_is_none_of_these(tmp_path):
    path = tmp_path / "mine.toml"
    assert main(["new", str(path), "--limb", "U[x,y] P[z] S", "--count", "6"]) == 0
    loose = dataclasses.replace(load_record(path), inputs=load_record(path).inputs[:5])
    answer = direct_by_conditions(loose, beside_home(loose, 1))
    assert not answer.complete
    assert (
        answer.right == "not proved, since the quadrics that limbs say of the platform leave it infinitely many poses"
    )
