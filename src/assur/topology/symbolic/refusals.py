"""What the symbolic rules answer where they do not hold: a reason, never a guess."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Refusal:
    """No answer from the rules. `reason` is one sentence without a full stop; the twists answer instead.

    >>> print(Refusal("the pitch of H1 couples a rotation and a translation"))
    the rules give no answer: the pitch of H1 couples a rotation and a translation
    """

    reason: str

    def __str__(self) -> str:
        return f"the rules give no answer: {self.reason}"
