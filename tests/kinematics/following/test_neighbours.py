"""Steps to neighbouring poses: changes of pose, and steps that would leave the mode."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.kinematics.following.neighbours import SignGuard, steps_at
from assur.kinematics.following.ways import pose_change
from assur.kinematics.named_signs import named_signs


def test_a_change_of_pose_takes_angles_the_short_way_and_quaternions_as_rotation_vectors():
    plane_platform = assur.load("planar_3rrr")
    change = pose_change(plane_platform, np.array([[0.0, 0.0, 3.1]]), np.array([[0.0, 0.0, -3.1]]))
    assert change[0, 2] == pytest.approx(2 * np.pi - 6.2)
    platform = replace(plane_platform.platform, pose=("qw", "qx", "qy", "qz"))
    half = 0.1
    turned = np.array([[np.cos(half), 0.0, 0.0, np.sin(half)]])
    change = pose_change(replace(plane_platform, platform=platform), np.array([[2.0, 0, 0, 0]]), turned)
    np.testing.assert_allclose(change, [[0.0, 0.0, 2 * half]], atol=1e-12)


def test_a_step_is_taken_inside_and_refused_beyond_the_border():
    record = assur.load("fivebar")
    poses = np.array([[0.0, 280.0], [0.0, 280.0]])
    joints = record.inverse(poses, mode="-+").joints[:, 0]
    steps = steps_at(SignGuard(record, named_signs(record, "inverse", joints[0])), poses, joints)
    found, good = steps.to(np.array([[0.0, 284.0], [0.0, 290.0]]))
    assert good.tolist() == [True, False]
    known = record.inverse([0.0, 284.0], mode="-+").joints[0]
    np.testing.assert_allclose(found.places.joints[0], known, atol=1e-9)
    parts, good = steps.in_parts(np.array([[0.0, 284.0], [0.0, 290.0]]))
    assert good.tolist() == [True, False]
    np.testing.assert_allclose(parts.places.joints[0], known, atol=1e-9)
