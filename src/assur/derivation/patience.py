"""How long a derivation may take where more is waited for: processor time counts, so that load decides nothing."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from time import process_time

from assur.errors import AssurError

_END: ContextVar[float] = ContextVar("processor's time at which a derivation is given up", default=float("inf"))


class TooLongError(AssurError):
    """What is not derived in the time that it may take. It is no `NotDerivedError`: in more time it may be."""


@contextmanager
def patience(seconds: float) -> Iterator[None]:
    """Give up what is derived inside after so many seconds of the processor's time.

    >>> with patience(0.0):
    ...     check_patience()
    Traceback (most recent call last):
    ...
    assur.derivation.patience.TooLongError: it takes longer than it may
    >>> check_patience()
    """
    token = _END.set(min(_END.get(), process_time() + seconds))
    try:
        yield
    finally:
        _END.reset(token)


def check_patience() -> None:
    """Errors: TooLongError, where the time is over."""
    if process_time() >= _END.get():
        raise TooLongError("it takes longer than it may")
