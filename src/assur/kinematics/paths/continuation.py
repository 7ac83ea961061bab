"""Continuation: the inverse problem at every node of a grid of poses, each solved from a neighbour that is solved.

From one assembly a working mode is followed over the grid, front by front. A step goes along the tangent and is
corrected; it is taken where the loops close, no joint value moves far, the signs that name the working mode stay,
and no two branches merge on the way (`platform_held.passes_zero`). What is reached is the part of the working mode
that hangs together with the start.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt

from assur.kinematics.paths.ending import Mode, blocks
from assur.kinematics.paths.neighbours import Steps
from assur.kinematics.paths.platform_held import platform_held
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
        found = np.full((2, len(self.joints)), np.nan)
        for rows in blocks(np.flatnonzero(self.reached)):
            held = platform_held(self.record, self.joints[rows])
            found[:, rows] = held.serial, held.output
        return found[0], found[1]


@dataclass(frozen=True, eq=False)
class Ends:
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
    ends: Ends
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
        return _nearest_in(self.reached)

    @cached_property
    def at_nodes(self) -> Followed:
        """Configurations at the nodes that are reached."""
        return Followed(self.record, self.joints[self.reached])

    @cached_property
    def at_ends(self) -> Followed:
        """Configurations at the ends."""
        return Followed(self.record, self.ends.joints)

    def _index(self, points: FloatArray) -> FloatArray:
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

    def nodes(self, points: FloatArray) -> IntArray:
        """The node (N, d) next to each point (N, d)."""
        return self._node(self._index(points))

    def _node(self, index: FloatArray) -> IntArray:
        return np.asarray(np.clip(np.rint(index), 0, np.subtract(self.reached.shape, 1)).astype(np.intp))

    def _at(self, points: FloatArray) -> Followed:
        joints = np.full((len(points), len(self.record.coordinates)), np.nan)
        if not np.any(self.reached):
            return Followed(self.record, joints)
        index = self._index(points)
        node = self._node(index)
        nearest = self._nearest[(slice(None), *node.T)].T  # (N, d)
        at_node = np.max(np.abs(index - node), axis=1) <= SAME
        joints[at_node] = self.joints[tuple(node[at_node].T)]
        near = np.flatnonzero(~at_node & (np.max(np.abs(index - nearest), axis=1) <= NEAR))
        for rows in blocks(near):
            start = nearest[rows]
            found, good = self.mode.stepped(self.joints[tuple(start.T)], _points(self, start), points[rows])
            joints[rows[good]] = found[good]
        return Followed(self.record, joints)

    def border(self, inside: FloatArray, outside: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Where the mode ends on ways from reached points (N, d) to others: the share (N,), and joint values (N, n).

        On the grid's own edges it is known; an edge of two steps ends on one of its halves.
        """
        middle = 0.5 * (inside + outside)
        far = np.sum(np.abs(self._index(outside) - self._index(inside)), axis=1)
        double = np.abs(far - 2.0) <= SAME
        later = double.copy()
        later[double] = self.at(middle[double]).reached
        first = np.where(later[:, None], middle, inside)
        last = np.where((double & ~later)[:, None], middle, outside)
        share, joints = self._border(first, last)
        return np.where(double, 0.5 * (share + later), share), joints

    def _border(self, inside: FloatArray, outside: FloatArray) -> tuple[FloatArray, FloatArray]:
        start, way = self._index(inside), self._index(outside) - self._index(inside)
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


def continued(
    mode: Mode,
    axes: tuple[FloatArray, ...],
    start: tuple[FloatArray, FloatArray] | None,
    tick: Callable[[float], None] | None = None,
) -> Continuation:
    """Follow a working mode over a grid.

    Args:
        mode: the mechanism, the signs of its working quantities that must stay, and the poses of points.
        axes: the nodes' coordinates along each of d axes, evenly spaced.
        start: a point (d,) and joint values (n,) assembled there; None where there is none.
        tick: called with the share that is done, as far as can be known.

    Example: the five-bar over a column of poses; its elbows straighten 285.5 above the motors.

    >>> from assur.kinematics.home import home_values
    >>> from assur.kinematics.paths.neighbours import working_signs
    >>> from assur.kinematics.pose import pose_of
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> home = home_values(record)
    >>> upwards = Mode(record, working_signs(record, home), lambda y: np.concatenate([0 * y, y], axis=1))
    >>> found = continued(upwards, (np.linspace(200.0, 300.0, 11),), (pose_of(record, home)[1:], home))
    >>> found.reached.astype(int).tolist(), found.border(np.array([[280.0]]), np.array([[290.0]]))[0].round(4)
    ([1, 1, 1, 1, 1, 1, 1, 1, 1, 0, 0], array([0.5545]))
    """
    shape = tuple(len(axis) for axis in axes)
    joints = np.full((*shape, len(mode.record.coordinates)), np.nan)
    none = np.zeros((0, len(axes)), dtype=np.intp)
    nowhere = np.full((*shape, 2 * len(axes)), -1)
    ends = Ends(none, none, np.zeros(0), np.zeros((0, joints.shape[-1])), nowhere)
    found = Continuation(mode, axes, joints, np.full(shape, np.nan), ends)
    if start is None:
        return found
    node = np.array([np.argmin(np.abs(axis - value)) for axis, value in zip(axes, start[0], strict=True)])
    point = np.array([axis[k] for axis, k in zip(axes, node, strict=True)])
    first, good = mode.stepped(start[1][None], start[0][None], point[None])
    if not good[0]:
        return found
    joints[tuple(node)] = first[0]
    rounds = sum(max(k, size - 1 - k) for k, size in zip(node.tolist(), shape, strict=True))
    front = node[None]
    done = 0
    while len(front):
        front = _spread(found, front)
        if not len(front):
            front = _across_the_rim(found)
        done += 1
        if tick is not None:
            tick(min(done / max(rounds, 1), 1.0))
    return replace(found, ends=_ends(found))


