"""The direct problem of a platform whose limbs, with their drives held, each say a distance between two points."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import product

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import Frame
from assur.joint_graph.geometry import characteristic_length, joint_scales
from assur.kinematics.home import home_values
from assur.kinematics.limbs.point_closure import MovingLimbError
from assur.kinematics.limbs.serial import NotSerialError, SerialLimb, serial_limbs
from assur.kinematics.limbs.solving import limb_solutions
from assur.kinematics.loops.loops import LoopSolutions, PositionQuestion
from assur.kinematics.platforms.distances import point_distance
from assur.kinematics.platforms.six_distances import LEGS, SixDistancePoses, six_distance_poses
from assur.kinematics.turns import periodic
from assur.model.mechanism import MechanismRecord
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
AS_HELD = 1e-5
"""By how much a drive may miss what it is held at, in rad and characteristic lengths, before loops are closed."""


def direct_by_distances(record: MechanismRecord, inputs: FloatArray) -> LoopSolutions | None:
    """All assemblies at printed inputs (n,) of a platform on six legs; None where limbs say anything else.

    >>> from assur.model.registry import load_record
    >>> legs = np.array([1.02, 0.64, 1.06, 1.48, 1.34, 0.77])
    >>> solutions = direct_by_distances(load_record("gough_stewart"), legs)
    >>> len(solutions.joints), solutions.right.split(",")[0]
    (18, 'six distances between points of base and platform: 40 complex poses')
    """
    question = PositionQuestion(record, "direct", inputs)
    held = question.locked
    try:
        limbs = serial_limbs(record)
        distances = [point_distance(limb, held) for limb in limbs]
        legs = [distance for distance in distances if distance is not None]
        if len(legs) != LEGS or len(limbs) != LEGS:
            return None
        solved = six_distance_poses(legs, characteristic_length(record))
        starts = [row for pose in solved.poses for row in _assemblies(record, limbs, pose, held)]
    except (NotSerialError, MovingLimbError):
        return None
    joints = question.closed(np.array(starts).reshape(-1, len(record.coordinates)))
    right = _right(solved)
    if solved.unknown or len(joints) != len(starts):
        return LoopSolutions(joints, False, f"not proved, since ends of paths are too near to tell them: {right}", LEGS)
    return LoopSolutions(joints, True, right, solved.complex)


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
