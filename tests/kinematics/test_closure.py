"""Assembly of the whole joint graph from anywhere, and what its rank says."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

import assur
from assur.joint_graph.frames import child_frame, frames
from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.tree import joint_graph
from assur.kinematics.closure import assemble, closing_system, closure_error, closure_jacobian, mobility, residuals
from assur.kinematics.home import home_values
from assur.kinematics.pose import platform_frame, pose_of
from assur.model.registry import load_record
from catalogue import each


def _starts(mechanism, count, seed=0):
    rng = np.random.default_rng(seed)
    angular = [item.kind == "angle" for item in mechanism.coordinates]
    shape = (count, len(angular))
    return np.where(
        angular, rng.uniform(-np.pi, np.pi, shape), rng.uniform(-1, 1, shape) * characteristic_length(mechanism)
    )


NEARLY_ALL = 0.9
FEWER = {
    # rods between ball joints, free to spin: they close slowly, and 200 steps do not end every way from anywhere
    "delta_4s": 0.35,
    "h4_robot": 0.25,
    "linear_delta_4s": 0.6,
    "three_p2us": 0.8,
    # parallelograms of four revolutes: more than one that has crossed over leaves a gap, and no step makes it smaller
    "linear_delta_4r": 0.4,
    "orthoglide": 0.7,
    "three_rrrp4r": 0.65,
    "tsai_platform": 0.45,
}
"""Mechanisms of which fewer than nearly all random starts close, and the share that must."""


@pytest.mark.parametrize("name", each())
def test_random_starts_assemble_and_no_axis_is_turned_round(name):
    """The check shares nothing with the residual: joint points and axis vectors, seen from both links."""
    mechanism = assur.load(name)
    found = assemble(mechanism, _starts(mechanism, 250), max_steps=200)
    assert np.mean(found.closed) > FEWER.get(name, NEARLY_ALL)
    residual = found.residual / characteristic_length(mechanism)
    assert np.all(residual[found.closed] < 1e-8)
    assert np.all(residual[~found.closed] > 1e-10), "the others are closest approaches, and say so"
    values = found.values[found.closed]
    placed = frames(mechanism, values)
    for joint in joint_graph(mechanism).cut:
        (parent, origin), (child, child_origin) = placed[joint.parent], placed[joint.child]
        gap = (parent @ joint.at + origin) - (child @ joint.child_at + child_origin)
        if len(joint.axes) == 2:  # a universal joint's axes keep their angle
            first, second = parent @ joint.axes[0], child @ joint.axes[1]
            np.testing.assert_allclose(np.sum(first * second, axis=-1), joint.axes[0] @ joint.axes[1], atol=1e-7)
        elif len(joint.axes) == 1:
            axis, child_axis = parent @ joint.axes[0], child @ (joint.turn.T @ joint.axes[0])
            np.testing.assert_allclose(axis, child_axis, atol=1e-7)
            if "translation" in joint.type.components:
                gap -= np.sum(gap * axis, axis=-1, keepdims=True) * axis
        np.testing.assert_allclose(gap / characteristic_length(mechanism), 0.0, atol=1e-8)


def test_a_joint_turned_by_half_a_turn_is_no_assembly():
    """Turning a rod of a parallelogram end for end keeps its axes' lines but not their senses."""
    mechanism = assur.load("zeng2019")
    home = mechanism.home_values.copy()
    for item in mechanism.coordinates:
        if item.joint == "D2":
            home[item.index] += np.pi
    assert closure_error(mechanism, home) > 1.0


