"""Acceleration on the joint graph, exact: A u' = 0 and A u'' + A' u' = 0, with A the derivative of the loops.

A' u' is what the twists around the loops change by along the motion: the program of these twists, read over dual
numbers. So there is no step size and no closed form.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.joint_graph.configuration import Configuration
from assur.joint_graph.frames import flat
from assur.joint_graph.programs import Outputs, program
from assur.joint_graph.tree import joint_graph
from assur.kinematics import border
from assur.kinematics.closure import closure_jacobian
from assur.kinematics.following.from_home import followed_by_ways
from assur.kinematics.home import home_values
from assur.kinematics.pose import LEAST_COSINE, platform_frame, platform_twists, pose_rates
from assur.kinematics.position import inverse
from assur.kinematics.rates.instantaneous import instantaneous
from assur.kinematics.rates.motions import SINGULAR, general_share, input_units, twist_units
from assur.kinematics.status import Status
from assur.kinematics.turns import joint_units
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, LENGTHS, rate_names
from assur.numerics import rotations
from assur.numerics.vectors import plus, times

FloatArray = NDArray[np.float64]
FEW = 8
"""So many poses that no way led to are looked at one by one: a proof that none does takes a second."""


def acceleration(
    record: MechanismRecord,
    poses: ArrayLike,
    input_rates: ArrayLike,
    input_accelerations: ArrayLike,
    mode: str | None = None,
) -> tuple[FloatArray, FloatArray]:
    """Velocity and acceleration (..., k) of the pose, as `acceleration_at`, at poses (..., m) in a working mode.

    Without a mode it is the file's default; without a closed form home's, followed from home to each pose. Of several
    solutions of a mode it is the first. NaN where the mode does not reach the pose too.

    Example: the five-bar's platform at rest, while its cranks begin to turn.

    >>> from assur.model.registry import load_record
    >>> velocity, _ = acceleration(load_record("fivebar"), [0.0, 224.0], [0.0, 0.0], [1.0, -1.0])
    >>> velocity.tolist()
    [0.0, 0.0]
    """
    given = border.checked_poses(record, poses)
    flat = given.reshape(-1, given.shape[-1])
    joints = joints_in_mode(record, flat, mode)
    known = np.all(np.isfinite(joints), axis=-1)
    shape, names = (len(flat), len(record.inputs)), border.input_names(record)
    first = border.checked(input_rates, names, f"input rates of {record.name}")
    second = border.checked(input_accelerations, names, f"input accelerations of {record.name}")
    batch = np.broadcast_shapes(first.shape, second.shape, (*given.shape[:-1], len(names)))
    rates = (np.broadcast_to(part, batch).reshape(shape)[known] for part in (first, second))
    answers = np.full((2, len(flat), len(rate_names(record.platform.pose))), np.nan)
    answers[:, known] = acceleration_at(record, joints[known], *rates)
    velocity, changes = answers.reshape(2, *given.shape[:-1], -1)
    return velocity, changes


def joints_in_mode(record: MechanismRecord, poses: FloatArray, mode: str | None = None) -> FloatArray:
    """Joint values (N, n) at poses (N, m) in a working mode; NaN where it does not reach.

    Without a mode it is the file's default; without a closed form home's, followed from home to all poses at once. Of
    several solutions of a mode it is the first.

    >>> from assur.model.registry import load_record
    >>> joints_in_mode(load_record("fivebar"), np.array([[0.0, 224.0], [0.0, 999.0]])).shape
    (2, 5)
    """
    asked = mode or record.modes.default_working
    if record.closed_form is None and asked == record.modes.default_working:
        return followed_by_ways(record, poses)
    return inverse(record, poses, asked).first_joints


def reached_in_mode(
    record: MechanismRecord, poses: FloatArray, mode: str | None = None
) -> tuple[FloatArray, NDArray[np.int8]]:
    """The same, with home's joint values (N, n) where the mode does not reach, and the status (N,) of that.

    It is `regular` where it reaches, else `unreachable`; without a closed form `undecided` where no way led there, or
    `unreachable` where that is proved, which is tried where there are `FEW` such poses at most.

    >>> from assur.model.registry import load_record
    >>> reached_in_mode(load_record("fivebar"), np.array([[0.0, 224.0], [0.0, 999.0]]))[1].tolist()
    [0, 8]
    """
    joints = joints_in_mode(record, poses, mode)
    lost = ~np.all(np.isfinite(joints), axis=-1)
    why = Status.unreachable if record.closed_form else Status.undecided
    status = np.where(lost, int(why), int(Status.regular)).astype(np.int8)
    if record.closed_form is None and np.sum(lost) <= FEW and mode in (None, record.modes.default_working):
        from assur.kinematics.following.home_mode import home_mode_at  # the searches, which most poses do without

        for place in np.flatnonzero(lost):
            status[place] = int(home_mode_at(record, poses[place]).status)
    return np.where(lost[:, None], home_values(record), joints), status


def acceleration_at(
    record: MechanismRecord, joints: ArrayLike, input_rates: ArrayLike, input_accelerations: ArrayLike
) -> tuple[FloatArray, FloatArray]:
    """Velocity and acceleration (..., k) of the pose at joint values (..., n), for rates (..., F) of printed inputs.

    They are named as `rate_names` names them; of a quaternion they are the angular velocity and acceleration in the
    base frame. NaN where the inputs do not determine them, or the loops are open.

    Example: the five-bar's cranks turning at 1 rad/s, opposite ways, lift P; by symmetry x stays.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> velocity, acceleration = acceleration_at(record, home_values(record), [-1.0, 1.0], [0.0, 0.0])
    >>> abs(velocity[0]) < 0.5, abs(acceleration[0]) < 0.5
    (np.True_, np.True_)
    """
    values = border.checked_joints(record, joints)
    names = border.input_names(record)
    rates = border.checked(input_rates, names, f"input rates of {record.name}") / input_units(record)
    second = border.checked(input_accelerations, names, f"input accelerations of {record.name}") / input_units(record)
    inverse = _driven(record, values)  # (..., n, 6 v + F)
    moving = (inverse[..., -len(names) :] @ rates[..., None])[..., 0]
    loops, platform = _biases(record, values, moving)
    goal = np.concatenate([-loops, np.broadcast_to(second, (*loops.shape[:-1], len(names)))], axis=-1)
    speeding = (inverse @ goal[..., None])[..., 0]
    velocity = (pose_rates(record, values) @ moving[..., None])[..., 0]
    acceleration = _pose_acceleration(record, values, moving, speeding, platform)
    instant = instantaneous(record, values)
    unknown = ~instant.closed | instant.singular_output | (instant.ranks.closure != instant.general.closure)
    return np.where(unknown[..., None], np.nan, velocity), np.where(unknown[..., None], np.nan, acceleration)


def _driven(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """Joint rates (..., n, 6 v + F) that gaps of the loops and input rates ask for; internal freedoms move least."""
    scale = joint_units(record)
    inputs = np.zeros((len(record.inputs), len(scale)))
    for row, item in enumerate(record.inputs):
        inputs[row, item.coordinate.index] = item.sign
    loops = closure_jacobian(record, values) * scale
    rows = np.concatenate([loops, np.broadcast_to(inputs, (*loops.shape[:-2], *inputs.shape))], axis=-2)
    return np.asarray(scale[:, None] * np.linalg.pinv(rows, rcond=SINGULAR * general_share(record)))


def _biases(record: MechanismRecord, values: FloatArray, rates: FloatArray) -> tuple[FloatArray, FloatArray]:
    """A' u' of the loops (..., 6 v), scaled as A is, and the same of the platform's twist (..., 6) at its point."""
    turning = np.array(rates)
    for place in joint_graph(record).turns:
        vectors = np.broadcast_to(values[..., place], rates[..., place].shape)
        turning[..., place] = (rotations.left_jacobian(vectors) @ rates[..., place, None])[..., 0]
    at = flat(record, np.broadcast_to(values, rates.shape))
    moved = flat(record, turning)
    given = tuple(f"speed {k}" for k in range(rates.shape[-1]))
    twists = program(record, _sums_of_twists, given).derivative(record, at, moved, moved.T)  # (6 v + 6, N)
    sums = twists.T.reshape(*rates.shape[:-1], -1, 6)
    loops = sums[..., :-1, :] / twist_units(record)
    return loops.reshape(*rates.shape[:-1], loops.shape[-2] * 6), sums[..., -1, :]


