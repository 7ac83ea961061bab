"""The joint graph's own answers to a few problems: what its solvers find, the closed form must have found."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import joint_scales
from assur.kinematics import border
from assur.kinematics.closure import RANK_GAP, assemble
from assur.kinematics.contract.completeness import missing
from assur.kinematics.contract.mismatch import Mismatch
from assur.kinematics.contract.solutions import Solutions, solves
from assur.kinematics.loops.loops import solve_by_loops
from assur.kinematics.modes import Problem
from assur.kinematics.pose import pose_of
from assur.kinematics.rates.motions import motions
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]

STARTS = 32
"""Of a search, where the loops cannot be solved in turn for all their roots."""
STEPS = 40


def lacking(solutions: Solutions, count: int, random: np.random.Generator) -> list[Mismatch]:
    """Solutions of the joint graph to so many problems of each kind that the closed form lacks.

    Args:
        solutions: solutions of the closed form; the problems are theirs.
        count: how many problems of each kind.
        random: for where a search begins.
    """
    record = solutions.record
    chosen = random.permutation(len(solutions))[:count]
    rows = [
        answer
        for joints in solutions.joints[chosen]
        for problem in ("direct", "inverse")
        if solves(record, problem)
        for answer in _answers(record, problem, joints, random)
    ]
    if not rows:
        return []
    joints = np.array(rows)
    return missing(solutions, joints, motions(record, joints, RANK_GAP))


def _answers(
    record: MechanismRecord, problem: Problem, joints: FloatArray, random: np.random.Generator
) -> list[FloatArray]:
    """Assemblies (n,) of the joint graph at the inputs, or at the pose, of another assembly."""
    given = {"inputs": border.inputs_of(record, joints)} if problem == "direct" else {"pose": pose_of(record, joints)}
    turn = solve_by_loops(record, **given, crossed=False)
    if turn.complete:
        return list(turn.joints)
    scale = joint_scales(record)
    starts = joints + 2.0 * scale * random.normal(size=(STARTS, len(joints)))
    if problem == "direct":
        starts[:, list(record.input_indices)] = joints[list(record.input_indices)]
        reached = assemble(record, starts, held=record.input_indices, max_steps=STEPS)
    else:
        reached = assemble(record, starts, poses=given["pose"], max_steps=STEPS)
    return list(reached.values[reached.closed])
