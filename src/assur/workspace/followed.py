"""Followed: the fields of a working mode without closed form, read off the joint values that following gives.

The reach itself is one margin: positive where the mode was followed to, falling to zero at its border as the square
of the measure of the serial side, negative elsewhere. Every other field is continued beyond the border.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.joint_graph.tree import joint_graph
from assur.kinematics.answers.at_border import angle_at_border
from assur.kinematics.following.continuation import continued
from assur.kinematics.following.ending import Mode
from assur.kinematics.following.followed_grid import Continuation, Followed
from assur.kinematics.following.following import follow
from assur.kinematics.home import home_values
from assur.kinematics.modes import TURNED, mode_signs, sign_names, without_letter
from assur.kinematics.naming import declared_signs, mode_names
from assur.kinematics.parasitic import all_coordinates
from assur.kinematics.position import checked_mode, inverse
from assur.kinematics.turns import periodic
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle
from assur.numerics import rotations
from assur.singularity.loci import OUTPUT
from assur.workspace.bounds import Bound, Stroke, Values, bounds
from assur.workspace.followed_field import FollowedField
from assur.workspace.followed_reach import ReachField
from assur.workspace.grid import UniformGrid
from assur.workspace.slices import Slice

FloatArray = NDArray[np.float64]
REACH = "reach"
STARTS = 24


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
    text = without_letter(checked_mode(record, "inverse", mode) if mode else "").partition("~")[0]
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
        crossed = "~" in mode.replace(f"~{TURNED}", "")
        solutions = inverse(record, slice_.poses(point[None])[0], mode or None, crossed=crossed)
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
