"""Every module of the package with the first line of its docstring, which says its idea."""

from __future__ import annotations

import ast
import inspect
import re
import tomllib
from pathlib import Path

_DOCSTRING = re.compile(r'\A((?:#[^\n]*\n|\s)*[rR]?""".*?""")', re.DOTALL)


def markdown(root: Path) -> str:
    """A heading and a table for each package."""
    source = root / "src" / "assur"
    folders = sorted(
        path.parent
        for path in source.rglob("__init__.py")
        if path.parent != source and "mechanisms" not in path.relative_to(source).parts
    )
    return "\n".join(_section(folder, source) for folder in folders)


def _section(folder: Path, source: Path) -> str:
    name = ".".join(("assur", *folder.relative_to(source).parts))
    rows = [f"| `{path.stem}` | {idea(path)} |" for path in sorted(folder.glob("[!_]*.py"))]
    head = f"## {name}\n\n{idea(folder / '__init__.py')}\n"
    return "\n".join([head, "| module | idea |", "|---|---|", *rows, ""]) if rows else head


def docstring(path: Path) -> str:
    """A module's docstring, the rest of it unread; empty where it begins with something else."""
    begun = _DOCSTRING.match(path.read_text(encoding="utf-8"))
    return inspect.cleandoc(ast.literal_eval(begun[1])) if begun else ""


def idea(path: Path) -> str:
    """First paragraph of a module's docstring, with what Markdown would read escaped."""
    words = docstring(path)
    line = " ".join(words.split("\n\n")[0].split())
    return line.replace("|", "\\|").replace("*", "\\*").replace("<", "&lt;")


def order(root: Path) -> list[str]:
    """Folders and modules of the package in the order of imports, the highest first, as pyproject.toml has it."""
    table = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))
    contracts = table["tool"]["importlinter"]["contracts"]
    return list(next(contract["layers"] for contract in contracts if contract["type"] == "layers"))


def layers(root: Path) -> str:
    """The order of imports, the highest first, one on a line."""
    return "\n".join(["```text", *order(root), "```"])
