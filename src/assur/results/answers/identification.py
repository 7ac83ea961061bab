"""The answer of `assur identify`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from assur.results.answers.answer import AnswerOfMechanism
from assur.results.answers.position import Numbers


@dataclass(frozen=True)
class NotTold:
    """A combination of parameters that moves nothing that is measured: in words, and what each is times."""

    words: str
    combination: Mapping[str, float]


@dataclass(frozen=True)
class IdentificationAnswer(AnswerOfMechanism):
    """Which dimensions, offsets of inputs, and places of the measuring frame measured poses tell, to first order.

    `parameters` are all of them, inputs for their offsets; `strained` are dimensions that are none, since alone they do
    not assemble. `rank` of their combinations are told, `unidentifiable` is a basis of the others. `base_parameters`
    are what is told in truth, by a parameter of each: what acts like it counts. `observability` has O1 to O5 of Sun and
    Hollerbach 2008 for what is told.
    """

    mode: str
    poses: tuple[Numbers, ...]
    measured: tuple[str, ...]
    parameters: tuple[str, ...]
    strained: tuple[str, ...]
    rank: int
    unidentifiable: tuple[NotTold, ...]
    base_parameters: Mapping[str, Mapping[str, float]]
    observability: Mapping[str, float]
    units: Mapping[str, str]
