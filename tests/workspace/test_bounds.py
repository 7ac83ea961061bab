"""Bounds as margins of joint values: lengths, angles, cones; alike over kernels' numbers and over followed joints."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.kinematics.limits import joint_limits, limits
from assur.kinematics.position import inverse
from assur.numerics import rotations
from assur.workspace.bounds import bounds, not_reached
from assur.workspace.fields import closed_form_fields
from assur.workspace.slices import slice_at

PLANAR, DELTA = assur.load("planar_3rrr"), assur.load("delta_4s")


def limited(record, name, **change):
    return replace(record, joints={**record.joints, name: replace(record.joints[name], **change)})


def solutions(record, count=400):
    low, high = np.array([record.box[name] for name in record.platform.pose]).T
    poses = np.random.default_rng(8).uniform(low, high, size=(count, len(low)))
    found = inverse(record, poses, record.modes.default_working)
    there = found.exists[:, 0]
    return poses[there], found.joints[there, 0]


@pytest.mark.parametrize("shares", [(0.3, 0.7), (0.0, 0.5), (0.6, 1.0)])
def test_the_limit_of_a_passive_angle_is_kept_exactly_where_the_joint_value_is_inside(shares):
    index = PLANAR.joint_coordinates("leg2.C")[0].index
    poses, joints = solutions(PLANAR, 4000)
    low, high = np.quantile(joints[:, index], shares)
    record = limited(PLANAR, "leg2.C", limits=((low, high),))
    (name,) = set(closed_form_fields(record, "+++")[0]) - set(closed_form_fields(PLANAR, "+++")[0])
    field = closed_form_fields(record, "+++")[0][name]
    inside = (joints[:, index] >= low) & (joints[:, index] <= high)
    clear = np.minimum(np.abs(joints[:, index] - low), np.abs(joints[:, index] - high)) > 1e-9
    assert 50 < np.sum(inside) < len(inside) - 50
    np.testing.assert_array_equal((field(tuple(poses.T)) >= 0)[clear], inside[clear])


def test_the_limit_of_a_length_gives_two_margins():
    record = assur.load("zeng2019")
    record = limited(record, "P1", limits=((-100.0, 50.0),))
    poses, joints = solutions(record)
    fields = closed_form_fields(record, "++-++")[0]
    index = record.joint_coordinates("P1")[0].index
    np.testing.assert_allclose(fields["P1 >= -100"](tuple(poses.T)), joints[:, index] + 100, atol=1e-9)
    np.testing.assert_allclose(fields["P1 <= 50"](tuple(poses.T)), 50 - joints[:, index], atol=1e-9)


def test_a_cone_is_kept_exactly_where_the_tilt_is_within_it():
    axis = np.array([0.0, 0.0, 1.0])
    record = limited(DELTA, "leg1.B1", cone=0.6, cone_axis=axis)
    poses, joints = solutions(record)
    (limit,) = (item for item in limits(record, joints[0]) if "cone" in item.name)
    field = closed_form_fields(record, "+++")[0]["tilt of leg1.B1 <= 34.3775 deg"]
    inside = limit.margin(joints) >= 0
    assert 10 < np.sum(inside) < len(inside) - 10
    np.testing.assert_array_equal(field(tuple(poses.T)) >= 0, inside)
    place = record.joint_coordinates("leg1.B1")[0].index
    turn = rotations.from_vector(joints[:, place : place + 3])
    np.testing.assert_allclose(field(tuple(poses.T)), (turn @ axis) @ axis - np.cos(0.6), atol=1e-9)


def test_a_stroke_replaces_that_of_the_file_and_none_takes_it_away():
    inputs = tuple(replace(item, stroke=(0.0, 1.0)) for item in PLANAR.inputs)
    record = replace(PLANAR, inputs=inputs)
    names = [item.name for item in inputs]
    assert len(bounds(record)) == 3
    assert list(bounds(record, {names[0]: None, names[1]: (0.5, 2.0)})) == [
        f"28.6479 deg <= {names[1]} <= 114.592 deg",
        f"0 deg <= {names[2]} <= 57.2958 deg",
    ]
    assert bounds(PLANAR) == {}


def test_a_whole_turn_is_no_bound():
    assert bounds(limited(PLANAR, "leg1.B", limits=((-4.0, 4.0),))) == {}
    assert slice_at(PLANAR).free == ("x", "y", "phi")


def test_what_a_bound_forbids_is_said_in_the_unit_of_the_file():
    record = limited(PLANAR, "leg1.B", limits=((0.5, 1.0),))
    (name,) = bounds(record)
    assert name == "28.6479 deg <= leg1.B <= 57.2958 deg"
    assert not_reached(name) == f"not {name}: not reached"
    assert joint_limits(record) == ["limit of leg1.B"]
