"""The form of a topology file: which keys there are, and what stands in each."""

from __future__ import annotations

import re
from typing import Annotated, get_args

from pydantic import BeforeValidator, Field, PlainValidator

from assur.model.file.kind import KIND
from assur.model.file.schema import Entry
from assur.model.file.values import Format, MechanismName, refuse, shown
from assur.model.topology_description import Counts, Mode

_COUNTS = re.compile(r"t([0-3]) r([0-3])")
_ACTUATOR = re.compile(r"([1-9]\d*)\.([1-9]\d*)")


def _kind(value: object) -> object:
    if value != KIND:
        raise refuse(shown(value), f'allowed: "{KIND}"')
    return value


def _mode(value: object) -> object:
    if value not in get_args(Mode):
        raise refuse(shown(value), f"allowed: {' or '.join(get_args(Mode))}")
    return value


def _text(value: object) -> object:
    if not isinstance(value, str):
        raise refuse(shown(value), "allowed: a text in quotes")
    return value


def _count(value: object) -> object:
    if isinstance(value, bool) or not isinstance(value, int) or value < 0:
        raise refuse(shown(value), "allowed: a whole number, 0 or more")
    return value


def _counts(value: object) -> object:
    """(t, r) of "t3 r0"."""
    found = _COUNTS.fullmatch(value) if isinstance(value, str) else None
    if found is None:
        raise refuse(shown(value), 'allowed: numbers of translations and rotations, each 0 to 3: "t3 r0"')
    return int(found[1]), int(found[2])


def _actuator(value: object) -> object:
    """(limb, joint) of "2.1"."""
    found = _ACTUATOR.fullmatch(value) if isinstance(value, str) else None
    if found is None:
        hint = f'write it in quotes: "{value}"' if isinstance(value, float) else ""
        raise refuse(shown(value), 'allowed: limb and joint, counted from 1: "2.1"', hint)
    return int(found[1]), int(found[2])


def _list(value: object) -> object:
    if not isinstance(value, list):
        raise refuse(shown(value), "allowed: a list [ ... ]")
    if not value:
        raise refuse("an empty list", "allowed: at least one element")
    return value


def _both(value: object) -> object:
    """Both numbers of { collapsed = 0, joint_graph = 0 }."""
    if not isinstance(value, dict) or set(value) != {"collapsed", "joint_graph"}:
        raise refuse(shown(value), "allowed: { collapsed = 0, joint_graph = 0 }, both of them")
    return _count(value["collapsed"]), _count(value["joint_graph"])


Text = Annotated[str, PlainValidator(_text)]
Count = Annotated[int, PlainValidator(_count)]
PocCounts = Annotated[Counts, PlainValidator(_counts)]
Both = Annotated[tuple[int, int], PlainValidator(_both)]
Actuator = Annotated[tuple[int, int], PlainValidator(_actuator)]


class DeclaredEntry(Entry):
    """Facts that are tested."""

    poc: PocCounts | None = None
    dim: Count | None = None
    dof: Count | None = None
    xi: Annotated[tuple[Count, ...], BeforeValidator(_list)] | None = None
    coupling_degree: Count | None = None
    limbs: Annotated[tuple[PocCounts, ...], BeforeValidator(_list)] | None = None
    limb_dims: Annotated[tuple[Count, ...], BeforeValidator(_list)] | None = None
    redundant_constraints: Both | None = None
    internal_freedoms: Both | None = None
    source: Text = ""


class TopologyEntry(Entry):
    """The whole file. What must be there is seen by the reader, so that a gap hides no other fault."""

    format: Format = None
    kind: Annotated[str, PlainValidator(_kind)] = KIND
    name: Annotated[MechanismName, BeforeValidator(_text)] = ""
    title: Text = ""
    source: Text = ""
    note: Text = ""
    chains: Annotated[tuple[Text, ...], BeforeValidator(_list)] = ()
    actuate: Annotated[tuple[Actuator, ...], BeforeValidator(_list)] = ()
    mode: Annotated[Mode, PlainValidator(_mode)] = "home"
    declared: DeclaredEntry = Field(default_factory=DeclaredEntry)
