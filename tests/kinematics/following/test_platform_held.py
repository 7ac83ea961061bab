"""The platform held: rates against differences, determinants against the null space, merging branches."""

import numpy as np
import pytest

import assur
from assur.kinematics.following.locked import matrices
from assur.kinematics.following.platform_held import held_matrix, passes_zero, platform_held
from assur.kinematics.position import inverse
from assur.kinematics.rates.instantaneous import instantaneous
from assur.kinematics.rates.motions import input_units, pose_units
from assur.kinematics.turns import joint_units

NAMES = ("fivebar", "planar_3rrr", "zeng2019", "delta_4s", "three_rps", "three_upu")


def solutions(record, count=60, seed=2):
    low, high = np.array([record.box[name] for name in record.platform.pose]).T
    poses = np.random.default_rng(seed).uniform(low, high, size=(count, len(low)))
    found = inverse(record, poses, record.modes.default_working)
    there = found.exists[:, 0]
    return poses[there], found.joints[there, 0]


@pytest.mark.parametrize("name", NAMES)
def test_the_matrix_is_that_of_path_following(name):
    record = assur.load(name)
    _, joints = solutions(record)
    first, second = held_matrix(record, joints), matrices(record, joints)["poses"]
    # loops are closed about other points: the rows span the same space, and those of the pose are the same
    assert np.all(np.linalg.matrix_rank(np.concatenate([first, second], axis=1)) == np.linalg.matrix_rank(first))
    assert np.all(np.linalg.matrix_rank(first) == np.linalg.matrix_rank(second))
    pose = slice(-len(pose_units(record)), None)
    np.testing.assert_allclose(first[:, pose], second[:, pose], atol=1e-12)


@pytest.mark.parametrize("name", NAMES)
def test_the_determinant_is_that_of_the_null_space(name):
    record = assur.load(name)
    _, joints = solutions(record)
    here, instant = platform_held(record, joints), instantaneous(record, joints)
    rows = np.linalg.solve(instant.jq, instant.jp * pose_units(record))
    rows /= np.linalg.norm(rows, axis=-1, keepdims=True)
    # normal equations square the condition: their error is rounding over the square of a singular value
    np.testing.assert_allclose(here.output, np.linalg.det(rows), atol=2e-6)
    smallest = 1.0 / np.sqrt(1.0 + np.linalg.svd(here.inputs, compute_uv=False)[:, 0] ** 2)
    np.testing.assert_allclose(smallest, instant.measures["input"], atol=1e-6)


@pytest.mark.parametrize("name", ["fivebar", "zeng2019", "planar_3rrr"])
def test_input_rates_are_those_of_differences(name):
    record = assur.load(name)
    poses, joints = solutions(record)
    rates = platform_held(record, joints).inputs
    clear = platform_held(record, joints).serial > 1e-2
    step = 1e-6
    for k, unit in enumerate(pose_units(record)):
        ahead, behind = (poses[clear] + side * step * unit * np.eye(poses.shape[1])[k] for side in (1, -1))
        first, second = (inverse(record, there, record.modes.default_working).inputs[:, 0] for there in (ahead, behind))
        turn = (first - second) / (2 * step * input_units(record))
        np.testing.assert_allclose(rates[clear, :, k], turn, atol=1e-5)


def test_the_measure_falls_linearly_to_zero_at_the_border():
    record = assur.load("fivebar")
    border = np.sqrt((100 + 194) ** 2 - 70**2)
    gaps = np.array([0.02, 0.01, 0.005])
    found = inverse(record, np.stack([0 * gaps, border - gaps], axis=1), "-+")
    serial = platform_held(record, found.joints[:, 0]).serial
    np.testing.assert_allclose(serial / serial[-1], [4.0, 2.0, 1.0], rtol=1e-2)


def test_branches_on_two_sides_of_a_merging_are_told_apart_and_one_branch_is_not():
    record = assur.load("fivebar")
    border = np.sqrt((100 + 194) ** 2 - 70**2)
    poses = np.array([[5.0, border - 2.0], [5.0, border - 3.0]])
    one, two = (inverse(record, poses, mode).joints[:, 0] for mode in ("-+", "++"))
    assert np.max(np.abs(one - two) / joint_units(record)) < 1.0
    d_one, d_two = held_matrix(record, one), held_matrix(record, two)
    assert np.all(passes_zero(record, d_one, d_two))
    assert not np.any(passes_zero(record, d_one[:1], d_one[1:]))
    assert not np.any(passes_zero(record, d_two[:1], d_two[1:]))
