"""The schema against what the classes become: what has their fields is valid, and nothing else."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import jsonschema
import pytest

from assur.results.answers.answer import ABSENT, Absent, Answer, named, spread
from assur.results.answers.schema import schema_of
from assur.results.json_text import json_text


@dataclass(frozen=True)
class Cut:
    """Where it is cut."""

    kind: Literal["plane", "line"]
    area: float | None
    by: str = named("found")
    at: Mapping[str, float] = spread()


@dataclass(frozen=True)
class Whole(Answer):
    """What is cut."""

    ends: tuple[float, float]
    cuts: tuple[Cut, ...]
    file: str | Absent = ABSENT


SCHEMA = schema_of({"cut": (Whole,)})


def faults(said):
    """What the schema says against an object."""
    return [error.message for error in jsonschema.Draft202012Validator(SCHEMA).iter_errors(said)]


def said(**changes):
    """An answer as JSON has it, with changes."""
    answer = Whole((0.0, 1.0), (Cut("plane", float("nan"), "rays", {"z": 450.0}),))
    return {**json.loads(json_text(answer)), **changes}


def test_the_schema_is_one():
    jsonschema.Draft202012Validator.check_schema(SCHEMA)


def test_an_answer_is_its_fields_without_those_that_are_absent():
    assert said() == {"ends": [0.0, 1.0], "cuts": [{"z": 450.0, "kind": "plane", "area": None, "found": "rays"}]}
    assert faults(said()) == []
    assert faults(said(file="cut.json", interrupted=True)) == []


@pytest.mark.parametrize(
    "changes",
    [
        {"ends": [0.0]},
        {"ends": [0.0, None]},
        {"cuts": [{"z": "450", "kind": "plane", "area": None, "found": "rays"}]},
        {"cuts": [{"z": 450.0, "kind": "ball", "area": None, "found": "rays"}]},
        {"cuts": [{"z": 450.0, "kind": "plane", "found": "rays"}]},
        {"file": None},
        {"interrupted": False},
        {"other": 1},
    ],
)
def test_what_no_field_allows_is_a_fault(changes):
    assert faults(said(**changes))


def test_a_refusal_is_valid_of_every_command():
    problem = {"file": "my.toml", "line": 3, "path": "links", "found": "none", "allowed": "one", "hint": ""}
    error = {"message": "bad", "hint": "", "exit_code": 3, "problems": [problem]}
    assert faults({"error": error}) == []
    assert faults({"error": {**error, "exit_code": "3"}})


def test_a_field_of_no_json_shape_is_refused():
    @dataclass(frozen=True)
    class Odd(Answer):
        """It holds what JSON has not."""

        number: complex

    with pytest.raises(TypeError, match="no JSON shape"):
        schema_of({"odd": (Odd,)})
