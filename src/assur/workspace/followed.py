"""Followed: the fields of a working mode without closed form, read off the joint values that following gives.

The reach itself is one margin: positive where the mode was followed to, falling to zero at its border as the square
of the measure of the serial side, negative elsewhere. Every other field is read off the joint values, beyond the
border off those at the nearest end of the mode, where the reach forbids the pose anyway. So a singularity locus runs
up to the border; of one that runs along it, nearer than a cell, only a part is seen, and where two loci cross the
sign of the one determinant rounds the crossing off within a cell.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.kinematics.home import home_values
from assur.kinematics.modes import mode_signs, sign_names
from assur.kinematics.parasitic import all_coordinates
from assur.kinematics.paths.continuation import Continuation, Followed, continued
from assur.kinematics.paths.ending import Mode
from assur.kinematics.paths.following import follow
from assur.kinematics.paths.neighbours import working_signs
from assur.kinematics.position import inverse
from assur.model.joint_graph import joint_graph
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle
from assur.numerics import rotations
from assur.singularity.loci import OUTPUT
from assur.topology.joints import SPHERICAL
from assur.workspace.bounds import Bound, Stroke, Values, bounds
from assur.workspace.grid import UniformGrid
from assur.workspace.slices import Columns, Slice

FloatArray = NDArray[np.float64]
REACH = "reach"
STARTS = 24
ROUNDS = 6
"""Steps of the false position in which a field is brought to zero on an edge, at most."""

ZERO = 1e-6
"""It counts as zero at this share of what it is at the ends."""


@dataclass(frozen=True, eq=False)
class FollowedField:
    """A field over a continuation: a number (N,) of what was followed to N points."""

    over: Continuation
    of: Callable[[Followed], FloatArray]

    def __call__(self, columns: Columns) -> FloatArray:
        """The field at points whose coordinates broadcast."""
        wide = np.broadcast_arrays(*columns)
        points = np.stack([column.ravel() for column in wide], axis=1).astype(float)
        return self.values(points).reshape(wide[0].shape)

    def values(self, points: FloatArray) -> FloatArray:
        """The field (N,) at points (N, d)."""
        found = self.over.at(points)
        return np.full(len(points), -1.0) if np.any(np.isnan(found.joints)) else self.of(found)

    def crossing(self, start: FloatArray, end: FloatArray) -> FloatArray:
        """Share (N,) of the way between points (N, 3) at which the field is zero, by false position (Illinois).

        Where the mode ends on the way it is looked for before the end, where it does not reach the way at all nowhere:
        the zero is interpolated.
        """
        size = len(self.over.axes)
        start, end = start[:, :size], end[:, :size]
        first, last = self.values(start), self.values(end)
        crossed = (first >= 0) != (last >= 0)
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.where(crossed, first / (first - last), np.nan)
        there, beyond = self.over.at(start).reached, self.over.at(end).reached
        rows = np.flatnonzero(crossed & there & beyond)
        share[rows] = self._zero(start[rows], end[rows], first[rows], last[rows])
        for turned in (False, True):
            rows = np.flatnonzero(crossed & (beyond & ~there if turned else there & ~beyond))
            inside, outside = (end[rows], start[rows]) if turned else (start[rows], end[rows])
            ahead, behind = (last[rows], first[rows]) if turned else (first[rows], last[rows])
            ends = self.over.border(inside, outside)
            found = ends * self._zero(inside, inside + ends[:, None] * (outside - inside), ahead, behind)
            share[rows] = 1.0 - found if turned else found
        return share

    def _zero(self, start: FloatArray, end: FloatArray, first: FloatArray, last: FloatArray) -> FloatArray:
        """Share (N,) of the way between points (N, d) with fields (N,) of different signs at which it vanishes."""
        low, high, share = np.zeros(len(start)), np.ones(len(start)), np.full(len(start), 0.5)
        size = np.maximum(np.abs(first), np.abs(last))
        first, last, before = first.copy(), last.copy(), np.zeros(len(start), dtype=np.int8)
        rows = np.arange(len(start))
        for _ in range(ROUNDS):
            share[rows] = low[rows] + (high[rows] - low[rows]) * first[rows] / (first[rows] - last[rows])
            here = self.values(start[rows] + share[rows, None] * (end[rows] - start[rows]))
            same = (here >= 0) == (first[rows] >= 0)
            front, back = rows[same], rows[~same]
            # the end that stays for a second time counts half
            last[front[before[front] == 1]] *= 0.5
            first[back[before[back] == -1]] *= 0.5
            low[front], first[front], before[front] = share[front], here[same], 1
            high[back], last[back], before[back] = share[back], here[~same], -1
            rows = rows[np.abs(here) > ZERO * size[rows]]
        return share


@dataclass(frozen=True, eq=False)
class ReachField(FollowedField):
    """The margin that is positive where the mode was followed to."""

    def values(self, points: FloatArray) -> FloatArray:
        """The measure (N,) of the serial side, -1 where a point (N, d) is not reached."""
        found = self.over.at(points)
        return np.where(found.reached, self.of(found), -1.0)

    def crossing(self, start: FloatArray, end: FloatArray) -> FloatArray:
        """Share (N,) of the way between points (N, 3) at which the reach ends."""
        size = len(self.over.axes)
        start, end = start[:, :size], end[:, :size]
        there, beyond = self.over.at(start).reached, self.over.at(end).reached
        shares = np.full(len(start), np.nan)
        for turned, rows in ((False, there & ~beyond), (True, beyond & ~there)):
            inside, outside = (end[rows], start[rows]) if turned else (start[rows], end[rows])
            found = self.over.border(inside, outside)
            shares[rows] = 1.0 - found if turned else found
        return shares


def followed_margins(
    over: Continuation, strokes: Mapping[str, Stroke | None] | None = None
) -> dict[str, FollowedField]:
    """The margins of a mode that was followed: its reach, then strokes and limits."""
    record = over.record
    found: dict[str, FollowedField] = {REACH: ReachField(over, lambda found: found.measures[0])}
    for name, bound in bounds(record, strokes).items():
        found[name] = FollowedField(over, _of_joints(record, bound))
    return found


def followed_factors(over: Continuation) -> dict[str, FollowedField]:
    """The determinant of Jp, signed; none where a mechanism has more or fewer inputs than rates of its pose."""
    return {OUTPUT.name: FollowedField(over, lambda found: found.measures[1])}


def over_grid(
    record: MechanismRecord,
    mode: str,
    slice_: Slice,
    grid: UniformGrid,
    tick: Callable[[float], None] | None = None,
) -> tuple[Continuation, str]:
    """A working mode followed over the nodes of a grid, and from where."""
    axes = tuple(grid.low[k] + grid.step[k] * np.arange(-1, size + 2) for k, size in enumerate(grid.cells))
    signs = _signs(record, mode)
    start, how = _start(record, mode, signs, slice_, grid)
    return continued(Mode(record, signs, slice_.poses), axes, start, tick), how


def _signs(record: MechanismRecord, mode: str) -> NDArray[np.int8]:
    text = mode.split("/")[0].split("~")[0]
    if not sign_names(record, "inverse"):
        return np.zeros(0, dtype=np.int8)
    return np.array(mode_signs(record, "inverse", text), dtype=np.int8)


def _start(
    record: MechanismRecord, mode: str, signs: NDArray[np.int8], slice_: Slice, grid: UniformGrid
) -> tuple[tuple[FloatArray, FloatArray] | None, str]:
    """A point (d,) of the box and joint values there, of the mode: by a path from home, else found."""
    size = grid.dimension
    low, high = grid.low[:size], grid.high[:size]
    spread = grid.box.spread(STARTS, np.random.default_rng(0))
    if not mode.strip("+-") and np.array_equal(working_signs(record, home_values(record)), signs):
        home = all_coordinates(record, home_values(record))
        own = np.array([home[name] for name in slice_.free])
        for point in (np.clip(own, low, high), 0.5 * (low + high), *spread[: STARTS // 3]):
            try:
                path = follow(record, home_values(record), poses=slice_.poses(point[None])[0], use_limits=False)
            except UsageError:  # a slice whose angles are right at the end of what they can be
                continue
            if path.stopped is None and np.array_equal(working_signs(record, path.joints[-1]), signs):
                return (point, path.joints[-1]), "followed from home"
    for point in spread:
        found = inverse(record, slice_.poses(point[None])[0], mode or None, crossed="~" in mode)
        if np.any(found.exists):
            joints = found.joints[found.exists][0]
            where = ", ".join(
                f"{name} = {value:.4g}{' rad' if is_angle(name) else ''}"
                for name, value in zip(slice_.free, point, strict=True)
            )
            return (point, joints), f"followed from a solution at {where}"
    return None, "no pose of the mode was found to follow from"


def _of_joints(record: MechanismRecord, bound: Bound) -> Callable[[Followed], FloatArray]:
    return lambda found: bound(_values(record, found.joints))


def _values(record: MechanismRecord, joints: FloatArray) -> Values:
    """Joint values (N, n) as bounds take them."""
    values: dict[str, object] = {}
    for item in record.coordinates:
        value = joints[:, item.index]
        values[record.coordinate_label(item)] = (np.cos(value), np.sin(value)) if item.kind == "angle" else value
    for name, joint in record.joints.items():
        if joint.type is SPHERICAL:
            turn = rotations.from_vector(joints[:, joint_graph(record).slices[name]])
            values[name] = [[turn[:, row, column] for column in range(3)] for row in range(3)]
    return values
