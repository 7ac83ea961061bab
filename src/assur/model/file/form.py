"""The form of a document, checked: what pydantic finds, in our words, and what is left to look at."""

from __future__ import annotations

import copy
import difflib
import re
from typing import Any

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from assur.errors import KeyPath
from assur.model.file import schema
from assur.model.file.faults import Faults, listed, nearest
from assur.model.file.values import shown

_TABLES: dict[str, type[schema.Entry]] = {
    "parameters": schema.ParameterEntry,
    "links": schema.LinkEntry,
    "inputs": schema.InputEntry,
    "generalised": schema.GeneralisedEntry,
    "chains": schema.ChainEntry,
    "points": schema.PointEntry,
    "materials": schema.MaterialEntry,
    "profiles": schema.ProfileEntry,
    "actuators": schema.ActuatorEntry,
    "tolerances": schema.ToleranceEntry,
}
_PASSES = 12
_REFERENCES = ("inputs", "home")
_DOTTED = 'a name with a dot stands in quotes: "leg1.B"'
_TYPES = {
    "string_type": "allowed: a text in quotes",
    "dict_type": "allowed: a table { ... }",
    "model_type": "allowed: a table { ... }",
    "model_attributes_type": "allowed: a table { ... }",
    "tuple_type": "allowed: a list [ ... ]",
    "bool_type": "allowed: true or false",
    "int_type": "allowed: a whole number",
}


_NEEDED = {(table,) for table in (*_TABLES, "joints", "limbs", "home")}
_NEEDED_OF_LIMB = {(), *((table,) for table in schema.LimbEntry.model_fields)} - {("repeat",), ("chain",)}


def check_form(data: dict[str, Any], faults: Faults) -> tuple[schema.FileEntry | None, frozenset[KeyPath]]:
    """Check the form of a document and note every fault.

    Returns the part of the document that is in form, and the paths that were cut out of it because they
    are not; None where too little is left to look any further.
    """
    cut: set[KeyPath] = set()
    rest = copy.deepcopy(data)
    for _ in range(_PASSES):
        try:
            return schema.FileEntry.model_validate(rest), frozenset(cut)
        except ValidationError as error:
            errors = [(details, _path(details["loc"], rest)) for details in error.errors(include_url=False)]
        unknown = [(details, path) for details, path in errors if details["type"] == "extra_forbidden"]
        for details, path in unknown:
            _note_unknown(details, path, rest, faults)
        for details, path in [] if unknown else errors:
            _note(details, path, faults)
            entry = _entry(path)
            if entry in _NEEDED or (entry[0] == "limbs" and entry[2:] in _NEEDED_OF_LIMB):
                return None, frozenset(cut)
            cut.add(entry)
            _take(rest, entry)
    return None, frozenset(cut)


def _path(location: tuple[str | int, ...], data: Any) -> KeyPath:
    """The place in the document: pydantic's location less the tags and marks that it adds."""
    path: list[str | int] = []
    for index, part in enumerate(location):
        inside = (isinstance(data, dict) and part in data) or (isinstance(data, list) and isinstance(part, int))
        if inside:
            data = data[part] if isinstance(data, dict) else data[int(part)]
            path.append(part)
        elif index == len(location) - 1 and isinstance(part, str) and part != "[key]" and isinstance(data, dict):
            path.append(part)
    return tuple(path)


def _entry(path: KeyPath) -> KeyPath:
    """The smallest part that can be cut out: one entry of a table, else a table."""
    if path[0] == "limbs":
        return path[: 3 if len(path) > 2 and path[2] in ("repeat", "chain") else 4]
    return path[:2] if path[0] in (*_TABLES, "joints", "home", "angles", "clearances", "compliances") else path[:1]


def _take(data: dict[str, Any], path: KeyPath) -> tuple[dict[str, Any], Any]:
    """Take a value out of the document; returns the table that it was in, and the value."""
    for part in path[:-1]:
        data = data.get(str(part), {})
    return data, data.pop(str(path[-1]), None)


