"""Paths run through a right angle of theta: phi and psi have no rates there, the angular velocity has."""

import numpy as np
import pytest

from assur.kinematics.following.course import course
from assur.kinematics.following.following import follow
from assur.kinematics.following.ways import pose_change
from assur.kinematics.pose import pose_of, turned_alike
from assur.mechanism import load
from assur.numerics import rotations
from spherical import ANGLES, OBLIQUE, QUATERNION, spherical

UPRIGHT, BEYOND = [0.0, -90.0, 0.0], [180.0, -89.5, 180.0]


def turn(pose):
    return rotations.from_angles(*pose)


@pytest.fixture
def record(tmp_path):
    return load(spherical(tmp_path, ANGLES, OBLIQUE, "angles"))


def test_a_path_goes_through_and_ends_where_that_of_quaternions_ends(record, tmp_path):
    """A second route: the same mechanism whose pose is a quaternion, which knows no such place."""
    legs = np.radians([UPRIGHT, BEYOND])
    path = follow(record, record.home_values, poses=legs)
    assert path.stopped is None
    assert np.allclose(turn(path.poses[-1]), turn(legs[-1]), atol=1e-9)
    twin = load(spherical(tmp_path, QUATERNION, OBLIQUE, "quaternion"))
    other = follow(twin, twin.home_values, poses=[rotations.to_quaternion(turn(leg)) for leg in legs])
    assert other.stopped is None
    assert np.max(np.abs(np.sin((path.joints[-1] - other.joints[-1]) / 2))) < 1e-7
    for name in ("inputs", "poses"):
        assert path.smallest[name].min() == pytest.approx(other.smallest[name].min(), rel=0.05)


def test_a_path_begins_where_theta_is_a_right_angle_and_comes_back(record):
    there = follow(record, record.home_values, poses=np.radians(UPRIGHT)).joints[-1]
    on = follow(record, there, poses=np.radians(BEYOND))
    assert on.stopped is None
    back = follow(record, on.joints[-1], poses=[np.radians(UPRIGHT), pose_of(record, record.home_values)])
    assert back.stopped is None
    assert np.allclose(np.sin((back.joints[-1] - record.home_values) / 2), 0.0, atol=1e-7)


@pytest.mark.parametrize("theta", [90.0, -90.0])
def test_phi_is_that_of_the_neighbour_where_only_psi_and_phi_together_count(theta):
    names = ("x", "phi", "theta", "psi")
    start, end = np.radians([3.0, 20.0, theta, 50.0]), np.radians([7.0, 170.0, 0.9 * theta, 10.0])
    found = turned_alike(names, start, end)
    assert found[1] == end[1]
    assert np.allclose(turn(found[1:]), turn(start[1:]), atol=1e-12)
    assert turned_alike(names, end, start) is end
    assert turned_alike(("x", "theta"), start[:2], end[:2]) is not end


@pytest.mark.parametrize("share", [0.1, 0.49999, 0.5, 0.7])
def test_the_rate_of_a_course_is_the_angular_velocity(record, share):
    way = course(record, "poses", np.radians([10.0, 80.0, 5.0]), np.radians([60.0, 90.0, 30.0]))
    step = 1e-6
    low, high = (turn(way.at(share + side * step, 0)) for side in (-1, 1))
    assert np.allclose(rotations.to_vector(high @ low.T) / (2 * step), way.rate(share, 0), atol=1e-6)


def test_a_step_to_a_neighbour_is_a_turn(record):
    start, end = np.radians([[170.0, 89.0, 10.0]]), np.radians([[-10.0, 89.0, -170.0]])
    (change,) = pose_change(record, start, end)
    assert np.allclose(rotations.from_vector(change) @ turn(start[0]), turn(end[0]), atol=1e-12)
    assert np.linalg.norm(change) < np.radians(3.0)
