"""Parasitic motion: the coordinates that the pose leaves out, which move along with it."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.joint_graph.frames import frames
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics import border
from assur.kinematics.border import checked_joints
from assur.kinematics.closure import assemble
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_of
from assur.kinematics.position import inverse
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, LENGTHS, has_quaternion, is_angle
from assur.numerics import rotations
from assur.work import stage

FloatArray = NDArray[np.float64]
STEPS = (0.05, 0.05 / 16)
"""How far home is left to see what moves, in rad and characteristic lengths; less far where that leads out of reach."""

CLOSING = 6
"""Steps in which loops are closed so near home: gaps of 0.05 fall by squares to rounding in four or five."""

STILL = 1e-6
"""What changes by less than this, in rad and characteristic lengths, stands still."""


def left_out(record: MechanismRecord) -> tuple[str, ...]:
    """Names of the platform's coordinates that the pose leaves out: of x, y, z and phi, theta, psi.

    >>> from assur.model.registry import load_record
    >>> left_out(load_record("three_rps"))
    ('x', 'y', 'phi')
    """
    known = (*record.platform.pose, *(ANGLES if has_quaternion(record.platform.pose) else ()))
    return tuple(name for name in (*LENGTHS, *ANGLES) if name not in known)


@lru_cache(maxsize=64)
@stage("parasitic motions")
def moving(record: MechanismRecord) -> tuple[str, ...]:
    """Names of those coordinates that the pose leaves out and that change when the platform leaves home.

    Home is left along every coordinate of the pose and along both diagonals of every two, both ways, so that what grows
    with a product or a square is seen too. A pose of lengths alone, of a platform that may turn, is that of a point:
    how the link turns is not asked.

    >>> from assur.model.registry import load_record
    >>> moving(load_record("three_rps")), moving(load_record("planar_3rrr")), moving(load_record("fivebar"))
    (('x', 'y', 'phi'), (), ())
    """
    names, pose = left_out(record), record.platform.pose
    if record.platform.orientation == "any" and not has_quaternion(pose) and not any(map(is_angle, pose)):
        names = tuple(name for name in names if not is_angle(name))
    if not names:
        return ()
    home, length = home_values(record), characteristic_length(record)
    unit = np.eye(len(pose))
    pairs = [unit[i] + sign * unit[j] for i in range(len(pose)) for j in range(i) for sign in (1.0, -1.0)]
    scale = np.array([1.0 if is_angle(name) else length for name in pose])
    ways = scale * np.stack([way for one in (*unit, *pairs) for way in (one, -one)])
    here, there = all_coordinates(record, home), all_coordinates(record, _beside(record, home, ways))
    still = {name: STILL * (1.0 if is_angle(name) else length) for name in names}
    return tuple(name for name in names if np.any(np.abs(there[name] - here[name]) > still[name]))


def _beside(record: MechanismRecord, home: FloatArray, ways: FloatArray) -> FloatArray:
    """Joint values (N, n) of assemblies a little way from home, along each of the ways (k, m) of the pose."""
    pose, closed = pose_of(record, home), list[FloatArray]()
    for step in STEPS:
        found = assemble(record, np.tile(home, (len(ways), 1)), poses=pose + step * ways, max_steps=CLOSING)
        closed.append(found.values[found.closed])
        ways = ways[~found.closed]
        if not len(ways):
            break
    return np.concatenate(closed)


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
