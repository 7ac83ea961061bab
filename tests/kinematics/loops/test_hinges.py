"""What joints and parallelograms say about orientations holds at home and at random assemblies."""

import dataclasses

import numpy as np
import pytest

from assur.joint_graph.frames import frames
from assur.joint_graph.tree import joint_graph
from assur.kinematics.closure import assemble
from assur.kinematics.home import home_values
from assur.kinematics.loops.hinges import (
    HingeTurn,
    Stiff,
    middle,
    rods_between_balls,
    triangles_of_balls,
    turns_of_joints,
    turns_of_parallelograms,
)
from assur.model.mechanism import MechanismRecord
from assur.model.registry import load_record


def _near_home(record: MechanismRecord) -> np.ndarray:
    home = home_values(record)
    start = home + np.random.default_rng(3).uniform(-0.2, 0.2, size=(6, len(home)))
    found = assemble(record, start)
    return np.asarray(found.values[found.closed])


@pytest.mark.parametrize("name", ["zeng2019", "orthoglide", "tripteron", "three_rrc"])
def test_orientations_at_assemblies_obey_them(name: str) -> None:
    record = load_record(name)
    joints = [*turns_of_joints(record, {}), *turns_of_parallelograms(record, tuple(record.generalised))]
    assert any(isinstance(joint, HingeTurn) for joint in joints)
    values = _near_home(record)
    assert len(values) >= 3
    placed = frames(record, values)
    for joint in joints:
        between = np.swapaxes(placed[joint.parent][0], -1, -2) @ placed[joint.child][0] @ joint.after.T
        if isinstance(joint, Stiff):
            np.testing.assert_allclose(between, np.broadcast_to(np.eye(3), between.shape), atol=1e-7)
        else:
            np.testing.assert_allclose(between @ joint.axis, np.broadcast_to(joint.axis, between.shape[:-1]), atol=1e-7)


def test_rods_of_a_p2us_and_the_crosses_of_their_joints_stay_parallel() -> None:
    record = load_record("three_p2us")
    alike = [turn for turn in turns_of_parallelograms(record, ("leg2.Pa",)) if isinstance(turn, Stiff)]
    crosses = {middle(record.joints[name]) for name in ("leg2.B1", "leg2.B2")}
    assert [{turn.parent, turn.child} for turn in alike] == [crosses, {"leg2.rod1", "leg2.rod2"}]
    start = home_values(record) + np.random.default_rng(1).uniform(-0.3, 0.3, size=(20, len(record.coordinates)))
    found = assemble(record, start, held=record.input_indices).values
    slices = joint_graph(record).slices
    angles = np.stack([found[:, slices[name]] for name in ("leg2.B1", "leg2.B2")])
    parallel = np.linalg.norm(_rod(record, found, "leg2.rod1") - _rod(record, found, "leg2.rod2"), axis=1) < 1e-9
    assert np.any(parallel)
    np.testing.assert_allclose(angles[0, parallel], angles[1, parallel], atol=1e-7)


def _rod(record: MechanismRecord, values: np.ndarray, link: str) -> np.ndarray:
    return np.asarray(frames(record, values)[link][0][..., 2])


def test_universal_joints_that_are_not_parallel_say_nothing_about_the_rods() -> None:
    record = load_record("three_p2us")
    joint = record.joints["leg1.B1"]
    turned = dataclasses.replace(joint, axes=(joint.axes[1], joint.axes[0]))
    other = dataclasses.replace(record, joints={**record.joints, "leg1.B1": turned})
    assert not [turn for turn in turns_of_parallelograms(other, ("leg1.Pa",)) if isinstance(turn, Stiff)]


def test_a_link_on_three_ball_joints_is_a_triangle() -> None:
    record = load_record("three_rps")
    ((link, corners),) = triangles_of_balls(record).items()
    assert link == "platform"
    balls = np.array([record.joints[f"leg{k}.S"].child_at for k in (1, 2, 3)])
    assert {tuple(row) for row in corners} == {tuple(row) for row in balls}
    six = triangles_of_balls(load_record("delta_4s"))["platform"]
    sides = six[1:] - six[0]
    assert np.linalg.norm(np.cross(*sides)) > 0.5 * np.prod(np.linalg.norm(sides, axis=1))  # far from being in line
    assert triangles_of_balls(load_record("fivebar")) == {}


def test_a_locked_joint_is_stiff() -> None:
    record = load_record("fivebar")
    free = list(turns_of_joints(record, {}))
    locked = list(turns_of_joints(record, dict.fromkeys(record.input_indices, 0.5)))
    assert [isinstance(joint, HingeTurn) for joint in free] == [True] * 5
    assert [isinstance(joint, HingeTurn) for joint in locked] == [False, False, True, True, True]


def test_rods_of_a_kept_parallelogram_share_a_number_and_a_direction() -> None:
    record = load_record("delta_4s")
    kept = rods_between_balls(record, tuple(record.generalised))
    apart = rods_between_balls(record, ())
    assert [number for _, number in kept.values()] == [0, 0, 1, 1, 2, 2]
    assert sorted(number for _, number in apart.values()) == list(range(6))
    placed = frames(record, home_values(record))
    for k in (1, 2, 3):
        first, second = (placed[rod][0] @ kept[rod][0] for rod in (f"leg{k}.rod1", f"leg{k}.rod2"))
        np.testing.assert_allclose(first, second, atol=1e-7)


def test_short_links_of_a_ball_jointed_parallelogram_turn_about_their_direction() -> None:
    record = load_record("delta_4s")
    found = list(turns_of_parallelograms(record, tuple(record.generalised)))
    assert [(turn.parent, turn.child) for turn in found] == [(f"leg{k}.arm", "platform") for k in (1, 2, 3)]
    assert all(isinstance(turn, HingeTurn) for turn in found)
    motor = record.joints["leg1.A"].axes[0]
    np.testing.assert_allclose(np.cross(found[0].axis, motor), 0.0, atol=1e-12)
    assert not list(turns_of_parallelograms(record, ()))
