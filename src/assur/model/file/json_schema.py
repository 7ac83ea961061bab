"""The JSON Schema of a mechanism file, for editors that complete and check it: made from the form in `schema`.

It describes the file as it is written. What a schema cannot say (names that exist, formulas that can be computed,
loops that close) is left to `assur check`.
"""

from __future__ import annotations

from typing import Any

from assur.model.file.schema import FileEntry
from assur.model.file.texts import MAX_NAME
from assur.model.file.values import AXES, DEFINITION, LINK_PATTERN, NAME_PATTERN, PLAIN_PATTERN

Schema = dict[str, Any]

REQUIRED = ("format", "name", "unit", "angle", "base", "platform", "links")
"""Keys without which no file is complete; joints, inputs and home may stand in limbs alone."""


def _ref(name: str) -> Schema:
    return {"$ref": f"#/$defs/{name}"}


def _list_of(entry: Schema, count: int, said: str) -> Schema:
    return {"description": said, "type": "array", "items": entry, "minItems": count, "maxItems": count}


_VALUE = _ref("value")
DEFINITIONS: dict[str, Schema] = {
    "value": {
        "description": 'A number, or a formula in quotes: 30, "l2/2", "62 deg".',
        "anyOf": [{"type": "number"}, {"type": "string", "minLength": 1}],
    },
    "vector": _list_of(_VALUE, 3, "Three components."),
    "range": _list_of(_VALUE, 2, "[low, high]"),
    "axis": {"description": "x, y, z, -x, -y, -z, or a vector.", "anyOf": [{"enum": list(AXES)}, _ref("vector")]},
    "two_axes": _list_of(_ref("axis"), 2, "Two axes that are not parallel."),
    "home_value": {
        "description": "The value of a joint; of a joint with several components a list of them.",
        "anyOf": [_VALUE, {"type": "array", "items": _VALUE}],
    },
    "number": {"description": "A number, in SI units.", "type": "number"},
    "two_numbers": _list_of({"type": "number"}, 2, "Two numbers, in SI units."),
    "inertia": _list_of({"type": "number"}, 6, "xx, yy, zz, xy, xz, yz, in kg m2."),
    "compliance": {
        "description": "The diagonal, or six rows: m/N, m/(N m), rad/N, rad/(N m), displacement before rotation.",
        "anyOf": [
            {"type": "array", "items": {"type": "number"}, "minItems": 6, "maxItems": 6},
            {"type": "array", "items": _list_of({"type": "number"}, 6, "A row."), "minItems": 6, "maxItems": 6},
        ],
    },
    "bar_ends": _list_of({"type": "string"}, 2, "Two joints."),
    "sense": {"description": "1 or -1.", "enum": [1, -1]},
    "mechanism_name": {
        "description": "Letters, digits, _ and -.",
        "type": "string",
        "maxLength": MAX_NAME,
        "pattern": "^[A-Za-z0-9][A-Za-z0-9_-]*$",
    },
    "format": {"description": "1, the format of the file.", "type": "integer", "const": 1},
    "name": {
        "description": "A letter, then letters, digits, _ and primes.",
        "type": "string",
        "maxLength": MAX_NAME,
        "pattern": NAME_PATTERN,
    },
    "link_name": {
        "description": "A name; of a template's link in one of its limbs leg1.rod.",
        "type": "string",
        "maxLength": MAX_NAME,
        "pattern": LINK_PATTERN,
    },
    "plain_name": {
        "description": "A letter, then letters, digits, _.",
        "type": "string",
        "maxLength": MAX_NAME,
        "pattern": PLAIN_PATTERN,
    },
}
_PATTERNS = {LINK_PATTERN: "link_name", NAME_PATTERN: "name", PLAIN_PATTERN: "plain_name"}


def json_schema() -> Schema:
    """The schema as plain data, in the words that drafts 6, 7 and later of JSON Schema share.

    >>> found = json_schema()
    >>> found["properties"]["platform"], found["$defs"]["RevoluteEntry"]["properties"]["axis"]
    ({'$ref': '#/$defs/PlatformEntry'}, {'$ref': '#/$defs/axis'})
    """
    found: Schema = _tidied(FileEntry.model_json_schema())
    entries = found.pop("$defs")
    entries["LimbEntry"]["required"] = ["repeat"]
    entries["Repeat"]["oneOf"] = [{"required": ["count"]}, {"required": ["angles"]}]
    return {
        "title": "Mechanism file of assur",
        **found,
        "description": "One mechanism: its dimensions, links, joints, inputs and platform.",
        "required": list(REQUIRED),
        "$defs": {**DEFINITIONS, **entries},
    }


def _tidied(node: Any) -> Any:
    """What pydantic says, less what a TOML file cannot have (null) or need not be told (titles, empty defaults)."""
    if isinstance(node, list):
        return [_tidied(item) for item in node]
    if not isinstance(node, dict):
        return node
    if DEFINITION in node:
        return _ref(node[DEFINITION])
    if node.get("pattern") in _PATTERNS:
        return _ref(_PATTERNS[node["pattern"]])
    options = [item for item in node.get("anyOf", ()) if item != {"type": "null"}]
    if len(options) == 1:
        return _tidied(options[0])
    if "$ref" in node:
        return {"$ref": node["$ref"]}
    return _entries(node)


def _entries(node: Schema) -> Schema:
    found: Schema = {}
    for key, value in node.items():
        if key in ("properties", "$defs"):
            found[key] = {name: _tidied(item) for name, item in value.items()}
        elif key == "patternProperties":
            ((pattern, item),) = value.items()
            found |= {"propertyNames": _ref(_PATTERNS[pattern]), "additionalProperties": _tidied(item)}
        elif key == "default":
            found |= {"default": value} if value and isinstance(value, str | int) else {}
        elif key not in ("title", "discriminator"):
            found[key] = _tidied(value)
    return found
