"""A course is straight between its vertices, in angles and rotations too."""

import dataclasses

import numpy as np
import pytest

import assur
from assur.kinematics.following.course import course
from assur.kinematics.rates.motions import pose_units
from assur.model.registry import load_record
from assur.numerics import rotations


def with_pose(*names):
    record = load_record("fivebar")
    return dataclasses.replace(record, platform=dataclasses.replace(record.platform, pose=names))


def test_shares_are_by_length_and_repeated_vertices_are_left_out():
    record = load_record("fivebar")
    way = course(record, "poses", np.zeros(2), [[3.0, 4.0], [3.0, 4.0], [3.0, 19.0]])
    np.testing.assert_allclose(way.shares, [0.0, 0.25, 1.0])
    np.testing.assert_allclose(way.at(0.125, 0), [1.5, 2.0])
    np.testing.assert_allclose(way.at(0.25, 0), way.at(0.25, 1))
    np.testing.assert_array_equal(way.at(1.0, 1), [3.0, 19.0])
    np.testing.assert_allclose(way.rate(0.5, 1) * pose_units(record), [0.0, 20.0])


def test_angles_turn_the_short_way_or_as_given():
    record = with_pose("x", "y", "phi")
    start, end = np.array([0.0, 0.0, np.radians(170)]), np.array([0.0, 0.0, np.radians(-170)])
    assert course(record, "poses", start, end).changes[0, 2] == pytest.approx(np.radians(20))
    assert course(record, "poses", start, end, "given").changes[0, 2] == pytest.approx(np.radians(-340))


def test_a_quaternion_turns_about_one_axis_evenly_and_its_sign_does_not_matter():
    record = with_pose("x", "qw", "qx", "qy", "qz")
    axis = np.array([1.0, 2.0, -2.0]) / 3
    start, end = (rotations.from_vector(angle * axis) for angle in (0.4, 1.6))
    first, last = (np.concatenate([[x], rotations.to_quaternion(turn)]) for x, turn in ((1.0, start), (5.0, end)))
    for target in (last, last * [1, -1, -1, -1, -1]):
        way = course(record, "poses", first, target)
        np.testing.assert_allclose(way.changes[0], [4.0, *(1.2 * axis)], atol=1e-12)
        quarter = way.at(0.25, 0)
        assert quarter[0] == pytest.approx(2.0)
        turn = rotations.from_quaternion(quarter[1:])
        np.testing.assert_allclose(turn, rotations.from_vector(0.7 * axis), atol=1e-12)


def test_an_input_that_runs_against_its_joint_has_a_negative_rate():
    record = load_record("fivebar")
    turned = (dataclasses.replace(record.inputs[0], sign=-1.0), record.inputs[1])
    way = course(dataclasses.replace(record, inputs=turned), "inputs", np.zeros(2), [0.3, 0.4])
    np.testing.assert_allclose(way.rate(0.5, 0), [-0.3, 0.4])


def test_what_is_no_target_is_refused():
    record = load_record("fivebar")
    with pytest.raises(assur.UsageError, match="one target or a row of them"):
        course(record, "poses", np.zeros(2), np.zeros((1, 1, 2)))
    with pytest.raises(assur.UsageError, match="3 values, 2 wanted"):
        course(record, "inputs", np.zeros(2), [1.0, 2.0, 3.0])
