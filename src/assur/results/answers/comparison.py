"""The answer of `assur crosscheck`: assur beside an engine."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from assur.results.answers.answer import Answer


@dataclass(frozen=True)
class ComparedKind:
    """The largest difference of one kind, how often it was measured, and in which mode it occurs."""

    kind: str
    largest: float
    tolerance: float
    count: int
    mode: str
    meaning: str
    holds: bool


@dataclass(frozen=True)
class CrossCheckAnswer(Answer):
    """What was compared with the engine; `modes`: problem -> mode -> number of solutions."""

    mechanism: str
    engine: str
    version: str
    samples: int
    seed: int
    holds: bool
    modes: Mapping[str, Mapping[str, int]]
    differences: tuple[ComparedKind, ...]
