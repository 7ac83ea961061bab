"""Ctrl-C: whatever a command has so far is printed, and where it was; the exit code says that it was ended.

A long work of the library ends in one of two ways. It answers with what it has, and says that it was interrupted; or it
raises `assur.errors.Interrupted` with that, of which the command makes its outcome (`handing_over`). A command of
several stages asks `go_on` between them, so that none begins after Ctrl-C. Where there is nothing to hand over,
`where` says at which stage of `assur.work` the command was.

A module that is half loaded cannot be loaded again, and what Python calls back from elsewhere swallows an exception: so
Ctrl-C waits for the end of an import, and is pressed once more where it was swallowed.
"""

from __future__ import annotations

import _thread
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from types import FrameType
from typing import TYPE_CHECKING, TypeVar

from assur import work
from assur.cli.exit_codes import INTERRUPTED
from assur.errors import Interrupted

if TYPE_CHECKING:
    from assur.cli.options import Outcome

Answer = TypeVar("Answer")

SAID = "interrupted: this is what was found so far"
NOTHING = "interrupted: there is no answer yet"
CUT = "interrupted: the answer is not printed whole"
LOADING = "importlib._bootstrap>"
"""What the names of Python's own files end in that load modules."""

AGAIN = 0.02
"""Seconds after which Ctrl-C is pressed once more that could not end the command; an import takes as long."""


@dataclass
class _Key:
    """Whether Ctrl-C was pressed since the command began, at which stages that was, and what was done.

    Also how far the answer is: whether there is one, and whether any of it was printed.
    """

    pressed: bool = False
    where: str = ""
    before: str = ""
    answered: bool = False
    printed: bool = False


_KEY = _Key()


class PartialOutcomeInterrupt(KeyboardInterrupt):
    """Ctrl-C, with what the command prints of the part that was done."""

    def __init__(self, outcome: Outcome) -> None:
        super().__init__()
        self.outcome = outcome


@contextmanager
def watched() -> Iterator[None]:
    """Note whether Ctrl-C is pressed inside; whoever ignores it, as a job in the background of a shell, still does."""
    vars(_KEY).update(vars(_Key()))
    before, unraisable = signal.getsignal(signal.SIGINT), sys.unraisablehook
    if before is not signal.default_int_handler or threading.current_thread() is not threading.main_thread():
        yield
        return
    signal.signal(signal.SIGINT, _noted)
    sys.unraisablehook = lambda lost: _press_again() if lost.exc_type is KeyboardInterrupt else unraisable(lost)
    try:
        yield
    finally:
        sys.unraisablehook = unraisable
        signal.signal(signal.SIGINT, before)


def pressed() -> bool:
    """Whether Ctrl-C was pressed since the command began."""
    return _KEY.pressed


def go_on() -> None:
    """Raise `KeyboardInterrupt` where Ctrl-C was pressed, also where the last stage answered with what it had."""
    if _KEY.pressed:
        raise KeyboardInterrupt


def was_the_end() -> None:
    """Ctrl-C was how this command ends, as that of a server: nothing was cut short."""
    _KEY.pressed = False


def answered() -> None:
    """Note that there is an answer, which is printed from now on."""
    _KEY.answered = True


def printing() -> None:
    """Note that printing begins, so that what is on standard output cannot be taken back."""
    _KEY.printed = True


def printed() -> bool:
    """Whether any of the answer may stand on standard output."""
    return _KEY.printed


@contextmanager
def handing_over(kind: type[Answer], outcome: Callable[[Answer], Outcome]) -> Iterator[None]:
    """Make an outcome of what a work inside has so far, where Ctrl-C ends it; of an answer of that kind, no other."""
    try:
        yield
    except Interrupted as stop:
        if not isinstance(stop.answer, kind):  # that of a step inside the work
            raise
        raise PartialOutcomeInterrupt(outcome(stop.answer)) from None


def ended(command: Callable[[], Outcome]) -> Outcome:
    """The outcome of a command, or of the part that was done before Ctrl-C, which says so."""
    try:
        outcome = command()
    except PartialOutcomeInterrupt as stop:
        outcome = stop.outcome
    else:
        if not _KEY.pressed:
            return outcome
    return replace(outcome, interrupted=True, interrupted_at=_KEY.where, exit_code=INTERRUPTED)


def said(*, handed_over: bool = True) -> str:
    """What is said of a command that Ctrl-C ended: whether its answer is printed, where it was, what was done."""
    head = SAID if handed_over or (_KEY.printed and not _KEY.answered) else CUT if _KEY.answered else NOTHING
    at = f"at: {_KEY.where}" if _KEY.where else ""
    return "\n".join(line for line in (head, at, _KEY.before) if line)


def _noted(number: int, frame: FrameType | None) -> None:
    if not _KEY.pressed:
        at = ": loading what it needs" if _loading(frame) else ""
        _KEY.pressed, _KEY.where, _KEY.before = True, work.where() + at, work.before()
    if _loading(frame):
        _press_again()
    else:
        signal.default_int_handler(number, frame)


def _loading(frame: FrameType | None) -> bool:
    """Whether a module is being loaded."""
    while frame is not None:
        if frame.f_code.co_filename.endswith(LOADING):
            return True
        frame = frame.f_back
    return False


def _press_again() -> None:
    timer = threading.Timer(AGAIN, _thread.interrupt_main)
    timer.daemon = True
    timer.start()
