"""Border pieces: what a followed mode reaches ends for several reasons, and each is a surface of its own.

At an end of the mode joints move infinitely fast: rates T grow without bound along one direction of joint values, which
tells the reason (this leg stretched, or that one), at one direction of the pose, the normal of the border. Ends beside
each other with one reason make a piece. Each piece is continued by its tangent planes to where the others end it, so
that two of them meet in an edge; one surface through all ends would cut it off within a cell.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from assur.kinematics.following.followed_grid import Continuation
from assur.kinematics.following.platform_held import platform_held
from assur.kinematics.following.ways import pose_change

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IntArray = NDArray[np.intp]
BESIDE = 1.5
"""Ends so many steps apart, along the axis on which they are farther, are beside each other: those of one cell are."""

ALIKE = 0.8
"""Cosine of the joints' directions above which two ends beside each other have one reason: legs that share no joint
have 0, one surface turns by less than 37 deg within a cell where the grid resolves it."""

FOREMOST = 3.0
"""The largest rate is so many times the next one where an end has one reason; at a corner itself there are two."""

FAR = 3.0
"""Steps from every end beyond which a piece is not continued: what lies there is beyond the border in any case."""

SAME = 1e-6
"""Steps within which an end is the one asked for."""

MOST = 24
"""Pieces at most, the largest ones: each is a solid that is cut off."""


@dataclass(frozen=True, eq=False)
class BorderPiece:
    """A piece of the border: its ends (k, d) in steps of the grid, and the normals (k, d) there, outwards."""

    ends: FloatArray
    normals: FloatArray

    @cached_property
    def _tree(self) -> cKDTree:
        return cKDTree(self.ends)

    def distance(self, index: FloatArray) -> FloatArray:
        """How far (N,) the nearest end is from points (N, d), in steps of the grid."""
        return np.asarray(self._tree.query(index)[0])

    def depth(self, index: FloatArray) -> FloatArray:
        """How far (N,) inside the tangent plane at the nearest end points (N, d) lie, all in steps of the grid."""
        nearest = self._tree.query(index)[1]
        return np.asarray(np.sum((self.ends[nearest] - index) * self.normals[nearest], axis=1))


@dataclass(frozen=True, eq=False)
class BorderPieces:
    """The pieces of the border of what a continuation reaches."""

    over: Continuation

    @cached_property
    def pieces(self) -> tuple[BorderPiece, ...]:
        """The pieces, the largest first; ends without one reason, and single ones, are in none."""
        ends = self.over.ends
        if not len(ends.tails):
            return ()
        way = ends.heads - ends.tails
        places = np.asarray(ends.tails + ends.share[:, None] * way, dtype=float)
        reasons, normals, clear = self._directions
        senses = np.sign(np.sum(normals * way, axis=1))
        rows = np.flatnonzero(clear & (senses != 0.0))
        if not len(rows):
            return ()
        labels = _joined(places[rows], reasons[rows])
        sizes = np.bincount(labels)
        chosen = [k for k in np.argsort(-sizes, kind="stable")[:MOST] if sizes[k] > len(self.over.axes)]
        own = [rows[labels == k] for k in chosen]
        return tuple(BorderPiece(places[part], senses[part, None] * normals[part]) for part in own)

    @cached_property
    def _directions(self) -> tuple[FloatArray, FloatArray, BoolArray]:
        """Joints' directions (E, n) and normals (E, d) at the ends, of length 1, and where one reason is foremost."""
        over, ends = self.over, self.over.ends
        rates = platform_held(over.record, ends.joints).rates
        points = over.points(ends.tails) + ends.share[:, None] * (over.points(ends.heads) - over.points(ends.tails))
        poses = over.mode.poses(points)
        changes = [
            pose_change(over.record, poses, over.mode.poses(points + (axis[1] - axis[0]) * np.eye(len(over.axes))[k]))
            for k, axis in enumerate(over.axes)
        ]
        along = rates @ np.stack(changes, axis=-1)
        known = np.all(np.isfinite(along), axis=(1, 2))
        left, sizes, right = np.linalg.svd(np.where(known[:, None, None], along, 0.0), full_matrices=False)
        clear = known & (sizes[:, 0] > (FOREMOST * sizes[:, 1] if sizes.shape[1] > 1 else 0.0))
        return left[:, :, 0], right[:, 0], clear

    @cached_property
    def _all(self) -> cKDTree:
        return cKDTree(np.concatenate([piece.ends for piece in self.pieces]))

    def beyond(self, piece: BorderPiece, points: FloatArray) -> BoolArray:
        """Which points (N, d) lie beyond a piece, or far beyond all; none that the mode reaches."""
        index = self.over.index(points)
        outside = ~self.over.at(points).reached
        outside[outside] = (piece.depth(index[outside]) < 0.0) | (self._all.query(index[outside])[0] > FAR)
        return outside

    def crossing(self, piece: BorderPiece, start: FloatArray, end: FloatArray, border: FloatArray) -> FloatArray:
        """Share (N,) of ways between points (N, d) at which they cross a piece, NaN where not.

        `border` is the share (N,) at which the mode ends, NaN where neither end is reached or both are. The piece is
        not before it.
        """
        first, last = self.beyond(piece, start), self.beyond(piece, end)
        low, high = (piece.depth(self.over.index(points)) for points in (start, end))
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.clip(low / (low - high), 0.0, 1.0)
        share = np.where(np.isfinite(share), share, 0.5)
        place = self.over.index(start + np.nan_to_num(border)[:, None] * (end - start))
        own = np.isfinite(border) & (piece.distance(place) <= self._all.query(place)[0] + SAME)
        behind = np.where(last, np.fmax(share, border), np.fmin(share, border))
        return np.where(first == last, np.nan, np.where(own, border, behind))


def _joined(places: FloatArray, reasons: FloatArray) -> IntArray:
    """To which piece (E,) each end belongs: those at places (E, d) beside each other with one reason (E, n) to one."""
    pairs = cKDTree(places).query_pairs(BESIDE, p=np.inf, output_type="ndarray")
    alike = np.abs(np.sum(reasons[pairs[:, 0]] * reasons[pairs[:, 1]], axis=1)) > ALIKE
    first, second = pairs[alike].T
    graph = coo_array((np.ones(len(first)), (first, second)), shape=(len(places), len(places)))
    return np.asarray(connected_components(graph, directed=False)[1])
