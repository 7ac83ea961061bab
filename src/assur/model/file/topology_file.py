"""Reads a topology file: chains of joints in the plain form, what is actuated, what is declared."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from assur.errors import KeyPath, UsageError
from assur.joints.catalogue import BY_LETTER
from assur.model.file.description import description_text
from assur.model.file.faults import Faults, listed, nearest
from assur.model.file.kind import is_mechanism
from assur.model.file.toml_source import read_toml
from assur.model.file.topology_schema import DeclaredEntry, TopologyEntry
from assur.model.file.values import shown
from assur.model.topology_description import Declared, TopologyDescription
from assur.topology.chains import Chain, ChainJoint, Parallelogram
from assur.topology.notation import NotationError, parse_chains

ACTUATED = tuple(letter for letter, joint_type in BY_LETTER.items() if joint_type.axial)
"""Letters of the joints that may be actuated; of a C it is the translation."""

_REQUIRED = {
    "format": "1, the format that this version reads",
    "kind": '"topology"',
    "name": "a short name: letters, digits, _ and -",
    "chains": 'a list of limbs from base to platform: ["P[x] R[x] R[x] R[x]", ...]',
}
_READABLE = dict[int, Chain]
"""Chains without a fault, by their place in the list."""


def read_topology(path: Path) -> TopologyDescription:
    """What a topology file says.

    Errors:
        MechanismFileError: the file has faults; all of them are in it.
        UsageError: there is no such file, it cannot be read, or it is that of a mechanism.
    """
    return read_topology_text(description_text(path), path)


def read_topology_text(text: str, path: Path) -> TopologyDescription:
    r"""What the text of a topology file says; `path` is what its errors name.

    Errors:
        MechanismFileError: the file has faults; all of them are in it.
        UsageError: it is the file of a mechanism with dimensions.

    Example:
        >>> text = 'format = 1\nkind = "topology"\nname = "arm"\nchains = ["R[z] R[z] P[z]"]'
        >>> [joint.type.letter for joint in read_topology_text(text, Path("arm.toml")).chains[0].joints]
        ['R', 'R', 'P']
    """
    source = read_toml(text, str(path))
    if is_mechanism(source.data):
        raise UsageError(f"{path} is a mechanism with dimensions, not a topology", hint="assur.load reads it")
    faults = Faults(str(path), source)
    for key, what in _REQUIRED.items():
        if key not in source.data:
            faults.add((key,), "missing", f"this must be there: {what}")
    entry = _entry(source.data, faults)
    chains = _chains(source.data.get("chains"), faults)
    _check_actuators(entry, chains, faults)
    _check_declared(entry, faults)
    faults.raise_any()
    return TopologyDescription(
        name=entry.name,
        chains=tuple(chains.values()),
        title=entry.title or entry.name,
        source=entry.source,
        note=entry.note,
        actuate=entry.actuate,
        mode=entry.mode,
        declared=Declared(**{key: getattr(entry.declared, key) for key in DeclaredEntry.model_fields}),
        file=path,
    )


def _entry(data: dict[str, Any], faults: Faults) -> TopologyEntry:
    """The part of a document that is in form."""
    rest = {key: dict(value) if isinstance(value, dict) else value for key, value in data.items()}
    try:
        return TopologyEntry.model_validate(rest)
    except ValidationError as error:
        for details in error.errors(include_url=False):
            _note(details, faults)
            _cut(rest, details["loc"])
    return TopologyEntry.model_validate(rest)


def _note(details: ErrorDetails, faults: Faults) -> None:
    path, context = details["loc"], details.get("ctx", {})
    if details["type"] == "form":
        faults.add(path, context["found"], context["allowed"], context["hint"])
    elif details["type"] == "extra_forbidden":
        keys = DeclaredEntry.model_fields if path[0] == "declared" else TopologyEntry.model_fields
        faults.add(path, "unknown key", f"allowed here: {listed(keys)}", nearest(str(path[-1]), keys))
    else:
        faults.add(path, shown(details["input"]), "allowed: a table [declared]")


def _cut(data: dict[str, Any], path: KeyPath) -> None:
    """Take out what is not in form: a key, of `declared` one of its keys."""
    inside = path[0] == "declared" and len(path) > 1
    table, key = (data["declared"], path[1]) if inside else (data, path[0])
    table.pop(str(key), None)


def _chains(texts: object, faults: Faults) -> _READABLE:
    """Each chain by itself, so that every fault is noted; then all of them together."""
    given = texts if isinstance(texts, list) else []
    found: _READABLE = {}
    for index, text in enumerate(given):
        if isinstance(text, str):
            try:
                found[index] = parse_chains([text])[0]
            except NotationError as error:
                _note_notation(error, index, faults)
    if not given or len(found) < len(given):
        return found
    try:
        return dict(enumerate(parse_chains(given)))
    except NotationError as error:
        _note_notation(error, max(error.limb - 1, 0), faults)
    return found


def _note_notation(error: NotationError, index: int, faults: Faults) -> None:
    place = f"{error.offending} at character {error.position + 1} of {shown(error.text)}"
    faults.add(("chains", index), place, f"expected {error.expected}", error.hint)


def _check_actuators(entry: TopologyEntry, chains: _READABLE, faults: Faults) -> None:
    for index, (limb, place) in enumerate(entry.actuate):
        path: KeyPath = ("actuate", index)
        if entry.actuate.index((limb, place)) < index:
            first = faults.first(("actuate", entry.actuate.index((limb, place))))
            faults.add(path, f'"{limb}.{place}" again; {first}', "allowed: each joint once")
        elif entry.chains and limb > len(entry.chains):
            faults.add(path, f'"{limb}.{place}"', f"there are {len(entry.chains)} chains")
        elif limb - 1 in chains:
            letters = [_letters(joint) for joint in chains[limb - 1].joints]
            _check_actuator(limb, place, letters, path, faults)


def _check_actuator(limb: int, place: int, letters: list[str], path: KeyPath, faults: Faults) -> None:
    """One joint of a limb whose joints have these letters."""
    if place > len(letters):
        found = f'"{limb}.{place}": limb {limb} has {len(letters)} joints'
    elif letters[place - 1] not in ACTUATED:
        found = f'"{limb}.{place}" is a joint {letters[place - 1]}'
    else:
        return
    may = [f"{limb}.{number} ({text})" for number, text in enumerate(letters, 1) if text in ACTUATED]
    faults.add(path, found, f"in this limb may be actuated: {', '.join(may) or 'none'}")


def _letters(joint: ChainJoint | Parallelogram) -> str:
    return joint.type.letter if isinstance(joint, ChainJoint) else f"P({joint.kind})"


def _check_declared(entry: TopologyEntry, faults: Faults) -> None:
    """What is declared of limbs, for every limb."""
    for key in ("limbs", "limb_dims"):
        given = getattr(entry.declared, key)
        if given is not None and entry.chains and len(given) != len(entry.chains):
            faults.add(("declared", key), f"{len(given)} of them", f"one for each of the {len(entry.chains)} chains")
