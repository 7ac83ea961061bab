"""The answers of `assur direct --certify` and `assur inverse --certify`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from assur.results.answers.position import GivenInputs, GivenPose, KeptLimits, Numbers, SolvedProblem


@dataclass(frozen=True)
class Bounds:
    """Proved bounds of some numbers."""

    low: Numbers
    high: Numbers


@dataclass(frozen=True)
class BoundedSolution:
    """What is said of every solution that is proved.

    `how` says by what, `left` what equations that are no part of the proof come to at most. Limits are judged in
    floating point.
    """

    mode: str
    how: str
    left: float
    limits: KeptLimits


@dataclass(frozen=True)
class ProvedPose(BoundedSolution):
    """Bounds of a pose at given inputs; of the undetermined coordinates no bounds can tell."""

    pose: Bounds
    undetermined: tuple[str, ...]
    working_mode: str

    @property
    def bounds(self) -> Bounds:
        """Of what was asked for."""
        return self.pose

    @property
    def other_mode(self) -> str:
        """The mode of the other problem."""
        return self.working_mode


@dataclass(frozen=True)
class ProvedInputs(BoundedSolution):
    """Bounds of the inputs at a given pose."""

    inputs: Bounds
    assembly_mode: str

    @property
    def bounds(self) -> Bounds:
        """Of what was asked for."""
        return self.inputs

    @property
    def other_mode(self) -> str:
        """The mode of the other problem."""
        return self.assembly_mode


@dataclass(frozen=True)
class UndecidedPlace(Bounds):
    """Where nothing is proved: a margin whose bounds hold zero, or a box of poses."""

    name: str
    unit: str
    meaning: str
    branches: int


@dataclass(frozen=True)
class CertifiedAnswer(SolvedProblem):
    """What is said of both problems."""

    proved: bool
    undecided: tuple[UndecidedPlace, ...]
    excluded: Mapping[str, int]


@dataclass(frozen=True)
class CertifiedDirect(GivenInputs, CertifiedAnswer):
    """Every pose at given inputs, proved."""

    solutions: tuple[ProvedPose, ...]


@dataclass(frozen=True)
class CertifiedInverse(GivenPose, CertifiedAnswer):
    """All inputs at a given pose, proved."""

    solutions: tuple[ProvedInputs, ...]
