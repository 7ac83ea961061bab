"""JSON Schema (draft 2020-12) of answers, derived from the fields of their classes."""

from __future__ import annotations

import types
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import fields, is_dataclass
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints

from assur.results.answers.answer import NAME, SPREAD, Absent, Answer, Circumstances, NoAnswer, derived_of

Schema = dict[str, Any]
DIALECT = "https://json-schema.org/draft/2020-12/schema"
SIMPLE: dict[Any, str] = {str: "string", bool: "boolean", int: "integer", float: "number", type(None): "null"}


def schema_of(kinds: Mapping[str, Iterable[type]]) -> Schema:
    """The schema of what commands print with --json, from the classes of answers of each.

    >>> schema_of({"nothing": ()})["$defs"]["nothing"]
    {'anyOf': [{'$ref': '#/$defs/NoAnswer'}]}
    """
    classes: dict[str, Schema] = {}
    commands = {name: {"anyOf": [_shape(kind, classes) for kind in (*some, NoAnswer)]} for name, some in kinds.items()}
    every = [{"$ref": f"#/$defs/{name}"} for name in commands]
    return {
        "$schema": DIALECT,
        "title": "What assur prints with --json",
        "anyOf": every,
        "$defs": {**commands, **dict(sorted(classes.items()))},
    }


def _shape(kind: Any, classes: dict[str, Schema]) -> Schema:
    """The schema of a type; those of the classes in it are added to `classes`."""
    if kind is Any:
        return {}
    if kind in SIMPLE:
        return {"type": SIMPLE[kind]}
    origin, inside = get_origin(kind), get_args(kind)
    if origin is Literal:
        return {"enum": list(inside)}
    if origin in (Union, types.UnionType):
        return _either([_shape(part, classes) for part in inside if part is not Absent])
    if origin is tuple and inside[-1] is not Ellipsis:
        return {"type": "array", "prefixItems": [_shape(part, classes) for part in inside], "items": False,
                "minItems": len(inside)}  # fmt: skip
    if origin in (tuple, Sequence):
        return {"type": "array", "items": _shape(inside[0], classes)}
    if origin is Mapping:
        return {"type": "object", "additionalProperties": _shape(inside[1], classes)}
    if is_dataclass(kind):
        name = kind.__name__  # type: ignore[union-attr]  # a class
        if name not in classes:
            classes[name] = {}  # a class may hold itself
            classes[name] = _object(kind, classes)
        return {"$ref": f"#/$defs/{name}"}
    raise TypeError(f"no JSON shape is known of {kind}")


def _either(parts: list[Schema]) -> Schema:
    """Any of some schemas; of simple types in short form.

    >>> _either([{"type": "number"}, {"type": "null"}])
    {'type': ['number', 'null']}
    """
    if len(parts) == 1:
        return parts[0]
    if all(part.keys() == {"type"} for part in parts):
        return {"type": [part["type"] for part in parts]}
    return {"anyOf": parts}


def _object(kind: Any, classes: dict[str, Schema]) -> Schema:
    """The schema of a class by its fields; of an answer what may stand in every answer too."""
    hints = get_type_hints(kind)
    properties: dict[str, Schema] = {}
    required: list[str] = []
    others: Schema | bool = False
    for attribute in fields(kind):
        hint = hints[attribute.name]
        if attribute.metadata.get(SPREAD):
            others = _shape(get_args(hint)[1], classes)
            continue
        name = attribute.metadata.get(NAME, attribute.name)
        properties[name] = _shape(hint, classes)
        if Absent not in get_args(hint):
            required.append(name)
    for name in derived_of(kind):
        properties[name] = _shape(get_type_hints(getattr(kind, name).fget)["return"], classes)
        required.append(name)
    if issubclass(kind, Answer):
        properties |= _object(Circumstances, classes)["properties"]
    said = (kind.__doc__ or "").strip().partition("\n\n")[0]
    return {
        "description": " ".join(said.split()),
        "type": "object",
        "properties": properties,
        "required": required,
        "additionalProperties": others,
    }
