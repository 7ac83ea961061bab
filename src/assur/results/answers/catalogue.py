"""The answers of `assur list`, `assur show` and `assur schema`: what there is, and what one mechanism is."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from assur.results.answers.answer import Answer, spread
from assur.results.answers.position import Numbers


@dataclass(frozen=True)
class SchemaAnswer(Answer):
    """A JSON Schema."""

    schema: Mapping[str, Any] = spread()


@dataclass(frozen=True)
class ListedMechanism:
    """A mechanism that is built in."""

    name: str
    title: str
    source: str
    unit: str
    angle: str
    inputs: tuple[str, ...]
    coordinates: tuple[str, ...]
    closed_form: bool


@dataclass(frozen=True)
class ListedTopology:
    """A mechanism that is known by its topology alone."""

    name: str
    title: str
    source: str
    limbs: str
    chains: tuple[str, ...]
    mode: str


@dataclass(frozen=True)
class LeftOutMechanism:
    """A mechanism that is not there, and why."""

    name: str
    title: str
    source: str
    reason: str


@dataclass(frozen=True)
class CatalogueAnswer(Answer):
    """The built-in mechanisms and topologies."""

    mechanisms: tuple[ListedMechanism, ...]
    topologies: tuple[ListedTopology, ...]
    left_out: tuple[LeftOutMechanism, ...]


@dataclass(frozen=True)
class ShownParameter:
    """A dimension."""

    name: str
    value: float
    unit: str
    meaning: str
    sign: str


@dataclass(frozen=True)
class ShownLink:
    """A link."""

    name: str
    meaning: str


@dataclass(frozen=True)
class ShownJoint:
    """A joint, and of each of its values whether it is an "angle" or a "length"."""

    name: str
    alias: str
    type: str
    kinds: tuple[str, ...]
    parent: str
    child: str


@dataclass(frozen=True)
class ShownInput:
    """An input and its joint; whether it is redundant, and follows those that determine the mechanism."""

    name: str
    joint: str
    kind: str
    redundant: bool


@dataclass(frozen=True)
class ShownModes:
    """By problem: name of a sign -> of what it is one; and the file's modes."""

    working: Mapping[str, str]
    assembly: Mapping[str, str]
    default_working: str
    default_assembly: str


@dataclass(frozen=True)
class ShownHome:
    """Home: the values of each joint, the platform's point, and the gap that is left."""

    joints: Mapping[str, Numbers]
    platform_point: Numbers
    residual: float


@dataclass(frozen=True)
class ShownMobility:
    """Freedoms without internal ones, and the rank of the closure of the whole joint graph, at home."""

    freedoms: int
    internal: int
    rank: int
    redundant: int


@dataclass(frozen=True)
class ShownClosedForm:
    """For which model a closed form is complete, and why not for the joint graph."""

    complete_for: str
    reduced_because: str


@dataclass(frozen=True)
class MechanismAnswer(Answer):
    """One mechanism, as its file says and as its joint graph counts."""

    mechanism: str
    title: str
    source: str
    file: str
    unit: str
    angle: str
    coordinates: tuple[str, ...]
    orientation: str
    platform: str
    base: str
    parameters: tuple[ShownParameter, ...]
    links: tuple[ShownLink, ...]
    joints: tuple[ShownJoint, ...]
    inputs: tuple[ShownInput, ...]
    modes: ShownModes
    box: Mapping[str, Numbers]
    home: ShownHome
    mobility: ShownMobility
    closed_form_not_run: bool
    closed_form: ShownClosedForm | None
