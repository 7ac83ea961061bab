"""Newton's method on the joint graph by recorded steps, for many starts that are near an assembly.

One step is a straight-line program (`assur.kinematics.newton_step`): frames, gaps, their derivative, and the least
change that closes them, by normal equations without pivots. What it leads to is looked at by the part of the program
that tells gaps alone. What does not close goes to damped least squares.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import joint_scales
from assur.joint_graph.graph_program import GraphProgram
from assur.joint_graph.programs import part, program
from assur.joint_graph.tree import joint_graph
from assur.kinematics.newton_step import NewtonStep
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, LENGTHS, QUATERNION, has_quaternion
from assur.numerics import rotations
from assur.numerics.newton import NewtonResult, iterated

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.intp]

ENOUGH = 1e-12
"""Gaps of a start that counts as closed, in characteristic lengths or rad."""
BLOCK = 2048
"""Starts that are worked on at a time: NumPy's own time is shared by many, their numbers stay in the cache."""


@dataclass(frozen=True, eq=False)
class Newton:
    """Newton's method for a mechanism; call it with starts (N, n) that are near assemblies.

    Attributes:
        record: the mechanism.
        step: what is held.
        units: what a change of one is of each joint value (n,) in rates; rad and characteristic lengths by default.
    """

    record: MechanismRecord
    step: NewtonStep
    units: FloatArray | None = None

    def __call__(self, start: FloatArray, poses: FloatArray | None = None) -> NewtonResult:
        """Joint values (N, n) with gaps in characteristic lengths or rad, at poses (N, m) where the step holds those.

        The derivative (N, n, k) is that by what is held, as `rates` has it. What is not closed has no assembly near.
        """
        given = np.empty((0, len(start))) if poses is None else targets(self.record, poses)
        program, count = self.program, len(self.record.coordinates)
        rates, look = np.empty((len(start), *self.shape)), part(program, "square")

        def step(values: FloatArray, rows: IntArray) -> tuple[FloatArray, FloatArray]:
            numbers = program(self.record, values, given[:, rows])
            rates[rows] = self._rates(numbers)
            changes = program.matrix("change", numbers, (count, 1))[:, :, 0] * joint_scales(self.record)
            return _largest(numbers[program.rows("square")]), moved(self.record, values, changes)

        def gaps(values: FloatArray, rows: IntArray) -> FloatArray:
            return _largest(look(self.record, values, given[:, rows]))

        found = iterated(step, start, ENOUGH, gaps, BLOCK)
        return NewtonResult(found.values, found.residual, found.closed, rates, found.steps)

    def rates(self, values: FloatArray, poses: FloatArray | None = None) -> FloatArray:
        """How fast joint values change (N, n, k) with what is held, at assemblies (N, n) at their own poses (N, m).

        Both without dimensions; ball joints' are angular velocities in the parent's frame.
        """
        return self._rates(self.program(self.record, values, None if poses is None else targets(self.record, poses)))

    def _rates(self, numbers: FloatArray) -> FloatArray:
        """The rates (N, n, k) that the program has told."""
        rates = self.program.matrix("rate", numbers, self.shape)
        if self.units is None:
            return rates
        scales = joint_scales(self.record) / self.units
        return rates * scales[:, None] / scales[list(self.step.held)] if self.step.held else rates * scales[:, None]

    @cached_property
    def shape(self) -> tuple[int, int]:
        """Joint values, and numbers that are held."""
        ends = [int(name.partition(",")[2]) for name in self.program.names if name.startswith("rate")]
        return len(self.record.coordinates), max(ends, default=-1) + 1

    @cached_property
    def program(self) -> GraphProgram:
        """The step's program."""
        return program(self.record, self.step, self.step.given)


def _largest(squares: FloatArray) -> FloatArray:
    return np.asarray(np.sqrt(np.max(squares, axis=0, initial=0.0)))


def moved(record: MechanismRecord, values: FloatArray, changes: FloatArray) -> FloatArray:
    """Joint values (N, n) after changes (N, n), those of ball joints by angular velocities.

    >>> from assur.model.registry import load_record
    >>> moved(load_record("fivebar"), np.zeros((1, 5)), np.array([[0.0, 0.5, 0.0, 0.0, 0.0]]))
    array([[0. , 0.5, 0. , 0. , 0. ]])
    """
    whole = changes.copy()
    balls = [range(turn.start, turn.stop) for turn in joint_graph(record).turns]
    if balls:
        whole[:, balls] = rotations.vector_rates(values[:, balls], whole[:, balls])
    return np.asarray(values + whole)


def targets(record: MechanismRecord, poses: FloatArray) -> FloatArray:
    """The numbers (12, N) of poses (N, m), in the order of `TARGETS`; what a pose leaves out is zero."""
    named = dict(zip(record.platform.pose, poses.T, strict=True))
    nothing = np.zeros(len(poses))
    if has_quaternion(record.platform.pose):
        rotation = rotations.from_quaternion(np.stack([named[name] for name in QUATERNION], axis=-1))
    elif all(name in named for name in ANGLES):
        rotation = rotations.from_angles(*(named[name] for name in ANGLES))
    else:
        phi, theta, psi = (named.get(name, nothing) for name in ANGLES)
        rotation = np.zeros((len(poses), 3, 3))
        rotation[:, 0, 0], rotation[:, 1, 0], rotation[:, 2, 0] = np.cos(phi), np.sin(phi), -np.sin(theta)
        rotation[:, 2, 1], rotation[:, 2, 2], rotation[:, 0, 1] = np.sin(psi), np.cos(psi), np.cos(theta)
    point = np.array([named.get(name, nothing) for name in LENGTHS])
    return np.concatenate([rotation.reshape(len(poses), 9).T, point])
