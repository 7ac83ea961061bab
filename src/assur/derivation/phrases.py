"""Phrases of geometry in which links, joints and directions are named: as text, and for print."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import sympy

AXES = {(1, 0, 0): "x", (0, 1, 0): "y", (0, 0, 1): "z"}


@dataclass(frozen=True)
class NamedLink:
    """A link, or a parallelogram whose links stay parallel."""

    name: str
    parallelogram: bool = False


@dataclass(frozen=True)
class NamedJoint:
    """A joint's point, or where a phrase says so its axis."""

    name: str


@dataclass(frozen=True, eq=False)
class NamedDirection:
    """A direction in the base, by its components."""

    vector: tuple[Any, Any, Any]


PhrasePart = str | NamedLink | NamedJoint | NamedDirection


@dataclass(frozen=True)
class GeometricPhrase:
    """What a quantity means.

    >>> phrase("{} is across {}", NamedLink("leg1.rod"), NamedDirection((1, 0, 0))).text
    'the rod of limb 1 is across x'
    """

    parts: tuple[PhrasePart, ...]

    @property
    def text(self) -> str:
        """In words, joints by their names in the file."""
        return "".join(map(_text, self.parts))

    def written(self, of_joint: Callable[[str], str], of_vector: Callable[[Sequence[Any]], str]) -> str:
        """In LaTeX, by what writes joints and vectors."""
        return "".join(self._latex(part, of_joint, of_vector) for part in self.parts)

    def _latex(
        self, part: PhrasePart, of_joint: Callable[[str], str], of_vector: Callable[[Sequence[Any]], str]
    ) -> str:
        if isinstance(part, NamedDirection):
            return of_vector(part.vector)
        if isinstance(part, NamedJoint):
            return f"${of_joint(part.name)}$"
        if isinstance(part, NamedLink) and part.parallelogram:
            return f"parallelogram ${of_joint(part.name)}$"
        return _text(part)


def phrase(text: str, *named: PhrasePart) -> GeometricPhrase:
    """A phrase with names in the place of `{}`."""
    pieces = text.split("{}")
    parts: list[PhrasePart] = [pieces[0]]
    for own, piece in zip(named, pieces[1:], strict=True):
        parts += [own, piece]
    return GeometricPhrase(tuple(part for part in parts if part != ""))


def joined(names: Sequence[PhrasePart]) -> tuple[str, tuple[PhrasePart, ...]]:
    """The text of a list with `{}` for each name, and the names.

    >>> joined([NamedJoint("A"), NamedJoint("B"), NamedJoint("C")])[0]
    '{}, {} and {}'
    """
    places = listed(["{}"] * len(names))
    groups = [own for own in names if isinstance(own, NamedLink) and own.parallelogram]
    if len(groups) == len(names) > 1:
        return f"parallelograms {places}", tuple(NamedJoint(own.name) for own in groups)
    return places, tuple(names)


def listed(names: Sequence[str], last: str = "and") -> str:
    """Names one after another.

    >>> listed(["A", "B", "C"])
    'A, B and C'
    """
    return "".join(names) if len(names) < 2 else f"{', '.join(names[:-1])} {last} {names[-1]}"


def words(link: str) -> str:
    """A link's name in words, with its number apart.

    >>> words("leg1.arm"), words("b1.arm"), words("link4a"), words("leg2.rod_a")
    ('arm of limb 1', 'arm of limb b1', 'link 4a', 'rod a of limb 2')
    """
    limb = re.fullmatch(r"([A-Za-z]+)(\d+)\.([A-Za-z]+)(?:_?(\d+\w?)|_(\w+))?", link)
    if limb:
        name, number, part, *further = limb.groups()
        of = f"limb {number}" if len(name) > 1 else f"limb {name}{number}"  # one of several kinds, as a1 and b1
        return " ".join([part, *(own.replace("_", " ") for own in further if own), "of", of])
    plain = re.fullmatch(r"([A-Za-z]+)(\d+)(\w?)", link)
    return f"{plain[1]} {plain[2]}{plain[3]}" if plain and len(plain[1]) > 1 else link.replace("_", " ")


def direction(axis: Sequence[Any]) -> str:
    """A direction in words: a letter, or its parts."""
    x, y, z = (sympy.sympify(part) for part in axis)
    return AXES.get((x, y, z), f"({x}, {y}, {z})")


def _text(part: PhrasePart) -> str:
    if isinstance(part, str):
        return part
    if isinstance(part, NamedDirection):
        return direction(part.vector)
    if isinstance(part, NamedJoint):
        return part.name
    if part.parallelogram:
        return f"parallelogram {part.name}"
    return f"the {words(part.name)}" if "." in part.name else words(part.name)
