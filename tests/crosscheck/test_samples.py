"""Configurations to compare at: both problems, every solution, each one closed."""

import dataclasses

import numpy as np

import assur
from assur.crosscheck import samples
from assur.crosscheck.samples import configurations
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closure import closure_error
from assur.kinematics.pose import pose_of
from assur.kinematics.position import inverse


def check(record, found):
    length = characteristic_length(record)
    for item in found:
        assert closure_error(record, item.joints) < 1e-9 * length
        np.testing.assert_allclose(pose_of(record, item.joints), item.pose, atol=1e-8 * length)


def test_solutions_of_both_problems_in_all_modes_of_each():
    record = assur.load("fivebar")
    found = configurations(record, 5, np.random.default_rng(0))
    check(record, found)
    assert {item.mode for item in found if item.problem == "inverse"} == {"++", "+-", "-+", "--"}
    assert {item.mode for item in found if item.problem == "direct"} == {"+", "-"}
    assert all(item.working_mode == item.mode for item in found if item.problem == "inverse")
    assert {item.working_mode for item in found if item.problem == "direct"} <= {"++", "+-", "-+", "--"}


def test_poses_are_in_the_box_of_the_file():
    record = assur.load("zeng2019")
    found = [item for item in configurations(record, 5, np.random.default_rng(0)) if item.problem == "inverse"]
    low, high = np.array([record.box[name] for name in record.platform.pose]).T
    assert all(np.all((low <= item.pose) & (item.pose <= high)) for item in found)


def test_without_a_box_poses_are_near_home():
    record = dataclasses.replace(assur.load("fivebar"), box={})
    found = configurations(record, 5, np.random.default_rng(0))
    check(record, found)
    poses = {tuple(item.pose.round(6)) for item in found if item.problem == "inverse"}
    assert len(poses) >= 3
    home = pose_of(record, assur.load("fivebar").home_values)
    assert all(np.linalg.norm(np.array(pose) - home) < characteristic_length(record) for pose in poses)


def test_without_a_closed_form_one_round_is_enough(monkeypatch):
    record = dataclasses.replace(assur.load("fivebar"), closed_form=None)
    rounds = []
    monkeypatch.setattr(samples, "inverse", lambda *given: rounds.append(given) or inverse(*given))
    check(record, configurations(record, 3, np.random.default_rng(0)))
    assert len(rounds) == 1
