"""The direct problem with redundant inputs given too: of the poses at the others, those that agree with them."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics import border
from assur.kinematics.answers.self_motion import SelfMotionCurve
from assur.kinematics.answers.solution import Failure
from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.status import Status
from assur.model.mechanism import MechanismRecord

if TYPE_CHECKING:
    from assur.kinematics.modes import Problem

FloatArray = NDArray[np.float64]

AGREEING = 1e-4
"""By how much of the characteristic length (rotations times it) a redundant input may differ from the pose that has it:
numbers copied from a table differ by some 1e-6, other assemblies by far more."""


class AgreeingSolutions(SolutionSet):
    """Candidates of the direct problem of which those exist whose redundant inputs are the given ones.

    Args:
        solutions: at the inputs that determine the mechanism.
        given: (..., d) every input of the file, those that follow last.
    """

    def __init__(self, solutions: SolutionSet, given: FloatArray) -> None:
        self.record: MechanismRecord = solutions.record
        self.problem: Problem = "direct"
        self.given = given
        self._all = solutions

    @cached_property
    def away(self) -> FloatArray:
        """How far (..., K) the redundant inputs are from the given ones, in length units; NaN without a solution."""
        drives = self.record.redundant_inputs
        given = np.broadcast_to(self.given[..., None, -len(drives) :], (*self._all.exists.shape, len(drives)))
        joints = self._all.joints.reshape(-1, self._all.joints.shape[-1])
        gaps = border.input_distance(self.record, drives, joints, given.reshape(len(joints), -1))
        return gaps.reshape(self._all.exists.shape)

    @cached_property
    def exists(self) -> NDArray[np.bool_]:
        """Whether a candidate (..., K) is a solution at the given inputs, all of them."""
        with np.errstate(invalid="ignore"):
            return np.asarray(self._all.exists & (self.away <= AGREEING * characteristic_length(self.record)))

    @property
    def overall_status(self) -> NDArray[np.int8]:
        """`Status` (...): unreachable where no pose agrees, though there are some at the other inputs."""
        dropped = ~np.any(self.exists, axis=-1) & np.any(self._all.exists, axis=-1)
        severe = np.max(np.where(self.exists, self._all.status, 0), axis=-1, initial=0)
        kept = np.where(np.any(self.exists, axis=-1), severe, self._all.overall_status)
        return np.where(dropped, Status.unreachable, kept).astype(np.int8)

    @property
    def right(self) -> str:
        """By what right the answer is complete, and how many poses do not agree."""
        if self.batch_shape or not np.any(self._all.exists):
            return self._all.right
        names = ", ".join(item.name for item in self.record.redundant_inputs)
        poses, agreeing = int(np.sum(self._all.exists)), int(np.sum(self.exists))
        nearest = "" if agreeing else f", the nearest by {np.nanmin(self.away):.3g} {self.record.unit}"
        checked = f"{agreeing} of {poses} poses at the other inputs agree with {names}{nearest}"
        return f"{self._all.right}; {checked}"

    @property
    def complete(self) -> bool:
        """Whether these are all: where those at the other inputs are."""
        return self._all.complete

    @property
    def complete_for(self) -> str:
        """The model."""
        return self._all.complete_for

    @property
    def poses(self) -> FloatArray:
        """Poses (..., K, m)."""
        return self._all.poses

    @property
    def inputs(self) -> FloatArray:
        """The inputs (..., K, n) that determine the mechanism."""
        return self._all.inputs

    @property
    def joints(self) -> FloatArray:
        """Joint values (..., K, coordinates)."""
        return self._all.joints

    @property
    def status(self) -> NDArray[np.int8]:
        """`Status` (..., K) of every candidate."""
        return self._all.status

    @property
    def labels(self) -> NDArray[np.str_]:
        """Assembly modes (..., K)."""
        return self._all.labels

    @property
    def other_labels(self) -> NDArray[np.str_]:
        """Working modes (..., K)."""
        return self._all.other_labels

    @property
    def factors(self) -> Mapping[str, FloatArray]:
        """What vanishes where a solution (..., K) is singular."""
        return self._all.factors

    @property
    def named_quantities(self) -> Mapping[str, FloatArray]:
        """What the source names (..., K)."""
        return self._all.named_quantities

    @property
    def curves(self) -> tuple[SelfMotionCurve, ...]:
        """Curves of poses at the other inputs."""
        return self._all.curves

    @property
    def failures(self) -> tuple[Failure, ...]:
        """Why there is no pose at the other inputs."""
        return self._all.failures

    @property
    def residuals(self) -> FloatArray:
        """What a solution (..., K) misses, in length units: of the loops, and of the inputs that determine it."""
        return self._all.residuals
