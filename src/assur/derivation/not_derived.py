"""What cannot be derived, and what was derived before it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from assur.errors import AssurError

if TYPE_CHECKING:
    from assur.derivation.elimination import SolvedSet
    from assur.derivation.loop_equations import UnknownDirection
    from assur.derivation.orientations import LinkOrientations


class NotDerivedError(AssurError):
    """What the method does not reach; the message says what resists."""


class ResistingSetError(NotDerivedError):
    """A set that resists, after others were solved.

    Attributes:
        placed: orientations of the links, and why.
        sets: what was solved before it.
        left: what is not solved, those of the set that resists and of the sets after it.
    """

    def __init__(
        self,
        message: str,
        placed: LinkOrientations,
        sets: tuple[SolvedSet, ...],
        left: tuple[UnknownDirection, ...],
    ) -> None:
        super().__init__(message)
        self.placed, self.sets, self.left = placed, sets, left
