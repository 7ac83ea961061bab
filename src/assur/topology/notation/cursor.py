"""A place in a text that moves on as signs are read, and what to say when the next one does not fit."""

from __future__ import annotations

import re

from assur.joints.catalogue import BY_LETTER
from assur.topology.notation import signs
from assur.topology.notation.errors import NotationError, Source, character

LETTERS = ", ".join(BY_LETTER)

_PARALLELOGRAMS = "P(4R), P(4S), P(4U), P(2US)"
_HINTS = {
    "the end": "write the joints from the base to the platform: P[x] R[x] R[x]",
    ",": "joints stand side by side: R[x] R[y]; two directions of one joint stand in its brackets: U[x,y]",
    ";": "joints stand side by side: R[x] R[y]",
    "[": "a direction follows its joint: R[x]",
    "(": "an inner loop stands in braces: {P[y] R[x] R[x] | P[y] R[x] R[x]}",
    ")": "there is no round bracket that it closes",
    "]": "there is no square bracket that it closes",
    "}": "there is no brace that it closes",
    "@": "a label follows its joint: R[x]@A",
    "|": "a bar stands between branches in braces, or between two joints that are parallel",
    "_": r"perpendicular is _|_, \perp or ⊥; a direction stands in brackets: R[x]",
    "\\": r"LaTeX: \parallel, \perp, \frown, \Diamond, \{ and \}",
    "+": "joints stand side by side: R[x] R[y]",
    "*": "write every joint: R[x] R[x]",
    "x": "a direction stands in brackets: R[x]",
    "y": "a direction stands in brackets: R[y]",
    "z": "a direction stands in brackets: R[z]",
}


class Cursor:
    """Where the reader stands. Patterns meet the text in plain letters, errors show it as written."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.text = signs.plain_letters(source.text)
        self.at = 0

    def skip(self) -> None:
        """Over blanks and dots."""
        self.take(signs.SPACE)

    def take(self, pattern: re.Pattern[str]) -> re.Match[str] | None:
        """What fits here, and move behind it."""
        match = pattern.match(self.text, self.at)
        if match:
            self.at = match.end()
        return match

    def sees(self, pattern: re.Pattern[str]) -> bool:
        """Whether something fits here, behind blanks."""
        self.skip()
        return pattern.match(self.text, self.at) is not None

    @property
    def ended(self) -> bool:
        """Whether only blanks are left."""
        self.skip()
        return self.at >= len(self.text)

    def error(self, at: int, offending: str, expected: str, hint: str = "") -> NotationError:
        """What to raise about a place."""
        return self.source.error(at, offending, expected, hint)

    def unexpected(self, expected: str, hint: str = "") -> NotationError:
        """What to raise about the character here."""
        self.skip()
        return self.error(self.at, character(self.source.text, self.at), expected, hint or self._hint())

    def _hint(self) -> str:
        sign = self.text[self.at : self.at + 1] or "the end"
        if sign in _HINTS:
            return _HINTS[sign]
        if sign.upper() in LETTERS.split(", "):
            return f"joints are capital letters: {sign.upper()}"
        if sign.isdigit():
            return "write every joint, and each limb as a chain of its own: R R C, not 2RC and not 3-RRC"
        if sign.isalpha():
            return f"{sign} is not a joint; the joints are {LETTERS} and the parallelograms {_PARALLELOGRAMS}"
        return ""
