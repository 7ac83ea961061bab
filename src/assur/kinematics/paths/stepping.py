"""One step along a path: along the tangent, corrected, and taken where nothing forbids it.

A step is taken where the loops close, the correction is small against the step, no limit is broken, and neither the
matrix with the inputs locked nor the one with the platform locked loses its rank on the way
(`assur.kinematics.paths.locked`). Else it is halved, down to the tolerance.
"""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.tree import joint_graph
from assur.kinematics.border import held_inputs
from assur.kinematics.closure import Assembly, assemble
from assur.kinematics.limits import Limit
from assur.kinematics.paths.course import Course
from assur.kinematics.paths.locked import Locked, locked, matrices, own, units
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
CLOSE = 0.1
"""A correction is at most this share of its step; half the angle, in rad, by which the tangent may turn."""

AIM = 0.7
"""The next step is meant to need a correction of this share of the largest allowed; at most twice the step before."""

LEAVING, CLEAR = 1e-3, 10.0
"""Share of the tolerance to which steps may go down in the first 10 tolerances: another path may have stopped there."""

KEPT = 0.2
"""What must be left of the rank after a step."""

MERGING = 0.9
"""Where less is left of a rank that the wanted rates need, two branches are foreseen to merge."""

AHEAD, BEFORE = 0.9, 0.7
"""Share of the way to a foreseen merging, and to another foreseen singularity, that the next step takes at most."""

LONGEST = 1.25 * np.pi
"""Rotation vectors that are longer are replaced by those of the same rotation the other way round."""

SAFE = 3.0
"""A singular value that is not so many times the noise may as well be zero."""

FLOOR = 1e-6
"""A smallest singular value below which the corrector cannot tell two branches from each other."""

NEWTON = 16
"""Steps of the corrector."""

FINE, COARSE = 1e-14, 1e-12
"""Tolerances of the corrector: the coarse one where it is enough for ACCURACY."""

ROUNDING = 1e-13
"""Residuals up to this, relative to the largest joint value, are rounding."""

ACCURACY = 1e-9
"""How exact joint values shall be, in rad or characteristic lengths; they are worse near singularities only."""


@dataclass(frozen=True, eq=False)
class Task:
    """What does not change from step to step."""

    record: MechanismRecord
    way: Course
    bounds: tuple[Limit, ...]
    ranks: dict[str, int]
    tolerance: float
    largest_step: float


@dataclass(frozen=True)
class Blocked:
    """What forbade the last step that was tried.

    Attributes:
        why: open (the loops did not close), far (the correction was large against the step), lost (a rank would be
            lost on the way), missed (no motion has these rates), limit, interrupted (by Ctrl-C).
        segment: of the way.
    """

    why: Literal["open", "far", "lost", "missed", "limit", "interrupted"]
    segment: int
    limit: Limit | None = None


@dataclass(frozen=True, eq=False)
class Point:
    """A place on the path.

    Attributes:
        share, joints: of the way, and joint values (n,).
        own, other: the matrix of what is prescribed, and that of what is not.
        ahead: share of the way after which two branches are foreseen to merge; inf where nothing is foreseen.
    """

    share: float
    joints: FloatArray
    own: Locked
    other: Locked
    ahead: float = np.inf

    @property
    def tolerance(self) -> float:
        """What the residual may be at the next point, relative to the characteristic length."""
        return min(COARSE, max(FINE, ACCURACY * float(self.own.sizes[-1])))

    @property
    def noise(self) -> float:
        """By how much the next point's joint values may be wrong then."""
        return self.tolerance / float(self.own.sizes[-1])


def point_at(task: Task, share: float, joints: FloatArray) -> Point:
    """An assembly (n,) at a share of the way, with its matrices."""
    found = matrices(task.record, joints)
    mine, other = (locked(found[name], task.ranks[name]) for name in own(task.way.prescribed))
    return Point(share, joints, mine, other)


def corrected(task: Task, start: FloatArray, share: float, segment: int, tolerance: float) -> FloatArray | None:
    """The assembly (n,) near `start` at a share of the way; None where the loops do not close as well as they can."""
    found = assembled(task.record, task.way, start, share, segment, NEWTON, tolerance)
    reach = 1.0 + float(np.max(np.abs(found.values / units(task.record))))
    best = characteristic_length(task.record) * max(10 * tolerance, ROUNDING * reach)
    return found.values if float(found.residual) <= best else None


