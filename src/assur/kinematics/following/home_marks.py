"""What is said of the solutions of one problem: which of them is that of home's mode, and by what."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class HomeSolution:
    """What is said of the listed solutions of one problem.

    Attributes:
        marks: for each of them whether it is that of home's mode; None where that is not decided.
        words: by what it is decided; empty where nothing is listed.
    """

    marks: tuple[bool | None, ...]
    words: str


def marked_words(labels: list[str], marks: tuple[bool, ...], how: str, none: str) -> str:
    """By what it is decided, with the labels of those that are of home's mode.

    >>> marked_words(["+", "-"], (True, False), "by its signs", "none of these")
    'home: mode +, by its signs'
    >>> marked_words([""], (True,), "followed straight from home", "none of these")
    'home: the only mode, followed straight from home'
    """
    own = [label for label, mark in zip(labels, marks, strict=True) if mark]
    if own == [""]:
        return f"home: the only mode, {how}"
    return f"home: mode {', '.join(own)}, {how}" if own else f"home: {none}"
