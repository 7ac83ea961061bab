"""Sampled configurations are assembled, in the mode that was asked for, and within the limits of the file."""

import dataclasses

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closure import closure_error
from assur.kinematics.limits import limits
from assur.kinematics.pose import pose_of
from assur.scene.sampled import from_box, sampled


def test_they_are_assembled_within_box_and_limits(every):
    record = every.record
    if record.closed_form is None:
        return
    joints = sampled(record, 20)
    assert 1 <= len(joints) <= 20
    assert np.max(closure_error(record, joints)) < 1e-6 * characteristic_length(record)
    assert all(np.min(item.margin(joints)) >= 0 for item in limits(record, record.home_values))


def test_the_mode_is_that_of_the_inverse_problem():
    record = assur.load("fivebar")
    for mode in ("++", "-+"):
        joints = sampled(record, 8, mode)
        for row in joints:
            found = record.inverse(pose_of(record, row[None])[0], mode)
            np.testing.assert_allclose(found.joints[found.exists][0], row, atol=1e-9)


def test_the_seed_says_which():
    record = assur.load("zeng2019")
    np.testing.assert_array_equal(sampled(record, 5, seed=3), sampled(record, 5, seed=3))
    assert not np.array_equal(sampled(record, 5, seed=3), sampled(record, 5, seed=4))


def test_nothing_and_nowhere_are_refused():
    with pytest.raises(UsageError, match="at least 1"):
        sampled(assur.load("fivebar"), 0)


@pytest.mark.parametrize(
    ("lost", "said"), [({"closed_form": None}, "a closed form"), ({"box": {}}, "a box for every coordinate")]
)
def test_near_home_no_mode_can_be_asked_for(lost, said):
    record = dataclasses.replace(assur.load("fivebar"), **lost)
    assert not from_box(record)
    joints = sampled(record, 5)
    assert np.max(closure_error(record, joints)) < 1e-6 * characteristic_length(record)
    for mode in ("bogus", "++"):
        with pytest.raises(UsageError, match=f"fivebar has not {said}") as caught:
            sampled(record, 5, mode)
        assert f"'{mode}'" in caught.value.message
        assert "leave the mode out" in caught.value.hint


def test_a_mode_that_is_none_is_refused():
    for name in ("fivebar", "planar_3rpr"):
        with pytest.raises(UsageError, match="bogus"):
            sampled(assur.load(name), 5, "bogus")
