"""Where in a `closed_form.py` a part of it is written: the text is read, never run."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path

from assur.kinematics.contract.mismatch import Mismatch

MOST = 1_000_000
"""Characters that are read; a longer file has no lines told."""


def line_of(path: Path, mismatch: Mismatch) -> int | None:
    """The line of the file at which what a mismatch names is worked out, else where it is declared."""
    tree = _tree(path)
    if tree is None:
        return None
    return next((node for node in _places(tree, mismatch) if node), None)


@lru_cache(maxsize=8)
def _tree(path: Path) -> ast.Module | None:
    try:
        text = path.read_text(encoding="utf-8")
        return ast.parse(text) if len(text) <= MOST else None
    except (OSError, ValueError, SyntaxError, RecursionError, MemoryError):
        return None


def _places(tree: ast.Module, mismatch: Mismatch) -> Iterator[int | None]:
    """Lines from the most telling to the least."""
    problem = _function(tree, mismatch.problem)
    name = mismatch.name
    if mismatch.part == "relation":
        yield from (node.lineno for node in ast.walk(tree) if isinstance(node, ast.Constant) and node.value == name)
    if mismatch.part == "margin":
        yield _entry(problem, name)
        yield from (_entry(function, name) for function in _functions(tree))
        yield _declared(tree, "Margin", name)
    elif mismatch.part == "status":
        yield _declared(tree, "Factor", name)
    elif mismatch.part == "factor":
        yield _entry(_function(tree, "factors"), name)
        yield _declared(tree, "Factor", name)
        yield _line(_function(tree, "factors"))
    elif mismatch.part == "mode sign":
        yield _attribute(problem, name)
        yield _entry(tree, name)
    elif mismatch.part == "joint":
        yield _entry(_function(tree, "joints"), name, followed=False)
        yield _line(_function(tree, "joints"))
    elif mismatch.part in ("Jp and Jq", "Jp", "Jq"):
        yield _line(_function(tree, "jacobians"))
    yield _line(problem)
    yield _keyword(tree, mismatch.problem)


def _line(node: ast.AST | None) -> int | None:
    return getattr(node, "lineno", None)


def _functions(tree: ast.AST) -> list[ast.FunctionDef]:
    return [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)]


def _function(tree: ast.Module, role: str) -> ast.FunctionDef | None:
    """The function that ClosedForm(...) is given as a keyword, or that has its name."""
    given = next((node for node in _keywords(tree, role) if isinstance(node, ast.Name)), None)
    name = given.id if given else role
    return next((node for node in _functions(tree) if node.name == name), None)


def _keywords(tree: ast.Module, role: str) -> Iterator[ast.expr]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "ClosedForm":
            yield from (item.value for item in node.keywords if item.arg == role)


def _keyword(tree: ast.Module, role: str) -> int | None:
    return next((node.lineno for node in _keywords(tree, role)), None)


def _entry(scope: ast.AST | None, key: str, *, followed: bool = True) -> int | None:
    """The line of what a dictionary has at a key; of a name that is followed, where it was last given a value."""
    if scope is None or not key:
        return None
    for node in ast.walk(scope):
        for own, value in zip(node.keys, node.values, strict=True) if isinstance(node, ast.Dict) else ():
            if isinstance(own, ast.Constant) and own.value == key:
                made = _assigned(scope, value.id, value.lineno) if followed and isinstance(value, ast.Name) else None
                return made or value.lineno
    return None


def _assigned(scope: ast.AST, name: str, before: int) -> int | None:
    lines = [
        node.lineno
        for node in ast.walk(scope)
        if isinstance(node, ast.Assign) and node.lineno <= before
        for target in node.targets
        for part in ast.walk(target)
        if isinstance(part, ast.Name) and part.id == name
    ]
    return max(lines, default=None)


def _attribute(scope: ast.AST | None, name: str) -> int | None:
    """Where the sign of that name is used."""
    nodes = ast.walk(scope) if scope is not None else ()
    return next((node.lineno for node in nodes if isinstance(node, ast.Attribute) and node.attr == name), None)


def _declared(tree: ast.Module, kind: str, name: str) -> int | None:
    """The line of Margin("name", ...)."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == kind and node.args:
            first = node.args[0]
            if isinstance(first, ast.Constant) and first.value == name:
                return node.lineno
    return None
