"""Laws about names: a class name means one thing, and a name says what it holds."""

import ast
from collections import defaultdict
from collections.abc import Iterable, Iterator
from pathlib import Path

import pytest
from imports import nodes, tree

from source import CORE

PLACES = {"found", "here", "there", "item", "wanted"}
"""Words for a place in a sentence: what they hold has a name in the theory, as solutions, roots, assemblies."""


def public_classes() -> dict[str, list[Path]]:
    """Modules by the name of a public class at their top."""
    modules = defaultdict(list)
    for path in CORE:
        for node in tree(path).body:
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                modules[node.name].append(path)
    return modules


def declared(nodes: Iterable[ast.AST]) -> Iterator[tuple[str, int]]:
    """Names, with their lines, of parameters, fields, methods and attributes that are set."""
    for node in nodes:
        if isinstance(node, ast.arg):
            yield node.arg, node.lineno
        elif isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
            yield node.attr, node.lineno
        elif isinstance(node, ast.ClassDef):
            for member in node.body:
                if isinstance(member, ast.AnnAssign) and isinstance(member.target, ast.Name):
                    yield member.target.id, member.lineno
                elif isinstance(member, ast.Assign):
                    yield from ((name.id, name.lineno) for name in member.targets if isinstance(name, ast.Name))
                elif isinstance(member, ast.FunctionDef):
                    yield member.name, member.lineno


def test_a_public_class_name_is_unique():
    assert {name: modules for name, modules in public_classes().items() if len(modules) > 1} == {}


def test_nothing_is_declared_by_a_word_for_a_place():
    places = [(path, line) for path in CORE for name, line in declared(nodes(path)) if name in PLACES]
    assert places == []


@pytest.mark.parametrize(
    "text",
    [
        "def f(found): ...",
        "def f(*, found=1): ...",
        "lambda found: found",
        "class A:\n    found: int",
        "class A:\n    found = 1",
        "class A:\n    def found(self): ...",
        "a.found = 1",
        "a.found: int = 1",
    ],
)
def test_a_declaration_is_seen(text):
    assert [name for name, _ in declared(ast.walk(ast.parse(text))) if name == "found"] == ["found"]
