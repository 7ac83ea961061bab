"""Poses followed to from home, many at once: against closed forms, where there are some."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import assur
from assur.kinematics import border
from assur.kinematics.following.from_home import followed_by_ways, followed_from_home, followed_together
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_of
from assur.kinematics.rates.acceleration import reached_in_mode
from assur.kinematics.status import Status
from assur.model.pose import is_angle
from assur.model.registry import load_record

NAMES = ("fivebar", "delta_4s", "zeng2019", "planar_3rrr", "three_crr")


@pytest.mark.parametrize("name", NAMES)
def test_what_is_reached_is_home_s_branch_of_the_closed_form(name):
    record = assur.load(name)
    home = home_values(record)
    start = pose_of(record, home)
    size = np.ptp([record.box[name] for name in record.platform.pose], axis=1)
    poses = start + np.random.default_rng(3).uniform(-0.25, 0.25, (60, len(start))) * size
    joints, reached = followed_from_home(record, poses)
    assert reached.sum() > 10
    np.testing.assert_allclose(pose_of(record, joints[reached]), poses[reached], rtol=0, atol=1e-7 * np.max(size))
    inputs = border.inputs_of(record, joints)
    mode = next(item.mode for item in record.inverse(start) if np.allclose(item.inputs, border.inputs_of(record, home)))
    answer = record.inverse(poses, mode)
    real = np.asarray(answer.overall_status) != Status.unreachable
    assert not np.any(reached & ~real)
    turns = np.array([2 * np.pi if item.coordinate.kind == "angle" else np.inf for item in record.inputs])
    difference = np.abs(inputs - answer.inputs[:, 0])[reached]
    np.testing.assert_array_less(np.minimum(difference, np.abs(turns - difference)), 1e-6 * np.max(size))


def test_what_a_pose_gets_depends_on_that_pose_alone():
    record = assur.load("fivebar")
    poses = np.array([[0.0, 280.0], [40.0, 250.0], [0.0, 290.0], [-60.0, 200.0], [500.0, 0.0]])
    joints, reached = followed_from_home(record, poses)
    assert reached.tolist() == [True, True, False, True, False]
    for k, pose in enumerate(poses):
        alone, _ = followed_from_home(record, pose[None])
        np.testing.assert_allclose(alone[0], joints[k], rtol=1e-12, atol=1e-12)


def test_a_grid_is_reached_wherever_home_leads_straight():
    """Half of it is out of reach; against every pose alone, and against home's branch of the closed form."""
    record = assur.load("fivebar")
    axes = np.meshgrid(np.linspace(-250.0, 250.0, 41), np.linspace(-40.0, 300.0, 31), indexing="ij")
    poses = np.stack([axis.ravel() for axis in axes], axis=1)
    joints, reached = followed_together(record, poses)
    _, alone = followed_from_home(record, poses)
    assert 0.3 < np.mean(reached) < 0.7
    assert np.all(reached[alone])
    wanted = record.inverse(poses[reached], record.modes.default_working).inputs[:, 0]
    away = border.inputs_of(record, joints[reached]) - wanted
    np.testing.assert_allclose((away + np.pi) % (2 * np.pi) - np.pi, 0.0, atol=1e-9)


def test_a_grid_of_inputs_keeps_home_s_assembly_mode():
    record = assur.load("fivebar")
    axes = np.meshgrid(np.radians(np.linspace(-60.0, 170.0, 24)), np.radians(np.linspace(10.0, 240.0, 24)))
    inputs = np.stack([axis.ravel() for axis in axes], axis=1)
    joints, reached = followed_together(record, inputs, "inputs")
    assert reached.mean() > 0.9
    np.testing.assert_allclose(border.inputs_of(record, joints[reached]), inputs[reached], rtol=0, atol=1e-9)
    wanted = record.direct(inputs[reached], record.modes.default_assembly).poses[:, 0]
    np.testing.assert_allclose(pose_of(record, joints[reached]), wanted, rtol=0, atol=1e-7)


@pytest.mark.parametrize("name", NAMES)
def test_poses_in_a_row_are_reached_as_from_home(name):
    """Lines of a grid, several of them, longer than the distance of what is followed from home."""
    record = assur.load(name)
    start = pose_of(record, home_values(record))
    size = np.ptp([record.box[name] for name in record.platform.pose], axis=1)
    lines = [start + np.outer(np.linspace(-0.2, 0.2, 90), size * way) for way in np.eye(len(start))[:2]]
    poses = np.concatenate(lines)
    straight, alone = followed_from_home(record, poses)
    joints, reached = followed_together(record, poses)
    assert reached.sum() > 20
    assert np.all(reached[alone])
    assert np.mean(reached == alone) > 0.9
    np.testing.assert_allclose(pose_of(record, joints[reached]), poses[reached], rtol=0, atol=1e-7 * np.max(size))
    inputs = [border.inputs_of(record, part)[alone] for part in (straight, joints)]
    turns = np.array([2 * np.pi if item.coordinate.kind == "angle" else np.inf for item in record.inputs])
    difference = np.abs(inputs[0] - inputs[1])
    np.testing.assert_array_less(np.minimum(difference, np.abs(turns - difference)), 1e-6 * np.max(size))


