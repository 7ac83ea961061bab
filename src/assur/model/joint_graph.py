"""The joint graph: links are nodes, joints are edges; a spanning tree and the joints that close its loops."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.model.mechanism import Joint, MechanismRecord
from assur.numerics import components
from assur.topology.joints import CYLINDRICAL, HELICAL, PRISMATIC, REVOLUTE, SPHERICAL, UNIVERSAL

FloatArray = NDArray[np.float64]
Frame = tuple[FloatArray, FloatArray]
"""A frame in the base frame: orientation (..., 3, 3) and origin (..., 3)."""


@dataclass(frozen=True)
class JointGraph:
    """A spanning tree of the joint graph and its independent loops.

    Attributes:
        tree: (joint, forward) in an order in which each joint's near link is already placed;
            forward means from parent to child.
        cut: the joints that close a loop each, v = m - n + 1 of them.
        loops: per cut joint, the tree joints of its loop with +1 where the loop runs from parent to
            child on the parent's side of the cut, -1 where it runs so on the child's side.
        slices: joint -> its place in the vector of joint values.
        paths: link -> the tree joints from the base to it, +1 where run from parent to child.
    """

    tree: tuple[tuple[Joint, bool], ...]
    cut: tuple[Joint, ...]
    loops: tuple[Mapping[str, int], ...]
    slices: Mapping[str, slice]
    paths: Mapping[str, Mapping[str, int]]


@lru_cache(maxsize=64)
def joint_graph(record: MechanismRecord) -> JointGraph:
    """Breadth-first spanning tree from the base, joints in the file's order."""
    placed, tree, used = [record.base], [], set()
    for link in placed:
        for name, joint in record.joints.items():
            if link not in (joint.parent, joint.child) or name in used:
                continue
            other = joint.child if joint.parent == link else joint.parent
            if other not in placed:
                placed.append(other)
                used.add(name)
                tree.append((joint, joint.parent == link))
    cut = tuple(joint for name, joint in record.joints.items() if name not in used)
    paths = _paths(record.base, tree)
    loops = tuple(_difference(paths[joint.parent], paths[joint.child]) for joint in cut)
    slices, start = {}, 0
    for name, joint in record.joints.items():
        slices[name] = slice(start, start + joint.type.freedoms)
        start += joint.type.freedoms
    return JointGraph(tuple(tree), cut, loops, slices, paths)


def _paths(base: str, tree: list[tuple[Joint, bool]]) -> dict[str, dict[str, int]]:
    """Tree joints from the base to each link, +1 where run from parent to child."""
    paths: dict[str, dict[str, int]] = {base: {}}
    for joint, forward in tree:
        near, far = (joint.parent, joint.child) if forward else (joint.child, joint.parent)
        paths[far] = {**paths[near], joint.name: 1 if forward else -1}
    return paths


def _difference(first: Mapping[str, int], second: Mapping[str, int]) -> dict[str, int]:
    names = [name for name in (*first, *second) if not (name in first and name in second)]
    return {name: first.get(name, 0) - second.get(name, 0) for name in names}


def motion(joint: Joint, values: FloatArray) -> tuple[FloatArray | None, FloatArray | None]:
    """Rotation (..., 3, 3) and shift (..., 3) of the child's joint frame in the parent's, for values (..., k).

    None stands for no rotation and for no shift.
    """
    if joint.type is SPHERICAL:
        return components.from_vector(values), None
    axis = joint.axes[0]
    first = values[..., 0]
    if joint.type is PRISMATIC:
        return None, first[..., None] * axis
    if joint.type is REVOLUTE:
        return components.about_axis(axis, first), None
    if joint.type is HELICAL:
        return components.about_axis(axis, first), (first * joint.pitch / (2 * np.pi))[..., None] * axis
    if joint.type is CYLINDRICAL:
        return components.about_axis(axis, values[..., 1]), first[..., None] * axis
    if joint.type is UNIVERSAL:
        second = components.about_axis(joint.axes[1], values[..., 1])
        return components.product(components.about_axis(axis, first), second), None
    raise AssertionError(f"no motion for joint type {joint.type.name}")


