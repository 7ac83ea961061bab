"""The source as laws of the house read it."""

import ast
from pathlib import Path

from imports import tree

SOURCE = Path(__file__).parents[2] / "src" / "assur"
CORE = sorted(path for path in SOURCE.rglob("*.py") if "mechanisms" not in path.relative_to(SOURCE).parts)
"""Modules but those of mechanisms, which repeat the names of their kind."""


def texts(path: Path) -> list[str]:
    """Strings in a module but its documentation."""
    nodes = list(ast.walk(tree(path)))
    documentation = {id(node.value) for node in nodes if isinstance(node, ast.Expr)}
    constants = [node for node in nodes if isinstance(node, ast.Constant) and id(node) not in documentation]
    return [node.value for node in constants if isinstance(node.value, str)]
