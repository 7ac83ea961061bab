"""The platform's pose on the joint graph: its coordinates, their rates, and how far it is from a wanted one."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.configuration import Configuration
from assur.joint_graph.frames import Frame, flat
from assur.joint_graph.programs import Outputs, program
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, LENGTHS, QUATERNION, Pose, has_quaternion, rate_names
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
LEAST_COSINE = 1e-12
"""Where theta is a right angle, phi and psi turn about one axis; this keeps their rates finite."""

UPRIGHT = 1e-9
"""Cosine of theta below which phi is rounding: loops close to so much."""


def platform_frame(record: MechanismRecord, values: FloatArray) -> Frame:
    """Orientation (..., 3, 3) of the platform and its point (..., 3), along the spanning tree."""
    return frame_of(program(record, platform_numbers)(record, flat(record, values)), np.shape(values)[:-1])


def frame_of(numbers: FloatArray, batch: tuple[int, ...]) -> Frame:
    """The same from the numbers (12, N) of `platform_numbers`."""
    rotation = np.moveaxis(numbers[:9].reshape(3, 3, *batch), (0, 1), (-2, -1))
    return rotation, np.moveaxis(numbers[9:].reshape(3, *batch), 0, -1)


def platform_numbers(configuration: Configuration) -> Outputs:
    """The twelve numbers of the platform's frame: its orientation row by row, and its point."""
    (a, b, c), point = configuration.platform
    return {f"platform {k}": number for k, number in enumerate((*a, *b, *c, *point))}


def platform_moves(configuration: Configuration) -> Outputs:
    """Twists of the platform at its point, those entries that are not zero: "move row,column"."""
    _, point = configuration.platform
    graph = configuration.graph
    return {
        f"move {row},{column}": number
        for name, sense in graph.paths[graph.platform].items()
        for row, column, number in configuration.entries(graph.joint(name), sense, point)
    }


