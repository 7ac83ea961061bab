"""Between the user's arrays and the kernels' components: shapes, angles, signs and offsets of inputs."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UsageError
from assur.kinematics.closure import characteristic_length
from assur.model.joint_graph import frames
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
LENGTHS = ("x", "y", "z")
LARGEST = 1e60
"""Beyond this the squares and products of a closed form overflow."""


def checked(values: ArrayLike, names: tuple[str, ...], what: str) -> FloatArray:
    """An array (..., k) of finite floats with one entry per name, or a clear refusal."""
    try:
        given = np.asarray(values)
        numeric = given.dtype.kind in "iuf" and not isinstance(values, np.ma.MaskedArray)
    except ValueError:  # rows of unequal length
        numeric = False
    if not numeric:
        raise UsageError(f"{what}: not an array of numbers", hint=f"give {', '.join(names)}")
    array = given.astype(float)
    if array.ndim == 0 or array.shape[-1] != len(names):
        found = "a single number" if array.ndim == 0 else f"{array.shape[-1]} values"
        raise UsageError(f"{what}: {found}, {len(names)} wanted", hint=f"give {', '.join(names)}")
    if not np.all(np.isfinite(array)):
        raise UsageError(f"{what}: every value must be finite, not NaN or infinite")
    if np.any(np.abs(array) > LARGEST):
        raise UsageError(f"{what}: no value may be larger than {LARGEST:g}")
    return array


def input_names(record: MechanismRecord) -> tuple[str, ...]:
    """Printed names of the inputs."""
    return tuple(item.name for item in record.inputs)


def input_components(record: MechanismRecord, inputs: FloatArray) -> tuple[Any, ...]:
    """Kernel inputs from printed ones (N, n): a length as it is, an angle as (cosine, sine)."""
    values = [(inputs[:, k] - item.offset) * item.sign for k, item in enumerate(record.inputs)]
    return tuple(
        (np.cos(value), np.sin(value)) if item.coordinate.kind == "angle" else value
        for value, item in zip(values, record.inputs, strict=True)
    )


def printed_inputs(record: MechanismRecord, components: tuple[Any, ...]) -> list[FloatArray]:
    """Printed inputs from a kernel's, one array each; no arithmetic where a printed input is the joint's value."""
    values = [scalar(value) for value in components]
    return [
        value if (item.sign, item.offset) == (1.0, 0.0) else item.sign * value + item.offset
        for value, item in zip(values, record.inputs, strict=True)
    ]


def pose_components(record: MechanismRecord, poses: FloatArray) -> tuple[Any, ...]:
    """Kernel pose from poses (N, m): a length as it is, an angle as (cosine, sine)."""
    return tuple(
        poses[:, k] if name in LENGTHS else (np.cos(poses[:, k]), np.sin(poses[:, k]))
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
    values = []
    for item in record.coordinates:
        key = item.joint if item.joint in joints else f"{item.joint}.{item.component}"
        values.append(scalar(joints[key]))
    return values


def distance(record: MechanismRecord, joints: FloatArray, poses: FloatArray, inputs: FloatArray) -> FloatArray:
    """How far joint values (N, coordinates) are from poses (N, m) and printed inputs (N, n), in length units.

    Lengths of the pose are compared with the platform's point in the joint graph; angles of the pose are not.
    """
    rotation, origin = frames(record, joints)[record.platform.link]
    point = (rotation @ record.platform.point) + origin
    gaps = [
        np.abs(point[:, "xyz".index(name)] - poses[:, k])
        for k, name in enumerate(record.platform.pose)
        if name in LENGTHS
    ]
    for k, item in enumerate(record.inputs):
        gap = np.abs(item.sign * joints[:, item.coordinate.index] + item.offset - inputs[:, k])
        if item.coordinate.kind == "angle":
            gap = characteristic_length(record) * np.abs((gap + np.pi) % (2 * np.pi) - np.pi)
        gaps.append(gap)
    return np.asarray(np.max(gaps, axis=0))
