"""Followed: the fields of a working mode without closed form, read off the joint values that following gives.

The reach itself is one margin: positive where the mode was followed to, falling to zero at its border as the square
of the measure of the serial side, negative elsewhere. Every other field is read off the joint values, beyond the
border off those of the nearest reached node, where the reach forbids the pose anyway.
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
from assur.kinematics.paths.continuation import Continuation, continued
from assur.kinematics.paths.following import follow
from assur.kinematics.paths.neighbours import working_signs
from assur.kinematics.paths.platform_held import platform_held
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
"""Steps of the false position in which a field is brought to zero on an edge."""


@dataclass(frozen=True, eq=False)
class FollowedField:
    """A field over a continuation: a number (N,) of joint values (N, n)."""

    over: Continuation
    of: Callable[[FloatArray], FloatArray]

    def __call__(self, columns: Columns) -> FloatArray:
        """The field at points whose coordinates broadcast."""
        wide = np.broadcast_arrays(*columns)
        points = np.stack([column.ravel() for column in wide], axis=1).astype(float)
        return self.values(points).reshape(wide[0].shape)

    def values(self, points: FloatArray) -> FloatArray:
        """The field (N,) at points (N, d)."""
        joints = self.over.at(points).joints
        return np.full(len(points), -1.0) if np.any(np.isnan(joints)) else self.of(joints)

    def crossing(self, start: FloatArray, end: FloatArray) -> FloatArray:
        """Share (N,) of the way between points (N, 3) at which the field is zero, by false position (Illinois)."""
        size = len(self.over.axes)
        start, end = start[:, :size], end[:, :size]
        low, high = np.zeros(len(start)), np.ones(len(start))
        first, last = self.values(start), self.values(end)
        crossed = (first >= 0) != (last >= 0)
        share, before = 0.5 * np.ones(len(start)), np.zeros(len(start), dtype=bool)
        for turn in range(ROUNDS):
            with np.errstate(divide="ignore", invalid="ignore"):
                share = np.where(crossed, low + (high - low) * first / (first - last), share)
            here = self.values(start + share[:, None] * (end - start))
            same = (here >= 0) == (first >= 0)
            # the end that stays for a second time counts half
            first, last = (
                np.where(same, here, np.where(~before & (turn > 0), 0.5 * first, first)),
                np.where(same, np.where(before & (turn > 0), 0.5 * last, last), here),
            )
            low, high, before = np.where(same, share, low), np.where(same, high, share), same
        return np.where(crossed, share, np.nan)


@dataclass(frozen=True, eq=False)
class ReachField(FollowedField):
    """The margin that is positive where the mode was followed to."""

    def values(self, points: FloatArray) -> FloatArray:
        """The measure (N,) of the serial side, -1 where a point (N, d) is not reached."""
        found = self.over.at(points)
        values = np.full(len(points), -1.0)
        if np.any(found.reached):
            values[found.reached] = self.of(found.joints[found.reached])
        return values

    def crossing(self, start: FloatArray, end: FloatArray) -> FloatArray:
        """Share (N,) of the way between points (N, 3) at which the reach ends, by halving from the reached side."""
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
    found: dict[str, FollowedField] = {REACH: ReachField(over, lambda joints: platform_held(record, joints).serial)}
    for name, bound in bounds(record, strokes).items():
        found[name] = FollowedField(over, _of_joints(record, bound))
    return found


def followed_factors(over: Continuation) -> dict[str, FollowedField]:
    """The determinant of Jp, signed; none where a mechanism has more or fewer inputs than rates of its pose."""
    record = over.record
    return {OUTPUT.name: FollowedField(over, lambda joints: platform_held(record, joints).output)}


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
    return continued(record, axes, slice_.poses, start, signs, tick), how


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


def _of_joints(record: MechanismRecord, bound: Bound) -> Callable[[FloatArray], FloatArray]:
    return lambda joints: bound(_values(record, joints))


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
