"""Collects the problems of a file, so that all of them are reported at once."""

from __future__ import annotations

import difflib
from collections.abc import Iterable

from assur.errors import MechanismFileError, Problem
from assur.model.file.toml_source import KeyPath, TomlSource

_SHOWN = 24


class Faults:
    """The problems found so far, each with its line. The same problem at the same place counts once."""

    def __init__(self, file: str, source: TomlSource) -> None:
        self.file = file
        self.source = source
        self.problems: list[Problem] = []

    def add(self, path: KeyPath, found: str, allowed: str, hint: str = "") -> None:
        """Note what was found at a place and what is allowed there."""
        while path and isinstance(path[-1], int) and path not in self.source.lines:
            path = path[:-1]  # an index into what the file writes as one value
        problem = Problem(self.file, self.source.line(path), path_text(path), found, allowed, hint)
        if problem not in self.problems:
            self.problems.append(problem)

    def unknown(self, path: KeyPath, kind: str, name: str, choices: Iterable[str]) -> None:
        """Note a name that does not exist, with those that do, nearest first in the hint."""
        self.add(path, f"unknown {kind} '{name}'", f"there is: {listed(choices)}", nearest(name, choices))

    def raise_any(self) -> None:
        """Raise `MechanismFileError` with every problem in the order of the file, if there is one."""
        if self.problems:
            raise MechanismFileError(sorted(self.problems, key=lambda problem: problem.line or 0))


def path_text(path: KeyPath) -> str:
    """A key path as TOML writes it, elements of arrays in brackets.

    >>> path_text(("joints", "B1", "at", 2)), path_text(("home", "leg1.B"))
    ('joints.B1.at[2]', 'home."leg1.B"')
    """
    text = ""
    for part in path:
        if isinstance(part, int):
            text += f"[{part}]"
        else:
            plain = part.replace("_", "a").replace("-", "a").isalnum() and part.isascii()
            text += ("." if text else "") + (part if plain else f'"{part}"')
    return text


def listed(names: Iterable[str]) -> str:
    """Names for a message; a long list is cut.

    >>> listed(["b", "a"]), listed([])
    ('a, b', 'none')
    """
    ordered = sorted(names)
    more = f", and {len(ordered) - _SHOWN} more" if len(ordered) > _SHOWN else ""
    return ", ".join(ordered[:_SHOWN]) + more if ordered else "none"


def nearest(name: str, choices: Iterable[str]) -> str:
    """A question that names the nearest choices, or nothing.

    >>> nearest("axsi", ["axis", "at"])
    "did you mean 'axis'?"
    """
    near = difflib.get_close_matches(name, sorted(choices), n=2, cutoff=0.5)
    return f"did you mean {' or '.join(repr(item) for item in near)}?" if near else ""
