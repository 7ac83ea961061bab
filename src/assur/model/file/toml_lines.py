"""The line of a TOML document on which every key and every array element stands."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable

from assur.errors import KeyPath

_BARE = re.compile(r"[A-Za-z0-9_-]+")
_STRING = re.compile(
    r'"""(?:[^\\]|\\.)*?"{3,5}' r"|'''.*?'{3,5}" r'|"(?:[^"\\\n]|\\.)*"' r"|'[^'\n]*'",
    re.DOTALL,
)
_SCALAR = re.compile(r"[^,\]}#\n]+")
_BLANK = re.compile(r"(?:[ \t\r\n]|#[^\n]*)*")


class Lines:
    """Walks over a document that is known to be TOML and notes where keys and elements stand.

    The elements of an array of tables ([[name]]) share the lines of that name: mechanism files have none.
    """

    def __init__(self, text: str) -> None:
        self.text = text
        self.position = 0
        self.seen = 0
        self.line = 1
        self.line_of: dict[KeyPath, int] = {}
        self.notes: list[tuple[KeyPath, int]] = []

    def lines(self) -> dict[KeyPath, int]:
        """Path of a key or array element -> its line, counted from 1."""
        table: KeyPath = ()
        self._skip()
        while self.position < len(self.text):
            if self._at("["):
                table = self._header()
            else:
                self._pair(table)
            self._skip()
        return self.line_of

    def _at(self, mark: str) -> bool:
        return self.text.startswith(mark, self.position)

    def _skip(self) -> None:
        match = _BLANK.match(self.text, self.position)
        self.position = match.end() if match else self.position

    def _note(self, path: KeyPath) -> KeyPath:
        self.line += self.text.count("\n", self.seen, self.position)
        self.seen = self.position
        self.notes.append((path, self.line))
        for length in range(1, len(path) + 1):
            self.line_of.setdefault(path[:length], self.line)
        return path

    def _header(self) -> KeyPath:
        brackets = 2 if self._at("[[") else 1
        self.position += brackets
        table = tuple(self._keys())
        self.position += brackets
        return self._note(table)

    def _keys(self) -> list[str]:
        keys: list[str] = []
        while True:
            self._skip_blanks()
            if self.text[self.position] in "\"'":
                text = self._match(_STRING)
                keys.append(str(tomllib.loads(f"k = {text}")["k"]))
            else:
                keys.append(self._match(_BARE))
            self._skip_blanks()
            if not self._at("."):
                return keys
            self.position += 1

    def _skip_blanks(self) -> None:
        while self.position < len(self.text) and self.text[self.position] in " \t":
            self.position += 1

    def _match(self, pattern: re.Pattern[str]) -> str:
        match = pattern.match(self.text, self.position)
        if match is None:  # cannot be in a document that tomllib has read; go on and lose only a line number
            self.position += 1
            return ""
        self.position = match.end()
        return match.group()

    def _pair(self, table: KeyPath) -> None:
        path = self._note((*table, *self._keys()))
        self.position += 1
        self._value(path)

    def _value(self, path: KeyPath) -> None:
        self._skip_blanks()
        if self._at("["):
            self._items("]", path, self._element)
        elif self._at("{"):
            self._items("}", path, lambda inner, _: self._pair(inner))
        elif self._at('"') or self._at("'"):
            self._match(_STRING)
        else:
            self._match(_SCALAR)

    def _element(self, path: KeyPath, index: int) -> None:
        self._value(self._note((*path, index)))

    def _items(self, closing: str, path: KeyPath, reader: Callable[[KeyPath, int], None]) -> None:
        self.position += 1
        index = 0
        self._skip()
        while self.position < len(self.text) and not self._at(closing):
            reader(path, index)
            index += 1
            self._skip()
            if self._at(","):
                self.position += 1
            self._skip()
        self.position += 1
