"""A working mode over a grid: which nodes it reaches, where it ends between them, and configurations at any points."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt

from assur.kinematics.following.ending import Mode, blocks
from assur.kinematics.following.platform_held import platform_held
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IntArray = NDArray[np.intp]
NEAR = 1.6
"""Points further than this from every reached node, in grid steps along an axis, are not tried."""

SAME = 1e-9
"""A point within this share of a step of a node is that node."""

KEPT = 40
"""Answers that are remembered, for several questions about the same points."""


@dataclass(frozen=True, eq=False)
class Followed:
    """Configurations at points: joint values (N, n), NaN where a point was not reached."""

    record: MechanismRecord
    joints: FloatArray

    @cached_property
    def reached(self) -> BoolArray:
        """Which points (N,) were reached."""
        return np.asarray(np.isfinite(self.joints[:, 0]))

    @cached_property
    def measures(self) -> tuple[FloatArray, FloatArray]:
        """The measures `serial` and `output` (N,) of `PlatformHeld` there; of NaN both are NaN."""
        numbers = np.full((2, len(self.joints)), np.nan)
        for rows in blocks(np.flatnonzero(self.reached)):
            held = platform_held(self.record, self.joints[rows])
            numbers[:, rows] = held.serial, held.output
        return numbers[0], numbers[1]


@dataclass(frozen=True, eq=False)
class ModeEnds:
    """Ways (E,) from reached nodes to neighbours that are not reached, and where the mode ends on each.

    Attributes:
        tails, heads: (E, d) the nodes at both ends of a way.
        share: (E,) of the way at which the mode ends.
        joints: (E, n) joint values a little before.
        place: (nodes.., 2 d) which way leads from a node up along every axis and then down; -1 where none does.
    """

    tails: IntArray
    heads: IntArray
    share: FloatArray
    joints: FloatArray
    place: IntArray

    @cached_property
    def longest(self) -> IntArray:
        """Of the ways to each head that one (H,) on which the mode ends nearest to it."""
        order = np.argsort(-self.share, kind="stable")
        _, first = np.unique(self.heads[order], axis=0, return_index=True)
        return np.asarray(order[first])


@dataclass(frozen=True, eq=False)
class Continuation:
    """A working mode followed over a grid.

    Attributes:
        mode: the mechanism, the signs that name the mode, and the poses of points.
        axes: the nodes' coordinates along each of d axes, evenly spaced.
        joints: (nodes.., n) joint values at the nodes, NaN where a node is not reached.
        serial: (nodes..) the measure of the serial side (`PlatformHeld.serial`) at reached nodes.
        ends: the ways to a neighbour on which the mode ends.
    """

    mode: Mode
    axes: tuple[FloatArray, ...]
    joints: FloatArray
    serial: FloatArray
    ends: ModeEnds
    _known: dict[bytes, Followed] = field(default_factory=dict, repr=False)

    @property
    def record(self) -> MechanismRecord:
        """The mechanism."""
        return self.mode.record

    @cached_property
    def reached(self) -> BoolArray:
        """Which nodes (nodes..) are reached."""
        return np.asarray(np.isfinite(self.joints[..., 0]))

    @cached_property
    def _nearest(self) -> IntArray:
        """Index (d, nodes..) of the nearest reached node."""
        return np.asarray(distance_transform_edt(~self.reached, return_distances=False, return_indices=True))

    @cached_property
    def at_nodes(self) -> Followed:
        """Configurations at the nodes that are reached."""
        return Followed(self.record, self.joints[self.reached])

    @cached_property
    def at_ends(self) -> Followed:
        """Configurations at the ends."""
        return Followed(self.record, self.ends.joints)

    def index(self, points: FloatArray) -> FloatArray:
        """Points (N, d) in steps of the grid from its first node."""
        low, step = (
            np.array(values) for values in zip(*((axis[0], axis[1] - axis[0]) for axis in self.axes), strict=True)
        )
        return np.asarray((points - low) / step)

    def at(self, points: FloatArray) -> Followed:
        """Configurations at points (N, d), each one step away from the nearest node that is reached."""
        key = hashlib.blake2b(np.ascontiguousarray(points).tobytes()).digest()
        if key not in self._known:
            while len(self._known) >= KEPT:
                self._known.pop(next(iter(self._known)))
            self._known[key] = self._at(points)
        return self._known[key]

    def points(self, nodes: IntArray) -> FloatArray:
        """The points (N, d) at nodes (N, d)."""
        return np.stack([axis[nodes[:, k]] for k, axis in enumerate(self.axes)], axis=1)

    def nodes(self, points: FloatArray) -> IntArray:
        """The node (N, d) next to each point (N, d)."""
        return self._node(self.index(points))

    def _node(self, index: FloatArray) -> IntArray:
        return np.asarray(np.clip(np.rint(index), 0, np.subtract(self.reached.shape, 1)).astype(np.intp))

    def _at(self, points: FloatArray) -> Followed:
        joints = np.full((len(points), len(self.record.coordinates)), np.nan)
        if not np.any(self.reached):
            return Followed(self.record, joints)
        index = self.index(points)
        node = self._node(index)
        nearest = self._nearest[(slice(None), *node.T)].T  # (N, d)
        at_node = np.max(np.abs(index - node), axis=1) <= SAME
        joints[at_node] = self.joints[tuple(node[at_node].T)]
        near = np.flatnonzero(~at_node & (np.max(np.abs(index - nearest), axis=1) <= NEAR))
        for rows in blocks(near):
            start = nearest[rows]
            found, good = self.mode.stepped(self.joints[tuple(start.T)], self.points(start), points[rows])
            joints[rows[good]] = found[good]
        return Followed(self.record, joints)

    def border(self, inside: FloatArray, outside: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Where the mode ends on ways from reached points (N, d) to others: the share (N,), and joint values (N, n).

        On the grid's own edges it is known; an edge of two steps ends on one of its halves.
        """
        middle = 0.5 * (inside + outside)
        far = np.sum(np.abs(self.index(outside) - self.index(inside)), axis=1)
        double = np.abs(far - 2.0) <= SAME
        later = double.copy()
        later[double] = self.at(middle[double]).reached
        first = np.where(later[:, None], middle, inside)
        last = np.where((double & ~later)[:, None], middle, outside)
        share, joints = self._border(first, last)
        return np.where(double, 0.5 * (share + later), share), joints

    def _border(self, inside: FloatArray, outside: FloatArray) -> tuple[FloatArray, FloatArray]:
        start, way = self.index(inside), self.index(outside) - self.index(inside)
        node, along = np.rint(start).astype(np.intp), np.rint(way).astype(np.intp)
        single = np.sum(np.abs(along), axis=1) == 1
        single &= np.all(np.abs(start - node) <= SAME, axis=1) & np.all(np.abs(way - along) <= SAME, axis=1)
        single &= np.all((node >= 0) & (node < self.reached.shape), axis=1)
        which = np.argmax(np.abs(along), axis=1)
        which += len(self.axes) * (along[np.arange(len(along)), which] < 0)
        place = np.full(len(inside), -1)
        place[single] = self.ends.place[(*node[single].T, which[single])]
        known, rows = place >= 0, np.flatnonzero(place < 0)
        share, joints = np.empty(len(inside)), np.empty((len(inside), self.joints.shape[-1]))
        share[known], joints[known] = self.ends.share[place[known]], self.ends.joints[place[known]]
        share[rows], joints[rows] = self.mode.ends(self.at(inside[rows]).joints, inside[rows], outside[rows])
        return share, joints
