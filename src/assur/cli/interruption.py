"""Ctrl-C: whatever a command has so far is printed, and the exit code says that it was ended.

A long work of the library ends in one of two ways. It answers with what it has, and says that it was interrupted; or it
raises `assur.errors.Interrupted` with that, of which the command makes its outcome (`handing_over`). A command of
several stages asks `go_on` between them, so that none begins after Ctrl-C.
"""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from types import FrameType
from typing import TypeVar

from assur.cli.exit_codes import INTERRUPTED
from assur.cli.options import Outcome
from assur.errors import Interrupted

Answer = TypeVar("Answer")

SAID = "interrupted: this is what was found so far"


@dataclass
class _Key:
    """Whether Ctrl-C was pressed since the command began."""

    pressed: bool = False


_KEY = _Key()


class PartialOutcomeInterrupt(KeyboardInterrupt):
    """Ctrl-C, with what the command prints of the part that was done."""

    def __init__(self, outcome: Outcome) -> None:
        super().__init__()
        self.outcome = outcome


@contextmanager
def watched() -> Iterator[None]:
    """Note whether Ctrl-C is pressed inside; whoever ignores it, as a job in the background of a shell, still does."""
    _KEY.pressed = False
    before = signal.getsignal(signal.SIGINT)
    if before is not signal.default_int_handler or threading.current_thread() is not threading.main_thread():
        yield
        return
    signal.signal(signal.SIGINT, _noted)
    try:
        yield
    finally:
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
    return replace(outcome, interrupted=True, exit_code=INTERRUPTED)


def _noted(number: int, frame: FrameType | None) -> None:
    _KEY.pressed = True
    signal.default_int_handler(number, frame)