def _sums_of_twists(configuration: Configuration, *rates: Any) -> Outputs:
    """Twists around each loop, and of the platform, at its point, at rates of the joints, a ball's angular ones."""
    graph, (_, point) = configuration.graph, configuration.platform
    still = replace(configuration, rates={})
    ways = [{cut.name: 1, **loop} for cut, loop in zip(graph.cut, graph.loops, strict=True)]
    sums: dict[str, Any] = {}
    for index, way in enumerate([*ways, graph.paths[graph.platform]]):
        rows: list[Any] = [0] * 6
        for name, sense in way.items():
            for row, column, number in still.entries(graph.joint(name), sense, point):
                rows[row] = plus(rows[row], times(number, rates[column]))
        sums |= {f"sum {6 * index + row}": number for row, number in enumerate(rows)}
    return sums


def _pose_acceleration(
    record: MechanismRecord, values: FloatArray, rates: FloatArray, second: FloatArray, bias: FloatArray
) -> FloatArray:
    """Acceleration (..., k) of the pose for joint rates and accelerations (..., n) and the platform's bias (..., 6)."""
    moves = platform_twists(record, values)
    turn = (moves[..., :3, :] @ rates[..., None])[..., 0]
    change = (moves @ second[..., None])[..., 0] + bias
    named = dict(zip(("wx", "wy", "wz", *LENGTHS), np.moveaxis(change, -1, 0), strict=True))
    if any(name in ANGLES for name in record.platform.pose):
        rotation, _ = platform_frame(record, values)
        named |= zip(ANGLES, angle_accelerations(rotation, turn, change[..., :3]), strict=True)
    return np.stack([named[name] for name in rate_names(record.platform.pose)], axis=-1)


def angle_accelerations(rotation: FloatArray, turn: FloatArray, angular: FloatArray) -> tuple[FloatArray, ...]:
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
