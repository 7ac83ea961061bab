"""Standard output and standard error: tables, one JSON object, and errors of one form."""

from __future__ import annotations

import contextlib
import os
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Literal

from assur.cli.exit_codes import INTERRUPTED
from assur.cli.interruption import printing
from assur.errors import AssurError, FileError, OutputError, visible

if TYPE_CHECKING:
    from rich.console import Console, RenderableType
    from rich.table import Table
    from rich.text import Text

    from assur.cli.options import Outcome
    from assur.results.answers.answer import Circumstances


def console(*, error: bool = False) -> Console:
    """A console on standard output or error; plain text where that is no terminal, 80 columns unless told."""
    from rich.console import Console

    class Faithful(Console):
        """A console that leaves a closed pipe to its caller."""

        def on_broken_pipe(self) -> None:
            raise

    return Faithful(stderr=error, markup=False, highlight=False, emoji=False)


def emit(outcome: Outcome, *, json: bool) -> None:
    """Print an outcome, and make sure that it has been written."""
    if json:
        from assur.results.answers.answer import entries
        from assur.results.json_text import json_text

        text = json_text({**entries(outcome.data), **entries(_circumstances(outcome))}) + "\n"
        with written():
            sys.stdout.write(text)
    else:
        show(outcome.shown())


def _circumstances(outcome: Outcome) -> Circumstances:
    from assur.results.answers.answer import ABSENT, Circumstances

    at = outcome.interrupted_at if outcome.interrupted else ABSENT
    return Circumstances(True if outcome.interrupted else ABSENT, at, outcome.not_run or ABSENT)


class Verbatim(str):
    """Text that is printed as it stands, however long its lines are."""

    __slots__ = ()


def show(items: Iterable[RenderableType]) -> None:
    """Print items one below the other."""
    out = console()
    for item in items:
        with written():
            out.print(_seen(item), soft_wrap=isinstance(item, Verbatim), crop=False)


def _seen(shown: RenderableType) -> RenderableType:
    """An item whose hidden characters, such as those of a path that was typed, are written out."""
    from rich.console import ConsoleOptions
    from rich.measure import Measurement
    from rich.segment import Segment

    class Seen:
        def __rich_console__(self, console: Console, options: ConsoleOptions) -> Iterator[Segment]:
            for part in console.render(shown, options):
                yield part if part.control else Segment(visible(part.text), part.style)

        def __rich_measure__(self, console: Console, options: ConsoleOptions) -> Measurement:
            return Measurement.get(console, options, shown)

    return Seen()


@contextmanager
def written() -> Iterator[None]:
    """What is written inside reaches the system; a full disk is an error of the user's, a closed pipe is none."""
    printing()
    try:
        yield
        sys.stdout.flush()
    except BrokenPipeError:
        forget_output()
        raise
    except OSError as error:
        forget_output()
        raise OutputError(f"cannot write standard output: {error.strerror}") from error


def forget_output() -> None:
    """Let the interpreter's last flush go nowhere: it would fail again."""
    with contextlib.suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


class InterruptedByUserError(AssurError):
    """Ctrl-C; what was done is kept, where the command keeps anything."""

    exit_code = INTERRUPTED


def complain(error: AssurError, *, json: bool = False) -> None:
    """An error on standard error: what is wrong, then a hint; with `json` as one object on standard output too."""
    text = visible(str(error))  # what was typed stands in it
    sys.stderr.write(f"{text}\n" if isinstance(error, InterruptedByUserError) else f"error: {text}\n")
    if json:
        from assur.results.answers.answer import NoAnswer, NoAnswerReason
        from assur.results.json_text import json_text

        problems = tuple(error.problems) if isinstance(error, FileError) else ()
        reason = NoAnswerReason(error.message, error.hint, error.exit_code, problems)
        with contextlib.suppress(OSError):  # the error is that nothing can be written there
            sys.stdout.write(json_text(NoAnswer(reason)) + "\n")
            sys.stdout.flush()


def heading(text: str) -> RenderableType:
    """A line that begins an answer or a part of one."""
    from rich.text import Text

    return Text(text, style="bold")


def table(
    columns: Sequence[str],
    rows: Iterable[Sequence[str | Text]],
    *,
    title: str = "",
    left: Sequence[str] = (),
    wrap: Sequence[str] | None = None,
    styles: Sequence[str] = (),
) -> Table:
    """A table; columns are set right except those in `left`, and those in `wrap` may be broken into lines.

    Where nothing is said about breaking, the last of `left` may be. A number is never cut (`WholeTable`).
    """
    from rich import box
    from rich.text import Text

    from assur.cli.tables import WholeTable

    found = WholeTable(
        title=Text(title, style="bold") if title else None,
        title_justify="left",
        box=box.SIMPLE_HEAD,
        pad_edge=False,
        collapse_padding=True,
        show_edge=False,
        header_style="bold",
    )
    for name in columns:
        free = name in (left[-1:] if wrap is None else wrap)
        side: Literal["left", "right"] = "left" if name in left else "right"
        found.add_column(Text(name), justify=side, no_wrap=not free, overflow="fold")
    for place, row in enumerate(rows):
        found.add_row(*(_cell(cell) for cell in row), style=styles[place] if styles else None)
    return found


def _cell(cell: str | Text) -> Text:
    from rich.text import Text

    return Text(cell) if isinstance(cell, str) else cell


def words(text: str) -> Text:
    """A cell of words, set left also in a column of numbers."""
    from rich.text import Text

    return Text(text, justify="left")
