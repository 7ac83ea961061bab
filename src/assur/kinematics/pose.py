"""The platform's pose on the joint graph: its coordinates, their rates, and how far it is from a wanted one."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.model.joint_graph import Frame, frames, joint_graph, screws
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, LENGTHS, QUATERNION, has_quaternion, rate_names
from assur.numerics import components, rotations

FloatArray = NDArray[np.float64]
LEAST_COSINE = 1e-12
"""Where theta is a right angle, phi and psi turn about one axis; this keeps their rates finite."""


def pose_of(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """Pose (..., m) of the platform along the spanning tree, at joint values (..., n), in lengths and rad.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> pose_of(record, home_values(record)).round(0) + 0.0
    array([  0., 224.])
    """
    rotation, point = _platform(record, frames(record, values))
    named = dict(zip(LENGTHS, np.moveaxis(point, -1, 0), strict=True))
    if has_quaternion(record.platform.pose):
        named |= zip(QUATERNION, np.moveaxis(rotations.to_quaternion(rotation), -1, 0), strict=True)
    else:
        named |= zip(ANGLES, rotations.to_angles(rotation), strict=True)
    return np.stack([named[name] for name in record.platform.pose], axis=-1)


def pose_rates(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """Rates (..., k, n) of the pose per rate of each joint, along the spanning tree, in the order of `rate_names`.

    For a quaternion the last three rows are the angular velocity in the base frame.
    """
    placed = frames(record, values)
    return platform_rates(record, placed, screws(record, placed, values))


def platform_twists(record: MechanismRecord, placed: dict[str, Frame], twists: FloatArray) -> FloatArray:
    """Angular velocity and velocity of the platform's point (..., 6, n) per rate of each joint, along the tree.

    `twists` (..., 6, n) are those of `assur.model.joint_graph.screws`.
    """
    graph = joint_graph(record)
    _, point = _platform(record, placed)
    moves = components.zeros(twists.shape[:-2], *twists.shape[-2:])
    for name, sense in graph.paths[record.platform.link].items():
        own, columns = moves[..., graph.slices[name]], twists[..., graph.slices[name]]
        own[...] = sense * columns
        own[..., 3:, :] += components.crossed(own[..., :3, :], point)
    return moves


def pose_error(record: MechanismRecord, placed: dict[str, Frame], poses: FloatArray, length: float) -> FloatArray:
    """How far (N, k) the platform is from poses (N, m): lengths, and rotations times `length`.

    Its derivative by the joint values is `pose_rates`, angular rows times `length`, exact where it is zero.
    """
    rotation, point = _platform(record, placed)
    given = {name: poses[..., k] for k, name in enumerate(record.platform.pose)}
    turned = any(name in ANGLES for name in record.platform.pose)
    angles = dict(zip(ANGLES, rotations.to_angles(rotation), strict=True)) if turned else {}
    rows = []
    for name in rate_names(record.platform.pose):
        if name in LENGTHS:
            rows.append(point[..., LENGTHS.index(name)] - given[name])
        elif name in ANGLES:
            rows.append(length * _nearest_turn(angles[name] - given[name]))
    if has_quaternion(record.platform.pose):
        wanted = rotations.from_quaternion(np.stack([given[name] for name in QUATERNION], axis=-1))
        turn = rotations.to_vector(rotation @ np.swapaxes(wanted, -1, -2))
        rows += [length * turn[..., k] for k in range(3)]
    return np.stack(rows, axis=-1)


def platform_rates(record: MechanismRecord, placed: dict[str, Frame], twists: FloatArray) -> FloatArray:
    """As `pose_rates`, of frames and twists that are known already."""
    moves = platform_twists(record, placed, twists)
    named = dict(zip(("wx", "wy", "wz", *LENGTHS), np.moveaxis(moves, -2, 0), strict=True))
    if any(name in ANGLES for name in record.platform.pose):
        rotation, _ = _platform(record, placed)
        named |= zip(ANGLES, _angle_rates(rotation, moves[..., :3, :]), strict=True)
    return np.stack([named[name] for name in rate_names(record.platform.pose)], axis=-2)


def _angle_rates(rotation: FloatArray, angular: FloatArray) -> tuple[FloatArray, ...]:
    """Rates (..., n) of phi, theta, psi for angular velocities (..., 3, n) in the base frame."""
    phi, theta, _ = (angle[..., None] for angle in rotations.to_angles(rotation))
    along = np.cos(phi) * angular[..., 0, :] + np.sin(phi) * angular[..., 1, :]
    across = np.cos(phi) * angular[..., 1, :] - np.sin(phi) * angular[..., 0, :]
    psi_rate = along / np.maximum(np.cos(theta), LEAST_COSINE)
    return angular[..., 2, :] + np.sin(theta) * psi_rate, across, psi_rate


def _platform(record: MechanismRecord, placed: dict[str, Frame]) -> Frame:
    """Orientation (..., 3, 3) of the platform and its point (..., 3)."""
    rotation, origin = placed[record.platform.link]
    return rotation, (rotation @ record.platform.point) + origin


def _nearest_turn(angle: FloatArray) -> FloatArray:
    return np.asarray((angle + np.pi) % (2 * np.pi) - np.pi)
