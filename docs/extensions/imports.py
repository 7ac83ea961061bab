"""Who imports whom: read from the source, nothing is executed."""

from __future__ import annotations

import ast
from collections.abc import Container, Iterable, Iterator, Mapping
from functools import cache
from pathlib import Path


def module_files(source: Path) -> dict[str, Path]:
    """Files of the package by the names of their modules; a package has the name of its folder."""
    paths = sorted(source.rglob("*.py"))
    return {
        ".".join((source.name, *path.relative_to(source).with_suffix("").parts)).removesuffix(".__init__"): path
        for path in paths
    }


@cache
def tree(path: Path) -> ast.Module:
    """The syntax tree of a file, read once."""
    return ast.parse(path.read_text(encoding="utf-8"))


@cache
def nodes(path: Path) -> tuple[ast.AST, ...]:
    """Everything in the syntax tree of a file: a law of the house reads it each, a thousand files are walked once."""
    return tuple(ast.walk(tree(path)))


def imported(nodes: Iterable[ast.AST], names: Container[str]) -> Iterator[str]:
    """Which of some modules a text imports, wherever in it."""
    for node in nodes:
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name in names)
        elif isinstance(node, ast.ImportFrom):
            modules = [f"{node.module}.{alias.name}" for alias in node.names]
            yield from (name if name in names else str(node.module) for name in modules)


def imports(files: Mapping[str, Path]) -> dict[str, set[str]]:
    """Of every module what it imports, also within a function or for types alone."""
    return {name: set(imported(nodes(path), files)) & files.keys() for name, path in files.items()}