def child_frame(joint: Joint, parent: Frame, values: FloatArray) -> Frame:
    """Frame of the child link, given the parent's and the joint's values (..., k)."""
    turn, shift = motion(joint, values)
    orientation = parent[0] if turn is None else components.product(parent[0], turn)
    if joint.turned:
        orientation = components.product(orientation, joint.turn)
    origin = parent[1] + _apply(parent[0], joint.at if shift is None else joint.at + shift)
    return orientation, origin - _apply(orientation, joint.child_at)


def parent_frame(joint: Joint, child: Frame, values: FloatArray) -> Frame:
    """Frame of the parent link, given the child's and the joint's values (..., k)."""
    turn, shift = motion(joint, values)
    orientation = components.product(child[0], joint.turn.T) if joint.turned else child[0]
    if turn is not None:
        orientation = components.product_turned_back(orientation, turn)
    origin = child[1] + _apply(child[0], joint.child_at)
    return orientation, origin - _apply(orientation, joint.at if shift is None else joint.at + shift)


def _apply(rotation: FloatArray, vector: FloatArray) -> FloatArray:
    """Rotated vectors (..., 3) of one vector (3,), or of one for each rotation; (3,) of zeros stay that."""
    if vector.ndim == 1 and not vector.any():
        return vector
    return components.applied(rotation, vector)


def frames(record: MechanismRecord, values: FloatArray) -> dict[str, Frame]:
    """Frame of every link in the base frame, along the spanning tree, for joint values (..., n).

    Loops need not close: the joints that close them are not asked.
    """
    graph = joint_graph(record)
    if np.ndim(values) == 0 or values.shape[-1] != len(record.coordinates):
        raise UsageError(f"joint values of shape {np.shape(values)}; {len(record.coordinates)} of them are wanted")
    values = components.by_components(values)
    unturned = components.zeros(values.shape[:-1], 3, 3)
    unturned[..., range(3), range(3)] = 1.0
    placed: dict[str, Frame] = {record.base: (unturned, components.zeros(values.shape[:-1], 3))}
    for joint, forward in graph.tree:
        near, far = (joint.parent, joint.child) if forward else (joint.child, joint.parent)
        move = child_frame if forward else parent_frame
        placed[far] = move(joint, placed[near], values[..., graph.slices[joint.name]])
    return placed


def screws(record: MechanismRecord, placed: Mapping[str, Frame], values: FloatArray) -> FloatArray:
    """Unit twists (..., 6, n) of the joint coordinates in the base frame, moving the child against the parent.

    Rows: angular velocity, then the velocity of the body point at the base's origin.
    """
    graph = joint_graph(record)
    values = components.by_components(values)
    twists = components.zeros(values.shape[:-1], 6, values.shape[-1])
    for name, joint in record.joints.items():
        rotation, origin = placed[joint.parent]
        point = origin + _apply(rotation, joint.at)
        columns, pitches = _local_axes(joint, values[..., graph.slices[name]])
        axes = twists[..., :3, graph.slices[name]]
        axes[...] = components.product(rotation, columns)
        moments = twists[..., 3:, graph.slices[name]]
        for k, pitch in enumerate(pitches):
            if pitch == np.inf:  # a pure translation
                moments[..., k], axes[..., k] = axes[..., k], 0.0
            else:
                moments[..., k] = pitch * axes[..., k]
        moments -= components.crossed(axes, point)
    return twists


def _local_axes(joint: Joint, values: FloatArray) -> tuple[FloatArray, tuple[float, ...]]:
    """Axes (..., 3, k) of a joint's components in the parent's frame, and pitches in length per rad (inf: shift)."""
    if joint.type is SPHERICAL:
        return components.left_jacobian(values), (0.0, 0.0, 0.0)
    first = joint.axes[0]
    if joint.type is UNIVERSAL:
        second = components.about_axis(first, values[..., 0]) @ joint.axes[1]
        return np.stack([np.broadcast_to(first, second.shape), second], axis=-1), (0.0, 0.0)
    if joint.type is CYLINDRICAL:
        return np.stack([first, first], axis=-1), (np.inf, 0.0)
    pitch = {PRISMATIC: np.inf, HELICAL: joint.pitch / (2 * np.pi)}.get(joint.type, 0.0)
    return first[:, None], (pitch,)
