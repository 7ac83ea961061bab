"""Continuation: the inverse problem at every node of a grid of poses, each solved from a neighbour that is solved.

From one assembly a working mode is followed over the grid, front by front. A step goes along the tangent and is
corrected; it is taken where the loops close, no joint value moves far, the signs that name the working mode stay,
and no two branches merge on the way (`platform_held.passes_zero`). What is reached is the part of the working mode
that hangs together with the start.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt

from assur.kinematics.paths.neighbours import Steps
from assur.kinematics.paths.platform_held import platform_held
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IntArray = NDArray[np.intp]
Poses = Callable[[FloatArray], FloatArray]
"""Points (N, d) of a grid to poses (N, m)."""

NEAR = 1.6
"""Points further than this from every reached node, in grid steps along an axis, are not tried."""

SAME = 1e-9
"""A point within this share of a step of a node is that node."""

HALVINGS = 4
"""A border is found to 2^-4 of the way between two points at worst."""

NEARINGS, MOST = 2, 0.9
"""Steps towards where it is foreseen, and what share of the way there each goes."""

BLOCK = 4096
KEPT = 6
"""Answers that are remembered, for several questions about the same points."""


@dataclass(frozen=True, eq=False)
class Followed:
    """Configurations at points: joint values (N, n), and whether they are assemblies there that were reached (N,).

    Where a point is not reached the values are the closest approach, far away those of the nearest reached node.
    """

    joints: FloatArray
    reached: BoolArray


@dataclass(frozen=True, eq=False)
class Continuation:
    """A working mode followed over a grid.

    Attributes:
        record: the mechanism.
        axes: the nodes' coordinates along each of d axes, evenly spaced.
        poses: points (N, d) to poses (N, m).
        signs: (s,) the signs that name the working mode.
        joints: (nodes.., n) joint values at the nodes, NaN where a node is not reached.
        beyond: (nodes.., n) the closest approach to nodes beside reached ones; else NaN.
        serial: (nodes..) the measure of the serial side (`PlatformHeld.serial`) at reached nodes.
    """

    record: MechanismRecord
    axes: tuple[FloatArray, ...]
    poses: Poses
    signs: NDArray[np.int8]
    joints: FloatArray
    beyond: FloatArray
    serial: FloatArray
    _known: dict[bytes, Followed] = field(default_factory=dict, repr=False)

    @cached_property
    def reached(self) -> BoolArray:
        """Which nodes (nodes..) are reached."""
        return np.asarray(np.isfinite(self.joints[..., 0]))

    @cached_property
    def _nearest(self) -> IntArray:
        """Index (d, nodes..) of the nearest reached node."""
        return np.asarray(distance_transform_edt(~self.reached, return_distances=False, return_indices=True))

    def at(self, points: FloatArray) -> Followed:
        """Configurations at points (N, d), each one step away from the nearest node that is reached."""
        key = hashlib.blake2b(np.ascontiguousarray(points).tobytes()).digest()
        if key not in self._known:
            while len(self._known) >= KEPT:
                self._known.pop(next(iter(self._known)))
            self._known[key] = self._at(points)
        return self._known[key]

    def _at(self, points: FloatArray) -> Followed:
        count = len(self.record.coordinates)
        if not np.any(self.reached):
            return Followed(np.full((len(points), count), np.nan), np.zeros(len(points), dtype=bool))
        low = np.array([axis[0] for axis in self.axes])
        step = np.array([axis[1] - axis[0] for axis in self.axes])
        index = (points - low) / step
        node = np.clip(np.rint(index), 0, np.subtract(self.reached.shape, 1)).astype(np.intp)
        nearest = self._nearest[(slice(None), *node.T)].T  # (N, d)
        joints, beyond = self.joints[tuple(nearest.T)], self.beyond[tuple(node.T)]
        at_node = np.max(np.abs(index - node), axis=1) <= SAME
        there = at_node & self.reached[tuple(node.T)]
        near = np.flatnonzero(~at_node & (np.max(np.abs(index - nearest), axis=1) <= NEAR))
        for rows in _blocks(near):
            found, good = self.stepped(joints[rows], low + step * nearest[rows], points[rows])
            joints[rows[good]], there[rows[good]] = found[good], True
        return Followed(np.where(there[:, None] | np.isnan(beyond), joints, beyond), there)

    def stepped(self, joints: FloatArray, start: FloatArray, end: FloatArray) -> tuple[FloatArray, BoolArray]:
        """Joint values (N, n) after a step between points (N, d), and where the step may be taken (N,)."""
        held = platform_held(self.record, joints)
        return Steps(self.record, self.signs, joints, self.poses(start), held).to(self.poses(end))

    def border(self, inside: FloatArray, outside: FloatArray) -> FloatArray:
        """Share (N,) of the way from reached points (N, d) to others at which the reach ends.

        The way is halved, from the last reached point each time. Then the measure of the serial side, which falls
        linearly to zero there, says where it ends: first most of the way is gone, at last all of it.
        """
        here = self.at(inside).joints.copy()
        last = here.copy()
        low, high, before = np.zeros(len(inside)), np.ones(len(inside)), np.zeros(len(inside))
        for turn in range(HALVINGS + NEARINGS):
            share = 0.5 * (low + high)
            if turn >= HALVINGS:
                share = low + MOST * (self._ending(last, here, before, low, high) - low)
            start, end = (inside + part[:, None] * (outside - inside) for part in (low, share))
            for rows in _blocks(np.arange(len(inside))):
                found, good = self.stepped(here[rows], start[rows], end[rows])
                taken, other = rows[good], rows[~good]
                last[taken], before[taken] = here[taken], low[taken]
                here[taken], low[taken] = found[good], share[taken]
                high[other] = share[other]
        return self._ending(last, here, before, low, high)

    def _ending(
        self, last: FloatArray, here: FloatArray, before: FloatArray, low: FloatArray, high: FloatArray
    ) -> FloatArray:
        """Share (N,) of the way at which the serial measure vanishes, by its values at two reached points."""
        share = 0.5 * (low + high)
        for rows in _blocks(np.flatnonzero(low > before)):
            first, second = (platform_held(self.record, values[rows]).serial for values in (last, here))
            fall = np.maximum(first - second, 1e-300)
            guess = low[rows] + (low[rows] - before[rows]) * second / fall
            share[rows] = np.clip(guess, low[rows], high[rows])
        return share


def continued(
    record: MechanismRecord,
    axes: tuple[FloatArray, ...],
    poses: Poses,
    start: tuple[FloatArray, FloatArray] | None,
    signs: NDArray[np.int8],
    tick: Callable[[float], None] | None = None,
) -> Continuation:
    """Follow a working mode over a grid.

    Args:
        record: the mechanism.
        axes: the nodes' coordinates along each of d axes, evenly spaced.
        poses: points (N, d) to poses (N, m), lengths and rad.
        start: a point (d,) and joint values (n,) assembled there; None where there is none.
        signs: of the record's working quantities, which must stay.
        tick: called with the share that is done, as far as can be known.

    Example: the five-bar over a column of poses; its elbows straighten 285.5 above the motors.

    >>> from assur.kinematics.home import home_values
    >>> from assur.kinematics.paths.neighbours import working_signs
    >>> from assur.kinematics.pose import pose_of
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> home = home_values(record)
    >>> found = continued(
    ...     record,
    ...     (np.linspace(200.0, 300.0, 11),),
    ...     lambda points: np.concatenate([0 * points, points], axis=1),
    ...     (pose_of(record, home)[1:], home),
    ...     working_signs(record, home),
    ... )
    >>> found.reached.astype(int).tolist(), float(found.border(np.array([[280.0]]), np.array([[290.0]]))[0].round(2))
    ([1, 1, 1, 1, 1, 1, 1, 1, 1, 0, 0], 0.55)
    """
    shape = tuple(len(axis) for axis in axes)
    joints = np.full((*shape, len(record.coordinates)), np.nan)
    found = Continuation(record, axes, poses, signs, joints, joints.copy(), np.full(shape, np.nan))
    if start is None:
        return found
    node = np.array([np.argmin(np.abs(axis - value)) for axis, value in zip(axes, start[0], strict=True)])
    point = np.array([axis[k] for axis, k in zip(axes, node, strict=True)])
    first, good = found.stepped(start[1][None], start[0][None], point[None])
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
    return found


def _blocks(rows: IntArray) -> Iterator[IntArray]:
    """Rows (N, ..) in blocks; none where there are no rows."""
    for first in range(0, len(rows), BLOCK):
        yield rows[first : first + BLOCK]


def _spread(found: Continuation, front: IntArray) -> IntArray:
    """Step from the nodes (N, d) of a front to their neighbours, each from one of them; what is new (M, d)."""
    new = [front[:0]]
    for rows in _blocks(front):
        steps = _steps(found, rows)
        found.serial[tuple(rows.T)] = steps.held.serial
        tails, heads = _edges(found, rows)
        heads, first = np.unique(heads, axis=0, return_index=True)
        new.append(_taken(found, heads, *steps.of(tails[first]).to(found.poses(_points(found, heads)))))
    return np.concatenate(new)


def _taken(found: Continuation, heads: IntArray, joints: FloatArray, good: BoolArray) -> IntArray:
    """Those of the nodes (N, d) that a step may be taken to, their joint values kept; of the others the nearest."""
    found.joints[tuple(heads[good].T)] = joints[good]
    found.beyond[tuple(heads[~good].T)] = joints[~good]
    return heads[good]


def _across_the_rim(found: Continuation) -> IntArray:
    """Try what lies beside reached nodes once more, in small steps from the best neighbour; what is new (M, d)."""
    reached = np.argwhere(np.isfinite(found.joints[..., 0]))
    tails, heads = _edges(found, reached)
    best = np.argsort(-found.serial[tuple(reached[tails].T)], kind="stable")
    tails, heads = tails[best], heads[best]
    heads, first = np.unique(heads, axis=0, return_index=True)
    new = [heads[:0]]
    for rows in _blocks(np.arange(len(heads))):
        steps = _steps(found, reached[tails[first[rows]]])
        new.append(_taken(found, heads[rows], *steps.in_parts(found.poses(_points(found, heads[rows])))))
    return np.concatenate(new)


def _steps(found: Continuation, nodes: IntArray) -> Steps:
    joints = found.joints[tuple(nodes.T)]
    poses = found.poses(_points(found, nodes))
    return Steps(found.record, found.signs, joints, poses, platform_held(found.record, joints))


def _edges(found: Continuation, front: IntArray) -> tuple[IntArray, IntArray]:
    """Edges from a front: places in it (E,) and the neighbours (E, d) that are not reached."""
    ways = np.concatenate([np.eye(len(found.axes)), -np.eye(len(found.axes))]).astype(np.intp)
    heads = (front[:, None] + ways).reshape(-1, len(found.axes))
    tails = np.repeat(np.arange(len(front)), len(ways))
    inside = np.all((heads >= 0) & (heads < found.joints.shape[:-1]), axis=1)
    inside[inside] = np.isnan(found.joints[(*heads[inside].T, 0)])
    return tails[inside], heads[inside]


def _points(found: Continuation, nodes: IntArray) -> FloatArray:
    return np.stack([axis[nodes[:, k]] for k, axis in enumerate(found.axes)], axis=1)
