"""Whatever is in a file, the reader answers with a record or with the faults of the file, and nothing else.

What it accepts is looked over by `assert_whole`, which knows the form of a record and none of the reader's code, and
is then checked on its joint graph, which may refuse it but not fail. Of a file with ever so many of something the calls
are counted, in place of a time that another machine would not have.
"""

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

import networkx as nx
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assur.errors import MechanismFileError, Problem, UsageError
from assur.kinematics.validation.check import doubts, faults
from assur.model.file.reader import read_text
from assur.model.mechanism import MechanismRecord
from assur.model.registry import names
from examples import examples
from work import calls

HERE = Path(__file__).parent
SOURCES = [
    (HERE.parent / "fourbar.toml").read_text(encoding="utf-8"),
    (HERE / "delta.toml").read_text(encoding="utf-8"),
    *(files("assur").joinpath(f"mechanisms/{name}/mechanism.toml").read_text(encoding="utf-8") for name in names()),
]
CALLS = 200
"""Of a character of a file at most: reading and checking grow in proportion, not with the square. The costliest names
close to an unknown key are 110; 200,000 characters are the most that a file has, some seconds."""
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
        problems = faults(found)
        if not problems:
            doubts(found)
    else:
        problems = found.problems
        assert problems
    lines = text.count("\n") + 1
    for problem in problems:
        assert problem.line is None or 1 <= problem.line <= lines
        assert problem.file == "f.toml"
        assert problem.given
        assert problem.allowed
        assert len(str(problem)) < 3000
        assert "Traceback" not in str(problem)


def outcome(text: str) -> MechanismRecord | MechanismFileError:
    try:
        return read_text(text, Path("f.toml"))
    except MechanismFileError as error:
        return error
    except UsageError as error:
        if "is a topology without dimensions" not in str(error):
            raise
        return MechanismFileError([Problem("f.toml", None, "", str(error), "a mechanism")])


def assert_whole(record: MechanismRecord) -> None:
    """No half result: numbers are finite, axes unit vectors, names lead somewhere, all hangs together."""
    assert np.all(np.isfinite(record.home))
    assert len(record.home) == sum(joint.type.freedoms for joint in record.joints.values()) == len(record.coordinates)
    assert [item.index for item in record.coordinates] == list(range(len(record.home)))
    assert all(math.isfinite(parameter.value) for parameter in record.parameters.values())
    for name, joint in record.joints.items():
        assert joint.name == name
        assert {joint.parent, joint.child} <= set(record.links)
        assert joint.parent != joint.child
        for array in (joint.at, joint.child_at, joint.axes, joint.turn):
            assert np.all(np.isfinite(array))
        assert len(joint.axes) == joint.type.axes
        assert np.allclose(np.linalg.norm(joint.axes, axis=1), 1.0, atol=1e-12)
        assert np.allclose(joint.turn @ joint.turn.T, np.eye(3), atol=1e-9)
        assert math.isfinite(joint.pitch)
        assert (joint.pitch != 0.0) == (joint.type.name == "helical")
        assert all(ends is None or -math.inf < ends[0] < ends[1] < math.inf for ends in joint.limits)
        assert joint.cone is None or 0 < joint.cone <= math.pi
    graph = nx.MultiGraph([(joint.parent, joint.child) for joint in record.joints.values()])
    graph.add_nodes_from(record.links)
    assert nx.is_connected(graph)
    assert {link for link in graph if graph.degree(link) < 2} <= {record.base, record.platform.link}
    assert record.base != record.platform.link
    assert {record.base, record.platform.link} <= set(record.links)
    aliases = [joint.alias for joint in record.joints.values() if joint.alias]
    letters = [*record.joints, *aliases, *record.points, *record.parameters, *record.angles]
    assert len(set(letters)) == len(letters)
    assert len(set(record.links) | set(record.joints)) == len(record.links) + len(record.joints)
    assert len({item.name for item in record.inputs}) == len({item.coordinate for item in record.inputs})
    assert len({item.name for item in record.inputs}) == len(record.inputs) > 0
    assert all(item.sign in (1.0, -1.0) and math.isfinite(item.offset) for item in record.inputs)
    assert len(set(record.platform.pose)) == len(record.platform.pose) > 0
    assert set(record.box) <= set(record.platform.pose)
    assert all(-math.inf < low < high < math.inf for low, high in record.box.values())
    assert all(math.isfinite(value) for value in record.sections)
    assert all(np.all(np.isfinite(point.at)) and point.link in record.links for point in record.points.values())
    in_chains = [
        joint
        for chain in record.chains.values()
        for name in (*chain.serial, *chain.loop, *chain.tail)
        for joint in (record.generalised[name].joints if name in record.generalised else (name,))
    ]
    assert not record.chains or sorted(in_chains) == sorted(record.joints)


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
    0.001, 1000, -250, 1e-200, 1e50, "-x", "0", "1e12", "-pi", "180 deg", "r", "L", "leg", "platform",
    "\U0001f600", "x" * 5000, "(" * 29 + "1" + ")" * 29, "(" * 10_000, "1" + "+1" * 499, "1" + "*1.5" * 240,
    "-" * 40 + "1",
    [0.0] * 3000, [[[[[[[[[[[[1]]]]]]]]]]]], {"a": {"b": {"c": {"d": {"e": {}}}}}}, ["A", "A", "A"],
    ["leg1.A", "B"], [1e-7, 0, 0], [0, 0, 1e-7], "l1", "l2", "l3", 2**70, "prismatic", "revolute", "m", "in", [-1, 1],
    [1, -1], ["x", "y", "phi"], ["qw", "qx", "qy", "qz"],
]  # fmt: skip


