"""The JSON Schema describes files as they are written: every good one fits, and what the reader refuses does not."""

import copy
import re
import tomllib
from pathlib import Path
from typing import Any

import pytest

import assur
from assur.model.file.json_schema import json_schema
from assur.model.file.schema import FileEntry
from assur.model.registry import topology_names
from assur.model.topologies import load_topology
from assur.results.json_text import indented
from assur.synthesis.drafting.drafting import drafted

ROOT = Path(__file__).parents[3]
SCHEMA = json_schema()
ANNOTATIONS = {"description", "title", "default", "$defs"}
TYPES: dict[str, Any] = {
    "object": dict,
    "array": list,
    "string": str,
    "number": (int, float),
    "integer": int,
    "boolean": bool,
}


def fits(value: Any, schema: Any) -> bool:
    """Whether a value fits a schema of the words that ours uses; an unknown word is an error."""
    if schema is False or schema is True:
        return bool(schema)
    return all(_holds(word, said, value, schema) for word, said in schema.items() if word not in ANNOTATIONS)


def _holds(word: str, said: Any, value: Any, schema: dict[str, Any]) -> bool:
    match word:
        case "$ref":
            return fits(value, SCHEMA["$defs"][said.removeprefix("#/$defs/")])
        case "type":
            return any(_is(value, item) for item in ([said] if isinstance(said, str) else said))
        case "enum":
            return any(value == item and type(value) is type(item) for item in said)
        case "const":
            return bool(value == said and type(value) is type(said))
        case "anyOf":
            return any(fits(value, item) for item in said)
        case "oneOf":
            return sum(fits(value, item) for item in said) == 1
        case "pattern":
            return not isinstance(value, str) or re.search(said, value) is not None
        case "maxLength":
            return not isinstance(value, str) or len(value) <= said
        case "minLength":
            return not isinstance(value, str) or len(value) >= said
        case "minimum":
            return not _is(value, "number") or value >= said
        case "maximum":
            return not _is(value, "number") or value <= said
        case "items":
            return not isinstance(value, list) or all(fits(item, said) for item in value)
        case "minItems":
            return not isinstance(value, list) or len(value) >= said
        case "maxItems":
            return not isinstance(value, list) or len(value) <= said
        case "required":
            return not isinstance(value, dict) or set(said) <= set(value)
        case "propertyNames":
            return not isinstance(value, dict) or all(fits(name, said) for name in value)
        case "properties":
            return not isinstance(value, dict) or all(fits(value[key], said[key]) for key in set(said) & set(value))
        case "additionalProperties":
            others = set(value) - set(schema.get("properties", ())) if isinstance(value, dict) else set()
            return all(fits(value[key], said) for key in others)
    raise AssertionError(f"the test does not know the word {word}")


def _is(value: Any, kind: str) -> bool:
    return isinstance(value, TYPES[kind]) and (kind == "boolean" or not isinstance(value, bool))


def text_of(name: str) -> str:
    return assur.load(name).file.read_text(encoding="utf-8")


def test_the_committed_schema_is_this_one() -> None:
    assert (ROOT / "docs" / "mechanism.schema.json").read_text(encoding="utf-8") == indented(json_schema()) + "\n"


@pytest.mark.parametrize("name", assur.names())
def test_every_mechanism_of_the_catalogue_fits(name: str) -> None:
    assert fits(tomllib.loads(text_of(name)), SCHEMA)


def test_the_page_s_example_and_drafted_files_fit() -> None:
    page = (ROOT / "docs" / "mechanism-file.md").read_text(encoding="utf-8")
    texts = re.findall(r"```toml\n(.*?)```", page, re.DOTALL)
    texts += [drafted(load_topology(name).chains, Path("my.toml")).text for name in ("tripteron", "planar_3rrr")]
    assert all(fits(tomllib.loads(text), SCHEMA) for text in texts)


@pytest.mark.parametrize("name", topology_names())
def test_a_topology_is_no_mechanism(name: str) -> None:
    assert not fits(tomllib.loads(load_topology(name).file.read_text(encoding="utf-8")), SCHEMA)


