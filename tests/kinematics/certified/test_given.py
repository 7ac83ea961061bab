import dataclasses

import mpmath
import numpy as np
import pytest

import assur
from assur.kinematics.certified.certify import certified_direct, certified_inverse
from assur.kinematics.certified.given import (
    inputs_meant,
    joint_inputs,
    number,
    parameters,
    pose_meant,
    pose_numbers,
    printed,
    turn,
)
from assur.kinematics.pose import pose_of
from assur.numerics.dual import Dual
from assur.numerics.intervals.interval import Interval


def test_bounds_of_an_angle_hold_it_wherever_it_points():
    angle = np.linspace(-np.pi, np.pi, 2001)
    off = np.random.default_rng(1).uniform(0, 1e-3, angle.shape)
    cosine, sine = np.cos(angle), np.sin(angle)
    found = number((Interval.of(cosine - off, cosine + off), Interval.of(sine - off, sine + off)))
    assert np.all(found.contains(angle) | found.contains(angle - 2 * np.pi) | found.contains(angle + 2 * np.pi))
    assert np.all(found.width < 20e-3)
    for x, y in ((off, off), (-off, off), (off, -off), (-off, -off)):
        moved = np.unwrap(np.stack([found.middle, np.arctan2(sine + y, cosine + x)]), axis=0)[1]
        assert found.contains(moved).all()


def test_a_pair_about_zero_has_no_angle():
    found = number((Interval.of(-1e-3, 1e-3), Interval.of(-1e-3, 1e-3)))
    assert not found.defined


def test_parameters_are_objects_of_their_own():
    p = parameters(assur.load("zeng2019"))
    values = list(vars(p).values())
    assert len({id(value) for value in values}) == len(values)
    assert (p.l2 * p.l2).contains(280.0**2)


def test_inputs_go_there_and_back():
    for name in ("zeng2019", "fivebar", "linear_delta_4r"):
        record = assur.load(name)
        given = np.array([0.3, 0.7, -0.2])[: len(record.inputs)]
        found = printed(record, joint_inputs(record, given))
        assert all(value.contains(item) for value, item in zip(found, given, strict=True))


def test_a_quaternion_is_given_length_one():
    record = assur.load("gough_stewart")
    found = pose_numbers(record, tuple(Interval.of(value) for value in (1.0, 2.0, 3.0, 0.1, 0.7, 0.1, 0.7)))
    assert sum((part.square() for part in found[4:]), found[3].square()).contains(1.0)
    assert found[0].contains(1.0)


def test_the_derivative_of_a_turn():
    cosine, sine = turn(Dual(Interval.of(0.3), Interval.of(2.0)))
    assert cosine.derivative.contains(-2 * np.sin(0.3))
    assert sine.derivative.contains(2 * np.cos(0.3))


def test_an_angle_in_degrees_counts_with_the_degrees_that_it_came_from():
    """127 deg are no float in rad. The bounds hold both; of a length, or an angle in rad, the float alone counts."""
    record = assur.load("fivebar")
    found = inputs_meant(record, np.radians([127.0, 53.0]))
    with mpmath.workdps(40):
        for k, degrees in enumerate((127, 53)):
            assert float(found.low[k]) < degrees * mpmath.pi / 180 < float(found.high[k])
    assert np.all(found.contains(np.radians([127.0, 53.0])))
    in_rad = dataclasses.replace(record, angle="rad")
    assert np.all(inputs_meant(in_rad, np.radians([127.0, 53.0])).width == 0)
    lengths = np.array([162.6907, -143.3209, -24.6776])
    assert np.all(inputs_meant(assur.load("zeng2019"), lengths).width == 0)
    pose = pose_meant(assur.load("planar_3rpr"), np.array([1.0, 2.0, np.radians(10.0)]))
    assert (pose.width[:2].tolist(), pose.width[2] > 0) == ([0.0, 0.0], True)


@pytest.mark.parametrize("way", ["auto", "boxes", "joint graph"])
def test_a_direct_problem_is_proved_for_the_degrees_and_the_float_alike(way):
    record = assur.load("fivebar")
    inputs = np.radians([127.0, 53.0])
    for item in certified_direct(record, inputs, way):
        assert np.all(item.inputs.low < inputs)
        assert np.all(inputs < item.inputs.high)


@pytest.mark.parametrize("way", ["auto", "joint graph"])
def test_an_inverse_problem_too(way):
    record = assur.load("planar_3rpr")
    pose = pose_of(record, record.home_values) + np.array([0.0, 0.0, np.radians(10.0)])
    found = certified_inverse(record, pose, way)
    assert len(found)
    for item in found:
        assert item.pose.low[2] < pose[2] < item.pose.high[2]
