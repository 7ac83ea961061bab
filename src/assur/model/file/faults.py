"""Collects the problems of a file, so that all of them are reported at once."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from typing import TYPE_CHECKING

from assur.errors import KeyPath, MechanismFileError, Problem, cut, path_text

if TYPE_CHECKING:
    from assur.model.file.toml_source import TomlSource

_SHOWN = 28
MOST = 100
"""So many faults are told one by one; who has more has one cause for all of them."""
_LONG = 400
_COMPARED = 500


class Faults:
    """The problems found so far, each with its line. The same problem at the same place counts once."""

    def __init__(self, file: str, source: TomlSource) -> None:
        self.file = file
        self.source = source
        self.problems: list[Problem] = []
        self.more = 0
        self._places: set[KeyPath] = set()

    def copy(self) -> Faults:
        """The same problems, to note others with them."""
        other = Faults(self.file, self.source)
        other.problems, other.more, other._places = [*self.problems], self.more, {*self._places}
        return other

    def add(self, path: KeyPath, given: str, allowed: str, hint: str = "") -> None:
        """Note what was found at a place and what is allowed there."""
        in_limb = path[:1] == ("limbs",)
        self._places.add(path[2:] if in_limb else path)
        if len(self.problems) >= MOST:
            self.more += 1
            return
        while path and isinstance(path[-1], int) and path not in self.source.lines:
            path = path[:-1]  # an index into what the file writes as one value
        place = (self.file, self.source.line(path), path_text(path))
        problem = Problem(*place, cut(given, _LONG), cut(allowed, 2 * _LONG), cut(hint, _LONG))
        if problem not in self.problems:
            self.problems.append(problem)

    def first(self, path: KeyPath) -> str:
        """Where the first of two that are equal stands, for the message about the second."""
        return f"the first one is in line {self.source.line(path)}"

    def unknown(self, path: KeyPath, kind: str, name: str, choices: Iterable[str]) -> None:
        """Note a name that does not exist, with those that do, nearest first in the hint."""
        told = len(self.problems) < MOST
        hint = nearest(name, choices) if told else ""
        self.add(path, f"unknown {kind} '{cut(name)}'", f"there is: {listed(choices) if told else ''}", hint)

    def spares(self, *places: KeyPath) -> bool:
        """Whether no fault so far lies at one of these places, in it or above it; `limbs.<limb>` is left out of paths.

        >>> from assur.model.file.toml_source import TomlSource
        >>> faults = Faults("my.toml", TomlSource({}, {}))
        >>> faults.add(("limbs", "leg", "joints", "A"), "a word", "allowed: a table")
        >>> faults.spares(("links",), ("platform", "link")), faults.spares(("joints",))
        (True, False)
        """
        both = ((path, place) for path in self._places for place in places)
        return not any(all(a == b for a, b in zip(path, place, strict=False)) for path, place in both)

    def raise_any(self) -> None:
        """Raise `MechanismFileError` with every problem in the order of the file, if there is one."""
        if self.problems:
            raise MechanismFileError(self.told())

    def told(self) -> tuple[Problem, ...]:
        """Every problem in the order of the file, and at the end how many more there are."""
        rest = [Problem(self.file, None, "", f"{self.more} more faults", "correct the others first")]
        ordered = sorted(self.problems, key=lambda problem: problem.line or 0)
        return (*ordered, *(rest if self.more else []))


def listed(names: Iterable[str]) -> str:
    """Names for a message; a long list is cut.

    >>> listed(["b", "a"]), listed([])
    ('a, b', 'none')
    """
    ordered = sorted(names)
    more = f", and {len(ordered) - _SHOWN} more" if len(ordered) > _SHOWN else ""
    return ", ".join(map(cut, ordered[:_SHOWN])) + more if ordered else "none"


def nearest(name: str, choices: Iterable[str]) -> str:
    """A question that names the nearest choices, or nothing.

    >>> nearest("axsi", ["axis", "at"])
    "did you mean 'axis'?"
    """
    choices = sorted(choices)
    if len(choices) > _COMPARED:
        return ""
    near = difflib.get_close_matches(cut(name), choices, n=2, cutoff=0.5)
    return f"did you mean {' or '.join(repr(item) for item in near)}?" if near else ""
