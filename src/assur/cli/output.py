"""Standard output and standard error: tables, one JSON object, and errors of one form."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Literal

from assur.errors import AssurError, OutputError

if TYPE_CHECKING:
    from rich.console import Console, RenderableType
    from rich.table import Table

    from assur.cli.options import Outcome


def console(*, error: bool = False) -> Console:
    """A console on standard output or error; plain text where that is no terminal, 80 columns unless told."""
    from rich.console import Console

    return Console(stderr=error, markup=False, highlight=False, emoji=False)


def emit(outcome: Outcome, *, json: bool) -> None:
    """Print an outcome, and make sure that it has been written."""
    if json:
        from assur.results.json_text import json_text

        sys.stdout.write(json_text(outcome.data) + "\n")
    else:
        show(outcome.shown())
    flush()


def show(items: Iterable[RenderableType]) -> None:
    """Print items one below the other."""
    out = console()
    for item in items:
        out.print(item)


def flush() -> None:
    """Hand what was printed to the system; a full disk is an error like any other, a closed pipe is not."""
    try:
        sys.stdout.flush()
    except BrokenPipeError:
        raise
    except OSError as error:
        raise OutputError(f"cannot write standard output: {error.strerror}") from error


def complain(error: AssurError) -> None:
    """An error on standard error: what is wrong, then a hint."""
    sys.stderr.write(f"error: {error}\n")


def heading(text: str) -> RenderableType:
    """A line that begins an answer or a part of one."""
    from rich.text import Text

    return Text(text, style="bold")


def table(
    columns: Sequence[str],
    rows: Iterable[Sequence[str]],
    *,
    title: str = "",
    left: Sequence[str] = (),
    wrap: Sequence[str] | None = None,
    styles: Sequence[str] = (),
) -> Table:
    """A table; columns are set right except those in `left`, and those in `wrap` may be broken into lines.

    Where nothing is said about breaking, the last of `left` may be.
    """
    from rich import box
    from rich.table import Table
    from rich.text import Text

    found = Table(
        title=Text(title, style="bold") if title else None,
        title_justify="left",
        box=box.SIMPLE_HEAD,
        pad_edge=False,
        show_edge=False,
        header_style="bold",
    )
    for name in columns:
        free = name in (left[-1:] if wrap is None else wrap)
        side: Literal["left", "right"] = "left" if name in left else "right"
        found.add_column(Text(name), justify=side, no_wrap=not free, overflow="fold")
    for place, row in enumerate(rows):
        found.add_row(*(Text(cell) for cell in row), style=styles[place] if styles else None)
    return found
