"""Progress bars on standard error, for what takes over a second; none where no person looks."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from assur.cli.output import console

if TYPE_CHECKING:
    from assur.cli.options import Plain

Step = Callable[[int, int], None]
"""Called with (steps done, steps in all)."""


@contextmanager
def progress(label: str, shared: Plain) -> Iterator[Step]:
    """A bar while the block runs, which goes when it ends; it pulses until the first step is reported."""
    if shared.json or not sys.stderr.isatty():
        yield _nothing
        return
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=console(error=True), transient=True) as bars:
        bar = bars.add_task(label, total=None)

        def step(done: int, total: int) -> None:
            bars.update(bar, completed=done, total=total)

        yield step


def _nothing(done: int, total: int) -> None:
    """Nobody looks."""
