"""Progress on standard error: a bar and times on a terminal, a line elsewhere if it takes long, none with --json.

The line says how far the work is, and about how long the rest takes if it goes on as it began.
"""

from __future__ import annotations

import math
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from assur.cli.interruption import go_on
from assur.cli.output import console
from assur.work import WorkStage, stage

if TYPE_CHECKING:
    from assur.cli.options import Plain

Step = Callable[[int, int], None]
"""Called with (steps done, steps in all)."""

LONG = 20.0
"""Seconds after which a line says that the command is at work, where there is no bar."""


@contextmanager
def progress(label: str, shared: Plain) -> Iterator[Step]:
    """A bar while the block runs, the time so far, and that left once it can be told; all goes when the block ends.

    The bar pulses until the first step is reported. How far it is is noted as a stage, whoever looks.
    """
    with stage(label) as work:
        if shared.json:
            yield work.at
        elif not sys.stderr.isatty():
            with _line(work):
                yield work.at
        else:
            with _bar(label, work) as step:
                yield step


@contextmanager
def _bar(label: str, work: WorkStage) -> Iterator[Step]:
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

    left = (TextColumn("left"), TimeRemainingColumn())
    columns = (TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn(), *left)
    with Progress(*columns, console=console(error=True), transient=True) as bars:
        bar = bars.add_task(label, total=None)

        def step(done: int, total: int) -> None:
            work.at(done, total)
            bars.update(bar, completed=done, total=total)

        yield step


def stages(step: Step) -> Step:
    """The same step, which ends a work of several stages where Ctrl-C has ended one of them with what it had."""

    def checked(done: int, total: int) -> None:
        go_on()
        step(done, total)

    return checked


@contextmanager
def _line(work: WorkStage) -> Iterator[None]:
    """One line on standard error when the block has taken long."""

    def say() -> None:
        left = math.ceil(LONG * (work.total / work.steps - 1)) if work.steps else 0
        rest = f", {work.steps} of {work.total} steps done, about {left} s left" if left > 0 else ""
        sys.stderr.write(f"{work.name}: still at work after {LONG:g} s{rest}\n")

    timer = threading.Timer(LONG, say)
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()
