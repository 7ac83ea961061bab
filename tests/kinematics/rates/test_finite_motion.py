"""Statuses from the joint graph are those of the closed forms; a self-motion is one that goes on."""

import numpy as np
import pytest

import assur
from assur.kinematics.rates.finite_motion import classify_at, has_finite_motion
from assur.kinematics.status import Status
from assur.singularity.examples import singular_examples

ROW_3 = [-15.4714, 9.6849, 456.3315]


@pytest.mark.parametrize("name", ["fivebar", "zeng2019"])
def test_the_status_is_that_of_the_closed_form(name):
    mechanism = assur.load(name)
    examples = singular_examples(mechanism)
    found = classify_at(mechanism, np.array([example.joints for example in examples]))
    assert [Status(status).name for status in found] == [example.status.name for example in examples]
    assert {Status.serial, Status.self_motion} <= {Status(status) for status in found}


@pytest.mark.parametrize("name", ["fivebar", "zeng2019"])
def test_regular_configurations_are_regular(name):
    mechanism = assur.load(name)
    low, high = np.array([mechanism.box[item] for item in mechanism.platform.pose]).T
    found = mechanism.inverse(np.random.default_rng(0).uniform(low, high, (60, len(low))))
    regular = found.joints[found.exists & (found.status == Status.regular)]
    assert len(regular) > 50
    assert set(classify_at(mechanism, regular).tolist()) <= {Status.regular, Status.near_singular}


@pytest.mark.parametrize("mode", ["+++++", "++--+"])
def test_equal_working_signs_are_self_motion(mode):
    paper = assur.load("zeng2019")
    joints = paper.inverse(ROW_3, mode).joints[0]
    assert classify_at(paper, joints) == Status.self_motion
    # the closed form's own curve of that self-motion passes through it, inputs unchanged
    assert np.all(has_finite_motion(paper, joints[None]))


def test_a_motion_of_first_order_only_is_no_self_motion():
    """w = 0: links 9 and 10 on one line; the platform shakes and goes nowhere."""
    paper = assur.load("zeng2019")
    example = next(item for item in singular_examples(paper) if item.factor.name == "w")
    assert not np.any(has_finite_motion(paper, example.joints[None]))
    assert classify_at(paper, example.joints) == Status.parallel


def test_postures_that_nearly_meet_another_are_no_self_motion():
    """Dietmaier's forty are isolated; two are loose to five digits: a way along them moves the inputs."""
    platform = assur.load("gough_stewart")
    forty = platform.direct([1, 0.645275, 1.086284, 1.503439, 1.281933, 0.771071])
    status = classify_at(platform, forty.joints[forty.exists])
    assert len(status) == 40
    assert Status.parallel in status
    assert Status.self_motion not in status


def test_a_regular_configuration_has_no_motion_at_all():
    paper = assur.load("zeng2019")
    assert has_finite_motion(paper, paper.home_values[None]).tolist() == [False]


def test_a_five_bar_in_one_line_is_self_motion():
    narrow = assur.load("fivebar", g=100.0)
    assert classify_at(narrow, narrow.inverse([194.0, 0.0], "++").joints[0]) == Status.self_motion


def test_spinning_rods_are_no_self_motion(balls):
    assert classify_at(balls, balls.home_values) == Status.regular
    assert not np.any(has_finite_motion(balls, balls.home_values[None]))


def test_what_is_not_assembled_is_not_closed():
    fivebar = assur.load("fivebar")
    found = classify_at(fivebar, np.array([[fivebar.home_values, fivebar.home_values + 0.2]]))
    assert found.tolist() == [[Status.regular, Status.not_closed]]