def toml(value: Node) -> str:
    """A value as TOML; the document itself is one inline table less its braces, a line for each key."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{json.dumps(key)} = {toml(item)}" for key, item in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(toml(item) for item in value) + "]"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    return str(value).lower() if isinstance(value, bool) else str(value)


def places(value: Node) -> list[tuple[Node, Node]]:
    """Every table or list in a document with each of its keys or indices."""
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    return [place for key, item in items for place in [(value, key), *places(item)]]


KEYS = sorted({key for document in DOCUMENTS for table, key in places(document) if isinstance(table, dict)})


@st.composite
def rebuilt(draw: Callable[..., Any]) -> str:
    """A file that is TOML, with one to four of its values replaced, removed, moved or renamed."""
    document = copy.deepcopy(draw(st.sampled_from(DOCUMENTS)))
    for _ in range(draw(st.integers(1, 3))):
        found = places(document)
        if not found:
            break
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


@examples(60)
@given(rebuilt())
def test_a_document_with_other_values_is_read_or_refused(text: str) -> None:
    check(text)


@pytest.mark.deep
@examples(200)
@given(rebuilt() | mutated())
def test_many_documents_with_other_values_are_read_or_refused(text: str) -> None:
    check(text)


@examples(100)
@given(st.data())
def test_any_document_is_refused(data: st.DataObject) -> None:
    """Tables, lists and values of TOML under the keys of the form, and others."""
    keys = st.sampled_from([*KEYS, "x", "", "a.b", "é"])
    leaves = st.sampled_from(VALUES) | st.text(max_size=5) | st.integers() | st.floats() | st.booleans()
    inner = st.recursive(
        leaves, lambda of: st.lists(of, max_size=3) | st.dictionaries(keys, of, max_size=4), max_leaves=8
    )
    document = data.draw(st.dictionaries(keys, inner, max_size=8))
    text = "\n".join(f"{json.dumps(key, ensure_ascii=False)} = {toml(value)}" for key, value in document.items())
    tomllib.loads(text)
    check(text)


def test_a_document_written_again_is_the_same() -> None:
    for text, document in zip(SOURCES, DOCUMENTS, strict=True):
        again = "\n".join(f"{json.dumps(key)} = {toml(value)}" for key, value in document.items())
        assert tomllib.loads(again) == document
        first, second = (read_text(each, Path("f.toml")) for each in (text, again))
        assert first.home.tolist() == second.home.tolist()


@examples(60)
@given(mutated())
def test_a_file_with_other_tokens_is_read_or_refused(text: str) -> None:
    check(text)


@examples(30)
@given(st.sampled_from(SOURCES), st.data())
def test_a_file_with_lines_lost_or_moved_is_read_or_refused(text: str, data: st.DataObject) -> None:
    lines = text.splitlines()
    for _ in range(data.draw(st.integers(1, 3))):
        line = lines.pop(data.draw(st.integers(0, len(lines) - 1)))
        if data.draw(st.booleans()):
            lines.insert(data.draw(st.integers(0, len(lines))), line)
    check("\n".join(lines))


@examples(60)
@given(st.text(max_size=80))
def test_any_text_is_refused(text: str) -> None:
    assert isinstance(outcome(text), MechanismFileError)


def joint(number: int, parent: str) -> str:
    return f'J{number} = {{ type = "revolute", parent = "{parent}", child = "coupler", axis = "z" }}'


MANY = {
    "joints": ("[joints]", [joint(n, "crank") for n in range(2000)]),
    "joints of unknown links": ("[joints]", [joint(n, f"q{n}") for n in range(190)]),
    "joints of no type": ("[joints]", [f'J{n} = {{ type = "ball{n}" }}' for n in range(3000)]),
    "links": ("[links]", [f"k{n} = {{}}" for n in range(4900)]),
    "islands": ("[links]", [f"k{n} = {{}}" for n in range(350)]),
    "unknown keys": ("format = 1", [f"k{n} = 1" for n in range(4900)]),
    "parameters": ("[parameters]", [f"p{n} = {{ value = {n + 1} }}" for n in range(6000)]),
    "parameters in a row": ("[parameters]", [f'p{n} = {{ value = "p{n + 1}" }}' for n in range(3900)]
        + ["p3900 = { value = 1 }"]),
    "parameters in a circle": ("[parameters]", [f'p{n} = {{ value = "p{(n + 1) % 3900}" }}' for n in range(3900)]),
    "parameters of nothing": ("[parameters]", [f'p{n} = {{ value = "no{n}" }}' for n in range(3900)]),
    "broken formulas": ("[parameters]", [f'p{n} = {{ value = "1 +* {n}" }}' for n in range(3900)]),
    "home of nothing": ("[home]", [f"k{n} = 0" for n in range(4900)]),
    "limbs": ("", [f'[limbs.q{n}]\nrepeat = {{ about = "z", count = 60 }}' for n in range(3000)]),
    "joints of limbs": ("", ['[limbs.leg]\nrepeat = { about = "z", count = 60 }\n[limbs.leg.joints]']
        + [joint(n, "crank") for n in range(500)]),
    "elements of a pose": ('["x", "y"]', ['["x", "y"' + ', "w"' * 4900 + "]"]),
    "elements of a list": ("sections = [50]", ["sections = [" + "true, " * 30_000 + "]"]),
    "sections": ("sections = [50]", ["sections = [" + "true, " * 4900 + "]"]),
    "orders": ("[inputs]", ["order = [" + '"A", ' * 4900 + "]"]),
    "points": ("[points]", [f'Q{n} = {{ link = "nothing", at = ["x", "y", "z"] }}' for n in range(390)]),
    "modes": ("[modes]", ["assembly = { " + ", ".join(f's{n} = "x{n}"' for n in range(4000)) + " }"]),
    "dots": ("", ["x" + ".x" * 90_000 + " = 1"]),
    "tables in tables": ("", ["[" + "x." * 90_000 + "x]"]),
    "brackets": ("sections = [50]", ["sections = " + "[" * 90_000 + "]" * 90_000]),
    "digits in base 16": ("value = 40", ["value = 0x" + "f" * 90_000]),
    "digits": ("value = 40", ["value = " + "9" * 90_000]),
    "letters of a name": ("ground = {}", ["g" * 90_000 + " = {}"]),
    "letters of a link": ('base = "ground"', ['base = "' + "g" * 90_000 + '"']),
    "signs of a formula": ("value = 40", ['value = "' + "-" * 90_000 + '1"']),
    "powers of ten": ("value = 40", ['value = "1' + "*1e99" * 190 + '"']),
    "quotes": ("value = 40", ['value = "' + "\\u0041" * 15_000 + '"']),
}  # fmt: skip


@pytest.mark.parametrize("what", MANY)
def test_ever_so_many_of_something_are_read_or_refused_by_work_in_proportion(what: str) -> None:
    """New lines stand below a table's head, in the place of a value, or, where no place is named, at the end."""
    old, new = MANY[what]
    lines = "\n".join(new)
    if not old:
        text = f"{SOURCES[0]}\n{lines}\n"
    else:
        assert old in SOURCES[0]
        text = SOURCES[0].replace(old, f"{old}\n{lines}" if old.startswith("[") else lines, 1)
    assert calls(lambda: check(text)) < CALLS * len(text)
