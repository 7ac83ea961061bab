"""The set of links that resists, and what was solved before it."""

from __future__ import annotations

from assur.derivation.elimination import SolvedSet
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.orientations import LinkOrientations
from assur.derivation.unknown_directions import UnknownDirection


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
