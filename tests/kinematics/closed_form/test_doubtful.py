"""Roots in doubt: what the loops decide, and what they leave open."""

import numpy as np
import pytest

import assur
from assur.kinematics.closed_form.doubtful import decided
from assur.kinematics.closed_form.roots import roots_of
from assur.kinematics.status import Status

LENGTHS = np.array([[380.0, 390.0, 400.0]])


@pytest.fixture
def found():
    mechanism = assur.load("three_rps")
    return roots_of(mechanism, mechanism.closed_form.direct, LENGTHS)


def changed(found, name, value, branch):
    """The same answer with another value of a branch in one of its cached properties."""
    values = np.array(getattr(found, name))
    values[0, branch] = value
    found.__dict__[name] = values
    return found


def counts(*doubtful, number=2):
    count = np.ones((1, 16), dtype=np.intp)
    count[0, list(doubtful)] = number
    return count


def test_two_different_poses_are_two(found):
    dropped, unsure = decided(found, counts(2, 3))
    assert not np.any(dropped)
    assert not np.any(unsure)


@pytest.mark.parametrize(
    ("status", "open_question"), [(Status.parallel, False), (Status.near_singular, False), (Status.regular, True)]
)
def test_two_roots_of_one_pose_are_one_if_it_is_singular(found, status, open_question):
    changed(found, "joints", found.joints[0, 2], 3)
    changed(found, "formula_status", status, 2)
    dropped, unsure = decided(found, counts(2, 3))
    assert np.flatnonzero(dropped[0]).tolist() == [3]
    assert np.flatnonzero(unsure[0]).tolist() == ([3] if open_question else [])


def test_an_open_loop_that_closes_at_another_pose_is_not_decided(found):
    changed(found, "residuals", 1.0, 3)
    dropped, unsure = decided(found, counts(2, 3))
    assert np.flatnonzero(dropped[0]).tolist() == [3]
    assert np.flatnonzero(unsure[0]).tolist() == [3]


def test_an_open_loop_that_cannot_be_closed_is_no_pose():
    mechanism = assur.load("three_rps")
    here = roots_of(mechanism, mechanism.closed_form.direct, LENGTHS)
    far = roots_of(mechanism, mechanism.closed_form.direct, np.array([[1.0, 390.0, 400.0]]))
    joints = np.array(here.joints)
    joints[0, 3, list(mechanism.input_indices)] = [1.0, 390.0, 400.0]
    assert len(far.poses[far.exists]) == 0
    here.__dict__["joints"] = joints
    changed(here, "residuals", 1.0, 3)
    dropped, unsure = decided(here, counts(2, 3))
    assert np.flatnonzero(dropped[0]).tolist() == [3]
    assert not np.any(unsure)


def test_three_together_must_all_be_poses_that_are_not_singular(found):
    assert not np.any(decided(found, counts(1, 2, 3, number=3))[1])
    changed(found, "formula_status", Status.parallel, 2)
    assert np.flatnonzero(decided(found, counts(1, 2, 3, number=3))[1][0]).tolist() == [2]


def test_where_the_kernel_degenerates_a_root_in_doubt_is_not_decided(found):
    found.margins["aside"] = np.where(np.arange(16) == 5, 0.0, found.margins["aside"])
    assert np.flatnonzero(decided(found, counts(4, 5))[1][0]).tolist() == [5]
    assert not np.any(decided(found, counts(2, 3))[1])


def test_a_root_in_doubt_that_another_margin_forbids_is_no_pose():
    """R - r = 80: the legs of 80 lie level and toward the middle, where the third would need 80, too."""
    mechanism = assur.load("three_rps")
    found, turned = (mechanism.direct([40.0, 80.0, 80.0], method=method) for method in ("closed form", "loops"))
    assert (len(found), found.complete) == (len(turned), turned.complete) == (0, True)


@pytest.mark.parametrize(("height", "open_question"), [(-1.0, False), (-1e-6, True), (0.0, True)])
def test_a_margin_forbids_only_what_rounding_cannot_bring_back(found, height, open_question):
    scale = found.record.values.R**2
    found.margins["aside"] = np.where(np.arange(16) == 5, np.nan, found.margins["aside"])
    found.margins["heights"] = np.where(np.arange(16) == 5, height * scale, found.margins["heights"])
    assert np.flatnonzero(decided(found, counts(4, 5))[1][0]).tolist() == ([5] if open_question else [])
