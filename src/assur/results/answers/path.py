"""The answer of `assur follow`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from assur.results.answers.answer import Answer, AnswerOfMechanism
from assur.results.answers.position import Numbers


@dataclass(frozen=True)
class NamedModes:
    """Both modes of a configuration."""

    working: str
    assembly: str


@dataclass(frozen=True)
class StoppedPath:
    """Where a path stopped, what stopped it, and that in words."""

    kind: str
    share: float
    pose: Numbers
    inputs: Numbers
    quantity: str
    value: float
    turns_back: bool
    gap: float | None
    factor: str
    meaning: str
    size: float | None
    text: str


@dataclass(frozen=True)
class PathAnswer(AnswerOfMechanism):
    """A path by shares of the way, joint values in rad and lengths; smallest singular values, modes at both ends."""

    prescribed: str
    input_names: tuple[str, ...]
    joint_names: tuple[str, ...]
    shares: Numbers
    poses: tuple[Numbers, ...]
    inputs: tuple[Numbers, ...]
    joints: tuple[Numbers, ...]
    smallest: Mapping[str, Numbers]
    modes: tuple[NamedModes, ...]
    remark: str
    stopped: StoppedPath | None


@dataclass(frozen=True)
class NoPath(Answer):
    """Why there is no path."""

    mechanism: str
    status: str
    why: str