def _note_unknown(details: ErrorDetails, path: KeyPath, data: dict[str, Any], faults: Faults) -> None:
    """Note an unknown key; from here on it is read as the key that it was meant to be, if that is clear."""
    keys = allowed_keys(path[:-1], data)
    dotted = path[0] in _REFERENCES and isinstance(details["input"], dict)
    key = str(path[-1])
    faults.add(path, "unknown key", f"allowed here: {listed(keys)}", _DOTTED if dotted else nearest(key, keys))
    table, value = _take(data, path)
    meant = difflib.get_close_matches(key, keys, n=1)
    if meant and meant[0] not in table:
        table[meant[0]] = value


def _note(details: ErrorDetails, path: KeyPath, faults: Faults) -> None:
    kind, context = details["type"], details.get("ctx", {})
    value = shown(details["input"])
    if kind == "form":
        dotted = path[0] in _REFERENCES and isinstance(details["input"], dict)
        faults.add(path, context["found"], context["allowed"], _DOTTED if dotted else context["hint"])
    elif kind in ("too_short", "too_long"):
        bound = f"at least {context['min_length']}" if kind == "too_short" else f"at most {context['max_length']}"
        faults.add(path, value, f"allowed: {bound}")
    elif kind == "missing":
        faults.add(path, "missing", "this key must be there")
    elif kind == "union_tag_not_found":
        faults.add((*path, "type"), "missing", f"allowed: {listed(schema.JOINT_ENTRIES)}")
    elif kind == "union_tag_invalid":
        tag = str(context["tag"])
        hint = nearest(tag, schema.JOINT_ENTRIES)
        faults.add((*path, "type"), f'"{tag}"', f"allowed: {listed(schema.JOINT_ENTRIES)}", hint)
    elif kind == "literal_error":
        hint = nearest(str(details["input"]), re.findall("'(.+?)'", context["expected"]))
        faults.add(path, value, f"allowed: {context['expected']}".replace("'", ""), hint)
    elif path[0] == "parameters" and len(path) == 2 and isinstance(details["input"], int | float | str):
        faults.add(path, value, _TYPES[kind], f"write {path[1]} = {{ value = {value} }}")
    elif path == ("base",):
        hint = "one link stands still; all joints on the ground have it as their parent or child"
        faults.add(path, value, "allowed: the name of one link", hint)
    else:
        faults.add(path, value, _TYPES.get(kind, f"allowed: {details['msg'].removeprefix('Input should be ')}"))


def allowed_keys(path: KeyPath, data: dict[str, Any]) -> tuple[str, ...]:
    """Keys that the table at a path may have."""
    model: type[schema.Entry]
    match path:
        case ("limbs", _):
            model = schema.LimbEntry
        case ("limbs", _, "chain"):
            model = schema.ChainEntry
        case ("limbs", _, "repeat"):
            model = schema.Repeat
        case ("limbs", limb, *rest):
            return allowed_keys(tuple(rest), data["limbs"][limb])
        case ("joints", joint):
            model = schema.JOINT_ENTRIES[data["joints"][joint]["type"]]
        case ("joints", joint, "limits"):
            model = type(schema.JOINT_ENTRIES[data["joints"][joint]["type"]].model_fields["limits"].default)
        case ("joints", _, "cone"):
            model = schema.Cone
        case ("generalised", _, "stands_for"):
            model = schema.StandsFor
        case (str(table), _) if table in _TABLES:
            model = _TABLES[table]
        case ("actuators", _, "friction"):
            model = schema.FrictionEntry
        case ("gravity",):
            model = schema.GravityEntry
        case ("payload",):
            model = schema.WeightEntry
        case ("platform",):
            model = schema.PlatformEntry
        case ("modes",):
            model = schema.ModesEntry
        case ("modes", "default"):
            model = schema.DefaultModes
        case ("workspace",):
            model = schema.WorkspaceEntry
        case _:
            model = schema.FileEntry
    return tuple(model.model_fields)
