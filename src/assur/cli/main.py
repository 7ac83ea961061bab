"""`assur`: one command line from its words to an exit code, and what becomes of an error.

What reads and runs it is loaded inside, where Ctrl-C is watched for already.
"""

from __future__ import annotations

import atexit
import contextlib
import gc
import os
import sys
from collections.abc import Sequence

from assur.cli import interruption
from assur.cli.exit_codes import BROKEN_PIPE, BUG, INTERRUPTED
from assur.errors import AssurError
from assur.work import stage

LINEAR_ALGEBRA = ("OPENBLAS_NUM_THREADS", "1")
"""Threads of the linear algebra, unless the user says otherwise: matrices of mechanisms are so small that several of
them only wait for each other, which made a search of assemblies three times as long."""

PLUGINS = ("PYDANTIC_DISABLE_PLUGINS", "__all__")
"""None of what is installed besides changes how a file is read: to look for it takes 3 % of `check`."""

OBJECTS = 50_000
"""Objects that are made before Python looks for cycles among them, 700 by default: modules and recorded programs are
hundreds of thousands, none of them garbage, and looking at them takes 4 % of the first command on a file."""


def _leave() -> None:
    """What is left at the end is not looked through for cycles, which is 8 % of that command.

    But solids are, where there may be any: their library lists on standard error those that were never taken away.
    """
    if "manifold3d" not in sys.modules:
        gc.freeze()


def main(words: Sequence[str] | None = None) -> int:
    """Run one command line (that of the process where none is given) and return its exit code."""
    with contextlib.suppress(AttributeError):
        sys.stdout.reconfigure(errors="replace")  # type: ignore[union-attr]  # absent where a test took its place
    if words is None:  # a process of our own, before NumPy is loaded
        os.environ.setdefault(*LINEAR_ALGEBRA)
        os.environ.setdefault(*PLUGINS)
        gc.set_threshold(OBJECTS)
        words = sys.argv[1:]
        atexit.register(_leave)
    debug, json = "--debug" in words, "--json" in words
    with interruption.watched():
        try:
            return _run(words)
        except AssurError as error:
            _traceback(debug)
            from assur.cli import parsing
            from assur.cli.application import application
            from assur.cli.spelling import as_typed

            _complain(as_typed(error, parsing.options(application(words), words)), json=json)
            return error.exit_code
        except BrokenPipeError:
            return BROKEN_PIPE
        except KeyboardInterrupt:
            return _ended(json=json)
        except Exception as error:  # whatever is left is our own bug, and a user gets one line
            _traceback(debug)
            if interruption.pressed():  # some libraries make an error of their own of it
                return _ended(json=json)
            what = " ".join(str(error).split())
            _complain(AssurError(f"a bug in assur: {type(error).__name__}: {what}", hint="run with --debug"), json=json)
            return BUG


def _run(words: Sequence[str]) -> int:
    with stage("assur"):
        from cyclopts import CycloptsError

        from assur.cli import parsing
        from assur.cli.application import application
        from assur.cli.code import leave_by, told
        from assur.cli.numbers import shielded
        from assur.cli.output import InterruptedByUserError, complain, emit, written

        words = shielded(words)
        app = application(words)
    try:
        command, bound, _ = app.parse_args(words, exit_on_error=False, print_error=False, verbose=False)
    except CycloptsError as error:
        raise parsing.complaint(app, words, error) from error
    if "shared" not in bound.signature.parameters:
        with written():  # help or version, printed by the parser
            command(*bound.args, **bound.kwargs)
        return 0
    shared = bound.arguments.get("shared", bound.signature.parameters["shared"].default)
    with leave_by(shared) as not_run, stage(words[0]):
        outcome = interruption.ended(lambda: command(*bound.args, **bound.kwargs))
        interruption.answered()
        with stage("printing the answer"):
            emit(told(outcome, not_run), json=shared.json)
    if outcome.exit_code == INTERRUPTED:
        complain(InterruptedByUserError(interruption.said()))
    return int(outcome.exit_code)


def _ended(*, json: bool) -> int:
    """The code of a command that Ctrl-C ended with nothing to hand over, or while it printed; it says where that was.

    Behind a part of one JSON object no other is printed.
    """
    from assur.cli.output import InterruptedByUserError

    with contextlib.suppress(KeyboardInterrupt):  # pressed once more
        _complain(
            InterruptedByUserError(interruption.said(handed_over=False)), json=json and not interruption.printed()
        )
    return INTERRUPTED


def _complain(error: AssurError, *, json: bool) -> None:
    from assur.cli.output import complain

    complain(error, json=json)


def _traceback(debug: bool) -> None:
    if debug:
        import traceback

        traceback.print_exc()
