"""Acceleration on the joint graph, exact: A u' = 0 and A u'' + A' u' = 0, with A the closure Jacobian.

The derivative of A along the motion is that of its screws (`screw_rates`), so there is no step size and no closed form.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.joint_graph.frames import frames
from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.tree import joint_graph
from assur.kinematics import border
from assur.kinematics.border import checked_joints
from assur.kinematics.closure import CLOSED, closure_error
from assur.kinematics.pose import LEAST_COSINE, platform_frame, platform_twists, pose_rates
from assur.kinematics.rates.motions import (
    SINGULAR,
    InstantaneousMotion,
    general,
    input_units,
    motions,
    twist_units,
)
from assur.kinematics.rates.screw_rates import screw_rates
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, LENGTHS, rate_names
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Acceleration:
    """Second-order motion at joint values (..., n), at given rates and accelerations of the inputs.

    Attributes:
        velocity, acceleration: (..., k) of the pose as `rate_names` names its rates; for a quaternion the angular
            velocity and the angular acceleration in the base frame.
        joint_rates, joint_accelerations: (..., n); internal freedoms move as little as they can.
        known: whether the inputs determine them (...); elsewhere every number is NaN.
    """

    velocity: FloatArray
    acceleration: FloatArray
    joint_rates: FloatArray
    joint_accelerations: FloatArray
    known: BoolArray


def acceleration_at(
    record: MechanismRecord, joints: ArrayLike, input_rates: ArrayLike, input_accelerations: ArrayLike
) -> Acceleration:
    """Velocity and acceleration of the pose at joint values (..., n), for printed inputs' rates (..., F).

    Example: the five-bar's cranks turning at 1 rad/s, opposite ways, lift P; by symmetry x stays.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> found = acceleration_at(record, home_values(record), [-1.0, 1.0], [0.0, 0.0])
    >>> abs(found.velocity[0]) < 0.5, abs(found.acceleration[0]) < 0.5
    (np.True_, np.True_)
    """
    values = checked_joints(record, joints)
    names = border.input_names(record)
    rates = border.checked(input_rates, names, f"input rates of {record.name}") / input_units(record)
    second = border.checked(input_accelerations, names, f"input accelerations of {record.name}") / input_units(record)
    motion = motions(record, values)
    usual = general(record)
    driven = np.linalg.pinv(motion.inputs, rcond=SINGULAR)  # (..., n, F) in combinations of motions
    joint_rates = (motion.null @ driven @ rates[..., None])[..., 0] * motion.scale
    bias, platform_bias = _bias(record, values, joint_rates)
    particular = _least(motion, bias)
    missing = second - particular[..., record.input_indices] * [item.sign for item in record.inputs]
    joint_second = (particular + (motion.null @ driven @ missing[..., None])[..., 0]) * motion.scale
    velocity = (pose_rates(record, values) @ joint_rates[..., None])[..., 0]
    acceleration = _pose_acceleration(record, values, joint_rates, joint_second, platform_bias)
    known = closure_error(record, values) <= CLOSED * characteristic_length(record)
    known = known & (motion.ranks.closure == usual.closure) & (motion.ranks.inputs == len(record.inputs))
    known = known & (motion.ranks.moving == motion.ranks.inputs)

    def labelled(numbers: FloatArray) -> FloatArray:
        return np.where(known[..., None], numbers, np.nan)

    return Acceleration(
        labelled(velocity), labelled(acceleration), labelled(joint_rates), labelled(joint_second), np.asarray(known)
    )


def _bias(record: MechanismRecord, values: FloatArray, rates: FloatArray) -> tuple[FloatArray, FloatArray]:
    """A' u' of the loops (..., 6 v), scaled as the closure, and of the platform (..., 6) at the base's origin."""
    graph = joint_graph(record)
    moved = screw_rates(record, values, rates) * rates[..., None, :]  # per joint coordinate
    rotation, origin = frames(record, values)[record.platform.link]
    point = (rotation @ record.platform.point) + origin
    loops = np.zeros((*values.shape[:-1], len(graph.cut), 6))
    for index, (joint, loop) in enumerate(zip(graph.cut, graph.loops, strict=True)):
        for name, sense in ((joint.name, 1), *loop.items()):
            loops[..., index, :] += sense * np.sum(moved[..., graph.slices[name]], axis=-1)
    loops[..., 3:] += np.cross(loops[..., :3], point[..., None, :])
    loops /= twist_units(record)
    platform = np.zeros((*values.shape[:-1], 6))
    for name, sense in graph.paths[record.platform.link].items():
        platform += sense * np.sum(moved[..., graph.slices[name]], axis=-1)
    platform[..., 3:] += np.cross(platform[..., :3], point)
    return loops.reshape(*values.shape[:-1], 6 * len(graph.cut)), platform


