"""Laws of the house: its picture is that of the code, things are where the page says, nothing is there for nobody."""

import ast
import re
import sys
from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path

import architecture
import networkx as nx
import pytest
from imports import imports, module_files, nodes
from packages import order

from assur.cli.application import COMMANDS
from assur.model.kernels.library import OFFERED
from source import SOURCE, texts

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "docs" / "architecture.md"
FILES = {name: path for name, path in module_files(SOURCE).items() if not name.startswith("assur.mechanisms.")}
NAMED = re.compile(r"\bassur(?:\.\w+)+")


@cache
def imports_of_all() -> dict[str, set[str]]:
    return imports(FILES)


def text_of(path: Path) -> str:
    return path.read_text(encoding="utf-8")


# ---- the picture and the page --------------------------------------------------------------------------------


def test_the_picture_is_that_of_the_code():
    drawn = text_of(ROOT / architecture.PICTURE)
    assert architecture.picture(ROOT) == drawn, "python docs/extensions/architecture.py draws it anew"


def test_the_picture_has_the_folders_in_the_order_of_imports():
    drawn = [name for names in architecture.STOREYS.values() for name in names.split()]
    listed = [name for names in order(ROOT) for name in names.split(" | ")]
    assert drawn == listed
    heights = {name: k for k, name in enumerate(drawn)}
    assert all(heights[upper] < heights[lower] for upper, lower in architecture.direct_imports(ROOT))


def rows(heading: str) -> list[list[str]]:
    """Cells of the table below a heading of the page."""
    table = text_of(PAGE).partition(f"## {heading}\n")[2].partition("\n## ")[0]
    lines = [line.strip("| ").split(" | ") for line in table.splitlines() if line.startswith("| ")]
    return lines[1:]


def defined(path: Path) -> set[str]:
    """Names that a module gives to functions, classes, methods and constants."""
    names = set()
    for node in nodes(path):
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            names.add(node.name)
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            names.add(node.id)
    return names


@pytest.mark.parametrize("row", rows("Where it is"), ids=lambda row: row[0])
def test_a_thing_is_where_the_page_says(row):
    _, paths, names = (re.findall(r"`([^`]+)`", cell) for cell in row)
    assert paths
    for path, name in zip(paths * len(names) if len(paths) == 1 else paths, names, strict=True):
        assert name in defined(SOURCE / path), path


def test_the_four_things_that_a_newcomer_asks_for_first_are_listed():
    asked = {
        "the equation that closes a loop",
        "what a revolute is",
        "the table of indices",
        "the text of an exit code",
    }
    assert asked <= {row[0] for row in rows("Where it is")}


def test_a_new_thing_goes_into_a_folder_that_there_is():
    places = [name for row in rows("Where a new one goes") for name in re.findall(r"`([a-z_]+)/", row[1])]
    assert len(places) >= 5
    assert {name for name in places if not (SOURCE / name).is_dir()} == set()


def test_it_is_one_page():
    assert len(text_of(PAGE).splitlines()) <= 70


# ---- imports -------------------------------------------------------------------------------------------------


def circles(by_module: Mapping[str, Iterable[str]]) -> list[list[str]]:
    """Modules that import one another, at once or through others; by module what it imports."""
    graph = nx.DiGraph([(module, name) for module, names in by_module.items() for name in names])
    return sorted(sorted(modules) for modules in nx.strongly_connected_components(graph) if len(modules) > 1)


def test_no_import_comes_back():
    """Also not within a function, nor for types alone."""
    by_module = imports_of_all()
    assert circles(by_module) == []
    assert sum(map(len, by_module.values())) > len(by_module)
    assert circles({"a": {"b"}, "b": {"c"}, "c": {"b"}}) == [["b", "c"]]


# ---- nothing is there for nobody -----------------------------------------------------------------------------


def entrances() -> set[str]:
    """Modules that people come in by: commands, the library, what a closed form may import, what pages name."""
    pages = [ROOT / "README.md", *(ROOT / "docs").rglob("*.md"), *(ROOT / "examples").iterdir()]
    commands = {"assur.__main__", "assur.cli.main", *(f"assur.cli.{name}" for name in COMMANDS)}
    library = {"assur", "assur.mechanism", *OFFERED.keys() & FILES.keys()}
    return commands | library | named("\n".join(map(text_of, pages)))


def named(text: str) -> set[str]:
    """Modules whose dotted name, or that of something in them, stands in a text."""
    dotted = [name.split(".") for name in NAMED.findall(text)]
    names = {".".join(parts[:k]) for parts in dotted for k in range(2, len(parts) + 1)}
    return {name for name in names & FILES.keys() if FILES[name].stem != "__init__"}


def written(path: Path) -> set[str]:
    """Modules that a module imports by name while it runs, or writes into a program that does: in its texts."""
    return named("\n".join(texts(path)))


def test_nothing_is_there_for_nobody():
    by_module = imports_of_all()
    graph = nx.DiGraph([(name, other) for name, path in FILES.items() for other in by_module[name] | written(path)])
    graph.add_nodes_from(FILES)
    reached = entrances().union(*(nx.descendants(graph, name) for name in entrances()))
    modules = {name for name, path in FILES.items() if path.stem != "__init__"}
    assert modules - reached == set()
    assert len(modules) > 500


def test_who_comes_in_is_told_from_who_is_named_in_passing():
    assert named("from assur.numerics.legs import thirds; `assur.numerics` is a folder") == {"assur.numerics.legs"}
    assert "assur.cli.direct" in entrances()


# ---- how large it is -----------------------------------------------------------------------------------------


def lines(paths: Iterable[Path]) -> int:
    return sum(len(text_of(path).splitlines()) for path in paths)


def counts() -> dict[str, int]:
    """What the house is measured by."""
    return {
        "lines of source": lines((ROOT / "src").rglob("*.py")),
        "lines of tests": lines((ROOT / "tests").rglob("*.py")),
        "lines of JavaScript": lines((ROOT / "web" / "src").rglob("*.js")),
        "lines of README": lines([ROOT / "README.md"]),
        "modules": len(FILES),
        "longest module": max(lines([path]) for path in FILES.values()),
        "circles of imports": len(circles(imports_of_all())),
    }


def test_the_counts_are_printed(capsys):
    measured = counts()
    with capsys.disabled():
        sys.stdout.write("".join(f"\n    {name}: {number}" for name, number in measured.items()) + "\n")
    assert measured["lines of README"] < 200
    assert measured["circles of imports"] == 0
    assert all(measured[f"lines of {name}"] for name in ("source", "tests", "JavaScript"))
