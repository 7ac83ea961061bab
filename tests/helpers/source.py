"""The source as laws of the house read it."""

import ast
from pathlib import Path

from imports import nodes

SOURCE = Path(__file__).parents[2] / "src" / "assur"
CORE = sorted(path for path in SOURCE.rglob("*.py") if "mechanisms" not in path.relative_to(SOURCE).parts)
"""Modules but those of mechanisms, which repeat the names of their kind."""


def texts(path: Path) -> list[str]:
    """Strings in a module but its documentation."""
    documentation = {id(node.value) for node in nodes(path) if isinstance(node, ast.Expr)}
    constants = [node for node in nodes(path) if isinstance(node, ast.Constant) and id(node) not in documentation]
    return [node.value for node in constants if isinstance(node.value, str)]
