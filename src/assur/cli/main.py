"""`assur`: the application, its commands, and what becomes of an error."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Sequence
from typing import Any

from cyclopts import App, CycloptsError, Group, Parameter

import assur
from assur.cli import interruption, parsing
from assur.cli.code import leave_by, told
from assur.cli.exit_codes import BROKEN_PIPE, BUG, INTERRUPTED
from assur.cli.numbers import shielded
from assur.cli.output import InterruptedByUserError, complain, console, emit, written
from assur.cli.spelling import as_typed
from assur.errors import AssurError

HELP = """From the topology of a parallel mechanism to its numbers, each with its proof.

Negative numbers need no tricks. Angles are in the unit that the mechanism's
file states. Exit codes: 0 fine, 1 a claim of ours fails, 2 usage, 3 bad file,
4 proved: no (no solution, a box not all reached, no path), 5 undecided,
6 a path that stopped short, 70 a bug of ours, 130 ended by Ctrl-C, with what
was found so far.

For example:
    assur direct zeng2019 162.6907 -143.3209 -24.6776
    assur audit zeng2019"""


def application() -> App:
    """The application with every command."""
    from assur.cli.aspects import aspects
    from assur.cli.audit import audit
    from assur.cli.cache import cache
    from assur.cli.certify import certify
    from assur.cli.check import check
    from assur.cli.collisions import collisions
    from assur.cli.crosscheck import crosscheck
    from assur.cli.demo import demo
    from assur.cli.direct import direct
    from assur.cli.doctor import doctor
    from assur.cli.export import export
    from assur.cli.figures import figures
    from assur.cli.follow import follow
    from assur.cli.indices import indices
    from assur.cli.inverse import inverse
    from assur.cli.list import list_
    from assur.cli.motion import motion
    from assur.cli.new import new
    from assur.cli.page import page
    from assur.cli.report import report
    from assur.cli.schema import schema
    from assur.cli.show import show
    from assur.cli.singularity import singularity
    from assur.cli.sweep import sweep
    from assur.cli.synthesize import synthesize
    from assur.cli.topology import topology
    from assur.cli.verify import verify
    from assur.cli.view import view
    from assur.cli.workspace import workspace

    app = App(
        name="assur",
        help=HELP,
        version=assur.__version__,
        help_format="plaintext",
        console=console(),
        default_parameter=Parameter(negative="", show_default=False),
    )
    groups: dict[str, tuple[Callable[..., Any], ...]] = {
        "Mechanisms": (list_, show, check, new, schema),
        "Topology": (topology, synthesize),
        "Position": (direct, inverse, follow, sweep),
        "Singularity, workspace, quality": (singularity, workspace, aspects, indices),
        "See it move": (page, view, motion),
        "Draw, write, build": (figures, report, export, collisions),
        "Prove and check": (certify, verify, crosscheck, audit, doctor, cache, demo),
    }
    for title, commands in groups.items():
        group = Group.create_ordered(title)
        for command in commands:
            app.command(command, name=command.__name__.rstrip("_"), group=group)
    return app


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
        complain(as_typed(error, parsing.options(application(), words)), json=json)
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
    app = application()
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
