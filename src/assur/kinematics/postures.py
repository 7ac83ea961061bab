"""Postures: every pose at a configuration's inputs, or every set of inputs at its pose, and which of them it is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.border import inputs_of
from assur.kinematics.closure import assemble
from assur.kinematics.configurations import SAME, places
from assur.kinematics.modes import Problem
from assur.kinematics.pose import pose_of
from assur.kinematics.position import direct, inverse
from assur.kinematics.status import Status
from assur.kinematics.turns import periodic
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Posture:
    """One solution as an assembly.

    Attributes:
        label: the signs or the number that name it.
        values: (n,) joint values with loops closed to the last digits, each angle within half a turn of the
            configuration's.
        status: of the solution.
        candidate: its place among the candidates of the answer; None where it is none of them.
    """

    label: str
    values: FloatArray
    status: Status
    candidate: int | None


@dataclass(frozen=True, eq=False)
class Postures:
    """The postures of one problem at a configuration.

    Attributes:
        listed: all of them, in the order of the answer, but for those whose loops do not close.
        place: which of them the configuration itself is, with its joint values as they are; None where it is none (an
            arc of a self-motion, a crossed parallelogram).
        answer: the solutions, with the right by which they are all.
    """

    listed: tuple[Posture, ...]
    place: int | None
    answer: SolutionSet

    @property
    def current(self) -> Posture | None:
        """The one that the configuration is."""
        return None if self.place is None else self.listed[self.place]

    @property
    def others(self) -> tuple[Posture, ...]:
        """Those that it is not."""
        return tuple(item for k, item in enumerate(self.listed) if k != self.place)


def postures(record: MechanismRecord, values: FloatArray, problem: Problem) -> Postures:
    """Postures at an assembly (n,): of the direct problem at its inputs, or of the inverse one at its pose.

    The assembly is the nearest of them, where all its joints, its platform and its inputs are within
    `assur.kinematics.search.SAME` of that one; a rod that spins about its own line stands where it stood.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> found = postures(record, home_values(record), "direct")
    >>> [item.label for item in found.listed], found.current.label, found.answer.complete
    (['+', '-'], '+', True)
    """
    held, pose = (record.input_indices, None) if problem == "direct" else ((), pose_of(record, values))
    answer = direct(record, inputs_of(record, values)) if pose is None else inverse(record, pose)
    rows = np.flatnonzero(answer.exists)
    if not len(rows):
        return Postures((), None, answer)
    joints = answer.joints[rows]
    away = np.linalg.norm(places(record, joints) - places(record, values[None]), axis=1)
    nearest = int(np.argmin(away))
    place = nearest if away[nearest] <= SAME else None
    found = assemble(record, joints, held=held, poses=pose, near=True)
    kept = [k for k, closed in enumerate(found.closed) if closed or k == place]
    listed = [
        Posture(
            str(answer.labels[rows[k]]),
            values if k == place else unwound(record, found.values[k], values),
            Status(int(answer.status[rows[k]])),
            int(rows[k]),
        )
        for k in kept
    ]
    return Postures(tuple(listed), None if place is None else kept.index(place), answer)


def unwound(record: MechanismRecord, values: FloatArray, near: FloatArray) -> FloatArray:
    """Joint values (n,) whose periodic angles are within half a turn of others'; screws and balls stay as they are.

    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> unwound(record, np.full(5, 7.0), np.zeros(5)).round(4).tolist()
    [0.7168, 0.7168, 0.7168, 0.7168, 0.7168]
    """
    return np.where(periodic(record), values - 2 * np.pi * np.round((values - near) / (2 * np.pi)), values)
