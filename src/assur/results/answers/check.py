"""The answer of `assur check`: every fault of a file, or what its joint graph says."""

from __future__ import annotations

from dataclasses import dataclass

from assur.errors import Problem
from assur.results.answers.answer import Answer


@dataclass(frozen=True)
class ExactAnswer:
    """What exact arithmetic says of a closed form: the bound on the error, and why nothing where nothing is proved."""

    says: str
    proved: bool
    any_dimensions: bool | None
    error: float | None
    guards_left_out: bool
    because: str


@dataclass(frozen=True)
class SoundFacts:
    """What a sound file describes.

    `redundant_inputs` follow those that determine it; `architecture` says so where the mechanism is architecturally
    singular; `unproved` are margins of a closed form that were held at places only.
    """

    links: int
    joints: int
    freedoms: int
    internal_freedoms: int
    redundant_inputs: tuple[str, ...]
    architecture: str
    closed_form: bool
    closed_form_checked: bool
    closed_form_not_run: bool
    exact: ExactAnswer | None
    unproved: tuple[str, ...]


@dataclass(frozen=True)
class CheckAnswer(Answer):
    """Every fault of a mechanism's file, what is worth a look, and facts where it is sound."""

    mechanism: str
    sound: bool
    faults: tuple[Problem, ...]
    notes: tuple[Problem, ...]
    facts: SoundFacts | None
