"""The answers of `assur singularity`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from assur.results.answers.answer import AnswerOfMechanism
from assur.results.answers.position import NegativeQuantity, Numbers


@dataclass(frozen=True)
class ConfigurationAnswer(AnswerOfMechanism):
    """What one configuration is: its kind, every factor, and the ranks of the joint graph.

    `failures` say why the mode does not reach the pose, where it does not.
    """

    pose: Numbers
    mode: str
    kind: str
    near: bool
    reduced_kind: str
    closest: str
    factors: Mapping[str, float | None]
    relative: Mapping[str, float | None]
    det_jp: float | None
    det_jq: float | None
    condition: float | None
    rank: int | None
    generic_rank: int | None
    freedoms: int | None
    types: tuple[str, ...]
    platform_gains: bool | None
    gap: float | None
    home: bool | None
    home_by: str
    known_modes: tuple[str, ...]
    characteristic_length: float | None
    failures: tuple[NegativeQuantity, ...]


@dataclass(frozen=True)
class ListedFactor:
    """A factor of det Jp or det Jq: what it means where it is zero, and the scale that it is judged against."""

    name: str
    kind: str
    meaning: str
    unit: str
    scale: float


@dataclass(frozen=True)
class SingularLocus:
    """Where a parallel factor vanishes inside the workspace box."""

    factor: str
    area: float | None
    everywhere: bool
    meaning: str


@dataclass(frozen=True)
class ListedExample:
    """A configuration at which a factor is zero."""

    factor: str
    kind: str
    mode: str
    pose: Numbers
    inputs: Numbers
    in_box: bool | None


@dataclass(frozen=True)
class SingularityAnswer(AnswerOfMechanism):
    """Where a mechanism is singular; groups of factors that are zero together lose a rank, or move the platform."""

    mode: str
    factors: tuple[ListedFactor, ...]
    constraint: tuple[tuple[str, ...], ...]
    self_motion: tuple[tuple[str, ...], ...]
    loci: tuple[SingularLocus, ...]
    examples: tuple[ListedExample, ...]
