"""`Mechanism`: a record with its analyses as methods, each one line to the function that does the work.

Analyses that need slow libraries are imported where they are called.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.kinematics import closure, position, velocity
from assur.kinematics.home import home_values
from assur.kinematics.solutions import SolutionSet
from assur.model import registry
from assur.model.joint_graph import Frame, frames
from assur.model.mechanism import MechanismRecord
from assur.model.points import point
from assur.singularity.verdict import Verdict, verdict

if TYPE_CHECKING:
    from assur.performance.dexterity import Dexterity
    from assur.workspace.region import Workspace

FloatArray = NDArray[np.float64]


class Mechanism(MechanismRecord):
    """A mechanism, from `assur.load`. Poses are (..., m), inputs (..., n), lengths in its unit, angles in rad."""

    def with_parameters(self, /, **values: float) -> Self:
        """The same mechanism with other dimensions, checked as those of the file are."""
        return registry.with_parameters(self, **values)

    def direct(self, inputs: ArrayLike, mode: str | None = None) -> SolutionSet:
        """Every pose at inputs (..., n): see `assur.kinematics.position.direct`."""
        return position.direct(self, inputs, mode)

    def inverse(self, poses: ArrayLike, mode: str | None = None) -> SolutionSet:
        """All inputs at poses (..., m): see `assur.kinematics.position.inverse`."""
        return position.inverse(self, poses, mode)

    def velocity_map(self, poses: ArrayLike, mode: str | None = None) -> velocity.VelocityMap:
        """Jp and Jq at poses (..., m): see `assur.kinematics.velocity.velocity_map`."""
        return velocity.velocity_map(self, poses, mode)

    def acceleration(
        self,
        poses: ArrayLike,
        input_rates: ArrayLike,
        input_accelerations: ArrayLike,
        mode: str | None = None,
    ) -> tuple[FloatArray, FloatArray]:
        """Velocity and acceleration of the pose: see `assur.kinematics.velocity.acceleration`."""
        return velocity.acceleration(self, poses, input_rates, input_accelerations, mode)

    def singularity(self, pose: ArrayLike, mode: str | None = None) -> Verdict:
        """The verdict on one pose (m,): see `assur.singularity.verdict`."""
        return verdict(self, pose, mode)

    def workspace(self, mode: str | None = None, **options: Any) -> Workspace:
        """The workspace of a working mode: see `assur.workspace.region.workspace` for the options."""
        from assur.workspace.region import workspace

        return workspace(self, mode, **options)

    def dexterity(self, poses: ArrayLike, mode: str | None = None) -> Dexterity:
        """Condition index and velocity factors at poses (..., m): see `assur.performance.dexterity`."""
        from assur.performance.dexterity import dexterity

        return dexterity(self, poses, mode)

    def point(self, name: str, joint_values: FloatArray) -> FloatArray:
        """Position (..., 3) of a lettered point or of a joint: see `assur.model.points.point`."""
        return point(self, name, joint_values)

    @property
    def home_values(self) -> FloatArray:
        """Joint values (n,) of the assembled home."""
        return home_values(self)

    def frames(self, joint_values: FloatArray) -> dict[str, Frame]:
        """Frame of every link, (..., 3, 3) and (..., 3) in the base frame, at joint values (..., n)."""
        return frames(self, joint_values)

    def closure_error(self, joint_values: FloatArray) -> FloatArray:
        """Largest gap (...) over the cut joints, in length units."""
        return closure.closure_error(self, joint_values)

    def mobility(self, joint_values: FloatArray) -> closure.Mobility:
        """Rank, freedoms and redundant constraints of the joint graph at joint values (..., n)."""
        return closure.mobility(self, joint_values)


def load(name: str | Path, /, **parameters: Any) -> Mechanism:
    """A built-in mechanism by name, or one from a file, with some of its parameters changed.

    >>> load("zeng2019", l2=300).parameters["l2"].value
    300.0
    """
    record = registry.load_record(name, **parameters)
    return Mechanism(**vars(record))


def names() -> tuple[str, ...]:
    """Names of the built-in mechanisms."""
    return registry.names()