def _nearest_in(there: BoolArray) -> IntArray:
    """Index (d, nodes..) of the nearest node that is there."""
    return np.asarray(distance_transform_edt(~there, return_distances=False, return_indices=True))


def _spread(found: Continuation, front: IntArray) -> IntArray:
    """Step from the nodes (N, d) of a front to their neighbours, each from one of them; what is new (M, d)."""
    new = [front[:0]]
    for rows in blocks(front):
        steps = _steps(found, rows)
        found.serial[tuple(rows.T)] = steps.held.serial
        tails, heads, _ = _edges(found, rows)
        heads, first = np.unique(heads, axis=0, return_index=True)
        new.append(_taken(found, heads, *steps.of(tails[first]).to(found.mode.poses(_points(found, heads)))))
    return np.concatenate(new)


def _taken(found: Continuation, heads: IntArray, joints: FloatArray, good: BoolArray) -> IntArray:
    """Those of the nodes (N, d) that a step may be taken to, their joint values kept."""
    found.joints[tuple(heads[good].T)] = joints[good]
    return heads[good]


def _across_the_rim(found: Continuation) -> IntArray:
    """Try what lies beside reached nodes once more, in small steps from the best neighbour; what is new (M, d)."""
    reached = np.argwhere(np.isfinite(found.joints[..., 0]))
    tails, heads, _ = _edges(found, reached)
    best = np.argsort(-found.serial[tuple(reached[tails].T)], kind="stable")
    tails, heads = tails[best], heads[best]
    heads, first = np.unique(heads, axis=0, return_index=True)
    new = [heads[:0]]
    for rows in blocks(np.arange(len(heads))):
        steps = _steps(found, reached[tails[first[rows]]])
        new.append(_taken(found, heads[rows], *steps.in_parts(found.mode.poses(_points(found, heads[rows])))))
    return np.concatenate(new)


def _ends(found: Continuation) -> Ends:
    """Where the mode ends on every edge from a reached node to another."""
    reached = np.argwhere(np.isfinite(found.joints[..., 0]))
    tails, heads, ways = _edges(found, reached)
    nodes = reached[tails]
    share, joints = found.mode.ends(found.joints[tuple(nodes.T)], _points(found, nodes), _points(found, heads))
    place = found.ends.place.copy()
    place[(*nodes.T, ways)] = np.arange(len(nodes))
    return Ends(nodes, heads, share, joints, place)


def _steps(found: Continuation, nodes: IntArray) -> Steps:
    return found.mode.steps(found.joints[tuple(nodes.T)], _points(found, nodes))


def _edges(found: Continuation, front: IntArray) -> tuple[IntArray, IntArray, IntArray]:
    """Edges from a front: places in it (E,), neighbours (E, d) that are not reached, and which way they lie (E,)."""
    ways = np.concatenate([np.eye(len(found.axes)), -np.eye(len(found.axes))]).astype(np.intp)
    heads = (front[:, None] + ways).reshape(-1, len(found.axes))
    tails, which = (values.ravel() for values in np.indices((len(front), len(ways))))
    inside = np.all((heads >= 0) & (heads < found.joints.shape[:-1]), axis=1)
    inside[inside] = np.isnan(found.joints[(*heads[inside].T, 0)])
    return tails[inside], heads[inside], which[inside]


def _points(found: Continuation, nodes: IntArray) -> FloatArray:
    return np.stack([axis[nodes[:, k]] for k, axis in enumerate(found.axes)], axis=1)