def platform_twists(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """Angular velocity and velocity of the platform's point (..., 6, n) per rate of each joint, along the tree."""
    moves = program(record, platform_moves)
    matrix = moves.matrix("move", moves(record, flat(record, values)), (6, len(record.coordinates)))
    return matrix.reshape(*np.shape(values)[:-1], 6, len(record.coordinates))


def pose_of(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """Pose (..., m) of the platform along the spanning tree, at joint values (..., n), in lengths and rad.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> pose_of(record, home_values(record)).round(0) + 0.0
    array([  0., 224.])
    """
    rotation, point = platform_frame(record, values)
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
    return twist_rates(record.platform.pose, platform_frame(record, values)[0], platform_twists(record, values))


def pose_error(record: MechanismRecord, values: FloatArray, poses: FloatArray, length: float) -> FloatArray:
    """How far (N, k) the platform is from poses (N, m) at joint values (N, n): lengths, and rotations times `length`.

    Its derivative by the joint values is that of `error_rates`, angular rows times `length`, exact where it is zero. A
    pose that tells the whole orientation is compared by the rotation between the two, since three angles lose one
    direction where theta is a right angle.
    """
    return error_of(record.platform.pose, platform_frame(record, values), poses, length)


def error_of(names: Pose, frame: Frame, poses: FloatArray, length: float) -> FloatArray:
    """The same for a platform's frame."""
    rotation, point = frame
    given = {name: poses[..., k] for k, name in enumerate(names)}
    rows = [point[..., LENGTHS.index(name)] - given[name] for name in names if name in LENGTHS]
    if whole_orientation(names):
        turn = rotations.to_vector(rotation @ np.swapaxes(orientation(names, given), -1, -2))
        rows += [length * turn[..., k] for k in range(3)]
    elif any(name in ANGLES for name in names):
        angles = dict(zip(ANGLES, rotations.to_angles(rotation), strict=True))
        rows += [length * rotations.nearest_turn(angles[name] - given[name]) for name in names if name in ANGLES]
    return np.stack(rows, axis=-1)


def error_rates(names: Pose, rotation: FloatArray, moves: FloatArray) -> FloatArray:
    """Rates (..., k, n) of the rows of `pose_error`, lengths first, then rad: per rate of each joint.

    `moves` (..., 6, n) are the platform's twists, `rotation` (..., 3, 3) is its orientation.
    """
    if whole_orientation(names):
        lengths = [3 + LENGTHS.index(name) for name in names if name in LENGTHS]
        return np.asarray(moves[..., [*lengths, 0, 1, 2], :])
    return np.asarray(twist_rates(names, rotation, moves)[..., error_order(names), :])


def error_order(names: Pose) -> list[int]:
    """Of the rows of `pose_error`, lengths first, the places among the rates of a pose (`turning_rates`).

    >>> error_order(("phi", "x", "y"))
    [1, 2, 0]
    """
    rates = rate_names(names)
    turning = [name for name in rates if name not in LENGTHS]
    if all(name in names for name in ANGLES):
        turning = list(ANGLES)
    return [rates.index(name) for name in (*(name for name in rates if name in LENGTHS), *turning)]


def whole_orientation(names: tuple[str, ...]) -> bool:
    """Whether a pose tells the platform's whole orientation."""
    return has_quaternion(names) or all(name in names for name in ANGLES)


def orientation(names: tuple[str, ...], given: dict[str, FloatArray]) -> FloatArray:
    """Rotation (..., 3, 3) that the coordinates of a pose mean."""
    if has_quaternion(names):
        return rotations.from_quaternion(np.stack([given[name] for name in QUATERNION], axis=-1))
    return rotations.from_angles(*(given[name] for name in ANGLES))


def twist_rates(names: Pose, rotation: FloatArray, moves: FloatArray) -> FloatArray:
    """Rates (..., k, r) of the pose for twists (..., 6, r) of the platform at its point, as turned by (..., 3, 3)."""
    named = dict(zip(("wx", "wy", "wz", *LENGTHS), np.moveaxis(moves, -2, 0), strict=True))
    if any(name in ANGLES for name in names):
        named |= zip(ANGLES, _angle_rates(rotation, moves[..., :3, :]), strict=True)
    return np.stack([named[name] for name in rate_names(names)], axis=-2)


def turning_rates(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """As `pose_rates`, wx, wy and wz in the places of phi, theta and psi where a pose has all three.

    Those rates exist at every orientation, also where theta is a right angle.
    """
    names = rate_names(record.platform.pose)
    if not all(name in names for name in ANGLES):
        return pose_rates(record, values)
    rows = [3 + LENGTHS.index(name) if name in LENGTHS else ANGLES.index(name) for name in names]
    return np.asarray(platform_twists(record, values)[..., rows, :])


def turning_matrix(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """What rates of the pose (k,) are to those of `turning_rates`: E (..., k, k) at joint values (..., n).

    The angular velocity is phi' z + theta' (Rz y) + psi' (Rz Ry x); E is the unit matrix for other poses. Its
    determinant is the cosine of theta but for its sign.
    """
    rotation, _ = platform_frame(record, values)
    phi, theta, _ = rotations.to_angles(rotation)
    return turning_of(record.platform.pose, phi, theta)


def turning_of(pose: tuple[str, ...], phi: FloatArray, theta: FloatArray) -> FloatArray:
    """As `turning_matrix`, E (..., k, k) of the coordinates of a pose at angles (...), in rad.

    >>> turning_of(("phi", "theta", "psi"), np.array(0.0), np.array(np.pi / 2)).round(9) + 0.0
    array([[ 0.,  0.,  0.],
           [ 0.,  1.,  0.],
           [ 1.,  0., -1.]])
    """
    names = rate_names(pose)
    matrix = np.broadcast_to(np.eye(len(names)), (*np.shape(phi), len(names), len(names))).copy()
    if not all(name in names for name in ANGLES):
        return matrix
    zero, unit = np.zeros_like(phi), np.ones_like(phi)
    columns = {
        "phi": (zero, zero, unit),
        "theta": (-np.sin(phi), np.cos(phi), zero),
        "psi": (np.cos(phi) * np.cos(theta), np.sin(phi) * np.cos(theta), -np.sin(theta)),
    }
    for name, column in columns.items():
        for row, value in zip(ANGLES, column, strict=True):
            matrix[..., names.index(row), names.index(name)] = value
    return matrix


def turned_alike(pose: tuple[str, ...], start: FloatArray, end: FloatArray) -> FloatArray:
    """The pose `start` (m,) with phi that of `end`, where theta is a right angle and only psi -+ phi counts.

    The orientation stays what it is. Elsewhere, and where a pose does not tell all three angles, nothing changes.
    """
    if not all(name in pose for name in ANGLES):
        return start
    phi, theta, psi = (pose.index(name) for name in ANGLES)
    if abs(np.cos(start[theta])) > UPRIGHT:
        return start
    turned = start.copy()
    turned[phi] = end[phi]
    turned[psi] += np.sign(start[theta]) * (end[phi] - start[phi])
    return turned


def _angle_rates(rotation: FloatArray, angular: FloatArray) -> tuple[FloatArray, ...]:
    """Rates (..., n) of phi, theta, psi for angular velocities (..., 3, n) in the base frame."""
    phi, theta, _ = (angle[..., None] for angle in rotations.to_angles(rotation))
    along = np.cos(phi) * angular[..., 0, :] + np.sin(phi) * angular[..., 1, :]
    across = np.cos(phi) * angular[..., 1, :] - np.sin(phi) * angular[..., 0, :]
    psi_rate = along / np.maximum(np.cos(theta), LEAST_COSINE)
    return angular[..., 2, :] + np.sin(theta) * psi_rate, across, psi_rate
