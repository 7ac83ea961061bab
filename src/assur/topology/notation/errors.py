"""A text that is no chain: where it goes wrong, what was found there, what was expected."""

from __future__ import annotations

import unicodedata
from dataclasses import dataclass

from assur.errors import UsageError

_SHOWN = 40


class NotationError(UsageError):
    """A chain that cannot be read, or that contradicts itself. Its message has a caret under the place.

    Attributes:
        text: the chain as written.
        position: index of the place in it.
        limb: number of the limb, from 1; 0 for a chain of its own.
    """

    def __init__(self, source: Source, position: int, offending: str, expected: str, *, hint: str = "") -> None:
        text = source.text
        start = max(0, position - _SHOWN)
        before, after = _plain(text[start:position]), _plain(text[position : position + _SHOWN])
        which = f"limb {source.limb}" if source.limb else "this chain"
        caret = " " * sum(map(_columns, before)) + "^"
        super().__init__(
            f"cannot read {which}:\n  {before}{after}\n  {caret} {offending}; expected {expected}",
            hint=hint,
        )
        self.text = text
        self.position = position
        self.limb = source.limb
        self.offending = offending
        self.expected = expected


@dataclass(frozen=True)
class Source:
    """The text of a chain, and the number of the limb that it is (0: it stands alone)."""

    text: str
    limb: int = 0

    def error(self, position: int, offending: str, expected: str, hint: str = "") -> NotationError:
        """What to raise about a place in this text."""
        return NotationError(self, position, offending, expected, hint=hint)


def character(text: str, position: int) -> str:
    r"""The character at a place, in words where it cannot be told by its look.

    >>> character("R R", 3), character("R Q", 2), character("R\u200bR", 1)
    ('the end', "'Q'", 'U+200B ZERO WIDTH SPACE')
    """
    if position >= len(text):
        return "the end"
    sign = text[position]
    if sign.isascii() and sign.isprintable():
        return f"'{sign}'"
    name = unicodedata.name(sign, "")
    look = f"'{sign}' " if sign.isprintable() else ""
    return f"{look}U+{ord(sign):04X} {name}".rstrip()


def _plain(text: str) -> str:
    """Control characters as spaces, so that the caret stands under its place."""
    return "".join(sign if sign.isprintable() or unicodedata.category(sign) == "Cf" else " " for sign in text)


def _columns(sign: str) -> int:
    if unicodedata.combining(sign) or unicodedata.category(sign) == "Cf":
        return 0
    return 2 if unicodedata.east_asian_width(sign) in "WF" else 1
