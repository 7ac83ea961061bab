"""Every key that must be there, taken out of files that have all of them: the fault has the line of its table."""

import copy
import json
import tomllib
from collections.abc import Iterator
from importlib.resources import files
from pathlib import Path
from typing import Any

import pytest

from assur.errors import MechanismFileError, Problem, UsageError
from assur.model.file.json_schema import json_schema
from assur.model.file.reader import read_text
from assur.model.file.topology_file import read_topology_text

HERE = Path(__file__).parent
FOLDER = Path(str(files("assur"))) / "mechanisms"
FILES = [
    (HERE.parent / "fourbar.toml", read_text),
    (HERE / "delta.toml", read_text),
    (FOLDER / "zeng2019" / "mechanism.toml", read_text),
    (FOLDER / "tripteron" / "topology.toml", read_topology_text),
]
"""Together they have every table and nearly every kind of joint."""
DOCUMENTS = [(tomllib.loads(path.read_text(encoding="utf-8")), read) for path, read in FILES]
TABLES = 3
"""So deep a table stands under a header of its own, a deeper one in one line with its key."""


def inline(value: Any) -> str:
    if isinstance(value, list):
        return f"[{', '.join(map(inline, value))}]"
    if isinstance(value, dict):
        return f"{{ {', '.join(f'{json.dumps(key)} = {inline(part)}' for key, part in value.items())} }}"
    return json.dumps(value)


def rows(data: dict[str, Any], head: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], str]]:
    """The lines of a document, each with the table or key that it begins."""
    tables = {key for key, value in data.items() if isinstance(value, dict) and len(head) < TABLES}
    for key in data.keys() - tables:
        yield (*head, key), f"{json.dumps(key)} = {inline(data[key])}"
    for key in tables:
        yield (*head, key), f"[{'.'.join(map(json.dumps, (*head, key)))}]"
        yield from rows(data[key], (*head, key))


def missing(data: dict[str, Any], read: Any) -> tuple[Problem, ...]:
    try:
        read("\n".join(text for _, text in rows(data)), Path("f.toml"))
    except MechanismFileError as error:
        return tuple(problem for problem in error.problems if problem.given == "missing")
    except UsageError:  # without what makes it a mechanism it is taken for a topology, or the other way round
        pass
    return ()


def paths(data: dict[str, Any], head: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    for key, value in data.items():
        yield (*head, key)
        if isinstance(value, dict):
            yield from paths(value, (*head, key))


@pytest.fixture(scope="module")
def told() -> list[tuple[tuple[str, ...], int | None, int]]:
    """For each key that is missed: where it was, the line that was told, the line of its table."""
    found = []
    for document, read in DOCUMENTS:
        seen: set[tuple[str, ...]] = set()
        for path in paths(document):
            kind = (path[0], str(len(path)), path[-1])
            if kind in seen:
                continue
            seen.add(kind)
            data = copy.deepcopy(document)
            table = data
            for part in path[:-1]:
                table = table[part]
            del table[path[-1]]
            lines = {place: number for number, (place, _) in enumerate(rows(data), 1)}
            for problem in missing(data, read):
                # what may stand in a limb as well is missed by the document, not by the limb
                head = path[:-1] if "." in problem.path else (problem.path,)
                while head and head not in lines:
                    head = head[:-1]
                found.append((path, problem.line, lines.get(head, 1)))
    return found


def test_a_missing_key_has_the_line_of_its_table(told: Any) -> None:
    assert [case for case in told if case[1] != case[2]] == []


def test_every_key_that_the_schema_requires_was_missed(told: Any) -> None:
    schema = json_schema()
    wanted = set(schema["required"])
    for name, entry in schema["$defs"].items():
        if name not in ("Cone", "HelicalEntry", "UniversalEntry"):  # none of these files has one
            wanted |= set(entry.get("required", ()))
    assert wanted <= {path[-1] for path, _, _ in told}
