"""The platform held: rates against differences, determinants against the null space, merging branches."""

import itertools

import numpy as np
import pytest

import assur
from assur.joint_graph.tree import joint_graph
from assur.kinematics.following.from_home import followed_together
from assur.kinematics.following.locked import matrices
from assur.kinematics.following.platform_held import holding, passes_zero, platform_held
from assur.kinematics.following.ways import held_system
from assur.kinematics.pose import pose_of
from assur.kinematics.position import inverse
from assur.kinematics.rates.instantaneous import instantaneous
from assur.kinematics.rates.motions import input_units, pose_units
from assur.kinematics.turns import joint_units
from assur.numerics import rotations
from assur.numerics.newton import damped

NAMES = ("fivebar", "planar_3rrr", "zeng2019", "delta_4s", "three_rps", "three_upu")


def solutions(record, count=60, seed=2):
    low, high = np.array([record.box[name] for name in record.platform.pose]).T
    poses = np.random.default_rng(seed).uniform(low, high, size=(count, len(low)))
    found = inverse(record, poses, record.modes.default_working)
    there = found.exists[:, 0]
    return poses[there], found.joints[there, 0]


def held_matrix(record, joints):
    """D of the closing system with the platform held, ball joints by angular velocities as rates have them."""
    matrix = held_system(record, joints, pose_of(record, joints))[1]
    for turn in joint_graph(record).turns:
        matrix[..., turn] = matrix[..., turn] @ rotations.vector_rates_matrix(joints[:, turn])
    return matrix


@pytest.mark.parametrize("name", NAMES)
def test_the_matrix_is_that_of_path_following(name):
    record = assur.load(name)
    poses, joints = solutions(record)
    first, second = held_system(record, joints, poses)[1], matrices(record, joints)["poses"]
    # loops are closed about other points: the rows span the same space, and those of the pose are the same
    assert np.all(np.linalg.matrix_rank(np.concatenate([first, second], axis=1)) == np.linalg.matrix_rank(first))
    assert np.all(np.linalg.matrix_rank(first) == np.linalg.matrix_rank(second))
    pose = slice(-len(pose_units(record)), None)
    np.testing.assert_allclose(first[:, pose], second[:, pose], atol=1e-12)


@pytest.mark.parametrize("name", [*NAMES, "gough_stewart", "h4_robot"])
def test_rates_are_those_that_keep_the_loops_closed(name):
    record = assur.load(name)
    _, joints = solutions(record)
    held = platform_held(record, joints)
    clear = held.serial > 1e-3
    assert np.any(clear)
    matrix, rates = held_matrix(record, joints[clear]), held.rates[clear]
    expected = np.linalg.pinv(matrix, rcond=1e-8)[..., -rates.shape[-1] :]
    np.testing.assert_allclose(matrix @ rates, matrix @ expected, atol=1e-6)
    if not joint_graph(record).turns:  # a rod between two balls may spin
        np.testing.assert_allclose(rates, expected, atol=1e-6 * np.max(np.abs(expected)))


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
    first, second = (platform_held(record, joints).rates for joints in (one, two))
    assert np.all(passes_zero(first, second))
    assert not np.any(passes_zero(first[:1], first[1:]))
    assert not np.any(passes_zero(second[:1], second[1:]))


def near_modes(record):
    """Joint values (N, n) of two modes that are near at the same poses, all pairs of modes together."""
    low, high = np.array([record.box[name] for name in record.platform.pose]).T
    found = inverse(record, np.random.default_rng(4).uniform(low, high, size=(2000, len(low))))
    pairs = []
    for i, j in itertools.combinations(range(found.exists.shape[1]), 2):
        there = found.exists[:, i] & found.exists[:, j]
        first, second = found.joints[there, i], found.joints[there, j]
        near = np.max(np.abs(first - second) / joint_units(record), axis=1, initial=0.0) < 0.4
        if np.any(near):
            pairs.append((first[near], second[near]))
    return pairs


def turned(first, second):
    return np.linalg.slogdet(damped(np.swapaxes(first, -1, -2) @ second, first))[0] < 0.0


@pytest.mark.parametrize("name", ["fivebar", "planar_3rrr", "delta_4s", "orthoglide", "h4_robot"])
def test_mergings_are_told_by_the_determinant_of_the_closing_system_too(name):
    """det(D1' D2) has the sign of what passes zero; where the closure alone passes, too, it says nothing."""
    record = assur.load(name)
    first, second = (np.concatenate(part) for part in zip(*near_modes(record), strict=True))
    one, other = held_matrix(record, first), held_matrix(record, second)
    closure = slice(6 * len(joint_graph(record).cut))
    clear = ~turned(one[:, closure], other[:, closure])
    told = passes_zero(platform_held(record, first).rates, platform_held(record, second).rates)
    assert np.sum(told & clear) >= 4
    np.testing.assert_array_equal(told[clear], turned(one, other)[clear])


def test_a_branch_goes_on_where_a_parallelogram_folds_over():
    """Whether two modes merge is the same wherever they are near, also where one is the other folded over.

    Beside two singularities at once a pair may be too far apart for either to be told.
    """
    record = assur.load("zeng2019")
    told = [passes_zero(*(platform_held(record, part).rates for part in pair)) for pair in near_modes(record)]
    assert {bool(one[0]) for one in told} == {True, False}
    assert all(abs(np.mean(one) - 0.5) >= 0.4 for one in told)


SCREWS = """
format = 1
name = "screws"
unit = "mm"
angle = "deg"
base = "base"
platform = { link = "nut", pose = ["z"] }
links = { base = {}, shaft = {}, nut = {} }
inputs = { H1 = { name = "q" } }
home = { H1 = 0, H2 = 0, P = 0 }
[joints]
H1 = { type = "helical", parent = "base", child = "shaft", axis = "z", pitch = 5 }
H2 = { type = "helical", parent = "shaft", child = "nut", axis = "z", pitch = -3 }
P = { type = "prismatic", parent = "base", child = "nut", axis = "z" }
"""


def test_screws_are_followed_through_turns(tmp_path):
    """A differential screw: 8 mm a turn. Rates are those of turns that move as far as other joints do."""
    path = tmp_path / "screws.toml"
    path.write_text(SCREWS, encoding="utf-8")
    record = assur.load(path)
    turn, units = 2 * np.pi, joint_units(record)
    z = np.linspace(0.0, 25.0, 30)[:, None]
    joints, reached = followed_together(record, z)
    expected = z * np.array([turn / 8, -turn / 8, 1.0])
    assert np.all(reached)
    np.testing.assert_allclose(joints, expected, atol=1e-8)
    slopes = np.array([turn / 8, -turn / 8, 1.0])
    for held, own, end in (("poses", pose_units(record), z), ("inputs", units[:1] * 8 / turn, joints[:, :1])):
        rates = holding(record, held).rates(joints, end if held == "poses" else None)
        np.testing.assert_allclose(rates[..., 0], np.tile(slopes * own / units, (30, 1)), rtol=1e-6)
    joints, reached = followed_together(record, expected[:, :1], "inputs")
    assert np.all(reached)
    np.testing.assert_allclose(joints, expected, atol=1e-8)