WRONG = [
    (("format",), 2),
    (("format",), True),
    (("name",), "a b"),
    (("unit",), "km"),
    (("angle",), "grad"),
    (("base",), 1),
    (("nonsense",), 1),
    (("platform", "pose"), ["w"]),
    (("platform", "pose"), []),
    (("platform", "orientation"), "fixed"),
    (("platform", "extra"), 1),
    (("parameters", "R"), 3),
    (("parameters", "R", "value"), [1]),
    (("parameters", "2R"), {"value": 1}),
    (("parameters", "sqrt"), {"value": 1}),
    (("parameters", "R", "sign"), "negative"),
    (("links", "base", "mass"), "1"),
    (("links", "base", "weight"), 1),
    (("gravity",), {"value": "9"}),
    (("materials",), {"steel": {"E": "210e9"}}),
    (("payload",), {"mass": 1, "inertia": [1, 1, 1]}),
    (("compliances",), {"leg1.A": [1e-8, 1e-8, 1e-8]}),
    (("compliances",), {"leg1.A": [1e-8, 1e-8, 1e-8, 1e-6, 1e-6, [1e-6]]}),
    (("links", "base", "compliance"), "stiff"),
    (("actuators",), {"A": {"gear": {"stiffness": 1e5}}}),
    (("joints",), {"A": {"type": "revolut", "parent": "base", "child": "platform", "axis": "z"}}),
    (("joints",), {"A": {"type": "revolute", "parent": "base", "child": "platform"}}),
    (("joints",), {"A": {"type": "revolute", "parent": "base", "child": "platform", "axis": "w"}}),
    (("joints",), {"A": {"type": "revolute", "parent": "base", "child": "platform", "axis": "z", "at": [1, 2]}}),
    (("joints",), {"A": {"type": "revolute", "parent": "base", "child": "platform", "axis": "z", "pitch": 3}}),
    (("joints",), {"A": {"type": "universal", "parent": "base", "child": "platform", "axis": "z"}}),
    (("limbs", "leg", "repeat"), {"about": "z"}),
    (("limbs", "leg", "repeat"), {"about": "z", "count": 1}),
    (("limbs", "leg", "repeat"), {"about": "z", "count": 3, "angles": [0]}),
    (("limbs", "leg", "joints", "A", "axis"), [0, 1]),
    (("limbs", "leg", "home", "A"), {}),
    (("limbs", "leg", "inputs", "A", "sign"), 2),
    (("modes", "default", "other"), "+"),
    (("workspace", "box", "x"), [1, 2, 3]),
    (("generalised",), {"G": {"kind": "P(5R)", "joints": [], "stands_for": {}}}),
]


@pytest.mark.parametrize(("path", "value"), WRONG)
def test_what_the_reader_refuses_for_its_form_does_not_fit(path: tuple[str, ...], value: Any) -> None:
    page = (ROOT / "docs" / "mechanism-file.md").read_text(encoding="utf-8")
    (text,) = re.findall(r"```toml\n(.*?)```", page, re.DOTALL)
    data = tomllib.loads(text)
    changed = copy.deepcopy(data)
    table = changed
    for part in path[:-1]:
        table = table.setdefault(part, {})
    table[path[-1]] = value
    assert fits(data, SCHEMA)
    assert not fits(changed, SCHEMA)
    form(data)
    with pytest.raises(ValueError, match=r".+"):
        form(changed)


def form(data: dict[str, Any]) -> None:
    """Raise ValueError as the reader notes a fault: of the form, or of how often a limb is there."""
    limb = FileEntry.model_validate(data).limbs["leg"]
    if limb.repeat is None or (limb.repeat.count is None) == (limb.repeat.angles is None):
        raise ValueError(limb.repeat)


@pytest.mark.parametrize("key", ["format", "name", "unit", "angle", "base", "platform", "links"])
def test_what_must_be_there_is_missed(key: str) -> None:
    data = tomllib.loads(text_of("delta_4s"))
    del data[key]
    assert not fits(data, SCHEMA)


def test_nothing_is_left_that_only_pydantic_or_json_knows() -> None:
    assert not re.search(r'"(definition|discriminator|prefixItems|null|patternProperties)"', indented(json_schema()))
    assert "://" not in indented(json_schema())
