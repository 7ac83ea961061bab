"""`assur`: the application, its commands, and what becomes of an error."""

from __future__ import annotations

import contextlib
import sys
import textwrap
from collections.abc import Callable, Sequence
from importlib import import_module
from typing import Any

from cyclopts import App, CycloptsError, Group, Parameter

import assur
from assur.cli import interruption, parsing
from assur.cli.code import leave_by, told
from assur.cli.exit_codes import BROKEN_PIPE, BUG, INTERRUPTED, MEANINGS
from assur.cli.numbers import shielded
from assur.cli.output import InterruptedByUserError, complain, console, emit, written
from assur.cli.spelling import as_typed
from assur.errors import AssurError

_NOTE = f"""Negative numbers need no tricks. Angles are in the unit that the mechanism's file states. Exit codes:
{", ".join(f"{code} {meaning}" for code, meaning in MEANINGS.items())}."""

HELP = f"""From the topology of a parallel mechanism to its numbers, each with its proof.

{textwrap.fill(_NOTE, 78)}

For example:
    assur direct zeng2019 162.6907 -143.3209 -24.6776
    assur audit zeng2019"""


GROUPS = {
    "Mechanisms": ("list", "show", "check", "new", "schema"),
    "Topology": ("topology", "synthesize"),
    "Position": ("direct", "inverse", "follow", "sweep"),
    "Singularity, workspace, quality": ("singularity", "workspace", "aspects", "indices"),
    "See it move": ("page", "view", "motion"),
    "Draw, write, build": ("figures", "report", "export", "collisions"),
    "Prove and check": ("certify", "verify", "crosscheck", "audit", "doctor", "cache", "demo"),
}
"""Commands as help lists them."""
COMMANDS = frozenset(name for names in GROUPS.values() for name in names)


def application(words: Sequence[str] = ()) -> App:
    """The application with every command; with one alone where words begin with it, as each costs its imports."""
    asked = words[0] if words and words[0] in COMMANDS else None
    app = App(
        name="assur",
        help=HELP,
        version=assur.__version__,
        help_format="plaintext",
        console=console(),
        default_parameter=Parameter(negative="", show_default=False),
    )
    for title, names in GROUPS.items():
        group = Group.create_ordered(title)
        for name in names:
            if asked in (None, name):
                app.command(_command(name), name=name, group=group)
    return app


def _command(name: str) -> Callable[..., Any]:
    """The function of a command: that of its name in the module of its name, `list_` where Python has the name."""
    module = vars(import_module(f"assur.cli.{name}"))
    command: Callable[..., Any] = module.get(f"{name}_") or module[name]
    return command


def main(words: Sequence[str] | None = None) -> int:
    """Run one command line (that of the process where none is given) and return its exit code."""
    with contextlib.suppress(AttributeError):
        sys.stdout.reconfigure(errors="replace")  # type: ignore[union-attr]  # absent where a test took its place
    words = sys.argv[1:] if words is None else words
    debug, json = "--debug" in words, "--json" in words
    try:
        with interruption.watched():
            return _run(shielded(words))
    except AssurError as error:
        _traceback(debug)
        complain(as_typed(error, parsing.options(application(words), words)), json=json)
        return error.exit_code
    except BrokenPipeError:
        return BROKEN_PIPE
    except KeyboardInterrupt:
        complain(InterruptedByUserError("interrupted"), json=json)
        return INTERRUPTED
    except Exception as error:  # whatever is left is our own bug, and a user gets one line
        _traceback(debug)
        what = " ".join(str(error).split())
        complain(AssurError(f"a bug in assur: {type(error).__name__}: {what}", hint="run with --debug"), json=json)
        return BUG


def _run(words: Sequence[str]) -> int:
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
    with leave_by(shared) as not_run:
        outcome = interruption.ended(lambda: command(*bound.args, **bound.kwargs))
        emit(told(outcome, not_run), json=shared.json)
    if outcome.exit_code == INTERRUPTED:
        complain(InterruptedByUserError(interruption.SAID))
    return int(outcome.exit_code)


def _traceback(wanted: bool) -> None:
    if wanted:
        import traceback

        traceback.print_exc()
