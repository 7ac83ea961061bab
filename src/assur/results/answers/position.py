"""The answers of the position problem, `assur direct` and `assur inverse`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar, Literal

from assur.results.answers.answer import Answer

Numbers = Sequence[float]


@dataclass(frozen=True)
class ExceededLimit:
    """A limit of the file that a solution exceeds, and by how much, in `unit`."""

    limit: str
    joint: str
    value: float
    low: float
    high: float
    by: float
    unit: str


@dataclass(frozen=True)
class KeptLimits:
    """Whether the limits of the file are kept (null where it states none), and each that is not."""

    within: bool | None
    outside: tuple[ExceededLimit, ...]


@dataclass(frozen=True)
class OpenLoop:
    """The loop that a solution leaves open most, the joint at which its gap was measured, and the gap."""

    loop: str
    joint: str
    gap: float


@dataclass(frozen=True)
class ListedSolution:
    """What is said of every solution.

    `home` is whether it is that of home's mode, null where nobody knows; `parasitic` are the platform's coordinates
    that the pose leaves out and that move; `angles` says which angles count where not each does.
    """

    mode: str
    residual: float
    status: str
    open_loop: OpenLoop | None
    limits: KeptLimits
    angles: str
    parasitic: Mapping[str, float]
    home: bool | None


@dataclass(frozen=True)
class PoseSolution(ListedSolution):
    """A pose at given inputs."""

    pose: Numbers
    working_mode: str

    @property
    def numbers(self) -> Numbers:
        """What was asked for."""
        return self.pose

    @property
    def other_mode(self) -> str:
        """The mode of the other problem."""
        return self.working_mode


@dataclass(frozen=True)
class InputsSolution(ListedSolution):
    """The inputs at a given pose."""

    inputs: Numbers
    assembly_mode: str

    @property
    def numbers(self) -> Numbers:
        """What was asked for."""
        return self.inputs

    @property
    def other_mode(self) -> str:
        """The mode of the other problem."""
        return self.assembly_mode


@dataclass(frozen=True)
class DoubleSolution:
    """Two solutions that are one, or too near to tell."""

    modes: tuple[str, str]
    apart: float


@dataclass(frozen=True)
class PoseCurve:
    """Poses (9, m) on a curve on which the platform moves while every input stands still."""

    parameter: str
    interval: Numbers
    mode: str
    poses: tuple[Numbers, ...]


@dataclass(frozen=True)
class NegativeQuantity:
    """Why branches do not exist: a quantity that is negative, where it comes nearest to zero."""

    quantity: str
    value: float | None
    unit: str
    meaning: str
    branches: int


@dataclass(frozen=True)
class PositionAnswer(Answer):
    """What is said of both problems."""

    mechanism: str
    unit: str
    angle: str
    coordinates: tuple[str, ...]
    input_names: tuple[str, ...]
    status: str
    complete: bool
    complete_for: str
    right: str
    limits_stated: bool
    doubles: tuple[DoubleSolution, ...]
    home_by: str
    curves: tuple[PoseCurve, ...]
    failures: tuple[NegativeQuantity, ...]


@dataclass(frozen=True)
class DirectAnswer(PositionAnswer):
    """Every pose at given inputs."""

    problem: ClassVar[Literal["direct"]] = "direct"
    inputs: Numbers
    solutions: tuple[PoseSolution, ...]

    @property
    def given(self) -> Numbers:
        """What the problem is given."""
        return self.inputs


@dataclass(frozen=True)
class InverseAnswer(PositionAnswer):
    """All inputs at a given pose."""

    problem: ClassVar[Literal["inverse"]] = "inverse"
    pose: Numbers
    solutions: tuple[InputsSolution, ...]

    @property
    def given(self) -> Numbers:
        """What the problem is given."""
        return self.pose
