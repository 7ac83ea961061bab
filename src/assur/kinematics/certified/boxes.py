"""The direct problem box by box: all poses that links allow are searched, and every box is proved to hold one or none.

It needs no closed form of the direct problem, only the legs (`assur.kinematics.certified.legs`).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.kinematics import position
from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.certified.domain import HALF_TURN, pose_box
from assur.kinematics.certified.given import inputs_meant
from assur.kinematics.certified.legs import Legs
from assur.kinematics.certified.proofs import sizes
from assur.kinematics.certified.recorded_legs import RecordedLegs
from assur.kinematics.certified.result import CertifiedSolutions, Doubt, ProvedSolution
from assur.kinematics.modes import mode_text
from assur.kinematics.status import closed_form_of
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle
from assur.numerics.branch_and_prune import Zeros, zeros
from assur.numerics.intervals.functions import TURN
from assur.numerics.intervals.interval import Interval, common

FloatArray = NDArray[np.float64]
HOW = "Krawczyk on the legs"
SMALLEST = 1e-6
"""Part of the size of a coordinate below which boxes are not halved any more."""
MOST, TOTAL = 60_000, 600_000
"""Boxes that are open at once, and that are looked at, at most."""
NEAR = 1e-7
"""How near a float answer must be to lend its name, against the size of a coordinate."""


def direct_by_boxes(
    record: MechanismRecord, inputs: FloatArray, *, smallest: float = SMALLEST, most: int = MOST
) -> CertifiedSolutions:
    """Every pose at printed inputs (n,), by branch and prune over the box that the links allow.

    Errors:
        UsageError: the pose is a quaternion, its coordinates are not as many as the inputs, or links do not bound it.
    """
    names = record.platform.pose
    bounds = pose_box(record, inputs)
    if bounds is None or len(names) != len(inputs):
        raise UsageError(
            f"{record.name}: no box of poses can be searched here",
            hint="it takes as many coordinates as inputs, no quaternion, and limbs that bound the platform",
        )
    legs = Legs(record, inputs)
    count = len(legs.modes)
    start = Interval.of(np.tile(bounds[0], (count, 1)), np.tile(bounds[1], (count, 1)))
    answer = zeros(
        RecordedLegs(legs), start, np.arange(count), sizes(record), smallest=smallest, most=most, total=TOTAL
    )
    floats = position.direct(record, inputs)
    poses, twice = _within_a_turn(names, answer)
    solutions = tuple(
        _solution(floats, poses[k], inputs, mode_text(legs.modes[answer.labels[k]].astype(int)))
        for k in range(len(poses.low))
        if k not in twice
    )
    meaning = "no box so small could be decided: singular or nearly so, a curve of poses, or too many boxes"
    doubts = [
        Doubt("pose", item.low, item.high, meaning)
        for item in (answer.undecided[k] for k in range(len(answer.undecided.low)))
    ]
    doubts += [Doubt("pose", poses[k].low, poses[k].high, "one pose or two, a whole turn apart") for k in sorted(twice)]
    form = closed_form_of(record)
    right = f"branch and prune over all poses that the links allow, {answer.examined} boxes, {count} working modes"
    right += " of the inverse's closed form"
    return CertifiedSolutions(record, "direct", inputs, solutions, tuple(doubts), True, form.complete_for, right)


def _within_a_turn(names: tuple[str, ...], zeros: Zeros) -> tuple[Interval, set[int]]:
    """Poses (K, m) with angles about zero, and those that may be others' after a whole turn."""
    poses = zeros.isolated
    for k, name in enumerate(names):
        if is_angle(name):
            over = poses.middle[:, k] > HALF_TURN
            less = poses[:, k] - TURN
            low, high = poses.low.copy(), poses.high.copy()
            low[over, k], high[over, k] = less.low[over], less.high[over]
            poses = Interval(low, high, poses.defined)
    twice = {
        k
        for k in range(len(poses.low))
        for j in range(k)
        if zeros.labels[j] == zeros.labels[k] and not np.any(common(poses[j], poses[k])[1])
    }
    return poses, twice


def _solution(floats: SolutionSet, pose: Interval, inputs: FloatArray, working: str) -> ProvedSolution:
    """With the name that the float answer gives it, if it has it."""
    rows = [row for row in np.flatnonzero(floats.exists) if str(floats.other_labels[row]).startswith(working)]
    near = [
        row
        for row in rows
        if np.all(np.abs(floats.poses[row] - pose.middle) <= pose.width + NEAR * sizes(floats.record))
    ]
    mode = str(floats.labels[near[0]]) if near else ""
    return ProvedSolution(pose, inputs_meant(floats.record, inputs), mode, working, mode, HOW)
