"""Python in a mechanism's folder: a person is asked at a terminal whether it may run, and told where it did not."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING

from assur.cli.options import Outcome, Plain, Shared
from assur.errors import CodeNotRunWarning, visible

if TYPE_CHECKING:
    from assur.results.answers.answer import NotRun


@contextmanager
def leave_by(shared: Plain) -> Iterator[list[NotRun]]:
    """Leave as the command line and the person at the terminal give it; what was not run is told on standard error.

    A command that is not about one mechanism, as `verify`, has no option for leave, and runs nothing.

    Yields what was not run.
    """
    from assur.model.consent import hint, leave

    about_one = isinstance(shared, Shared)
    at_terminal = sys.stdin is not None and sys.stdin.isatty() and sys.stderr.isatty() and not shared.json
    given, ask = isinstance(shared, Shared) and shared.run_code, asked if at_terminal else None
    with warnings.catch_warnings(), leave(given=given, forbidden=not about_one, ask=ask) as not_run:
        warnings.simplefilter("ignore", CodeNotRunWarning)  # told below, in its own form
        try:
            yield not_run
        finally:
            for code in not_run:
                sys.stderr.write(f"note: {visible(str(code))}\n")
            if not_run:
                sys.stderr.write(f"hint: {hint()}\n")


def asked(code: NotRun) -> bool:
    """Whether the person at the terminal lets a file run; no is the answer where none is given."""
    place = f"{code.file}:{code.line}" if code.line else code.file
    may = "It would have to run as Python, which may do all that you may. Run it? [y/N] "
    sys.stderr.write(f"{visible(place)}: {code.reason}.\n{may}")
    sys.stderr.flush()
    return sys.stdin.readline().strip().lower() in ("y", "yes")


def told(outcome: Outcome, not_run: Sequence[NotRun]) -> Outcome:
    """An outcome that says what was not run."""
    return replace(outcome, not_run=tuple(not_run))
