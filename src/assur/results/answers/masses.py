"""The answer of `assur show --masses`, in SI units."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from assur.results.answers.answer import AnswerOfMechanism
from assur.results.answers.position import Numbers


@dataclass(frozen=True)
class ShownBody:
    """A link's mass, its centre, its inertia about it (xx, yy, zz, xy, xz, yz), in its frame; where they come from."""

    link: str
    mass: float
    centre: Numbers
    inertia: Numbers
    source: str


@dataclass(frozen=True)
class MassesAnswer(AnswerOfMechanism):
    """What links weigh, the base left out; `lacking` are links of which the file says nothing."""

    links: tuple[ShownBody, ...]
    payload: ShownBody | None
    gravity: Numbers
    total: float
    lacking: tuple[str, ...]
    notes: tuple[str, ...]
    units: Mapping[str, str]
