"""The answers of the position problem, `assur direct` and `assur inverse`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar, Literal

from assur.results.answers.answer import AnswerOfMechanism

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
    """A pose at given inputs; `following` are the values of redundant inputs there."""

    pose: Numbers
    working_mode: str
    following: Mapping[str, float]

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
class SolvedProblem(AnswerOfMechanism):
    """A direct or an inverse problem, and whether and by what right its solutions are complete."""

    input_names: tuple[str, ...]
    complete: bool
    complete_for: str
    right: str
    limits_stated: bool


@dataclass(frozen=True)
class GivenInputs:
    """What a direct problem is given."""

    problem: ClassVar[Literal["direct"]] = "direct"
    inputs: Numbers

    @property
    def given(self) -> Numbers:
        """The inputs."""
        return self.inputs


@dataclass(frozen=True)
class GivenPose:
    """What an inverse problem is given."""

    problem: ClassVar[Literal["inverse"]] = "inverse"
    pose: Numbers

    @property
    def given(self) -> Numbers:
        """The pose."""
        return self.pose


@dataclass(frozen=True)
class PositionAnswer(SolvedProblem):
    """What is said of both problems.

    `signs` are those of a mode, in order, each with what holds where it is +. Where several solutions share them, a
    letter follows, which is given at every problem anew. `known_modes` are those that have solutions where the one that
    was asked for has none. `architecture` says so where the mechanism is architecturally singular: solutions of the
    direct problem are then single points of self-motions.
    """

    status: str
    architecture: str
    doubles: tuple[DoubleSolution, ...]
    home_by: str
    known_modes: tuple[str, ...]
    signs: Mapping[str, str]
    curves: tuple[PoseCurve, ...]
    failures: tuple[NegativeQuantity, ...]

    @property
    def of_one_mode(self) -> bool:
        """Whether one mode was asked for, and these are all that it has."""
        return not self.complete and not self.right.startswith(("not all", "not proved"))


@dataclass(frozen=True)
class DirectAnswer(GivenInputs, PositionAnswer):
    """Every pose at given inputs."""

    solutions: tuple[PoseSolution, ...]


@dataclass(frozen=True)
class LimbWays:
    """All ways in which a limb closes at a pose: the inputs of each, by name; a way may have none."""

    joints: tuple[str, ...]
    ways: tuple[Mapping[str, float], ...]


@dataclass(frozen=True)
class InverseAnswer(GivenPose, PositionAnswer):
    """All inputs at a given pose.

    Where `limbs` are listed, the solutions are all choices of one way each.
    """

    solutions: tuple[InputsSolution, ...]
    limbs: tuple[LimbWays, ...]
