"""Whatever is in a file, the reader answers with a record or with the faults of the file, and nothing else."""

from __future__ import annotations

import copy
import datetime
import json
import math
import re
import tomllib
from collections.abc import Callable
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from assur.errors import MechanismFileError
from assur.model.file.reader import read_text
from assur.model.mechanism import MechanismRecord

HERE = Path(__file__).parent
SOURCES = [
    (HERE.parent / "fourbar.toml").read_text(encoding="utf-8"),
    (HERE / "delta.toml").read_text(encoding="utf-8"),
    files("assur").joinpath("mechanisms/zeng2019/mechanism.toml").read_text(encoding="utf-8"),
]
TOKEN = re.compile(r"\"[^\"\n]*\"|[A-Za-z_][\w.']*|-?\d+(?:\.\d+)?|[^\w\s]")
ODD = [
    "nan", "inf", "-1", "0", "1e308", "true", '"x"', '""', '"-z"', '"l1*(2"', '"pi"', '"1 deg"', "[]", "{}", "[[]]",
    ",", "=", '"a.b"', '"leg1.A"', '"sqrt(0-1)"', '"1/0"', "1979-05-27", "[0, 0, 0]", '"universal"', '"spherical"',
    "#", '"', "'", "\u0000", "é", "\n", "x.y", "limbs", "links", "9" * 30,
]  # fmt: skip


def check(text: str) -> None:
    found = outcome(text)
    if isinstance(found, MechanismRecord):
        assert_whole(found)
        return
    assert found.problems
    lines = text.count("\n") + 1
    for problem in found.problems:
        assert problem.line is None or 1 <= problem.line <= lines
        assert problem.found
        assert problem.allowed
        assert "Traceback" not in str(problem)


def outcome(text: str) -> MechanismRecord | MechanismFileError:
    try:
        return read_text(text, Path("f.toml"))
    except MechanismFileError as error:
        return error


def assert_whole(record: MechanismRecord) -> None:
    """No half result: every number of a record is a finite one, and every name leads somewhere."""
    assert np.all(np.isfinite(record.home))
    assert len(record.home) == sum(joint.type.freedoms for joint in record.joints.values())
    assert all(math.isfinite(parameter.value) for parameter in record.parameters.values())
    for joint in record.joints.values():
        assert {joint.parent, joint.child} <= set(record.links)
        for array in (joint.at, joint.child_at, joint.axes, joint.turn):
            assert np.all(np.isfinite(array))
    assert {record.base, record.platform.link} <= set(record.links)
    assert record.inputs


def test_the_sources_are_in_order() -> None:
    for text in SOURCES:
        assert_whole(read_text(text, Path("f.toml")))


def tokens(text: str) -> list[tuple[int, int]]:
    return [match.span() for match in TOKEN.finditer(text)]


DOCUMENTS = [tomllib.loads(text) for text in SOURCES]
SPANS = [tokens(text) for text in SOURCES]


@st.composite
def mutated(draw: Callable[..., int]) -> str:
    """A file with one to four of its tokens replaced, removed, doubled or exchanged."""
    which = draw(st.integers(0, len(SOURCES) - 1))
    text, spans = SOURCES[which], SPANS[which]
    places = sorted({draw(st.integers(0, len(spans) - 1)) for _ in range(draw(st.integers(1, 4)))}, reverse=True)
    for place in places:
        start, end = spans[place]
        own = text[start:end]
        other = spans[draw(st.integers(0, len(spans) - 1))]
        change = draw(st.integers(0, 3))
        new = [draw(st.sampled_from(ODD)), "", f"{own} {own}", SOURCES[which][slice(*other)]][change]
        text = text[:start] + str(new) + text[end:]
    return text


Node = Any
VALUES: list[Node] = [
    0, -1, 7.5, math.nan, math.inf, 1e308, 10**400, True, "", "x", "-z", "l1*(2", "pi/2", "30 deg", "sqrt(0-1)", "1/0",
    "R + turn", "b", "A", "B.rotation", "leg1.A", "leg2.C1.rx", "ground", "base", "arm", [], {}, [[]], ["x", "y"],
    [0, 0, 0], ["0", "cos(30 deg)", 1], {"a": 1}, "universal", "spherical", "cylindrical", "helical", "prismatic",
    "deg", "rad", "any", "P(4U)", datetime.date(2000, 1, 1), "é\u0000", "O'.x - B3.y", "++", "count",
]  # fmt: skip


def toml(value: Node) -> str:
    """A value as TOML; the document itself is one inline table less its braces, a line for each key."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{json.dumps(key)} = {toml(item)}" for key, item in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(toml(item) for item in value) + "]"
    if isinstance(value, str):
        return json.dumps(value)
    return str(value).lower() if isinstance(value, bool) else str(value)


def places(value: Node) -> list[tuple[Node, Node]]:
    """Every table or list in a document with each of its keys or indices."""
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    return [place for key, item in items for place in [(value, key), *places(item)]]


@st.composite
def rebuilt(draw: Callable[..., Any]) -> str:
    """A file that is TOML, with one to four of its values replaced, removed, moved or renamed."""
    document = copy.deepcopy(draw(st.sampled_from(DOCUMENTS)))
    for _ in range(draw(st.integers(1, 4))):
        found = places(document)
        table, key = found[draw(st.integers(0, len(found) - 1))]
        change = draw(st.integers(0, 4))
        if change == 0:
            table.pop(key)
        elif change == 1:
            other, own = found[draw(st.integers(0, len(found) - 1))]
            table[key] = copy.deepcopy(other[own])
        elif change == 2 and isinstance(table, dict):
            name = draw(
                st.sampled_from(["x", "A", "l1", "", "a.b", "axes", "count", key[1:], key + "x", "sin", "leg2"])
            )
            table[name] = table.pop(key)
        else:
            table[key] = copy.deepcopy(draw(st.sampled_from(VALUES)))
    return "\n".join(f"{json.dumps(key)} = {toml(value)}" for key, value in document.items())


@settings(max_examples=400, deadline=None)
@given(rebuilt())
def test_a_document_with_other_values_is_read_or_refused(text: str) -> None:
    check(text)


def test_a_document_written_again_is_the_same() -> None:
    for text, document in zip(SOURCES, DOCUMENTS, strict=True):
        again = "\n".join(f"{json.dumps(key)} = {toml(value)}" for key, value in document.items())
        assert tomllib.loads(again) == document
        first, second = (read_text(each, Path("f.toml")) for each in (text, again))
        assert first.home.tolist() == second.home.tolist()


@settings(max_examples=100, deadline=None)
@given(mutated())
def test_a_file_with_other_tokens_is_read_or_refused(text: str) -> None:
    check(text)


@settings(max_examples=100, deadline=None)
@given(st.sampled_from(SOURCES), st.data())
def test_a_file_with_lines_lost_or_moved_is_read_or_refused(text: str, data: st.DataObject) -> None:
    lines = text.splitlines()
    for _ in range(data.draw(st.integers(1, 3))):
        line = lines.pop(data.draw(st.integers(0, len(lines) - 1)))
        if data.draw(st.booleans()):
            lines.insert(data.draw(st.integers(0, len(lines))), line)
    check("\n".join(lines))


@settings(max_examples=100, deadline=None)
@given(st.text(max_size=80))
def test_any_text_is_refused(text: str) -> None:
    assert isinstance(outcome(text), MechanismFileError)
