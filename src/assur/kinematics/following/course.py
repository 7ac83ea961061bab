"""A course: inputs or poses as functions of the share of a way, straight from vertex to vertex."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UnknownNameError, UsageError
from assur.kinematics.border import checked, checked_poses, input_names
from assur.kinematics.pose import turned_alike, turning_of
from assur.kinematics.rates.motions import pose_units
from assur.kinematics.turns import joint_units, periodic_inputs
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, QUATERNION, has_quaternion, is_angle
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
Prescribed = Literal["inputs", "poses"]
Turns = Literal["short", "given"]
LEAST = 1e-12
"""Vertices closer than this, lengths in units of the characteristic length, are one."""


@dataclass(frozen=True, eq=False)
class Course:
    """A polyline of inputs (k, n) or of poses (k, m), and where along it its vertices lie.

    Attributes:
        prescribed: "inputs" or "poses".
        vertices: (k, n) or (k, m); angles run on, so that neighbours differ by the turn that is meant.
        shares: (k,) shares of the way, from 0 to 1, by length (a rad counts as one characteristic length).
        scales: (r,) what counts as a change of one: the characteristic length, a rad, or the turns of a screw for
            that length; negative for an input that runs against its joint value.
        changes: (k - 1, r) what changes from vertex to vertex; a quaternion's change is a rotation vector
            in the base frame (`assur.model.pose.rate_names`).
    """

    prescribed: Prescribed
    names: tuple[str, ...]
    vertices: FloatArray
    shares: FloatArray
    changes: FloatArray
    scales: FloatArray

    def at(self, share: float, segment: int) -> FloatArray:
        """The inputs (n,) or the pose (m,) at a share of the way, on the segment that follows a vertex."""
        low, high = self.shares[segment : segment + 2]
        part = (share - low) / (high - low)
        if not (self.prescribed == "poses" and has_quaternion(self.names)):
            # from its end: where theta is a right angle a segment may begin with another phi than the one before ends
            return np.asarray(self.vertices[segment + 1] - (1.0 - part) * self.changes[segment])
        if part == 1.0:
            return np.asarray(self.vertices[segment + 1])
        vertex: FloatArray = self.vertices[segment]
        columns = [self.names.index(name) for name in QUATERNION]
        others = [k for k, name in enumerate(self.names) if name not in QUATERNION]
        pose: FloatArray = np.array(vertex)
        pose[others] = vertex[others] + part * self.changes[segment, :-3]
        turn = rotations.from_vector(part * self.changes[segment, -3:])
        pose[columns] = rotations.to_quaternion(turn @ rotations.from_quaternion(vertex[columns]))
        return pose

    def rate(self, share: float, segment: int) -> FloatArray:
        """Change (r,) of the driven joint values or of the pose per share of the way, in units of `scales`.

        Of a pose with phi, theta and psi it is that of the angular velocity, which exists at every orientation
        (`assur.kinematics.pose.turning_rates`).
        """
        rate = self.changes[segment] / (self.shares[segment + 1] - self.shares[segment])
        if self.prescribed == "poses" and all(name in self.names for name in ANGLES):
            pose = self.at(share, segment)
            phi, theta = (pose[self.names.index(name)] for name in ("phi", "theta"))
            rate = turning_of(self.names, phi, theta) @ rate
        return np.asarray(rate / self.scales)


def course(
    record: MechanismRecord, prescribed: Prescribed, start: FloatArray, targets: ArrayLike, turns: Turns = "short"
) -> Course:
    """The way from `start` to wanted inputs (n,) or a wanted pose (m,), or along several, (k, n) or (k, m).

    With turns = "short" every angle goes the short way from vertex to vertex; "given" takes the numbers as they
    stand, as inputs whose turns count always do. Quaternions always go the short way. Vertices that repeat the one
    before are left out.

    >>> from assur.model.registry import load_record
    >>> way = course(load_record("fivebar"), "inputs", np.radians([170.0, 10.0]), np.radians([-170.0, 10.0]))
    >>> np.degrees(way.at(0.25, 0)).round(6)
    array([175.,  10.])
    """
    if turns not in ("short", "given"):
        raise UnknownNameError("way to turn", str(turns), ("short", "given"))
    names = input_names(record) if prescribed == "inputs" else record.platform.pose
    what = f"{prescribed} of {record.name}"
    given = checked(targets, names, what) if prescribed == "inputs" else checked_poses(record, targets)
    if given.ndim > 2:
        raise UsageError(f"{what}: shape {given.shape}; one target or a row of them is wanted")
    turning = _turning(record, prescribed)
    sizes = _sizes(record, prescribed)
    vertices, changes, lengths = [np.asarray(start, dtype=float)], [], []
    for target in np.atleast_2d(given):
        begin = vertices[-1]
        aim = target.copy()
        if turns == "short":
            if prescribed == "poses":
                begin, aim = turned_alike(names, begin, aim), turned_alike(names, aim, begin)
            aim[turning] = begin[turning] + rotations.nearest_turn(aim[turning] - begin[turning])
        change = _change(names, prescribed, begin, aim)
        if np.linalg.norm(change / sizes) <= LEAST:
            continue
        vertices.append(aim)
        changes.append(change)
        lengths.append(float(np.linalg.norm(change / sizes)))
    along = np.concatenate([[0.0], np.cumsum(lengths)])
    shares = along / along[-1] if lengths else along
    all_changes = np.array(changes).reshape(len(changes), len(sizes))
    return Course(prescribed, names, np.array(vertices), shares, all_changes, sizes)


def _turning(record: MechanismRecord, prescribed: Prescribed) -> NDArray[np.bool_]:
    if prescribed == "inputs":
        return periodic_inputs(record)
    return np.array([is_angle(name) for name in record.platform.pose])


def _sizes(record: MechanismRecord, prescribed: Prescribed) -> FloatArray:
    """What counts as a change of one, per rate."""
    if prescribed == "poses":
        return pose_units(record)
    return joint_units(record)[list(record.input_indices)] * [driven.sign for driven in record.inputs]


def _change(names: tuple[str, ...], prescribed: Prescribed, start: FloatArray, end: FloatArray) -> FloatArray:
    if prescribed == "inputs" or not has_quaternion(names):
        return np.asarray(end - start)
    columns = [names.index(name) for name in QUATERNION]
    others = [k for k, name in enumerate(names) if name not in QUATERNION]
    first, second = (rotations.from_quaternion(pose[columns]) for pose in (start, end))
    return np.concatenate([end[others] - start[others], rotations.to_vector(second @ first.T)])
