"""Sweeps in all modes: each row is the sweep of its mode, and the directs are those of one problem at a time."""

import numpy as np
import pytest

from assur.kinematics.closed_form.all_modes_sweep import all_modes_sweep
from assur.kinematics.closed_form.sweep import inverse_sweep
from assur.kinematics.modes import all_modes


def test_every_row_of_the_expanded_answer_is_its_mode(mechanism, poses_of, count):
    poses = poses_of(mechanism)
    inputs, exists = all_modes_sweep(mechanism, "inverse", poses, block=999)
    modes = all_modes(mechanism, "inverse")
    assert inputs.shape == (len(modes), len(mechanism.inputs), count)
    for k, mode in enumerate(modes):
        one = inverse_sweep(mechanism, poses, mode, ("inputs", "exists"))
        np.testing.assert_array_equal(inputs[k], one["inputs"])
        np.testing.assert_array_equal(exists[k], one["exists"])


def test_directs_contain_the_pose_whose_inputs_they_are_given(mechanism, poses_of):
    poses = poses_of(mechanism)
    found = inverse_sweep(mechanism, poses)
    sizes = np.abs(found["factors"]) / np.abs(found["factors"]).max(axis=1, keepdims=True)
    regular = found["exists"] & np.all(sizes > 1e-3, axis=0)
    assert regular.sum() > 50
    directs, exist = all_modes_sweep(mechanism, "direct", found["inputs"][:, regular])
    gaps = np.abs(directs - poses[:, regular]).max(axis=1)  # (K, N)
    np.testing.assert_array_less(np.where(exist, gaps, np.inf).min(axis=0), 1e-8 * np.ptp(poses))


def test_directs_agree_with_the_solution_set(mechanism, inputs_of):
    inputs = inputs_of(mechanism)
    poses, exist = all_modes_sweep(mechanism, "direct", inputs, block=100)
    found = mechanism.direct(inputs.T)
    np.testing.assert_array_equal(exist.T, found.exists)
    assert exist.any()
    np.testing.assert_array_equal(np.moveaxis(poses, 2, 0)[exist.T], found.poses[exist.T])


@pytest.mark.parametrize(("gap", "exists"), [(0.0, False), (1e-3, True), (-1e-3, True)])
def test_self_motion_is_no_pose(zeng, gap, exists):
    # B = yA1 - l3 - yA2 = 0 lets the platform move with all inputs locked: a curve, of which no sample is listed
    _, exist = all_modes_sweep(zeng, "direct", ([100.0 + gap], [-40.0], [60.0]))
    assert bool(exist.any()) is exists
