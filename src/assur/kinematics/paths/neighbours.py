"""Steps to neighbouring poses: along the tangent, corrected, and taken only where the working mode is kept."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.points import quantities
from assur.joint_graph.tree import joint_graph
from assur.kinematics.border import checked_poses
from assur.kinematics.paths.correcting import Corrected, corrected
from assur.kinematics.paths.locked import units
from assur.kinematics.paths.platform_held import PlatformHeld, held_system, passes_zero, platform_held
from assur.kinematics.rates.motions import pose_units
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, LENGTHS, QUATERNION, has_quaternion
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IntArray = NDArray[np.intp]

FURTHEST = 1.0
"""How far a joint value may move in one step, in rad or characteristic lengths."""

LONG = 0.3
"""How far a step goes along the tangent at most."""

PARTS = 4
"""What cannot be reached in one step is tried in so many."""


@dataclass(frozen=True, eq=False)
class Steps:
    """Steps from assemblies (N, n) at poses (N, m), with the first-order motion there."""

    record: MechanismRecord
    signs: NDArray[np.int8]
    joints: FloatArray
    poses: FloatArray
    held: PlatformHeld

    def of(self, rows: IntArray) -> Steps:
        """Those of some of the assemblies, which may repeat."""
        return Steps(self.record, self.signs, self.joints[rows], self.poses[rows], self.held.of(rows))

    def to(self, poses: FloatArray) -> tuple[FloatArray, BoolArray]:
        """Joint values (N, n) at poses (N, m), and where the step may be taken (N,); elsewhere the closest approach."""
        if not len(poses):
            return self.joints, np.zeros(0, dtype=bool)
        move = np.einsum("nij,nj->ni", self.held.rates, pose_change(self.record, self.poses, poses))
        share = LONG / np.maximum(np.max(np.abs(move), axis=1, initial=0.0), LONG)
        predicted = self.joints + move * share[:, None] * units(self.record)
        found = _at_poses(self.record, predicted, poses)
        near = np.max(np.abs(found.values - self.joints) / units(self.record), axis=1, initial=0.0) <= FURTHEST
        values = np.where(near[:, None], found.values, self.joints)
        good = found.closed & near
        rows = np.flatnonzero(good)
        good[rows] = self.of(rows).kept(values[rows], found.derivative[rows])
        return whole_turns_less(self.record, values), good

    def kept(self, values: FloatArray, matrix: FloatArray) -> BoolArray:
        """Whether other assemblies (N, n) with D `matrix` (N, r, n) are of the mode, with no merging between."""
        same = np.all(working_signs(self.record, values) * self.signs >= 0, axis=1)
        rows = np.flatnonzero(same)
        same[rows] = ~passes_zero(self.record, self.held.matrix[rows], matrix[rows])
        return np.asarray(same)

    def in_parts(self, poses: FloatArray) -> tuple[FloatArray, BoolArray]:
        """The same in several parts, none of which may fail."""
        values, good = self.joints.copy(), np.ones(len(poses), dtype=bool)
        here, rows = self, np.arange(len(poses))
        for part in range(1, PARTS + 1):
            target = checked_poses(self.record, self.poses[rows] + part / PARTS * (poses[rows] - self.poses[rows]))
            values[rows], taken = here.to(target)
            good[rows[~taken]] = False
            rows = rows[taken]
            if not len(rows):
                break
            held = platform_held(self.record, values[rows])
            here = Steps(self.record, self.signs, values[rows], target[taken], held)
        return values, good


def _at_poses(record: MechanismRecord, start: FloatArray, poses: FloatArray) -> Corrected:
    """Assemblies at poses (N, m) near joint values (N, n)."""
    size = units(record)

    def system(trial: FloatArray, rows: IntArray) -> tuple[FloatArray, FloatArray]:
        return held_system(record, trial * size, poses[rows])

    found = corrected(system, start / size)
    return replace(found, values=found.values * size)


def working_signs(record: MechanismRecord, joints: FloatArray) -> NDArray[np.int8]:
    """Signs (..., s) of the quantities that name working modes, at joint values (..., n)."""
    signs = [np.sign(value) for value in quantities(record, record.modes.working.values(), joints)]
    shape = joints.shape[:-1]
    return (
        np.stack([np.broadcast_to(item, shape) for item in signs], axis=-1).astype(np.int8)
        if signs
        else np.zeros((*shape, 0), dtype=np.int8)
    )


def pose_change(record: MechanismRecord, start: FloatArray, end: FloatArray) -> FloatArray:
    """Change (N, k) from poses to poses (N, m), as `assur.kinematics.pose.error_rates` has it, without dimensions.

    Lengths are in characteristic lengths; angles go the short way; a whole orientation changes by a rotation vector.
    """
    pose = record.platform.pose
    if all(name in pose for name in ANGLES):
        first, second = (_rotation(pose, poses) for poses in (start, end))
        place = [k for k, name in enumerate(pose) if name in LENGTHS]
        turn = rotations.to_vector(second @ np.swapaxes(first, -1, -2))
        return np.concatenate([(end - start)[:, place] / characteristic_length(record), turn], axis=1)
    columns = []
    for k, name in enumerate(pose):
        if name in LENGTHS:
            columns.append(end[:, k] - start[:, k])
        elif name not in QUATERNION:
            columns.append((end[:, k] - start[:, k] + np.pi) % (2 * np.pi) - np.pi)
    if has_quaternion(pose):
        place = [pose.index(name) for name in QUATERNION]
        first, second = (rotations.from_quaternion(_unit(poses[:, place])) for poses in (start, end))
        columns += list(rotations.to_vector(second @ np.swapaxes(first, -1, -2)).T)
    return np.stack(columns, axis=1) / pose_units(record)


def _rotation(pose: tuple[str, ...], poses: FloatArray) -> FloatArray:
    """Orientations (N, 3, 3) of poses (N, m) with phi, theta and psi."""
    return rotations.from_angles(*(poses[:, pose.index(name)] for name in ANGLES))


def _unit(quaternion: FloatArray) -> FloatArray:
    return np.asarray(quaternion / np.linalg.norm(quaternion, axis=-1, keepdims=True))


def whole_turns_less(record: MechanismRecord, joints: FloatArray) -> FloatArray:
    """The same assemblies (N, n) with every rotation vector within half a turn and a little more."""
    for name, joint in record.joints.items():
        if joint.type.ball:
            place = joint_graph(record).slices[name]
            angle = np.linalg.norm(joints[:, place], axis=1)
            rows = angle > 1.25 * np.pi
            joints[rows, place] *= (1.0 - 2 * np.pi / angle[rows])[:, None]
    return joints