def test_held_joints_stand_still_and_crossed_parallelograms_are_found():
    """The joint graph has more assemblies than the reduced model of the paper: the closed form says so."""
    mechanism = assur.load("zeng2019")
    inputs = [162.6907, -143.3209, -24.6776]
    starts = _starts(mechanism, 250)
    starts[:, :3] = inputs
    found = assemble(mechanism, starts, held=mechanism.input_indices, max_steps=200)
    np.testing.assert_array_equal(found.values[:, :3], starts[:, :3])
    rotation, poses = frames(mechanism, found.values[found.closed])["platform"]
    reduced = mechanism.direct(inputs).poses[mechanism.direct(inputs).exists]
    gaps = np.linalg.norm(poses[:, None] - reduced, axis=-1)
    assert np.all(gaps.min(axis=0) < 1e-6), "every closed-form pose is met"
    crossed = gaps.min(axis=1) > 1e-3
    turned = np.abs(rotation - np.eye(3)).max(axis=(-1, -2)) > 1e-3
    assert np.any(crossed)
    assert np.any(turned & crossed), "a crossed parallelogram may turn the platform"


def test_the_closed_form_of_the_five_bar_is_complete_for_the_joint_graph():
    mechanism = assur.load("fivebar")
    inputs = np.array([np.arctan2(0.8, -0.6), np.arctan2(0.8, 0.6)])
    starts = _starts(mechanism, 300)
    starts[:, mechanism.input_indices] = inputs
    found = assemble(mechanism, starts, held=mechanism.input_indices, max_steps=200)
    poses = np.array([mechanism.point("P", values)[:2] for values in found.values[found.closed]])
    closed_form = mechanism.direct(inputs).poses
    assert np.linalg.norm(poses[:, None] - closed_form, axis=-1).min(axis=1).max() < 1e-6


def test_what_cannot_close_is_reported_as_it_stands():
    mechanism = assur.load("zeng2019")
    start = mechanism.home_values.copy()
    start[:2] = [700.0, -700.0]
    found = assemble(mechanism, start, held=mechanism.input_indices)
    assert not found.closed
    # B1 and B2 are 1400 apart and links 9, 11 and 10 reach over 700
    assert float(found.residual) > 100.0


def test_the_derivative_of_the_residual_is_the_screws_at_an_assembly():
    mechanism = assur.load("zeng2019")
    values, step = mechanism.home_values, 1e-6
    matrix, length = closure_jacobian(mechanism, values), characteristic_length(mechanism)
    placed, (_, point) = frames(mechanism, values), platform_frame(mechanism, values)
    differences = np.empty_like(matrix)
    for index in range(len(values)):
        change = np.zeros_like(values)
        change[index] = step
        gap = (residuals(mechanism, values + change) - residuals(mechanism, values - change)) / (2 * step)
        differences[:, index] = gap.ravel()
    for row, joint in enumerate(joint_graph(mechanism).cut):
        rotation, origin = placed[joint.child]
        arm = rotation @ joint.child_at + origin - point
        block = matrix[6 * row : 6 * row + 6]
        velocity = length * block[3:] + np.cross(block[:3], arm[:, None], axis=0)
        np.testing.assert_allclose(differences[6 * row : 6 * row + 3], velocity, atol=1e-5)
        np.testing.assert_allclose(differences[6 * row + 3 : 6 * row + 6], length * block[:3], atol=1e-4)


def test_rank_of_the_paper_s_joint_graph():
    """17 joints, 14 links: 4 loops, 24 rows of rank 14, F = 3, 10 redundant constraints (errata E13)."""
    mechanism = assur.load("zeng2019")
    free = mobility(mechanism, mechanism.home_values)
    assert (len(mechanism.joints), len(mechanism.links), len(joint_graph(mechanism).cut)) == (17, 14, 4)
    assert (int(free.rank), int(free.freedoms), int(free.redundant)) == (14, 3, 10)
    assert float(free.gap) > 1e6


def test_home_follows_a_change_of_parameters():
    for value in (250.0, 300.0, 400.0):
        mechanism = assur.load("zeng2019", l2=value)
        assert mechanism.closure_error(mechanism.home_values) < 1e-8


def test_home_that_cannot_close_is_refused_with_the_gap():
    with pytest.raises(assur.UsageError, match="the loops do not close from home: a gap of"):
        _ = assur.load("zeng2019", b=1000.0).home_values


