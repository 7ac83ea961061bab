"""Frames, screws and loops of the joint graph, over every joint type."""

from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import expm

import assur
from assur.joint_graph.frames import child_frame, frames, screws
from assur.joint_graph.points import point
from assur.joint_graph.tree import joint_graph
from assur.joints.catalogue import JOINT_TYPES
from assur.model.registry import load_record
from assur.numerics import rotations

EVERY_TYPE = Path(__file__).parents[1] / "kinematics" / "rates" / "every_type.toml"


@pytest.fixture
def every():
    return load_record(EVERY_TYPE)


def test_a_spanning_tree_reaches_every_link_and_leaves_the_independent_loops(every):
    graph = joint_graph(every)
    assert len(graph.tree) == len(every.links) - 1
    assert len(graph.cut) == len(every.joints) - len(every.links) + 1
    assert {name for loop in graph.loops for name in loop} <= set(every.joints)


def exponential(joint, values):
    """What a joint does to its child (4, 4), as exponentials of its definition: an oracle that knows no steps."""
    axes = [np.r_[axis, 0, 0, 0] for axis in joint.axes]
    slides = [np.r_[0, 0, 0, axis] for axis in joint.axes]
    twists = {
        "revolute": lambda a: [a * axes[0]],
        "prismatic": lambda a: [a * slides[0]],
        "helical": lambda a: [a * (axes[0] + joint.pitch / (2 * np.pi) * slides[0])],
        "cylindrical": lambda a, b: [a * slides[0] + b * axes[0]],
        "universal": lambda a, b: [a * axes[0], b * axes[1]],
        "spherical": lambda a, b, c: [np.array([a, b, c, 0, 0, 0])],
        "planar": lambda a, b, c: [a * slides[1] + b * slides[2], c * axes[0]],
    }[joint.type.name](*values)
    displaced = np.eye(4)
    for twist in twists:
        matrix = np.zeros((4, 4))
        matrix[:3, :3], matrix[:3, 3] = rotations.skew(twist[:3]), twist[3:]
        displaced = displaced @ expm(matrix)
    return displaced


def test_a_child_is_displaced_by_the_exponential_of_its_joint(every):
    rng = np.random.default_rng(0)
    parent = np.eye(4)
    parent[:3, :3], parent[:3, 3] = rotations.from_vector(rng.normal(size=3)), rng.normal(size=3)
    for joint in every.joints.values():
        values = rng.normal(size=joint.type.freedoms)
        before, after = np.eye(4), np.eye(4)
        before[:3, 3], after[:3, :3], after[:3, 3] = joint.at, joint.turn, -joint.turn @ joint.child_at
        expected = parent @ before @ exponential(joint, values) @ after
        rotation, origin = child_frame(joint, (parent[:3, :3], parent[:3, 3]), values)
        np.testing.assert_allclose(rotation, expected[:3, :3], atol=1e-13)
        np.testing.assert_allclose(origin, expected[:3, 3], atol=1e-12)


def test_links_are_where_their_joints_put_them(every):
    """Along the spanning tree, from parent to child and from child to parent."""
    values = np.random.default_rng(1).normal(size=(7, len(every.coordinates)))
    graph, placed = joint_graph(every), frames(every, values)
    assert {forward for _, forward in graph.tree} == {True, False}
    for joint, _ in graph.tree:
        for k, own in enumerate(values[:, graph.slices[joint.name]]):
            parent, child = ([part[k] for part in placed[link]] for link in (joint.parent, joint.child))
            rotation, origin = child_frame(joint, tuple(parent), own)
            np.testing.assert_allclose(rotation, child[0], atol=1e-13)
            np.testing.assert_allclose(origin, child[1], atol=1e-11)


def test_at_zero_every_frame_is_parallel_to_the_base(every):
    straight = [joint for joint in every.joints.values() if np.allclose(joint.turn, np.eye(3))]
    assert len(straight) == len(every.joints) - 1
    for joint in straight:
        zero = np.zeros(joint.type.freedoms)
        rotation, _ = child_frame(joint, (np.eye(3), np.zeros(3)), zero)
        np.testing.assert_allclose(rotation, np.eye(3), atol=1e-15)


def test_child_axis_is_laid_on_the_axis(every):
    joint = every.joints["J2"]
    rotation, origin = child_frame(joint, (np.eye(3), np.zeros(3)), np.array([7.0]))
    np.testing.assert_allclose(rotation @ [0.0, 0.0, 1.0], [0.0, -1.0, 0.0], atol=1e-15)
    np.testing.assert_allclose(origin, [0.0, 20.0 - 7.0, 0.0], atol=1e-12)


def test_a_screw_advances_by_its_pitch_per_turn(every):
    joint = every.joints["J3"]
    _, origin = child_frame(joint, (np.eye(3), np.zeros(3)), np.array([2 * np.pi]))
    np.testing.assert_allclose(origin, [0.0, 0.0, 20.0 + 5.0], atol=1e-12)


def test_screws_are_the_derivatives_of_the_frames(every):
    """Every component of every joint, cut ones too, moves its child against its parent as its screw says."""
    values = np.random.default_rng(3).normal(size=len(every.coordinates))
    graph, placed = joint_graph(every), frames(every, values)
    twists = screws(every, values)
    step, seen = 1e-6, set()
    for joint in every.joints.values():
        columns, parent = graph.slices[joint.name], placed[joint.parent]
        own = values[columns]
        for component in range(len(own)):
            change = step * np.eye(len(own))[component]
            ahead, behind = child_frame(joint, parent, own + change), child_frame(joint, parent, own - change)
            turn = rotations.to_vector(ahead[0] @ behind[0].T) / (2 * step)
            middle = child_frame(joint, parent, own)[1]
            omega, velocity = twists[:3, columns.start + component], twists[3:, columns.start + component]
            np.testing.assert_allclose(turn, omega, atol=1e-8, err_msg=joint.name)
            moved = (ahead[1] - behind[1]) / (2 * step)
            np.testing.assert_allclose(moved, velocity + np.cross(omega, middle), atol=1e-6, err_msg=joint.name)
        seen.add(joint.type.name)
    assert seen == set(JOINT_TYPES)


def test_points_are_where_the_frames_say():
    mechanism = assur.load("zeng2019")
    home = mechanism.home_values
    rotation, origin = mechanism.frames(home)["platform"]
    np.testing.assert_allclose(point(mechanism, "O'", home), origin)
    np.testing.assert_allclose(point(mechanism, "F3", home), rotation @ [50.0, 0.0, 0.0] + origin)
    assert np.linalg.norm(point(mechanism, "D3", home) - point(mechanism, "E3", home)) == pytest.approx(230.0)


def test_an_unknown_point_is_refused_with_the_known_ones():
    mechanism = assur.load("zeng2019")
    with pytest.raises(assur.UnknownNameError, match="unknown point of zeng2019 'Q9'"):
        point(mechanism, "Q9", mechanism.home_values)