def _least(motion: InstantaneousMotion, bias: FloatArray) -> FloatArray:
    """The smallest scaled joint accelerations (..., n) that undo a bias (..., 6 v) of the loops."""
    count = motion.values.shape[-1]
    kept = np.arange(count) < motion.ranks.closure[..., None]
    inverse = np.where(kept, 1.0 / np.where(kept, motion.values, 1.0), 0.0)
    share = (np.swapaxes(motion.left[..., :count], -1, -2) @ bias[..., None])[..., 0] * inverse
    return np.asarray(-(np.swapaxes(motion.right[..., :count, :], -1, -2) @ share[..., None])[..., 0])


def _pose_acceleration(
    record: MechanismRecord, values: FloatArray, rates: FloatArray, second: FloatArray, bias: FloatArray
) -> FloatArray:
    """Acceleration (..., k) of the pose for joint rates and accelerations (..., n) and the platform's bias (..., 6)."""
    moves = platform_twists(record, values)
    twist = (moves @ rates[..., None])[..., 0]
    change = (moves @ second[..., None])[..., 0] + bias
    turn, speed = twist[..., :3], twist[..., 3:]
    angular, linear = change[..., :3], change[..., 3:] + np.cross(turn, speed)
    named = dict(zip(("wx", "wy", "wz"), np.moveaxis(angular, -1, 0), strict=True))
    named |= zip(LENGTHS, np.moveaxis(linear, -1, 0), strict=True)
    if any(name in ANGLES for name in record.platform.pose):
        rotation, _ = platform_frame(record, values)
        named |= zip(ANGLES, _angle_accelerations(rotation, turn, angular), strict=True)
    return np.stack([named[name] for name in rate_names(record.platform.pose)], axis=-1)


def _angle_accelerations(rotation: FloatArray, turn: FloatArray, angular: FloatArray) -> tuple[FloatArray, ...]:
    """Second derivatives (...) of phi, theta, psi for angular velocity and acceleration (..., 3) in the base frame.

    With along and across the parts of w in the direction of phi and a quarter turn ahead: theta' = across,
    psi' cos(theta) = along, phi' = wz + psi' sin(theta).
    """
    phi, theta, _ = rotations.to_angles(rotation)
    cosine, sine = np.maximum(np.cos(theta), LEAST_COSINE), np.sin(theta)
    along, across = _turned(phi, turn)
    along_rate, across_rate = _turned(phi, angular)
    psi_rate = along / cosine
    phi_rate = turn[..., 2] + sine * psi_rate
    psi_second = (along_rate + across * phi_rate + psi_rate * sine * across) / cosine
    phi_second = angular[..., 2] + cosine * across * psi_rate + sine * psi_second
    return phi_second, across_rate - along * phi_rate, psi_second


def _turned(phi: FloatArray, vector: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Parts (...) of vectors (..., 3) along the direction phi in the XY plane, and a quarter turn ahead of it."""
    x, y = vector[..., 0], vector[..., 1]
    return np.cos(phi) * x + np.sin(phi) * y, np.cos(phi) * y - np.sin(phi) * x
