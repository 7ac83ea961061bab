"""The direct problem of platforms on serial limbs: all poses that these allow with drives held, then all joints."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.configurations import distinct
from assur.kinematics.home import home_values
from assur.kinematics.limbs.networks import Limb, limbs_of, limbs_of_middle
from assur.kinematics.limbs.point_closure import MovingLimbError
from assur.kinematics.limbs.serial import NotSerialError, SerialLimb
from assur.kinematics.limbs.solving import LimbSolutions
from assur.kinematics.loops.loops import LoopSolutions, PositionQuestion, unsolved
from assur.kinematics.platforms.chains import closed_series, loop_of
from assur.kinematics.platforms.conditions import UncertainConditionsError, joined
from assur.kinematics.platforms.inverse import OPEN
from assur.kinematics.platforms.limbs import closed_limb, held_limb, limb_conditions
from assur.kinematics.platforms.poses import poses_under
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
AS_HELD = 1e-5
"""By how much a limb may miss the platform, in sizes and rad, before loops are closed."""
LIMBS_OF_LOOP = 2


def direct_by_conditions(record: MechanismRecord, inputs: FloatArray, *, crossed: bool = False) -> LoopSolutions:
    """All assemblies at printed inputs (n,) of a platform on limbs; not complete where their quadrics leave it free.

    Parallelograms of hinges stay such, unless `crossed` ones are asked for too.

    >>> from assur.model.registry import load_record
    >>> legs = np.array([1.02, 0.64, 1.06, 1.48, 1.34, 0.77])
    >>> solutions = direct_by_conditions(load_record("gough_stewart"), legs)
    >>> len(solutions.joints), solutions.right.split(":")[0]
    (18, '6 quadrics that limbs hold the platform to')
    """
    question = PositionQuestion(record, "direct", inputs)
    try:
        limbs = [held_limb(limb, question.locked) for limb in limbs_of(record, crossed=crossed)]
        known = _by_link(question, limbs) or _by_link(question, limbs_of_middle(limbs)) or _single_loop(question, limbs)
    except (NotSerialError, MovingLimbError, UncertainConditionsError) as error:
        return unsolved(record, False, f"not proved, since {error}")
    return known or unsolved(record, False, f"not proved, since {OPEN}")


def _by_link(question: PositionQuestion, limbs: Sequence[Limb] | None) -> LoopSolutions | None:
    """By all poses of the link where limbs meet."""
    if limbs is None:
        return None
    size = characteristic_length(question.record)
    conditions = joined(limb_conditions(limb, size) for limb in limbs)
    poses = poses_under(conditions, size)
    if poses is None:
        return None
    sets = [[_sound(closed_limb(limb, frame, size)) for limb in limbs] for frame in poses.frames]
    right = f"{poses.right(conditions)}; then each limb alone"
    return _closed(question, sets, right, poses.complex, sure=poses.sure)


def _single_loop(question: PositionQuestion, limbs: Sequence[Limb]) -> LoopSolutions | None:
    """Two series of which neither says enough of the platform."""
    series = [limb for limb in limbs if isinstance(limb, SerialLimb)]
    if len(limbs) != LIMBS_OF_LOOP or len(series) != LIMBS_OF_LOOP:
        return None
    loop = loop_of(*series)
    turned = [motion.index for motion in loop.motions]  # the platform may be turned where no point is elsewhere
    solutions = closed_series(loop, (np.eye(3), np.zeros(3)), turned)
    right = f"its one loop by the middle link: {solutions.roots} complex assemblies"
    return _closed(question, [[_sound(solutions)]], right, solutions.roots, sure=True)


def _closed(
    question: PositionQuestion, sets: Sequence[Sequence[LimbSolutions]], right: str, looked: int, *, sure: bool
) -> LoopSolutions:
    """The assemblies of all choices of one way a limb, for each pose."""
    starts = [row for limbs in sets for row in _assemblies(question.record, limbs, question.locked)]
    values = np.array(starts).reshape(-1, len(question.record.coordinates))
    values = values[distinct(question.record, values)]  # a link may stand in two ways in which no joint is elsewhere
    joints = question.closed(values)
    if not sure or len(joints) != len(values):
        return LoopSolutions(joints, False, f"not proved, since roots are too near to tell them: {right}", looked)
    return LoopSolutions(joints, True, right, looked)


def _sound(solutions: LimbSolutions) -> LimbSolutions:
    """Those that close: a limb with drives held may miss a frame that its conditions allow."""
    near = solutions.bent < AS_HELD
    return replace(solutions, values=solutions.values[near], bent=solutions.bent[near])


def _assemblies(record: MechanismRecord, limbs: Sequence[LimbSolutions], held: Mapping[int, float]) -> list[FloatArray]:
    """Joint values (n,) of all choices of one way a limb, drives as they are held."""
    rows = []
    for chosen in product(*([(own.indices, values) for values in own.values] for own in limbs)):
        row = home_values(record).copy()
        for indices, values in chosen:
            row[list(indices)] = values
        row[list(held)] = [*held.values()]
        rows.append(row)
    return rows