def test_home_is_followed_to_dimensions_that_do_not_close_from_the_file_s():
    """From the file's home l4 = 20 closes in another mode and metres do not close at all; step by step they do."""
    metres = {name: item.value / 1000 for name, item in load_record("zeng2019").parameters.items()}
    for changed in ({"l4": 20.0}, metres):
        mechanism = assur.load("zeng2019", **changed)
        assert mechanism.closure_error(mechanism.home_values) < 1e-9 * characteristic_length(mechanism)
        assert mechanism.singularity(mechanism.point("O'", mechanism.home_values)).kind == "regular"


def test_home_of_a_file_that_does_not_close_is_a_fault_of_the_file():
    record = load_record("zeng2019")
    away = dataclasses.replace(record.joints["P3"], at=np.array([5000.0, 0.0, 0.0]))
    with pytest.raises(assur.MechanismFileError, match="home: the loops do not close from home: a gap of"):
        home_values(dataclasses.replace(record, joints={**record.joints, "P3": away}))


def test_rank_does_not_depend_on_the_place():
    """The sliders may be anywhere along Y."""
    paper = assur.load("zeng2019")
    for far in (1e3, 1e6, 1e8):
        values = paper.home_values.copy()
        values[:3] += far
        assert int(mobility(paper, values).rank) == 14


def test_an_empty_batch_held_joints_and_wrong_ones():
    paper = assur.load("zeng2019")
    assert assemble(paper, np.empty((2, 0, 17))).values.shape == (2, 0, 17)
    whole = assemble(paper, paper.home_values, held=range(17))
    assert bool(whole.closed)
    for wrong in ([99], [-1], ["P1"]):
        with pytest.raises(assur.UsageError, match="held: no joint values"):
            assemble(paper, paper.home_values, held=wrong)
    with pytest.raises(assur.UsageError, match="17 of them are wanted"):
        paper.closure_error(np.zeros(20))


def test_rank_does_not_depend_on_the_unit():
    """The same mechanism written in metres has the same rank."""
    record = load_record("zeng2019")
    small = {name: item.value / 1000 for name, item in record.parameters.items()}
    mechanism = assur.load("zeng2019", **small)
    values = record.home.copy()
    values[[item.kind == "length" for item in record.coordinates]] /= 1000
    closed = assemble(mechanism, values)
    assert int(mobility(mechanism, closed.values).rank) == 14


def test_one_joint_frame_is_reached_from_both_sides():
    mechanism = assur.load("zeng2019")
    placed = mechanism.frames(mechanism.home_values)
    graph = joint_graph(mechanism)
    for joint in graph.cut:
        reached = child_frame(joint, placed[joint.parent], mechanism.home_values[graph.slices[joint.name]])
        np.testing.assert_allclose(reached[1], placed[joint.child][1], atol=1e-9)


@pytest.mark.parametrize("name", ["zeng2019", "gough_stewart", "orthoglide", "delta_4s", "every"])
def test_the_derivative_of_open_loops_is_that_of_differences(name):
    """Far from closing too: turns that are left have rates of their own, the point reached is not the child's.

    Joints that lead to both sides of a loop, as of a parallelogram that is carried, turn its gap.
    """
    record = load_record(Path(__file__).parent / "rates" / "every_type.toml" if name == "every" else name)
    length = characteristic_length(record)
    rng, home = np.random.default_rng(4), np.array(record.home)
    size = np.array([length if item.kind == "length" else 1.0 for item in record.coordinates])
    values = home + 0.4 * rng.normal(size=(5, len(home))) * size
    poses = pose_of(record, values + 0.2 * rng.normal(size=values.shape) * size)
    derivative, step = closing_system(record, values, poses)[1], 1e-6
    assert np.max(np.abs(closing_system(record, values, None)[0])) > 0.1 * length
    loops = slice(0, 6 * len(joint_graph(record).cut))
    for k in range(values.shape[1]):
        push = step * size * np.eye(len(home))[k]
        ahead, behind = (closing_system(record, values + sense * push, poses)[0] for sense in (1, -1))
        change = (ahead - behind)[:, loops] / (2 * step)
        np.testing.assert_allclose(derivative[:, loops, k] * size[k], change, atol=1e-5 * length)
