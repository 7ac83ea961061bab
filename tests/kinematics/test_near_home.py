"""The order of solutions does not depend on that in which they were found, and home is the first of its pose."""

from functools import cache

import numpy as np
import pytest

import assur
from assur.kinematics.home import home_values
from assur.kinematics.near_home import distances, nearest_first
from assur.kinematics.pose import pose_of
from assur.kinematics.position import inverse

NAMES = ["fivebar", "three_rps", "planar_3rrr", pytest.param("three_upu", marks=pytest.mark.deep)]  # 20 s of search


@cache
def searched(name):
    """The record and its solutions at home's pose, which every test reads and none changes."""
    record = assur.load(name)
    return record, inverse(record, pose_of(record, home_values(record)), method="search")


@pytest.mark.parametrize("name", NAMES)
def test_home_is_the_first_inverse_solution_at_its_pose(name):
    record, found = searched(name)
    assert len(found) > 1
    joints = found.joints[found.exists]
    assert (distances(record, joints) < 1e-5).tolist() == [True] + [False] * (len(joints) - 1)
    assert np.all(np.diff(distances(record, joints)) > -1e-5)


@pytest.mark.parametrize("name", NAMES)
def test_the_order_is_that_of_the_solutions_and_not_of_their_finding(name):
    record, found = searched(name)
    joints = found.joints[found.exists]
    rng = np.random.default_rng(1)
    for _ in range(3):
        mixed = joints[rng.permutation(len(joints))] + 1e-10 * rng.standard_normal(joints.shape)
        np.testing.assert_allclose(mixed[nearest_first(record, mixed)], joints, atol=1e-8)


def test_no_solutions_have_no_order():
    record = assur.load("fivebar")
    assert nearest_first(record, np.empty((0, len(record.coordinates)))).tolist() == []
