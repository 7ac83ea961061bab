"""Texts of a document: seen as they are read, and names short enough to be read."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator
from typing import Any

from assur.errors import KeyPath, hidden

MAX_NAME = 100
"""Characters of a name at most."""
_LINES = "\n\t"
"""What a text of several lines may have."""


def text_faults(data: Any, path: KeyPath = ()) -> Iterator[tuple[KeyPath, tuple[str, str]]]:
    r"""Places of texts that nobody should read, with what was found there and what is allowed.

    Controls and escapes, which a terminal obeys; changes of direction and other marks that nobody sees; keys that are
    too long.

    >>> list(text_faults({"title": "a\x1b[2J"}))
    [(('title',), ('U+001B, a control character', 'allowed: text that is seen as it is read'))]
    """
    if isinstance(data, str):
        yield from ((path, said) for said in _of_text(data, _LINES))
    elif isinstance(data, dict):
        for key, value in data.items():
            place = (*path, key)
            yield from ((place, said) for said in (*_of_text(key, ""), *_of_key(key)))
            yield from text_faults(value, place)
    elif isinstance(data, list):
        for index, value in enumerate(data):
            yield from text_faults(value, (*path, index))


def long_name(text: str) -> tuple[str, str] | None:
    """What is wrong with a name that is too long, and what is allowed; None of another one."""
    if len(text) <= MAX_NAME:
        return None
    return f"a name of {len(text)} characters", f"allowed: at most {MAX_NAME}"


def _of_text(text: str, kept: str) -> Iterator[tuple[str, str]]:
    for sign in hidden(text, kept)[:1]:
        name = unicodedata.name(sign, "a control character").lower()
        yield f"U+{ord(sign):04X}, {name}", "allowed: text that is seen as it is read"


def _of_key(key: str) -> Iterator[tuple[str, str]]:
    said = long_name(key)
    if said:
        yield said
