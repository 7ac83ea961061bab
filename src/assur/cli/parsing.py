"""What is wrong with a command line that cannot be parsed: one sentence, and the option that was probably meant."""

from __future__ import annotations

import difflib
from collections.abc import Sequence
from typing import TYPE_CHECKING

from cyclopts import CycloptsError, MissingArgumentError, RepeatArgumentError, UnusedCliTokensError

from assur.cli.numbers import END
from assur.errors import UsageError

if TYPE_CHECKING:
    from cyclopts import App


def complaint(app: App, words: Sequence[str], error: CycloptsError) -> UsageError:
    """What to say of words that the parser refuses: of an option that does not exist first, whatever else is wrong."""
    command = command_of(app, words)
    see = f"see {' '.join(['assur', *command])} --help"
    known = options(app, words)
    unknown = _unknown(known, words)
    later = next((word for word in words if word in app and not word.startswith("-")), None)
    if unknown and later and not command:
        return UsageError(f"{unknown} before the command", hint=f"options follow it, as assur {later} {unknown}")
    if unknown:
        by_word = {option.lstrip("-"): option for option in sorted(known)}
        near = difflib.get_close_matches(unknown.lstrip("-"), by_word, n=2)
        guess = f"did you mean {' or '.join(by_word[word] for word in near)}? " if near else ""
        return UsageError(f"unknown option {unknown}{f' of assur {command[0]}' if command else ''}", hint=guess + see)
    if isinstance(error, RepeatArgumentError) and error.token.keyword:
        return UsageError(_repeated(app, words, error.token.keyword), hint=see)
    return UsageError(_said(words, error), hint=see)


def command_of(app: App, words: Sequence[str]) -> list[str]:
    """The command as a list of one, of none where the first word is no command."""
    return [word for word in words[:1] if word in app and not word.startswith("-")]


def options(app: App, words: Sequence[str]) -> frozenset[str]:
    """The options of the command that the first word names, short ones and those that all commands have too."""
    found = {*app.help_flags}
    for name in command_of(app, words):
        found.update(part for names in _names(app, name) for part in names if part.startswith("-"))
    return frozenset(found if command_of(app, words) else {*found, *app.version_flags})


def _names(app: App, command: str) -> list[tuple[str, ...]]:
    """The names of each argument of a command: flags have no opposites but those that they are given."""
    every = app[command].assemble_argument_collection(default_parameter=app.default_parameter)
    return [tuple(argument.names) for argument in every]


def _unknown(known: frozenset[str], words: Sequence[str]) -> str:
    """The first word that looks like an option and is none; words are shielded, so that no value does."""
    for word in words:
        if word == END:
            break
        name = word.partition("=")[0]
        if name.startswith("-") and name not in known and not (name[1:2] != "-" and name[:2] in known):
            return name
    return ""


def _repeated(app: App, words: Sequence[str], name: str) -> str:
    """An option that is given twice, or by two of its names, as one and its opposite."""
    every = (names for command in words[:1] for names in _names(app, command))
    names = next((names for names in every if name in names), (name,))
    given = dict.fromkeys(word.partition("=")[0] for word in words)
    typed = [word for word in given if word in names]
    return f"one of {' and '.join(typed)} may be given" if len(typed) > 1 else f"{name} is given twice"


def _said(words: Sequence[str], error: CycloptsError) -> str:
    if isinstance(error, UnusedCliTokensError):
        return f"too many values: {', '.join(word.strip() for word in error.unused_tokens or ())}"
    if isinstance(error, MissingArgumentError) and error.argument is not None:
        names = error.argument.names
        typed = next((word for word in words if word in names), None)
        longest, *others = sorted(names, key=len, reverse=True)
        also = f" (or {', '.join(others)})" if others else ""
        return f"{longest}{also} is missing" if typed is None else f"{typed} needs a value"
    text = " ".join(str(error).split())
    text = text if text.endswith("...") else text.rstrip(".")
    return text[:1].lower() + text[1:]
