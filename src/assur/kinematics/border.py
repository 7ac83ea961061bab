"""Between the user's arrays and the kernels' components: shapes, angles, signs and offsets of inputs."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UnknownNameError, UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.pose import pose_error
from assur.kinematics.turns import periodic, periodic_inputs
from assur.model.mechanism import Input, MechanismRecord
from assur.model.pose import QUATERNION, has_quaternion, is_angle
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
Named = ArrayLike | Mapping[str, ArrayLike]
"""Numbers (..., k) in the order of k names, or the numbers (...) of each by name."""
SHORTEST_QUATERNION = 1e-6
LARGEST = 1e60
"""Beyond this the squares and products of a closed form overflow."""


def checked(values: Named, names: tuple[str, ...], what: str) -> FloatArray:
    """An array (..., k) of finite floats, one for each name, given in their order or by name; or a clear refusal."""
    try:
        given = np.asarray(_columns(values, names, what) if isinstance(values, Mapping) else values)
        numeric = given.dtype.kind in "iuf" and not _is_masked(values)
    except ValueError:  # rows of unequal length
        numeric = False
    if not numeric:
        raise UsageError(f"{what}: not an array of numbers", hint=f"give {', '.join(names)}")
    array = given.astype(float)
    if array.ndim == 0 or array.shape[-1] != len(names):
        given_shape = "a single number" if array.ndim == 0 else f"{array.shape[-1]} values"
        raise UsageError(f"{what}: {given_shape}, {len(names)} wanted", hint=f"give {', '.join(names)}")
    if not np.all(np.isfinite(array)):
        raise UsageError(f"{what}: every value must be finite, not NaN or infinite")
    if np.any(np.abs(array) > LARGEST):
        raise UsageError(f"{what}: no value may be larger than {LARGEST:g}")
    return array


def _is_masked(values: object) -> bool:
    """Whether values are a masked array; there is none before NumPy has loaded its module of these, a slow one."""
    masked = sys.modules.get("numpy.ma")
    return masked is not None and isinstance(values, masked.MaskedArray)


def _columns(values: Mapping[str, ArrayLike], names: tuple[str, ...], what: str) -> NDArray[Any]:
    """Values by name as an array (..., k) in the order of the names, if each is there and no other."""
    for name in values:
        if name not in names:
            raise UnknownNameError(f"name in the {what}", str(name), names)
    missing = [name for name in names if name not in values]
    if missing:
        raise UsageError(f"{what}: no value for {', '.join(missing)}", hint=f"give {', '.join(names)}")
    return np.stack([np.asarray(values[name]) for name in names], axis=-1)


def checked_joints(record: MechanismRecord, joints: Named) -> FloatArray:
    """Joint values (..., n) as floats, from an array or from values by name; or a clear refusal."""
    return checked(joints, joint_names(record), f"joint values of {record.name}")


def joint_array(record: MechanismRecord, joints: Named) -> FloatArray:
    """Joint values (..., n) as they are, NaN among them where there is no solution; those by name in their order."""
    if isinstance(joints, Mapping):
        joints = _columns(joints, joint_names(record), f"joint values of {record.name}")
    return np.asarray(joints, dtype=float)


def joint_names(record: MechanismRecord) -> tuple[str, ...]:
    """Names of the joint values."""
    return tuple(record.coordinate_label(coordinate) for coordinate in record.coordinates)


def checked_poses(record: MechanismRecord, values: ArrayLike) -> FloatArray:
    """Poses (..., m) as `checked`; a quaternion is made a unit one."""
    poses = checked(values, record.platform.pose, f"pose of {record.name}")
    if "theta" in record.platform.pose:
        theta = poses[..., record.platform.pose.index("theta")]
        if np.any(np.abs(theta) > np.pi / 2):
            raise UsageError(
                f"pose of {record.name}: theta is between -90 and 90 deg",
                hint="angles are in rad here: np.radians(30) is 30 deg; beyond 90 deg turn phi and psi instead",
            )
    if not has_quaternion(record.platform.pose):
        return poses
    columns = [record.platform.pose.index(name) for name in QUATERNION]
    size = np.linalg.norm(poses[..., columns], axis=-1, keepdims=True)
    if not np.all(size > SHORTEST_QUATERNION):
        raise UsageError(f"pose of {record.name}: a quaternion of length zero", hint="no rotation is 1, 0, 0, 0")
    poses[..., columns] /= size
    return poses


def in_range(record: MechanismRecord, poses: FloatArray) -> FloatArray:
    """Poses (..., m) with theta cut off at -90 and 90 deg: for poses that are drawn by chance."""
    if "theta" not in record.platform.pose:
        return poses
    column = record.platform.pose.index("theta")
    answer = np.array(poses)
    answer[..., column] = np.clip(answer[..., column], -np.pi / 2, np.pi / 2)
    return answer


def input_names(record: MechanismRecord) -> tuple[str, ...]:
    """Printed names of the inputs that determine the mechanism."""
    return tuple(driven.name for driven in record.inputs)


def drive_names(record: MechanismRecord) -> tuple[str, ...]:
    """Printed names of every input, those that follow last."""
    return tuple(driven.name for driven in record.drives)


def checked_inputs(record: MechanismRecord, values: Named) -> FloatArray:
    """Inputs (..., n), or every input (..., d) where redundant ones are given too, as `checked`."""
    names = drive_names(record)
    if record.redundant_inputs:
        few = not isinstance(values, Mapping) and np.shape(values)[-1:] == (len(record.inputs),)
        if few or (isinstance(values, Mapping) and not set(values) & {item.name for item in record.redundant_inputs}):
            names = input_names(record)
    return checked(values, names, f"inputs of {record.name}")


def input_components(record: MechanismRecord, inputs: FloatArray) -> tuple[Any, ...]:
    """Kernel inputs from printed ones (N, n): an angle as (cosine, sine), a length or counted turns as they are."""
    values = [driven.joint_value(inputs[:, k]) for k, driven in enumerate(record.inputs)]
    return tuple(
        (np.cos(value), np.sin(value)) if same else value
        for value, same in zip(values, periodic_inputs(record), strict=True)
    )


def printed_inputs(record: MechanismRecord, components: tuple[Any, ...]) -> list[FloatArray]:
    """Printed inputs from a kernel's, one array each; no arithmetic where a printed input is the joint's value."""
    values = [scalar(value) for value in components]
    return [
        value if (driven.sign, driven.offset) == (1.0, 0.0) else driven.printed(value)
        for value, driven in zip(values, record.inputs, strict=True)
    ]


def inputs_of(record: MechanismRecord, joints: FloatArray) -> FloatArray:
    """Printed inputs (..., n) at joint values (..., coordinates)."""
    columns = [driven.printed(joints[..., driven.coordinate.index]) for driven in record.inputs]
    return np.stack(columns, axis=-1)


def drives_of(record: MechanismRecord, joints: FloatArray) -> FloatArray:
    """Every printed input (..., d), those that follow last, at joint values (..., coordinates)."""
    return np.stack([driven.printed(joints[..., driven.coordinate.index]) for driven in record.drives], axis=-1)


def held_inputs(record: MechanismRecord, joints: FloatArray, inputs: FloatArray) -> FloatArray:
    """Joint values (..., coordinates) with the actuated ones as printed inputs (..., n) say."""
    answer = np.broadcast_to(joints, (*np.broadcast_shapes(joints.shape[:-1], inputs.shape[:-1]), joints.shape[-1]))
    answer = np.array(answer)
    for k, driven in enumerate(record.inputs):
        answer[..., driven.coordinate.index] = driven.joint_value(inputs[..., k])
    return answer


def pose_components(record: MechanismRecord, poses: FloatArray) -> tuple[Any, ...]:
    """Kernel pose from poses (N, m): a number as it is, an angle as (cosine, sine)."""
    return tuple(
        (np.cos(poses[:, k]), np.sin(poses[:, k])) if is_angle(name) else poses[:, k]
        for k, name in enumerate(record.platform.pose)
    )


def scalar(value: Any) -> FloatArray:
    """A kernel's number as it is, a pair (cosine, sine) as its angle in rad."""
    if isinstance(value, tuple):
        cosine, sine = value
        return np.asarray(np.arctan2(sine, cosine))
    return np.asarray(value, dtype=float)


