"""The answer of `assur crosscheck`: assur beside an engine."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from assur.results.answers.answer import Answer


@dataclass(frozen=True)
class ComparedKind:
    """The largest difference of one kind, how often it was measured, and in which mode it occurs."""

    derived: ClassVar = ("holds",)

    kind: str
    largest: float
    tolerance: float
    count: int
    mode: str
    meaning: str

    @property
    def holds(self) -> bool:
        """Whether it is within its tolerance."""
        return bool(self.largest <= self.tolerance)


@dataclass(frozen=True)
class CrossCheckAnswer(Answer):
    """What was compared with the engine; `modes`: problem -> mode -> number of solutions."""

    derived: ClassVar = ("holds",)

    mechanism: str
    engine: str
    version: str
    samples: int
    seed: int
    modes: Mapping[str, Mapping[str, int]]
    differences: tuple[ComparedKind, ...]

    @property
    def holds(self) -> bool:
        """Whether something was compared, and every difference is within its tolerance."""
        return bool(self.differences) and all(item.holds for item in self.differences)
