"""Six distances: the poses are those of the closed form, and those that a search meets; all are known."""

import numpy as np
import pytest

import assur
from assur.cli.main import main
from assur.kinematics.closure import closure_error
from assur.kinematics.home import home_values
from assur.kinematics.platforms.direct import direct_by_conditions
from assur.kinematics.pose import pose_of
from assur.kinematics.search import distinct, search
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


@pytest.mark.parametrize("name", ["6-RUS", pytest.param("6-UPS", marks=pytest.mark.deep),
                                  pytest.param("6-PUS", marks=pytest.mark.deep)])  # fmt: skip
def test_a_draft_has_all_that_a_search_meets(name, tmp_path):
    path = tmp_path / "mine.toml"
    assert main(["new", str(path), name]) == 0
    record = load_record(path)
    home = home_values(record)
    inputs = np.array([driven.printed(home[driven.coordinate.index]) for driven in record.inputs])
    inputs = inputs + np.random.default_rng(3).uniform(-0.05, 0.05, 6) * np.where(np.abs(inputs) > 10, inputs, 1.0)
    solutions = direct_by_conditions(record, inputs)
    assert solutions.complete
    assert np.max(closure_error(record, solutions.joints)) < 1e-9
    met = search(record, "direct", inputs).joints
    assert len(met) > 0
    assert len(distinct(record, np.concatenate([solutions.joints, met]))) == len(solutions.joints)


def test_forty_real_poses_are_all_found():
    """Of Dietmaier's legs."""
    solutions = direct_by_conditions(
        assur.load("gough_stewart"), np.array([1, 0.645275, 1.086284, 1.503439, 1.281933, 0.771071])
    )
    assert (len(solutions.joints), solutions.complete) == (40, True)


def test_other_mechanisms_are_no_six_distances():
    assert direct_by_conditions(load_record("three_rps"), np.full(3, 300.0)) is None
    assert direct_by_conditions(load_record("zeng2019"), np.full(3, 10.0)) is None
