"""Meanings: the points and links that the words of a factor's meaning name, e.g. "B1C1 and B2C2 are parallel"."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.figures.letters import letter
from assur.scene.skeleton import Skeleton

FloatArray = NDArray[np.float64]
_WORD = re.compile(r"[A-Za-z0-9'.]+")
_NUMBERED = re.compile(r"\blinks? ((?:\w+)(?:(?:, | and )\d+)*)")


@dataclass(frozen=True, eq=False)
class NamedParts:
    """What a text names.

    Attributes:
        lines: polylines (k, 3) through points that stand together, as B1C1 or A3, B3, C3.
        letters: names of all those points, each once.
        links: links that the text names by their number, as link 12.
    """

    lines: tuple[FloatArray, ...]
    letters: tuple[str, ...]
    links: tuple[str, ...]


def named(text: str, skeleton: Skeleton) -> NamedParts:
    """Find the points, lines and links of a text.

    >>> from assur.scene.companion import companion
    >>> from assur.scene.skeleton import skeleton
    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("zeng2019")
    >>> found = named("B1C1 and B2C2 are parallel", skeleton(record, companion(record), home_values(record)))
    >>> len(found.lines), found.letters
    (2, ('B1', 'C1', 'B2', 'C2'))
    """
    runs: list[list[str]] = [[]]
    for part in re.split(r"(,\s*|\s+|:)", text):
        names = _letters(part, skeleton)
        if len(names) > 1:
            runs += [names, []]
        elif names:
            runs[-1] += names
        elif part.strip() not in ("", ",", "and"):
            runs.append([])
    lines = [np.array([skeleton.points[name] for name in run]) for run in runs if len(run) > 1]
    letters = dict.fromkeys(name for run in runs if len(run) > 1 for name in run)
    links = _links(text, skeleton)
    lines += [rod.points for rod in skeleton.rods if rod.link in links and not letters]
    return NamedParts(tuple(lines), tuple(letters), links)


def together(named_parts: Sequence[NamedParts]) -> NamedParts:
    """What several texts name, each point and link once."""
    return NamedParts(
        tuple(line for item in named_parts for line in item.lines),
        tuple(dict.fromkeys(name for item in named_parts for name in item.letters)),
        tuple(dict.fromkeys(link for item in named_parts for link in item.links)),
    )


def typeset(text: str, skeleton: Skeleton) -> str:
    """A text with the letters of its points as they are drawn."""
    parts = re.split(r"(,\s*|\s+|:)", text)
    return "".join("".join(map(letter, _letters(part, skeleton))) or part for part in parts).replace("$$", "")


def _letters(word: str, skeleton: Skeleton) -> list[str]:
    """The points that a word is made of, if it is made of nothing else."""
    if not _WORD.fullmatch(word):
        return []
    choices = "|".join(re.escape(name) for name in sorted(skeleton.points, key=len, reverse=True))
    return re.findall(choices, word) if re.fullmatch(f"(?:{choices})+", word) else []


def _links(text: str, skeleton: Skeleton) -> tuple[str, ...]:
    found: dict[str, None] = {}
    for group in _NUMBERED.findall(text):
        for number in re.split(r", | and ", group):
            found |= dict.fromkeys(rod.link for rod in skeleton.rods if rod.label == number)
    return tuple(found)


def accented(parts: NamedParts, skeleton: Skeleton) -> tuple[str, ...]:
    """Links that lie along the lines that a text names."""
    links = dict.fromkeys(parts.links)
    for rod in skeleton.rods:
        for line in parts.lines:
            near = [float(np.min(np.linalg.norm(line - end, axis=1))) for end in rod.points]
            if max(near) < 1e-9 * skeleton.size:
                links[rod.link] = None
    return tuple(links)
