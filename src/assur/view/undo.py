"""Undo: what was shown before and after, as a value; changes of the same thing in a row count as one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Generic, Self, TypeVar

T = TypeVar("T")
MOST = 200
"""So many changes are remembered."""


@dataclass(frozen=True)
class History(Generic[T]):
    """A present with its past, oldest first, and its future, next first.

    `label` names what the last change was of, so that a drag is one step; "" where the next change stands alone.

    >>> found = History(1).then(2, "l1").then(3, "l1").then(4, "l2")
    >>> found.back().present, found.back().back().present, found.back().on().present
    (3, 1, 4)
    """

    present: T
    past: tuple[T, ...] = ()
    future: tuple[T, ...] = ()
    label: str = ""

    def then(self, present: T, label: str = "") -> Self:
        """After a change; with the label of the last one it takes that one's place."""
        past = self.past if label and label == self.label else (*self.past, self.present)[-MOST:]
        return type(self)(present, past, (), label)

    def alone(self) -> Self:
        """The same, but the next change is a step of its own, whatever it is of."""
        return type(self)(self.present, self.past, self.future)

    def back(self) -> Self:
        """Before the last change; the same where there was none."""
        if not self.past:
            return self
        return type(self)(self.past[-1], self.past[:-1], (self.present, *self.future))

    def on(self) -> Self:
        """After the change that was undone last; the same where there is none."""
        if not self.future:
            return self
        return type(self)(self.future[0], (*self.past, self.present), self.future[1:])
