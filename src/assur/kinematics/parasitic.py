"""Parasitic motion: the coordinates that the pose leaves out, which move along with it."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.kinematics import border
from assur.kinematics.position import inverse
from assur.kinematics.rates.motions import checked_joints
from assur.model.joint_graph import frames
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, LENGTHS, has_quaternion
from assur.numerics import rotations

FloatArray = NDArray[np.float64]


def left_out(record: MechanismRecord) -> tuple[str, ...]:
    """Names of the platform's coordinates that the pose leaves out: of x, y, z and phi, theta, psi.

    >>> from assur.model.registry import load_record
    >>> left_out(load_record("three_rps"))
    ('x', 'y', 'phi')
    """
    known = (*record.platform.pose, *(ANGLES if has_quaternion(record.platform.pose) else ()))
    return tuple(name for name in (*LENGTHS, *ANGLES) if name not in known)


def all_coordinates(record: MechanismRecord, joints: ArrayLike) -> dict[str, FloatArray]:
    """x, y, z of the platform's point and the angles phi, theta, psi, each (...), at joint values (..., n)."""
    rotation, origin = frames(record, checked_joints(record, joints))[record.platform.link]
    point = (rotation @ record.platform.point) + origin
    named = dict(zip(LENGTHS, np.moveaxis(point, -1, 0), strict=True))
    return named | dict(zip(ANGLES, rotations.to_angles(rotation), strict=True))


def parasitic_at(record: MechanismRecord, joints: ArrayLike) -> dict[str, FloatArray]:
    """The coordinates that the pose leaves out, each (...), in lengths and rad, at joint values (..., n)."""
    found = all_coordinates(record, joints)
    return {name: found[name] for name in left_out(record)}


def parasitic(record: MechanismRecord, poses: ArrayLike, mode: str | None = None) -> dict[str, FloatArray]:
    """The coordinates that poses (..., m) leave out, each (...), in lengths and rad, in a working mode.

    The mode is the file's default where none is given. NaN where it does not reach a pose.

    Example: tilted by theta and psi, the platform of a 3-RPS shifts sideways and turns about the vertical by
    tan(phi) = sin(theta) sin(psi) / (cos(theta) + cos(psi)).

    >>> from assur.model.registry import load_record
    >>> moved = parasitic(load_record("three_rps"), [250.0, 0.3, 0.2])
    >>> expected = np.arctan2(np.sin(0.3) * np.sin(0.2), np.cos(0.3) + np.cos(0.2))
    >>> list(moved), bool(abs(moved["phi"] - expected) < 1e-12)
    (['x', 'y', 'phi'], True)
    """
    given = border.checked_poses(record, poses)
    flat = given.reshape(-1, given.shape[-1])
    found = inverse(record, flat, mode or record.modes.default_working or None)
    there = np.any(found.exists, axis=-1)
    first = np.argmax(found.exists, axis=-1) if found.exists.shape[-1] else np.zeros(len(flat), dtype=int)
    joints = found.joints[np.flatnonzero(there), first[there]]
    answer = {}
    for name, values in parasitic_at(record, joints).items():
        column = np.full(len(flat), np.nan)
        column[there] = values
        answer[name] = column.reshape(given.shape[:-1])
    return answer
