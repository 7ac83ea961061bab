"""The answers of `assur doctor`, `assur cache` and `assur demo`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from assur.results.answers.answer import Answer, named


@dataclass(frozen=True)
class Check:
    """One thing that was looked at; a "note" is worth knowing, a "fault" makes the doctor fail."""

    what: str
    answer: Literal["ok", "note", "fault"]
    outcome: str = named("found")


@dataclass(frozen=True)
class InstallationAnswer(Answer):
    """What is installed, and whether its numbers hold."""

    python: str
    platform: str
    checks: tuple[Check, ...]
    faults: int


@dataclass(frozen=True)
class KeptSize:
    """How many entries, and how large."""

    entries: int
    bytes: int


@dataclass(frozen=True)
class KeptKind(KeptSize):
    """What is kept of one kind."""

    name: str
    what: str


@dataclass(frozen=True)
class CacheAnswer(Answer):
    """What is kept for the next start."""

    folder: str
    limit: int
    bytes: int
    kinds: tuple[KeptKind, ...]
    removed: KeptSize


@dataclass(frozen=True)
class Claim:
    """A statement, whether it holds, and what was found when it was checked."""

    section: str
    claim: str
    holds: bool
    outcome: str = named("found")


@dataclass(frozen=True)
class DemonstrationAnswer(Answer):
    """The claims of the demonstration, and the files that it wrote."""

    mechanism: str
    claims: tuple[Claim, ...]
    failed: int
    files: tuple[str, ...]
    seconds: float
