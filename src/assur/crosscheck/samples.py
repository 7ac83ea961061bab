"""Configurations to compare at: every mode of both problems, at random poses and at inputs that reach one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import joint_scales
from assur.kinematics import border
from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.closure import assemble
from assur.kinematics.home import home_values
from assur.kinematics.modes import Problem
from assur.kinematics.pose import pose_of
from assur.kinematics.position import direct, inverse
from assur.kinematics.status import Status
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
SPREAD = 0.2
"""How far joints are spread about home, in rad and in characteristic lengths, where there is no closed form or box."""

ROUNDS = 20


@dataclass(frozen=True, eq=False)
class SolvedConfiguration:
    """One solution: the problem that it answers, its mode there, and the working mode.

    `pose` (m,), `inputs` (n,) and `joints` (coordinates,) are in lengths and rad.
    """

    problem: Problem
    mode: str
    working_mode: str
    pose: FloatArray
    inputs: FloatArray
    joints: FloatArray
    status: Status


def configurations(record: MechanismRecord, samples: int, rng: np.random.Generator) -> list[SolvedConfiguration]:
    """Every solution at random poses (inverse), and at the inputs of one solution at each of them (direct).

    Poses are drawn until `samples` of them are reached, or `ROUNDS` times as many have been drawn.

    >>> from assur.model.registry import load_record
    >>> found = configurations(load_record("fivebar"), 3, np.random.default_rng(0))
    >>> sorted({(item.problem, item.mode) for item in found if item.problem == "direct"})
    [('direct', '+'), ('direct', '-')]
    """
    reached: list[list[SolvedConfiguration]] = []
    for _ in range(ROUNDS):
        poses = _poses(record, samples, rng)
        if len(poses):
            reached += [items for items in _listed(inverse(record, poses)) if items]
        if len(reached) >= samples:
            break
    reached = reached[:samples]
    if not reached:
        return []
    inputs = np.stack([_one_of(items, rng).inputs for items in reached])
    return [item for items in (*reached, *_listed(direct(record, inputs))) for item in items]


def _one_of(items: list[SolvedConfiguration], rng: np.random.Generator) -> SolvedConfiguration:
    """Any of the regular ones, where there are some: from a self-motion the direct problem has curves, not poses."""
    regular = [item for item in items if item.status == Status.regular] or items
    return regular[int(rng.integers(len(regular)))]


def _poses(record: MechanismRecord, samples: int, rng: np.random.Generator) -> FloatArray:
    """Random poses (at most samples, m): from the file's box, else of assemblies near home, which are all reached.

    Without a closed form a pose out of reach costs a whole search for every assembly that it could have had.
    """
    pose = record.platform.pose
    if record.closed_form is not None and all(name in record.box for name in pose):
        low, high = np.array([record.box[name] for name in pose]).T
        return border.checked_poses(record, rng.uniform(low, high, size=(samples, len(pose))))
    units = joint_scales(record)
    near = assemble(record, home_values(record) + SPREAD * units * rng.uniform(-1, 1, size=(samples, len(units))))
    return pose_of(record, near.values[near.closed])


def _listed(solutions: SolutionSet) -> list[list[SolvedConfiguration]]:
    """The solutions of each problem of a batch (N,)."""
    rows: list[list[SolvedConfiguration]] = [[] for _ in solutions.given]
    for row, column in zip(*np.nonzero(solutions.exists), strict=True):
        mode, other = str(solutions.labels[row, column]), str(solutions.other_labels[row, column])
        rows[row].append(
            SolvedConfiguration(
                solutions.problem,
                mode,
                other if solutions.problem == "direct" else mode,
                solutions.poses[row, column],
                solutions.inputs[row, column],
                solutions.joints[row, column],
                Status(int(solutions.status[row, column])),
            )
        )
    return rows