def assembled(
    record: MechanismRecord, way: Course, start: FloatArray, share: float, segment: int, steps: int, tolerance: float
) -> Assembly:
    """The closest approach near `start` to the inputs or the pose at a share of the way."""
    target = way.at(share, segment)
    if way.prescribed == "poses":
        return assemble(record, start, poses=target, tolerance=tolerance, max_steps=steps)
    held = held_inputs(record, start, target)
    return assemble(record, held, held=record.input_indices, tolerance=tolerance, max_steps=steps)


def step_on(task: Task, here: Point, segment: int, tangent: FloatArray, step: float) -> tuple[Point | Blocked, float]:
    """The next point and the step to try after it; or what blocks the smallest step."""
    end = float(task.way.shares[segment + 1])
    least = _least(task, here.share)
    while True:
        share = here.share + step
        if share > end - least / 2:
            share = end
        tried, following = _try(task, here, segment, tangent, share)
        if isinstance(tried, Point) or step <= least:
            return tried, following
        step = max((share - here.share) / 2, 0.9 * least)


def _least(task: Task, share: float) -> float:
    """The smallest step that is tried at a share of the way."""
    return task.tolerance * (1.0 if share > CLEAR * task.tolerance else LEAVING)


def _try(task: Task, here: Point, segment: int, tangent: FloatArray, share: float) -> tuple[Point | Blocked, float]:
    """The point at a share of the way and the step to try after it, or what forbids it."""
    record, step, size = task.record, share - here.share, units(task.record)
    move = _along(step, here.ahead) * tangent
    predicted = here.joints + move * size
    joints = corrected(task, predicted, share, segment, here.tolerance)
    if joints is None:
        return Blocked("open", segment), step
    away, moved = (float(np.linalg.norm(change)) for change in ((joints - predicted) / size, move))
    if away > CLOSE * moved + here.noise:
        return Blocked("far", segment), step
    found = matrices(record, joints)
    mine, other = own(task.way.prescribed)
    kept, kept_other = here.own.kept(found[mine]), here.other.kept(found[other])
    if min(kept, kept_other) < KEPT:
        return Blocked("lost", segment), step
    broken = outside(task, joints)
    if broken is not None:
        return Blocked("limit", segment, broken), step
    there = point_at(task, share, _whole_turns_less(record, joints))
    if there.own.sizes[-1] < FLOOR or there.other.sizes[-1] < SAFE * there.noise:
        return Blocked("lost", segment), step
    following = step * min(2.0, AIM * CLOSE * moved / away if away > 0.0 else 2.0)
    if there.own.drives(task.way.rate(share, segment)) and kept < MERGING:
        # near a merging the square of the singular value goes to zero linearly
        there = dataclasses.replace(there, ahead=step * kept**2 / (1.0 - kept**2))
        following = AHEAD * there.ahead
        kept = 1.0
    least = min(kept, kept_other)
    if least < 1.0:
        # were the singular value to go on like this, it would vanish after step * least / (1 - least)
        following = min(following, BEFORE * step * least / (1.0 - least))
    return there, max(following, _least(task, share))


def _along(step: float, ahead: float) -> float:
    """How much of the tangent a step takes: all of it, or less and less than the step where a merging is `ahead`.

    The joint values are q* - a sqrt(s* - s) there, so that a step h goes 2 ahead (1 - sqrt(1 - h / ahead)) far.
    """
    if step >= ahead:
        return 2 * ahead
    return step if np.isinf(ahead) else 2 * ahead * (1.0 - float(np.sqrt(1.0 - step / ahead)))


def outside(task: Task, joints: FloatArray) -> Limit | None:
    """The limit that joint values (n,) break most, if any."""
    rooms = [(float(limit.margin(joints)), k) for k, limit in enumerate(task.bounds)]
    least, k = min(rooms, default=(0.0, 0))
    return task.bounds[k] if least < 0.0 else None


def _whole_turns_less(record: MechanismRecord, joints: FloatArray) -> FloatArray:
    """The same assembly with every rotation vector well inside one turn, where its rates are those of a rotation."""
    found = joints
    for name, joint in record.joints.items():
        if not joint.type.ball:
            continue
        place = joint_graph(record).slices[name]
        angle = float(np.linalg.norm(joints[place]))
        if angle > LONGEST:
            found = found.copy() if found is joints else found
            found[place] *= 1.0 - 2 * np.pi / angle
    return found
