"""What every answer shares: fields that may be absent, entries that stand among them, and how an answer came about."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from enum import Enum
from typing import Any, Literal

from assur.errors import Problem

SPREAD, NAME = "spread", "name"


class Absent(Enum):
    """Of a field that is left out where it says nothing."""

    ABSENT = "absent"


ABSENT = Absent.ABSENT


def spread() -> Any:
    """A field with a mapping whose entries stand among the other fields in JSON, as `z` of a section at z."""
    return field(metadata={SPREAD: True})


def named(name: str) -> Any:
    """A field that has another name in JSON."""
    return field(metadata={NAME: name})


def entries(value: Any) -> dict[str, Any]:
    """The fields of a dataclass as JSON has them: none that is absent, and those of a mapping that is spread.

    >>> from collections.abc import Mapping
    >>> @dataclass(frozen=True)
    ... class Cut:
    ...     at: Mapping[str, float] = spread()
    ...     note: str | Absent = ABSENT
    >>> entries(Cut({"z": 450.0}))
    {'z': 450.0}
    """
    said: dict[str, Any] = {}
    for attribute in fields(value):
        part = getattr(value, attribute.name)
        if attribute.metadata.get(SPREAD):
            said.update(part)
        elif part is not ABSENT:
            said[attribute.metadata.get(NAME, attribute.name)] = part
    return said | {name: getattr(value, name) for name in derived_of(type(value))}


def derived_of(kind: type) -> tuple[str, ...]:
    """Properties of a class that stand in JSON too, those that its `derived` names."""
    return getattr(kind, "derived", ())


@dataclass(frozen=True)
class Answer:
    """What a command says; each kind of answer is a class."""


@dataclass(frozen=True)
class AnswerOfMechanism(Answer):
    """What answers about one mechanism begin with: its name, its units, the coordinates of its pose."""

    mechanism: str
    unit: str
    angle: str
    coordinates: tuple[str, ...]


@dataclass(frozen=True)
class NotRun:
    """Python beside a mechanism's file that was not run: where, why it would have had to, what answers instead."""

    file: str
    line: int | None
    reason: str
    instead: str

    def __str__(self) -> str:
        place = f"{self.file}:{self.line}" if self.line else self.file
        return f"{place}: {self.reason}; not run: {self.instead}"


@dataclass(frozen=True)
class Circumstances:
    """What may stand in every answer of how it came about."""

    interrupted: Literal[True] | Absent = ABSENT
    interrupted_at: str | Absent = ABSENT
    code_not_run: tuple[NotRun, ...] | Absent = ABSENT


@dataclass(frozen=True)
class NoAnswerReason:
    """Why there is no answer."""

    message: str
    hint: str
    exit_code: int
    problems: tuple[Problem, ...]


@dataclass(frozen=True)
class NoAnswer:
    """In place of an answer, where a command was refused or ended."""

    error: NoAnswerReason
