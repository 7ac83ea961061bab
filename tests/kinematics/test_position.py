"""Which route answers: closed form, loops in turn or a search, and that they agree."""

import dataclasses

import numpy as np
import pytest

from assur.cli.main import main
from assur.errors import UnknownNameError, UsageError
from assur.kinematics.border import inputs_of
from assur.kinematics.closed_form.grids import Grid
from assur.kinematics.closed_form.stored import stored_sweep
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_of
from assur.kinematics.position import direct, inverse
from assur.kinematics.status import Status
from assur.model.registry import load_record
from assur.workspace.region import workspace


def test_what_the_roots_of_a_polynomial_leave_open_goes_to_the_loops():
    record, legs = load_record("three_rps", R=60.0, r=120.0), [255.3, 343.9, 304.3]
    assert not direct(record, legs, method="closed form").complete
    found, searched = direct(record, legs), direct(record, legs, method="search")
    assert (found.complete, found.right) == (True, direct(record, legs, method="loops").right)
    apart = np.linalg.norm(found.poses[:, None] - searched.poses, axis=-1)
    assert len(found) == len(searched) == 12
    assert np.all(np.min(apart, axis=1) < 1e-6)


def test_a_problem_that_the_roots_decide_stays_with_them():
    record = load_record("three_rps")
    found = direct(record, [255.3, 343.9, 304.3])
    assert found.complete
    assert found.right.startswith("closed form")


def test_an_unknown_method_is_refused():
    with pytest.raises(UnknownNameError, match="method 'newton'"):
        direct(load_record("fivebar"), [1.0, 2.0], method="newton")


@pytest.mark.deep
def test_of_assemblies_that_move_a_few_are_kept_and_all_others(tmp_path):
    """Three equal radial slides driven to turn together: one platform turns about its middle, or comes to rest."""
    path = tmp_path / "slides.toml"
    assert main(["new", str(path), "--limb", "R[z] {R[x]@O H[x]@O | P[x]} S"]) == 0
    record = load_record(path)
    inputs = inputs_of(record, home_values(record))
    answer = direct(record, inputs)
    moving = [solution for solution in answer if solution.status == Status.self_motion]
    resting = [solution for solution in answer if solution.status == Status.regular]
    assert 1 <= len(moving) <= 8
    assert len(resting) == 2
    assert "most of which move with what is held" in answer.right
    place = np.array([solution.pose for solution in moving])
    apart = np.linalg.norm(place[:, None, :2] - place[None, :, :2], axis=-1) + 1e9 * np.eye(len(place))
    assert np.min(apart) > 1.0


def test_a_number_is_refused_with_the_name_that_the_solution_has_where_it_was_asked_else_at_home():
    record = load_record("planar_3rrr")
    bare = dataclasses.replace(record, closed_form=None)
    home, phi = pose_of(record, home_values(record)), np.array([0.0, 0.0, 0.1])
    labels = [str(label) for label in inverse(bare, home + phi).labels]
    for given, where in ((home + phi, "where this was asked"), ((home + phi)[None], "where this was asked")):
        with pytest.raises(UnknownNameError) as caught:
            inverse(bare, given, "3")
        assert caught.value.hint.endswith(f"a number is no name: {where} number 3 is now {labels[2]}")
    at_home = str(inverse(bare, home).labels[2])
    grid = Grid(("x", "y", "phi"), (-1.0, 0.0, 0.0), (1.0, 0.0, 0.0), (2, 1, 1), (1.0, 1.0, 1.0))
    for asked in (lambda: workspace(bare, "3", resolution=4), lambda: stored_sweep(bare, "inverse", grid, "3")):
        with pytest.raises(UsageError) as caught:
            asked()
        assert caught.value.hint.endswith(f"a number is no name: at home number 3 is now {at_home}")
    with pytest.raises(UnknownNameError, match="unknown working mode") as caught:
        inverse(record, home, "2")
    assert f"number 2 is now {inverse(record, home).labels[1]}" in caught.value.hint
