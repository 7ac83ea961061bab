"""The direct problem of platforms whose limbs, with drives held, say one condition each: all poses, then all joints."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import Frame
from assur.joint_graph.geometry import characteristic_length, joint_scales
from assur.kinematics.home import home_values
from assur.kinematics.limbs.point_closure import MovingLimbError
from assur.kinematics.limbs.rotations import rotations_under
from assur.kinematics.limbs.serial import NotSerialError, SerialLimb, serial_limbs
from assur.kinematics.limbs.solving import limb_solutions
from assur.kinematics.loops.loops import LoopSolutions, PositionQuestion
from assur.kinematics.platforms.distances import point_distance
from assur.kinematics.platforms.six_distances import LEGS, SixDistancePoses, six_distance_poses
from assur.kinematics.platforms.spherical import fixed_point, rotation_conditions
from assur.kinematics.turns import periodic
from assur.model.mechanism import MechanismRecord
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
AS_HELD = 1e-5
"""By how much a drive may miss what it is held at, in rad and characteristic lengths, before loops are closed."""


def direct_by_conditions(record: MechanismRecord, inputs: FloatArray) -> LoopSolutions | None:
    """All assemblies at printed inputs (n,) of a platform on six legs; None where limbs say anything else.

    >>> from assur.model.registry import load_record
    >>> legs = np.array([1.02, 0.64, 1.06, 1.48, 1.34, 0.77])
    >>> solutions = direct_by_conditions(load_record("gough_stewart"), legs)
    >>> len(solutions.joints), solutions.right.split(",")[0]
    (18, 'six distances between points of base and platform: 40 complex poses')
    """
    question = PositionQuestion(record, "direct", inputs)
    held = question.locked
    try:
        limbs = serial_limbs(record)
        poses = _six(record, limbs, held) or _spherical(limbs, held)
        if poses is None:
            return None
        starts = [row for frame in poses.frames for row in _assemblies(record, limbs, frame, held)]
    except (NotSerialError, MovingLimbError):
        return None
    joints = question.closed(np.array(starts).reshape(-1, len(record.coordinates)))
    if not poses.sure or len(joints) != len(starts):
        right = f"not proved, since roots are too near to tell them: {poses.right}"
        return LoopSolutions(joints, False, right, poses.complex)
    return LoopSolutions(joints, True, poses.right, poses.complex)


@dataclass(frozen=True, eq=False)
class _Poses:
    """Real frames of the platform, how many poses there are with complex ones, whether that is sure, and why."""

    frames: tuple[Frame, ...]
    complex: int
    sure: bool
    right: str


def _six(record: MechanismRecord, limbs: Sequence[SerialLimb], held: Mapping[int, float]) -> _Poses | None:
    if len(limbs) != LEGS:
        return None
    distances = [point_distance(limb, held) for limb in limbs]
    legs = [distance for distance in distances if distance is not None]
    if len(legs) != LEGS:
        return None
    solved = six_distance_poses(legs, characteristic_length(record))
    return _Poses(solved.poses, solved.complex, not solved.unknown, _right(solved))


def _spherical(limbs: Sequence[SerialLimb], held: Mapping[int, float]) -> _Poses | None:
    fixed = fixed_point(limbs)
    conditions = None if fixed is None else rotation_conditions(limbs, held, fixed)
    if fixed is None or conditions is None:
        return None
    solved = rotations_under(conditions)
    frames = tuple((rotation, fixed[0] - rotation @ fixed[1]) for rotation in solved.values)
    right = f"three linear conditions on the platform's rotation about a fixed point: {solved.complex} complex"
    return _Poses(frames, solved.complex, solved.sure, f"{right} rotations of at most 8, {len(frames)} of them real")


def _right(solved: SixDistancePoses) -> str:
    right = (
        f"six distances between points of base and platform: {solved.complex} complex poses, {len(solved.poses)} of"
        " them real"
    )
    if solved.infinite:
        right += f", and {solved.infinite} paths that end at infinity"
    return f"{right}; there are no more than 40 (Ronga, Vust 1995; Lazard 1993; Mourrain 1993)"


def _assemblies(
    record: MechanismRecord, limbs: Sequence[SerialLimb], pose: Frame, held: Mapping[int, float]
) -> list[FloatArray]:
    """Joint values (n,) of all limbs at a frame of the platform, drives as they are held."""
    choices = []
    for limb in limbs:
        solutions = limb_solutions(limb, pose, record.input_indices)
        driven = [k for k, index in enumerate(solutions.indices) if index in held]
        own = [solutions.indices[k] for k in driven]
        off = solutions.values[:, driven] - [held[index] for index in own]
        off = np.where(periodic(record)[own], rotations.nearest_turn(off), off) / joint_scales(record)[own]
        near = np.all(np.abs(off) < AS_HELD, axis=1)
        choices.append([(solutions.indices, row) for row in solutions.values[near]])
    rows = []
    for chosen in product(*choices):
        row = home_values(record).copy()
        for indices, values in chosen:
            row[list(indices)] = values
        row[list(held)] = [*held.values()]
        rows.append(row)
    return rows
