"""Followed: the fields of a working mode without closed form, read off the joint values that following gives.

The reach itself is one margin: positive where the mode was followed to, falling to zero at its border as the square
of the measure of the serial side, negative elsewhere. Every other field is read off the joint values, and continued
beyond the border as the root of a closed form would be (`continued_past`). So a singularity locus runs up to the
border and along it; two loci nearer to each other than a cell are not seen, as the sign of the one determinant is
the same on both sides of them, and where two cross the crossing is rounded off within a cell.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt

from assur.errors import UsageError
from assur.joint_graph.tree import joint_graph
from assur.kinematics.answers.at_border import angle_at_border
from assur.kinematics.following.continuation import continued
from assur.kinematics.following.ending import Mode
from assur.kinematics.following.followed_grid import Continuation, Followed
from assur.kinematics.following.following import follow
from assur.kinematics.home import home_values
from assur.kinematics.modes import mode_signs, sign_names, without_letter
from assur.kinematics.naming import declared_signs, mode_names
from assur.kinematics.parasitic import all_coordinates
from assur.kinematics.position import inverse
from assur.kinematics.turns import periodic
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle
from assur.numerics import rotations
from assur.singularity.loci import OUTPUT
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

SHORTEST = 0.01
"""Least share of a way from which a field is continued beyond its end."""


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
        """The field (N,) at points (N, d); where the mode does not reach that at the nearest node, continued."""
        at_points = self.over.at(points)
        return np.where(at_points.reached, self.of(at_points), self._at_nodes[tuple(self.over.nodes(points).T)])

    def known(self, points: FloatArray) -> FloatArray:
        """The field (N,) at points (N, d); NaN where the mode does not reach that."""
        return np.asarray(self.of(self.over.at(points)))

    @cached_property
    def _at_nodes(self) -> FloatArray:
        """The field (nodes..), continued beyond the border; -1 everywhere where nothing is reached."""
        over, ends = self.over, self.over.ends
        values = np.full(over.reached.shape, np.nan)
        if not np.any(over.reached):
            return np.full_like(values, -1.0)
        values[over.reached] = self.of(over.at_nodes)
        rows = ends.longest
        first, last = values[tuple(ends.tails[rows].T)], self.of(over.at_ends)[rows]
        values[tuple(ends.heads[rows].T)] = continued_past(first, last, ends.share[rows])
        return filled(values)

    def crossing(self, start: FloatArray, end: FloatArray) -> FloatArray:
        """Share (N,) of the way between points (N, 3) at which the field is zero, by false position (Illinois).

        Where the mode ends on the way it is zero before the end, or beyond, where the field is continued. Where it
        does not reach the way at all the zero is interpolated.
        """
        size = len(self.over.axes)
        start, end = start[:, :size], end[:, :size]
        first, last = self.values(start), self.values(end)
        crossed = (first >= 0) != (last >= 0)
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.where(crossed, first / (first - last), np.nan)
        from_start, beyond = self.over.at(start).reached, self.over.at(end).reached
        rows = np.flatnonzero(crossed & from_start & beyond)
        share[rows] = self._zero(start[rows], end[rows], first[rows], last[rows])
        for rows, turned in ((crossed & from_start & ~beyond, False), (crossed & beyond & ~from_start, True)):
            inside, outside = (end[rows], start[rows]) if turned else (start[rows], end[rows])
            ahead, behind = (last[rows], first[rows]) if turned else (first[rows], last[rows])
            portion = self._across(inside, outside, ahead, behind)
            share[rows] = 1.0 - portion if turned else portion
        return share

    def _across(self, inside: FloatArray, outside: FloatArray, ahead: FloatArray, behind: FloatArray) -> FloatArray:
        """Share (N,) of ways out of the mode, between points (N, d), at which the field, known at both, is zero."""
        ends, joints = self.over.border(inside, outside)
        value = self.of(Followed(self.over.record, joints))
        before = (value >= 0) != (ahead >= 0)
        with np.errstate(divide="ignore", invalid="ignore"):
            share = ends + (1.0 - ends) * (value / (value - behind)) ** 2
        stop = inside + ends[:, None] * (outside - inside)
        rows = np.flatnonzero(before)
        share[rows] = ends[rows] * self._zero(inside[rows], stop[rows], ahead[rows], value[rows], bent=True)
        return share

    def _zero(
        self, start: FloatArray, end: FloatArray, first: FloatArray, last: FloatArray, bent: bool = False
    ) -> FloatArray:
        """Share (N,) of the way between points (N, d) with fields (N,) of different signs at which it vanishes.

        With `bent` the ways end at the border, where fields run as the square root of what is left of the way.
        """
        low, high, share = np.zeros(len(start)), np.ones(len(start)), np.full(len(start), 0.5)
        size = np.maximum(np.abs(first), np.abs(last))
        first, last, before = first.copy(), last.copy(), np.zeros(len(start), dtype=np.int8)
        rows = np.arange(len(start))
        for _ in range(ROUNDS):
            share[rows] = low[rows] + (high[rows] - low[rows]) * first[rows] / (first[rows] - last[rows])
            part = _straight(share[rows], bent)
            value = self.values(start[rows] + part[:, None] * (end[rows] - start[rows]))
            same = (value >= 0) == (first[rows] >= 0)
            front, back = rows[same], rows[~same]
            # the end that stays for a second time counts half
            last[front[before[front] == 1]] *= 0.5
            first[back[before[back] == -1]] *= 0.5
            low[front], first[front], before[front] = share[front], value[same], 1
            high[back], last[back], before[back] = share[back], value[~same], -1
            rows = rows[np.abs(value) > ZERO * size[rows]]
        return _straight(share, bent)


def _straight(share: FloatArray, bent: bool) -> FloatArray:
    return 1.0 - (1.0 - share) ** 2 if bent else share


def continued_past(first: FloatArray, last: FloatArray, share: FloatArray) -> FloatArray:
    """A field (N,) at the far end of ways at whose `share` the mode ends, from what it is at the start and there.

    It ends where it turns back into another branch, and fields run as a + b sqrt(d) at the distance d from there.
    Beyond, the smooth function a - b sqrt(d) goes on with them.

    >>> continued_past(np.array([3.0]), np.array([1.0]), np.array([0.2]))
    array([-3.])
    """
    share = np.maximum(share, SHORTEST)
    return np.asarray(last + (last - first) * np.sqrt((1.0 - share) / share))


def filled(values: FloatArray) -> FloatArray:
    """A field (nodes..) with no NaN: beside known nodes as a plane through three of them, else the nearest value."""
    for _ in range(values.ndim - 1):
        values = np.where(np.isnan(values), _planes(values), values)
    nearest = distance_transform_edt(np.isnan(values), return_distances=False, return_indices=True)
    return np.asarray(values[tuple(nearest)])


def _planes(values: FloatArray) -> FloatArray:
    """At each node the mean over the squares of the grid that it closes of what makes them plane; NaN without one."""
    total, count = np.zeros(values.shape), np.zeros(values.shape)
    padded = np.pad(values, 1, constant_values=np.nan)

    def moved(steps: dict[int, int]) -> FloatArray:
        return padded[
            tuple(slice(1 + steps.get(k, 0), size + 1 + steps.get(k, 0)) for k, size in enumerate(values.shape))
        ]

    for i, j in itertools.combinations(range(values.ndim), 2):
        for a, b in itertools.product((-1, 1), repeat=2):
            plane = moved({i: a}) + moved({j: b}) - moved({i: a, j: b})
            known = np.isfinite(plane)
            total[known] += plane[known]
            count += known
    with np.errstate(invalid="ignore"):
        return np.asarray(total / count)


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


def followed_margins(
    over: Continuation, strokes: Mapping[str, Stroke | None] | None = None
) -> dict[str, FollowedField]:
    """The margins of a mode that was followed: its reach, then strokes and limits."""
    record = over.record
    margins: dict[str, FollowedField] = {REACH: ReachField(over, lambda grid: grid.measures[0])}
    for name, bound in bounds(record, strokes).items():
        margins[name] = FollowedField(over, _of_joints(record, bound))
    return margins


def followed_factors(over: Continuation) -> dict[str, FollowedField]:
    """The determinant of Jp, signed; none where a mechanism has more or fewer inputs than rates of its pose."""
    return {OUTPUT.name: FollowedField(over, lambda grid: grid.measures[1])}


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
    text = without_letter(mode).partition("~")[0]
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
    if mode in ("", mode_names(record, home_values(record))[0]):
        home = all_coordinates(record, home_values(record))
        own = np.array([home[name] for name in slice_.free])
        for point in (np.clip(own, low, high), 0.5 * (low + high), *spread[: STARTS // 3]):
            try:
                path = follow(record, home_values(record), poses=slice_.poses(point[None])[0], use_limits=False)
            except UsageError:  # a slice whose angles are right at the end of what they can be
                continue
            if path.stopped is None and np.array_equal(declared_signs(record, "inverse", path.joints[-1]), signs):
                return (point, path.joints[-1]), "followed from home"
    if not mode:  # a mode without a name is home's: what a search finds may be another
        return None, "home's mode was not followed into the box: no path from home led there"
    for point in spread:
        solutions = inverse(record, slice_.poses(point[None])[0], mode or None, crossed="~" in mode)
        if np.any(solutions.exists):
            joints = solutions.joints[solutions.exists][0]
            where = ", ".join(
                f"{name} = {angle_at_border(record, value):.4g} {record.angle}"
                if is_angle(name)
                else f"{name} = {value:.4g}"
                for name, value in zip(slice_.free, point, strict=True)
            )
            return (point, joints), f"followed from a solution at {where}"
    return None, "no pose of the mode was found to follow from"


def _of_joints(record: MechanismRecord, bound: Bound) -> Callable[[Followed], FloatArray]:
    return lambda grid: bound(_values(record, grid.joints))


def _values(record: MechanismRecord, joints: FloatArray) -> Values:
    """Joint values (N, n) as bounds take them."""
    values: dict[str, object] = {}
    for coordinate, same in zip(record.coordinates, periodic(record), strict=True):
        value = joints[:, coordinate.index]
        values[record.coordinate_label(coordinate)] = (np.cos(value), np.sin(value)) if same else value
    for name, joint in record.joints.items():
        if joint.type.ball:
            turn = rotations.from_vector(joints[:, joint_graph(record).slices[name]])
            values[name] = [[turn[:, row, column] for column in range(3)] for row in range(3)]
    return values
