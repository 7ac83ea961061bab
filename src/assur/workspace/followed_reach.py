"""The reach of a mode that was followed, as a margin, and as the fields of its border's pieces, which meet in edges."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from assur.workspace.border_pieces import BorderPiece, BorderPieces
from assur.workspace.followed_field import FollowedField

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class ReachField(FollowedField):
    """The margin that is positive where the mode was followed to."""

    def values(self, points: FloatArray) -> FloatArray:
        """The measure (N,) of the serial side, -1 where a point (N, d) is not reached."""
        at_points = self.over.at(points)
        return np.where(at_points.reached, self.of(at_points), -1.0)

    def crossing(self, start: FloatArray, end: FloatArray) -> FloatArray:
        """Share (N,) of the way between points (N, 3) at which the reach ends."""
        size = len(self.over.axes)
        start, end = start[:, :size], end[:, :size]
        from_start, beyond = self.over.at(start).reached, self.over.at(end).reached
        shares = np.full(len(start), np.nan)
        for turned, rows in ((False, from_start & ~beyond), (True, beyond & ~from_start)):
            inside, outside = (end[rows], start[rows]) if turned else (start[rows], end[rows])
            portion, _ = self.over.border(inside, outside)
            shares[rows] = 1.0 - portion if turned else portion
        return shares

    @cached_property
    def parts(self) -> tuple[FollowedField, ...]:
        """Fields none of which is negative where this one is not: one for each piece of the border, then what is left.

        They have a sign and a crossing; their size says nothing.
        """
        pieces = BorderPieces(self.over)
        own = tuple(PieceField(self.over, self.of, self, pieces, (piece,)) for piece in pieces.pieces)
        return (*own, RestField(self.over, self.of, self, pieces, pieces.pieces))


@dataclass(frozen=True, eq=False)
class PieceField(FollowedField):
    """Negative beyond a piece of the border."""

    reach: ReachField
    pieces: BorderPieces
    own: tuple[BorderPiece, ...]

    def values(self, points: FloatArray) -> FloatArray:
        """1 or -1 (N,) at points (N, d)."""
        return np.where(self.pieces.beyond(self.own[0], points), -1.0, 1.0)

    def crossing(self, start: FloatArray, end: FloatArray) -> FloatArray:
        """Share (N,) of the way between points (N, 3) at which it ends."""
        size = len(self.over.axes)
        border = self.reach.crossing(start, end)
        return self.pieces.crossing(self.own[0], start[:, :size], end[:, :size], border)


@dataclass(frozen=True, eq=False)
class RestField(PieceField):
    """Negative where a point is not reached though it lies beyond no piece."""

    def values(self, points: FloatArray) -> FloatArray:
        """1 or -1 (N,) at points (N, d)."""
        allowed = self.over.at(points).reached
        for piece in self.own:
            allowed |= self.pieces.beyond(piece, points)
        return np.where(allowed, 1.0, -1.0)

    def crossing(self, start: FloatArray, end: FloatArray) -> FloatArray:
        """Share (N,) of the way between points (N, 3) at which the reach ends."""
        return self.reach.crossing(start, end)
