"""Slices of the space of poses: some coordinates vary, the others are held.

A workspace with the orientation held is one of positions, one with the position held one of orientations. The
orientation of a pose that is a quaternion is told by the angles phi, theta, psi here: Rz(phi) Ry(theta) Rx(psi).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.errors import UnknownNameError, UsageError
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_of
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, LENGTHS, QUATERNION, has_quaternion, is_angle
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
Columns = tuple[FloatArray, ...]
"""Free coordinates as separate arrays that broadcast against one another."""

MOST = 3


@dataclass(frozen=True)
class Slice:
    """The poses at which some coordinates have given values.

    Attributes:
        pose: coordinates of the mechanism's pose.
        free: those that vary, in the order of the pose.
        held: the others with their values, lengths and rad.
    """

    pose: tuple[str, ...]
    free: tuple[str, ...]
    held: Mapping[str, float]

    def components(self, columns: Columns) -> tuple[Any, ...]:
        """The pose as kernels take it: numbers, angles as (cosine, sine)."""
        values = self._values(columns)
        pairs = {name: (np.cos(value), np.sin(value)) for name, value in values.items() if is_angle(name)}
        return tuple((values | pairs)[name] for name in self.pose)

    def poses(self, points: FloatArray) -> FloatArray:
        """Poses (N, m) of points (N, free)."""
        values = self._values(tuple(points[:, k] for k in range(len(self.free))))
        return np.stack([np.broadcast_to(values[name], (len(points),)) for name in self.pose], axis=-1)

    def _values(self, columns: Columns) -> dict[str, Any]:
        values: dict[str, Any] = {**self.held, **dict(zip(self.free, columns, strict=True))}
        if has_quaternion(self.pose):
            halves = (values[name] / 2 for name in ANGLES)
            values |= zip(QUATERNION, quaternion_of(*((np.cos(half), np.sin(half)) for half in halves)), strict=True)
        return values


def coordinates(record: MechanismRecord) -> tuple[str, ...]:
    """Coordinates that a slice may hold or leave free: those of the pose, with angles for a quaternion."""
    if not has_quaternion(record.platform.pose):
        return record.platform.pose
    kept = tuple(name for name in record.platform.pose if name not in QUATERNION)
    return (*kept, *ANGLES)


def slice_at(record: MechanismRecord, held: Mapping[str, float] | None = None) -> Slice:
    """The slice in which some coordinates are held.

    Where none is named and the pose has more than three, the angles are held as they are at home.

    Errors:
        UnknownNameError: a coordinate that the pose does not have.
        UsageError: a value that is not finite, everything held, or more than three coordinates left free.

    >>> from assur.model.registry import load_record
    >>> slice_at(load_record("zeng2019"), {"y": 0.0}).free
    ('x', 'z')
    """
    names = coordinates(record)
    if held is None:
        held = _home_angles(record) if len(names) > MOST else {}
    for name, value in held.items():
        if name not in names:
            raise UnknownNameError(f"pose coordinate of {record.name}", name, names)
        if not np.isfinite(value):
            raise UsageError(f"held: {name} = {value} is not finite")
    free = tuple(name for name in names if name not in held)
    if not 1 <= len(free) <= MOST:
        left = ", ".join(free) or "nothing"
        raise UsageError(f"a workspace has 1 to {MOST} coordinates; {left} is left free", hint="hold others, or fewer")
    return Slice(record.platform.pose, free, {name: float(value) for name, value in held.items()})


def _home_angles(record: MechanismRecord) -> dict[str, float]:
    values = home_values(record)
    if has_quaternion(record.platform.pose):
        pose = dict(zip(record.platform.pose, pose_of(record, values).tolist(), strict=True))
        turned = rotations.from_quaternion(np.array([pose[name] for name in QUATERNION]))
        return {name: float(angle) for name, angle in zip(ANGLES, rotations.to_angles(turned), strict=True)}
    pose = dict(zip(record.platform.pose, pose_of(record, values).tolist(), strict=True))
    return {name: value for name, value in pose.items() if name not in LENGTHS}


def quaternion_of(phi: Any, theta: Any, psi: Any) -> tuple[Any, ...]:
    """Unit quaternion of Rz(phi) Ry(theta) Rx(psi) from (cosine, sine) of half of each angle, scalar first.

    >>> quaternion_of((1, 0), (1, 0), (0, 1))
    (0, 1, 0, 0)
    """
    (c1, s1), (c2, s2), (c3, s3) = phi, theta, psi
    return (
        c1 * c2 * c3 + s1 * s2 * s3,
        c1 * c2 * s3 - s1 * s2 * c3,
        c1 * s2 * c3 + s1 * c2 * s3,
        s1 * c2 * c3 - c1 * s2 * s3,
    )