def test_ways_lead_round_what_the_straight_one_ends_at_and_stay_in_home_s_mode():
    record = assur.load("fivebar")
    poses = np.random.default_rng(5).uniform([-220.0, -150.0], [220.0, 250.0], (100, 2))
    joints, straight = followed_by_ways(record, poses), followed_from_home(record, poses)[1]
    reached = np.isfinite(joints[:, 0])
    assert straight.sum() < reached.sum() < 100
    assert np.all(reached[straight])
    wanted = record.inverse(poses[reached], record.modes.default_working).inputs[:, 0]
    away = border.inputs_of(record, joints[reached]) - wanted
    np.testing.assert_allclose(np.sin(0.5 * away), 0.0, atol=1e-9)


def test_angles_go_the_short_way():
    record = assur.load("planar_3rrr")
    turn = [2 * np.pi if is_angle(name) else 0.0 for name in record.platform.pose]
    poses = pose_of(record, home_values(record)) + np.random.default_rng(1).uniform(-1, 1, (5, 3)) * [30, 30, 0.3]
    np.testing.assert_allclose(followed_by_ways(record, poses + turn), followed_by_ways(record, poses), atol=1e-9)


@pytest.mark.parametrize(("count", "said"), [(9, "undecided"), pytest.param(1, "unreachable", marks=pytest.mark.deep)])
def test_a_pose_that_no_way_leads_to_is_undecided_among_many_and_alone_where_that_is_proved_out_of_reach(count, said):
    record = replace(load_record("fivebar"), closed_form=None)
    far = pose_of(record, home_values(record)) + 1e4
    assert [Status(code).name for code in reached_in_mode(record, np.tile(far, (count, 1)))[1]] == [said] * count


def test_coordinates_of_a_pose_may_stand_in_any_order():
    record = assur.load("planar_3rrr")
    order = [2, 0, 1]
    turned = replace(record, platform=replace(record.platform, pose=tuple(record.platform.pose[k] for k in order)))
    poses = pose_of(record, home_values(record)) + np.random.default_rng(1).uniform(-1, 1, (20, 3)) * [60, 60, 0.6]
    joints, reached = followed_from_home(record, poses)
    same, also = followed_from_home(turned, poses[:, order])
    assert 10 < reached.sum() == np.sum(reached & also)
    np.testing.assert_allclose(same[reached], joints[reached], atol=1e-9)


def test_a_grid_of_a_mechanism_of_one_s_own_closes_as_its_rods_say():
    """A Par4 with 56 joint values, redundant loops and rods that spin, against the lengths of its rods alone."""
    record = load_record(Path(__file__).with_name("par4.toml"))
    size = {name: own.value for name, own in record.parameters.items()}
    away = np.meshgrid(*[np.linspace(-70.0, 70.0, 5)] * 3, np.linspace(-0.6, 0.6, 5), indexing="ij")
    home = pose_of(record, home_values(record))
    poses = home + np.stack(away, axis=-1).reshape(-1, 4)
    joints, reached = followed_together(record, poses)
    assert np.all(reached)
    phi, flat = poses[:, 3], np.zeros(len(poses))
    middle = poses[:, :3] - [size["a"], 0.0, 0.0]
    side = size["g"] * np.stack([-np.sin(phi), np.cos(phi), flat], axis=1)  # the bars keep their orientation
    arms = border.inputs_of(record, joints)
    for k, (x, y) in enumerate([(1, 1), (-1, 1), (-1, -1), (1, -1)]):
        out, end = np.array([x, y, 0.0]) / np.sqrt(2), middle + y * side + [x * size["a"], 0.0, 0.0]
        knee = out * size["R"] + size["L"] * (np.cos(arms[:, [k]]) * out - np.sin(arms[:, [k]]) * [0.0, 0.0, 1.0])
        aside = out * (size["R"] + size["L"]) - [x * size["a"], y * size["g"], size["z"]]
        np.testing.assert_allclose(np.linalg.norm(end - knee, axis=1), np.linalg.norm(aside), rtol=1e-11)


def test_an_empty_row():
    joints, reached = followed_together(assur.load("fivebar"), np.empty((0, 2)))
    assert (joints.shape, reached.shape) == ((0, 5), (0,))
