"""Exit codes: one rule for every command, whatever it is that it proves."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

FINE = 0
FAILS = 1
"""Of `collisions`: links meet."""
USAGE = 2
BAD_FILE = 3
NO = 4
UNDECIDED = 5
STOPPED = 6
BUG = 70
INTERRUPTED = 130
"""What a shell says of a program that Ctrl-C ended."""
BROKEN_PIPE = 141
"""What a shell says of a program whose reader went away."""

MEANINGS: Mapping[int, str] = {
    FINE: "fine",
    FAILS: "a claim of ours fails",
    USAGE: "usage",
    BAD_FILE: "bad file",
    NO: "proved: no (no solution, a box not all reached, no path)",
    UNDECIDED: "undecided",
    STOPPED: "a path that stopped short",
    BUG: "a bug of ours",
    INTERRUPTED: "ended by Ctrl-C, with what was found so far",
}
"""What `assur --help` says of each; CONVENTIONS.md says it at length."""


def of_status(status: str) -> int:
    """The code of a `Status` by name: there is a solution, singular or not, or there is none, or that is undecided.

    A solution that is not closed is one of a file whose formulas are wrong.

    >>> of_status("parallel"), of_status("unreachable"), of_status("undecided"), of_status("not_closed")
    (0, 4, 5, 3)
    """
    return {"unreachable": NO, "undecided": UNDECIDED, "not_closed": BAD_FILE}.get(status, FINE)


def of_answers(answers: Iterable[str]) -> int:
    """The code of a question that is answered part by part: 4 where any part is "no", 0 where all are "yes", else 5.

    >>> of_answers(["yes", "yes"]), of_answers(["open", "no"]), of_answers(["yes", "open"])
    (0, 4, 5)
    """
    different = set(answers)
    if "no" in different:
        return NO
    return FINE if different <= {"yes"} else UNDECIDED
