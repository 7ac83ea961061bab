"""An attempt: an answer, or in one line why there is none."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from assur.errors import MechanismFileError, UsageError

REFUSED = (UsageError, MechanismFileError)
"""What says that an analysis does not apply to a mechanism, or not to its file as it is."""

Answer = TypeVar("Answer")


def reason(error: UsageError | MechanismFileError) -> str:
    """Why an analysis was refused, in one line, without a path of this machine."""
    if isinstance(error, MechanismFileError):
        first = error.problems[0]
        return f"{first.path}: {first.given}"
    return error.message


def attempt(make: Callable[[], Answer]) -> Answer | str:
    """What it makes, or why that is refused.

    >>> def refuse():
    ...     raise UsageError("it does not apply")
    >>> attempt(lambda: 3), attempt(refuse)
    (3, 'it does not apply')
    """
    try:
        return make()
    except REFUSED as error:
        return reason(error)
