"""What goes wrong, and what to say about it: one place for every error that assur raises.

Misuse raises one of these; mathematics never does, it answers by a `Status`.
"""

from __future__ import annotations

import difflib
import unicodedata
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from inspect import signature
from typing import Any, TypeVar

Answer = TypeVar("Answer")

_HIDDEN = frozenset(("Cc", "Cf", "Cs", "Zl", "Zp"))
"""Categories of Unicode that a reader does not see, but a terminal obeys: controls, directions, separators of lines."""


def hidden(text: str, kept: str = "\n") -> str:
    r"""The characters of a text that nobody sees: controls, escapes, changes of direction; "" where there are none.

    Args:
        text: any text.
        kept: those that may be there.

    >>> hidden("a\x1b[2J"), hidden("a title"), hidden("x\u202ey")
    ('\x1b', '', '\u202e')
    """
    if text.isprintable():
        return ""
    return "".join(sign for sign in text if sign not in kept and unicodedata.category(sign) in _HIDDEN)


def visible(text: str, kept: str = "\n") -> str:
    r"""A text with its hidden characters written out, so that no terminal obeys them.

    >>> print(visible("a\x1b[2J"))
    a\x1b[2J
    """
    unseen = set(hidden(text, kept))
    if not unseen:
        return text
    return "".join(sign.encode("unicode_escape").decode() if sign in unseen else sign for sign in text)


def cut(text: str, length: int = 60) -> str:
    """A text for a message, cut where it is very long, with all of it to be seen.

    >>> cut("a long name", 9)
    'a long...'
    """
    text = visible(text, kept="")
    return text if len(text) <= length else text[: length - 3] + "..."


def extra_hint(extra: str) -> str:
    """How to get what an extra of assur brings: from its source, for no package index has assur.

    >>> extra_hint("view")
    "pip install '.[view]' in assur's folder"
    """
    return f"pip install '.[{extra}]' in assur's folder"


class AssurError(Exception):
    """An error with a hint. `exit_code` is what the command line returns for it."""

    exit_code = 70

    def __init__(self, message: str, *, hint: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.hint = hint

    def __str__(self) -> str:
        return f"{self.message}\nhint: {self.hint}" if self.hint else self.message


class UsageError(AssurError):
    """A call with a wrong name, shape or value.

    A message about one argument begins with its name and a colon, as `gap: -1 is no share`; the command line puts the
    option there that the argument came from.
    """

    exit_code = 2


class UnknownNameError(UsageError):
    """A name that does not exist; the message lists the valid ones, nearest first."""

    def __init__(self, kind: str, name: str, choices: Iterable[str], *, hint: str = "") -> None:
        ordered = sorted(choices)
        near = difflib.get_close_matches(name, ordered, n=3, cutoff=0.5)
        guess = f"did you mean {' or '.join(near)}?" if near else ""
        listed = ", ".join(ordered) if ordered else "none"
        super().__init__(f"unknown {kind} '{cut(name)}'; there is: {listed}", hint=hint or guess)
        self.choices = tuple(ordered)


def called(function: Callable[..., Answer], *given: Any, **options: Any) -> Answer:
    """What a function answers; an option that it does not have is refused, with those that it has.

    Errors: UnknownNameError for such an option.

    >>> called(sorted, [2, 1], revers=True)
    Traceback (most recent call last):
    ...
    assur.errors.UnknownNameError: unknown option of sorted 'revers'; there is: key, reverse
    hint: did you mean reverse?
    """
    named = list(signature(function).parameters)[len(given) :]
    for name in options:
        if name not in named:
            raise UnknownNameError(f"option of {function.__name__}", name, named)
    return function(*given, **options)


class BatchError(UsageError, AttributeError):
    """What only a single answer has, asked of a batch; so `hasattr` says no, and inspection passes over it."""


class OutputError(UsageError):
    """A path that cannot be written; what was there before is unchanged."""


class CodeNotRunWarning(UserWarning):
    """Python in a mechanism's folder was not run, since nobody gave leave (`assur.model.consent`)."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C during a long work.

    Attributes:
        answer: what was found before it, in the form of the work's answer.
    """

    def __init__(self, answer: Any) -> None:
        super().__init__()
        self.answer = answer


KeyPath = tuple[str | int, ...]
"""Where something stands in a TOML document: the keys and places in lists that lead there."""


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
            text += ("." if text else "") + (cut(part) if plain else f'"{cut(part)}"')
    return text


@dataclass(frozen=True)
class Problem:
    """One fault in a file: where it is, what is given, what is allowed."""

    file: str
    line: int | None
    path: str
    given: str = field(metadata={"name": "found"})  # in JSON, as it has been from the first
    allowed: str
    hint: str = ""

    def __str__(self) -> str:
        place = f"{self.file}:{self.line}" if self.line else self.file
        text = (
            f"{place}: {self.path}: {self.given}; {self.allowed}"
            if self.path
            else f"{place}: {self.given}; {self.allowed}"
        )
        return f"{text}\n    hint: {self.hint}" if self.hint else text


class FileError(AssurError):
    """Files that cannot be used: every problem in them, at once."""

    exit_code = 3

    def __init__(self, problems: Sequence[Problem], *, hint: str = "") -> None:
        count = len(problems)
        head = "1 problem" if count == 1 else f"{count} problems"
        super().__init__(f"{head}:\n" + "\n".join(str(problem) for problem in problems), hint=hint)
        self.problems = tuple(problems)


class MechanismFileError(FileError):
    """A mechanism file that cannot be used."""


class DamagedStoreError(FileError):
    """A store whose files are not what was written; the path of a problem is that of its blocks."""
