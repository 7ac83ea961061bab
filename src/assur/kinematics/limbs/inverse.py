"""The inverse problem as a product: each limb closes alone, and any choice of one way a limb is an assembly."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from math import prod

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import Frame
from assur.kinematics.home import home_values
from assur.kinematics.limbs.completion import Completion, completion
from assur.kinematics.limbs.point_closure import DOUBTFUL, MovingLimbError
from assur.kinematics.limbs.serial import NotSerialError, SerialLimb, serial_limbs
from assur.kinematics.limbs.solving import LimbSolutions, limb_solutions, still_point
from assur.kinematics.loops.hinges import NoAssemblyError, NotCirclesError
from assur.kinematics.loops.loops import LoopSolutions, PositionQuestion
from assur.kinematics.loops.orientations import turnings
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS

FloatArray = NDArray[np.float64]
MOST = 4096
"""Assemblies that are listed at most."""


def inverse_by_limbs(record: MechanismRecord, pose: FloatArray) -> LoopSolutions | None:
    """All assemblies at a pose (m,), limb by limb; None where the pose or the limbs are not of that kind.

    >>> from assur.model.registry import load_record
    >>> record = load_record("gough_stewart")
    >>> solutions = inverse_by_limbs(record, np.array([0.0, 10.0, 300.0, 1.0, 0.0, 0.0, 0.0]))
    >>> len(solutions.joints), solutions.complete
    (64, True)
    """
    question = PositionQuestion(record, "inverse", pose)
    try:
        series = serial_limbs(record)
        platform = _platform(question, series)
        whole = completion(question, series) if platform is None else Completion((platform,), True, "")
        if whole is None:
            return None
        sets = [[limb_solutions(limb, frame, record.input_indices) for limb in series] for frame in whole.frames]
    except (NotSerialError, MovingLimbError):
        return None
    if sum(prod(len(own.values) for own in limbs) for limbs in sets) > MOST:
        return None
    right = _right(whole, series, sets)
    pieces = [_starts(record, limbs) for limbs in sets] or [(np.zeros((0, len(record.coordinates))), np.zeros(0))]
    starts, bent = (np.concatenate(part) for part in zip(*pieces, strict=True))
    joints = question.closed(starts)
    looked = sum(own.roots for limbs in sets for own in limbs)
    sure = starts[bent <= DOUBTFUL]
    doubtful = len(joints) != len(sure) or (len(sure) < len(starts) and len(question.closed(sure)) < len(joints))
    if doubtful or not whole.sure:
        return LoopSolutions(joints, False, f"not proved, since roots are too near to tell them: {right}", looked)
    return LoopSolutions(joints, True, right, looked)


def _right(whole: Completion, series: Sequence[SerialLimb], sets: Sequence[Sequence[LimbSolutions]]) -> str:
    if not sets:
        return f"{whole.right}: none is real" if whole.right else "each limb alone"
    names = ", ".join(f"{limb.joints[0]} ({own.roots})" for limb, own in zip(series, sets[0], strict=True))
    return f"{whole.right + ', then ' if whole.right else ''}each limb alone, for all its roots: {names}"


def _platform(question: PositionQuestion, limbs: Sequence[SerialLimb]) -> Frame | None:
    """The platform's frame, where pose and limbs say it all."""
    rotation = _rotation(question)
    if rotation is None:
        return None
    point = question.record.platform.point
    if question.place.keys() == {*LENGTHS}:
        return rotation, np.array([question.place[name] for name in LENGTHS]) - rotation @ point
    for limb in limbs:
        centre = still_point(limb)
        if centre is not None and not question.place:
            return rotation, centre - rotation @ (limb.zero[0].T @ (centre - limb.zero[1]))
    return None


def _rotation(question: PositionQuestion) -> FloatArray | None:
    """Of the platform (3, 3), where the pose gives it or the joints leave but one."""
    if question.orientation is not None:
        return None if question.tilt_open else question.orientation
    try:
        turning = turnings(question.record, {}, None, parallel=())[question.record.platform.link]
    except (NotCirclesError, NoAssemblyError):
        return None
    free = (turning.circle, turning.rod, turning.ball, turning.triangle)
    return turning.rotation if all(own is None for own in free) else None


def _starts(record: MechanismRecord, limbs: list[LimbSolutions]) -> tuple[FloatArray, FloatArray]:
    """Joint values (N, n) of all choices, and by how much (N,) their roots were made real."""
    choices = [*product(*(range(len(own.values)) for own in limbs))]
    starts = np.tile(home_values(record), (len(choices), 1))
    bent = np.zeros(len(choices))
    for own, chosen in zip(limbs, np.array(choices, dtype=int).reshape(-1, len(limbs)).T, strict=True):
        starts[:, list(own.indices)] = own.values[chosen]
        bent = np.maximum(bent, own.bent[chosen])
    return starts, bent