def joint_values(record: MechanismRecord, joints: Any) -> list[FloatArray]:
    """Joint values in the order of the record's coordinates, from a kernel's {joint or joint.component: value}."""
    values: list[FloatArray] = []
    for name, joint in record.joints.items():
        if joint.type.ball:
            values += _rotation_vector(joints[name])
        elif name in joints:
            values.append(scalar(joints[name]))
        else:
            values += [scalar(joints[f"{name}.{component}"]) for component in joint.type.components]
    return values


def _rotation_vector(rows: Any) -> list[FloatArray]:
    """Parts of the rotation vector of a rotation given as three rows of numbers that broadcast."""
    entries = np.broadcast_arrays(*(np.asarray(entry, dtype=float) for row in rows for entry in row))
    matrix = np.stack(entries, axis=-1)
    vector = rotations.to_vector(matrix.reshape(*matrix.shape[:-1], 3, 3))
    return list(np.moveaxis(vector, -1, 0))


def distance(record: MechanismRecord, joints: FloatArray, poses: FloatArray, inputs: FloatArray) -> FloatArray:
    """How far joint values (N, coordinates) are from poses (N, m) and printed inputs (N, n), in length units.

    Rotations count times the characteristic length.
    """
    away = np.max(np.abs(pose_error(record, joints, poses, characteristic_length(record))), axis=-1)
    return np.asarray(np.maximum(away, input_distance(record, record.inputs, joints, inputs)))


def input_distance(
    record: MechanismRecord, drives: Sequence[Input], joints: FloatArray, inputs: FloatArray
) -> FloatArray:
    """How far joint values (N, coordinates) are from printed inputs (N, k) of k drives, in length units, as above."""
    length, gaps = characteristic_length(record), np.zeros(len(joints))
    for k, driven in enumerate(drives):
        gap = np.abs(driven.printed(joints[:, driven.coordinate.index]) - inputs[:, k])
        if periodic(record)[driven.coordinate.index]:
            gap = np.abs(rotations.nearest_turn(gap))
        gaps = np.maximum(gaps, length * gap if driven.coordinate.kind == "angle" else gap)
    return gaps
