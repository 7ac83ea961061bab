"""The other modes of a state: every pose at its inputs, every set of inputs at its pose, with its joint values."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.closure import assemble, characteristic_length
from assur.kinematics.modes import Problem
from assur.kinematics.position import direct, inverse
from assur.kinematics.status import relative_factors
from assur.model.joint_graph import frames
from assur.model.mechanism import MechanismRecord
from assur.numerics import rotations
from assur.page.branches import unwound
from assur.view.state import State

FloatArray = NDArray[np.float64]
SAME = 1e-6
"""Assemblies that differ by less, in rad or characteristic lengths, are one."""


@dataclass(frozen=True, eq=False)
class Choice:
    """One mode that could be current.

    Attributes:
        label: the signs or the number that name it.
        values: (n,) its joint values.
        current: whether it is the one that is shown.
        factors: relative factors of the closed form there; empty without one.
    """

    label: str
    values: FloatArray
    current: bool
    factors: dict[str, float]


@dataclass(frozen=True, eq=False)
class Modes:
    """Modes of one problem: the choices, and by what right they are all."""

    choices: tuple[Choice, ...]
    complete: bool
    right: str

    @property
    def others(self) -> tuple[Choice, ...]:
        """Those that are not shown."""
        return tuple(item for item in self.choices if not item.current)

    @property
    def current(self) -> Choice | None:
        """The one that is shown, where it is among them."""
        return next((item for item in self.choices if item.current), None)


def modes(state: State, problem: Problem) -> Modes:
    """Assembly modes ("direct") or working modes ("inverse") of a state.

    >>> from assur.model.registry import load_record
    >>> from assur.view.state import start
    >>> found = modes(start(load_record("fivebar")), "direct")
    >>> [(item.label, item.current) for item in found.choices]
    [('+', True), ('-', False)]
    """
    record = state.record
    found = direct(record, state.inputs) if problem == "direct" else inverse(record, state.pose)
    listed = np.flatnonzero(found.exists)
    if not len(listed):
        return Modes((), found.complete, found.right)
    values = assemble(record, found.joints[listed], held=record.input_indices, near=True).values
    away = np.array([_away(record, row, state.values) for row in values])
    nearest = int(np.argmin(away))
    choices = [
        Choice(
            str(found.labels[k]),
            state.values if here else unwound(record, row, state.values),
            here,
            _factors(record, found, int(k)),
        )
        for place, (k, row) in enumerate(zip(listed, values, strict=True))
        for here in [place == nearest and bool(away[place] <= SAME)]
    ]
    return Modes(tuple(choices), found.complete, found.right)


def _away(record: MechanismRecord, first: FloatArray, second: FloatArray) -> float:
    """How far joints and platform of two assemblies (n,) are from one another, in characteristic lengths.

    A rod that only spins about its own line stands where it stood.
    """
    length = characteristic_length(record)
    one, other = frames(record, first), frames(record, second)
    gaps = [
        np.linalg.norm(one[link][0] @ at + one[link][1] - other[link][0] @ at - other[link][1]) / length
        for joint in record.joints.values()
        for link, at in ((joint.parent, joint.at), (joint.child, joint.child_at))
    ]
    turn = one[record.platform.link][0] @ other[record.platform.link][0].T
    return float(max(*gaps, np.linalg.norm(rotations.to_vector(turn))))


def _factors(record: MechanismRecord, found: SolutionSet, k: int) -> dict[str, float]:
    form = record.closed_form
    if form is None or any(item.name not in found.factors for item in form.factor_list):
        return {}
    relative = relative_factors(record, found.factors)
    return {name: float(value[k]) for name, value in relative.items()}
