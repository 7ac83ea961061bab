"""TOML text with the line on which every key and every array element stands."""

from __future__ import annotations

import contextlib
import re
import tomllib
from dataclasses import dataclass
from typing import Any

from assur.errors import KeyPath, MechanismFileError, Problem, path_text
from assur.model.file.texts import text_faults
from assur.model.file.toml_lines import Lines

MAX_CHARACTERS = 200_000
MAX_DEPTH = 20
MAX_BITS = 10_000
MAX_ITEMS = 5_000
"""Limits far beyond any mechanism, so that no text takes long or exhausts the stack."""

_PLACE = re.compile(r"\s*\(at (?:line (\d+), column \d+|end of document)\)$")
MAX_SYNTAX = 20
"""Syntax errors that are told at once."""
_ALONE = (
    "Invalid value",
    "Expected newline or end of document after a statement",
    "Expected '=' after a key",
    "Cannot overwrite a value",
)
"""Errors that concern the line in which they are found, and no other."""
_STATEMENT = re.compile(r"\s*[\w.\"'-]+\s*=?[^\[\]{}\"']*(?:#.*)?")
"""A line that opens nothing which another one closes."""
_DECIMAL_COMMA = re.compile(r"=\s*[\[{]?[^#\"']*\d,\d")
_PART = r"""(?:[A-Za-z0-9_-]+|"(?:[^"\\\n]|\\.)*"|'[^'\n]*')"""
_TOKEN = re.compile(
    r'#[^\n]*|"""(?:[^\\]|\\.)*?"{3,5}|' + r"'''.*?'{3,5}|"
    rf"(?P<deep>(?:{_PART}[ \t]*\.[ \t]*){{{MAX_DEPTH}}})|{_PART}",
    re.DOTALL,
)
_TWICE = ("overwrite", "twice", "Duplicate", "mutate", "redefine")
_TOO_DEEP = ("names or brackets nested too deeply", f"at most {MAX_DEPTH} levels; a few are enough")


@dataclass(frozen=True)
class TomlSource:
    """A TOML document and where its parts stand.

    Attributes:
        data: the document.
        lines: path of a key or array element -> its line, counted from 1.
        text: what was read.
    """

    data: dict[str, Any]
    lines: dict[KeyPath, int]
    text: str = ""

    def line(self, path: KeyPath) -> int:
        """Line of the deepest part of a path that stands in the document; the first line where none does."""
        for length in range(len(path), 0, -1):
            if path[:length] in self.lines:
                return self.lines[path[:length]]
        return 1


def read_toml(text: str, file: str) -> TomlSource:
    r"""Read a TOML document.

    Args:
        text: the document.
        file: its name, for error messages.

    Errors:
        MechanismFileError: it is not TOML. The TOML reader stops at the first fault; where that is a value in a line
            of its own, it goes on without that line.

    Example:
        >>> source = read_toml("unit = 'mm'\n[links]\nbase = {}", "my.toml")
        >>> source.line(("links", "base", "meaning"))
        3
    """
    if len(text) > MAX_CHARACTERS:
        raise _fault(file, None, f"{len(text)} characters", f"at most {MAX_CHARACTERS}")
    for match in _TOKEN.finditer(text):
        if match["deep"]:  # for which the TOML reader would need the square of the depth
            raise _fault(file, text.count("\n", 0, match.start()) + 1, *_TOO_DEEP)
    try:
        data = tomllib.loads(text)
        _check_size(data, file)
        source = TomlSource(data, Lines(text.replace("\r\n", "\n")).lines(), text)
    except tomllib.TOMLDecodeError as error:
        raise MechanismFileError(_all_syntax(file, text, str(error))) from None
    except RecursionError:
        raise _fault(file, None, *_TOO_DEEP) from None
    except ValueError as error:  # an integer of thousands of digits
        raise _fault(file, None, f"not TOML: {error}", "numbers within the range of floats") from None
    unreadable = [Problem(file, source.line(path), path_text(path), *said) for path, said in text_faults(data)]
    if unreadable:
        raise MechanismFileError(unreadable[:MAX_SYNTAX])
    return source


def _check_size(data: dict[str, Any], file: str) -> None:
    """Refuse tables within tables, and whole numbers, that nothing after this could handle."""
    level: list[Any] = [data]
    for _ in range(MAX_DEPTH):
        longest = max(level, key=len)
        if len(longest) > MAX_ITEMS:
            what = "keys in one table" if isinstance(longest, dict) else "elements in one list"
            raise _fault(file, None, f"{len(longest)} {what}", f"at most {MAX_ITEMS}")
        items = [item for group in level for item in (group.values() if isinstance(group, dict) else group)]
        if any(isinstance(item, int) and item.bit_length() > MAX_BITS for item in items):
            raise _fault(file, None, "a whole number of thousands of digits", "numbers within the range of floats")
        level = [item for item in items if isinstance(item, dict | list)]
        if not level:
            return
    raise _fault(file, None, *_TOO_DEEP)


def _fault(file: str, line: int | None, given: str, allowed: str, hint: str = "") -> MechanismFileError:
    return MechanismFileError([Problem(file, line, "", given, allowed, hint)])


def _all_syntax(file: str, text: str, message: str) -> list[Problem]:
    """The syntax error, and those behind it that do not follow from it."""
    rows, found = text.splitlines() or [""], list[Problem]()
    while True:
        line = _line_of(rows, message)
        found.append(_syntax(file, rows, message))
        if len(found) >= MAX_SYNTAX or not (message.startswith(_ALONE) and _STATEMENT.fullmatch(rows[line - 1])):
            return found
        rows[line - 1] = ""
        try:
            tomllib.loads("\n".join(rows))
        except tomllib.TOMLDecodeError as error:
            message = str(error)
        except (ValueError, RecursionError):
            return found
        else:
            return found
        if _line_of(rows, message) <= line:
            return found


def _line_of(rows: list[str], message: str) -> int:
    place = _PLACE.search(message)
    return min(int(place[1]) if place and place[1] else len(rows), len(rows))


def _syntax(file: str, rows: list[str], message: str) -> Problem:
    """A TOML syntax error in our words."""
    line = _line_of(rows, message)
    row = rows[line - 1].strip()
    reason = _PLACE.sub("", message)
    found = f"not TOML: {reason[0].lower()}{reason[1:]}" + (f" in `{row[:80]}`" if row else "")
    hint = ""
    first = _first_of(rows, line) if any(word in reason for word in _TWICE) else None
    if first is not None:
        found += f"; the first one is in line {first}"
    if _DECIMAL_COMMA.search(row):
        hint = "write decimals with a point: 0.5, not 0,5"
    elif any(word in reason for word in _TWICE):
        hint = "each name may be given once"
    return Problem(file, line, "", found, "a document in TOML 1.0", hint)


def _first_of(rows: list[str], line: int) -> int | None:
    """The line of what is given again in a line: of the same name, or of the value that it would be a part of."""
    walk = Lines("\n".join(rows[:line]))
    with contextlib.suppress(IndexError):  # a value that goes on after the line
        walk.lines()
    noted: dict[KeyPath, int] = {}
    first = None
    for path, where in walk.notes:
        earlier = [noted[path[:length]] for length in range(1, len(path) + 1) if path[:length] in noted]
        if where == line and earlier:
            first = earlier[-1]
        for length in range(1, len(path) + 1):
            noted.setdefault(path[:length], where)
    return first
