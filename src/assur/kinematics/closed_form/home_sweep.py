"""Stored sweeps on the joint graph: home's mode, where there is no closed form."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from importlib.metadata import version
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.border import drives_of
from assur.kinematics.closed_form.blocks import FloatArray
from assur.kinematics.closed_form.grid_sweep import GridSweep
from assur.kinematics.following.from_home import followed_together
from assur.kinematics.pose import pose_of
from assur.kinematics.rates.finite_motion import classify_at
from assur.kinematics.status import Status
from assur.results.store.layout import block_length

HOME = "home"
"""Stands for the mode of home."""
LONGEST = 8192
"""Places in a block: so many that those of a block that are followed from home are worked on together."""


@dataclass(frozen=True, eq=False)
class HomeSweep(GridSweep):
    """A sweep in which poses or inputs are followed to from home, straight or by way of their neighbours in a block."""

    @property
    def formulas(self) -> dict[str, str]:
        """The mechanism's file, in a few letters, and the version."""
        text = self.record.file.read_bytes()
        return {"formulas": hashlib.blake2b(text, digest_size=12).hexdigest(), "version": version("assur")}

    @property
    def how(self) -> str:
        """What is not proved."""
        return (
            "followed on the joint graph from home, straight or by way of neighbours; one that is not reached so is "
            "undecided: another way may lead there"
        )

    @property
    def existence(self) -> str:
        """That a pose was reached."""
        return "whether home leads there, straight or by way of neighbours"

    @property
    def engine(self) -> str:
        """The joint graph."""
        return "the joint graph, followed from home"

    @property
    def block_length(self) -> int:
        """Places in a block."""
        return block_length(self.grid.size, LONGEST, LONGEST)

    def answers(self, given: FloatArray) -> dict[str, NDArray[Any]]:
        """What is kept of poses or inputs (m, b), angles in rad, and whether each was reached (b,)."""
        if self.problem == "inverse":
            joints, reached = followed_together(self.record, given.T)
            found = {"exists": reached, "inputs": drives_of(self.record, joints).T}
        else:
            joints, reached = followed_together(self.record, given.T, "inputs")
            found = {"exists": reached, "poses": np.full((len(self.record.platform.pose), len(joints)), np.nan)}
            found["poses"][:, reached] = pose_of(self.record, joints[reached]).T
        found["status"] = np.full(reached.shape, Status.undecided, dtype=np.int8)
        if np.any(reached):
            found["status"][reached] = classify_at(self.record, joints[reached])
        return found
