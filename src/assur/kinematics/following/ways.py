"""Ways: what varies over a share from 0 to 1 while the loops stay closed: inputs, a pose, a dimension, a joint value.

Every way is the same problem: gaps F(u, s) of joint values u at a share s that are to vanish, with D = dF/du. Gaps are
those of the loops, then those of what is held; none of them, nor joint values in D, has a dimension.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.tree import joint_graph
from assur.kinematics.border import checked_poses, held_inputs
from assur.kinematics.closure import closing_system
from assur.kinematics.following.course import Course, Prescribed
from assur.kinematics.pose import error_order, orientation, turning_rates, whole_orientation
from assur.kinematics.rates.motions import pose_units
from assur.kinematics.turns import joint_units
from assur.model.dimensions import with_parameters
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, LENGTHS, has_quaternion
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.intp]


class Way(Protocol):
    """N ways; rows (k,) say which of them joint values (k, n) and shares (k,) belong to."""

    @property
    def linear(self) -> bool:
        """Whether gaps are to first order those at other shares, so that what D cannot undo no motion does."""
        ...

    def mechanism(self, share: float, /) -> MechanismRecord:
        """The mechanism at a share; where it is not the same all along there is one way."""
        ...

    def units(self, share: float, /) -> FloatArray:
        """What a change of one is of each unknown (n,), in the units of the file."""
        ...

    def system(self, joints: FloatArray, shares: FloatArray, rows: IntArray, /) -> tuple[FloatArray, FloatArray]:
        """Gaps (k, r) and D (k, r, n)."""
        ...

    def gaps(self, joints: FloatArray, shares: FloatArray, ends: FloatArray, rows: IntArray, /) -> FloatArray:
        """Gaps (k, r) at other shares (k,) of what is assembled at shares (k,), to first order at least."""
        ...


@dataclass(frozen=True, eq=False)
class Stretch:
    """One straight part of a course of inputs or poses: a single way."""

    record: MechanismRecord
    course: Course
    segment: int
    linear: bool = True

    def mechanism(self, _share: float) -> MechanismRecord:
        """The same all along."""
        return self.record

    def units(self, share: float) -> FloatArray:
        """Those of the joint values."""
        return joint_units(self.mechanism(share))

    def system(self, joints: FloatArray, shares: FloatArray, _rows: IntArray) -> tuple[FloatArray, FloatArray]:
        """Gaps (1, r) and D (1, r, n)."""
        target = self.course.at(float(shares[0]), self.segment)
        return system_of(self.record, self.course.prescribed, joints, target[None])

    def gaps(self, _joints: FloatArray, shares: FloatArray, ends: FloatArray, _rows: IntArray) -> FloatArray:
        """Gaps (1, r): what is prescribed goes ahead, the loops stay closed."""
        return -(ends - shares)[:, None] * held_rows(self.record, self.rate(float(shares[0])))

    def rate(self, share: float) -> FloatArray:
        """Change (k,) of what is held per share of the course, in the order of the rows of D."""
        rate = self.course.rate(share, self.segment)
        return rate[error_order(self.course.names)] if self.course.prescribed == "poses" else rate


@dataclass(frozen=True, eq=False)
class Straight:
    """Poses (N, m) or inputs (N, k) to others, straight in their coordinates, as their numbers stand."""

    record: MechanismRecord
    start: FloatArray
    end: FloatArray
    held: Prescribed = "poses"
    linear: bool = True

    def mechanism(self, _share: float) -> MechanismRecord:
        """The same all along."""
        return self.record

    def units(self, share: float) -> FloatArray:
        """Those of the joint values."""
        return joint_units(self.mechanism(share))

    def system(self, joints: FloatArray, shares: FloatArray, rows: IntArray) -> tuple[FloatArray, FloatArray]:
        """Gaps and D with the platform or the inputs held."""
        return system_of(self.record, self.held, joints, self.at(shares, rows))

    def gaps(self, _joints: FloatArray, shares: FloatArray, ends: FloatArray, rows: IntArray) -> FloatArray:
        """Gaps: what is held goes ahead, the loops stay closed."""
        return -held_rows(self.record, self.change(shares, ends, rows))

    def change(self, shares: FloatArray, ends: FloatArray, rows: IntArray) -> FloatArray:
        """Change (k, c) of what is held from shares (k,) to others, without dimensions."""
        change = pose_change if self.held == "poses" else input_change
        return change(self.record, self.at(shares, rows), self.at(ends, rows))

    def at(self, shares: FloatArray, rows: IntArray) -> FloatArray:
        """Poses (k, m) or inputs; at the end the very ones."""
        start, end, part = self.start[rows], self.end[rows], shares[:, None]
        between = start + part * (end - start)
        poses = np.where(part == 1.0, end, np.where(part == 0.0, start, between))
        if self.held == "poses" and has_quaternion(self.record.platform.pose):
            return checked_poses(self.record, poses)
        return poses


@dataclass(frozen=True, eq=False)
class Led:
    """Ways that a joint value leads and whose shares follow, so that they run smoothly through where they turn back.

    Unknowns (k, n + 1) are joint values and the share of the other way, shares (k,) those of the leading joint values.

    Attributes:
        way: the other one, whose gaps change evenly with its share.
        lead: (N,) which joint value leads on each.
    """

    way: Way
    lead: IntArray
    linear: bool = False

    def mechanism(self, share: float) -> MechanismRecord:
        """That of the other way."""
        return self.way.mechanism(share)

    def units(self, share: float) -> FloatArray:
        """Those of the joint values, and a share."""
        return np.append(self.way.units(share), 1.0)

    def system(self, joints: FloatArray, shares: FloatArray, rows: IntArray) -> tuple[FloatArray, FloatArray]:
        """Gaps (k, r + 1) and D (k, r + 1, n + 1): those of the other way, then of the leading joint value."""
        values, others = joints[:, :-1], joints[:, -1]
        gaps, matrix = self.way.system(values, others, rows)
        leading = (values / self.way.units(0.0))[np.arange(len(rows)), self.lead[rows]]
        away = np.concatenate([gaps, (leading - shares)[:, None]], axis=1)
        return away, self.bordered(matrix, values, rows)

    def bordered(self, matrix: FloatArray, joints: FloatArray, rows: IntArray) -> FloatArray:
        """D (k, r + 1, n + 1) from that (k, r, n) of the other way."""
        count = len(rows)
        whole = np.zeros((count, matrix.shape[1] + 1, matrix.shape[2] + 1))
        whole[:, :-1, :-1] = matrix
        whole[:, :-1, -1] = self.way.gaps(joints, np.zeros(count), np.ones(count), rows)
        whole[np.arange(count), -1, self.lead[rows]] = 1.0
        return whole

    def gaps(self, joints: FloatArray, shares: FloatArray, ends: FloatArray, rows: IntArray) -> FloatArray:
        """Gaps (k, r + 1): the leading joint value goes ahead."""
        other = self.way.gaps(joints[:, :-1], joints[:, -1], joints[:, -1], rows)
        return np.concatenate([other, (shares - ends)[:, None]], axis=1)


@dataclass(frozen=True, eq=False)
class DimensionWay:
    """One dimension that changes from a value to another, in the unit of the file; the inputs or the pose are held.

    Where the file allows a value between the two, that is; else its `UsageError` is raised.
    """

    record: MechanismRecord
    name: str
    values: tuple[float, float]
    held: Prescribed
    target: FloatArray
    linear: bool = False
    _records: dict[float, MechanismRecord] = field(default_factory=dict)

    def value(self, share: float) -> float:
        """The dimension at a share."""
        start, end = self.values
        return end if share == 1.0 else start + share * (end - start)

    def mechanism(self, share: float) -> MechanismRecord:
        """The mechanism at a share."""
        if share not in self._records:
            self._records[share] = with_parameters(self.record, **{self.name: self.value(share)})
        return self._records[share]

    def units(self, share: float) -> FloatArray:
        """Those of the joint values."""
        return joint_units(self.mechanism(share))

    def system(self, joints: FloatArray, shares: FloatArray, _rows: IntArray) -> tuple[FloatArray, FloatArray]:
        """Gaps (1, r) and D (1, r, n)."""
        return system_of(self.mechanism(float(shares[0])), self.held, joints, self.target[None])

    def gaps(self, joints: FloatArray, _shares: FloatArray, ends: FloatArray, _rows: IntArray) -> FloatArray:
        """Gaps (1, r) of the loops with the other dimension."""
        return self.system(joints, ends, _rows)[0]


def system_of(
    record: MechanismRecord, held: Prescribed, joints: FloatArray, target: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Gaps (N, r) and D (N, r, n) at joint values (N, n) with inputs (N, k) or poses (N, m) held."""
    if held == "poses":
        return held_system(record, joints, target)
    gaps, derivative = closing_system(record, joints, None)
    size, length, driven = joint_units(record), characteristic_length(record), list(record.input_indices)
    away = (joints - held_inputs(record, joints, target))[:, driven] / size[driven]
    return np.concatenate([gaps / length, away], axis=1), with_inputs_held(record, derivative * (size / length))


def with_inputs_held(record: MechanismRecord, matrix: FloatArray) -> FloatArray:
    """D (N, r + k, n) of the loops and the inputs, from that (N, r, n) of the loops."""
    driven = np.eye(matrix.shape[-1])[list(record.input_indices)]
    return np.concatenate([matrix, np.broadcast_to(driven, (len(matrix), *driven.shape))], axis=1)


def other_side(record: MechanismRecord, held: Prescribed, joints: FloatArray, matrix: FloatArray) -> FloatArray:
    """D (N, r, n) with the platform held where D is that with the inputs held, and the other way round."""
    if held == "poses":
        return with_inputs_held(record, matrix[:, : -len(pose_units(record))])
    moves = turning_rates(record, joints) * joint_units(record) / pose_units(record)[:, None]
    return np.concatenate([matrix[:, : -len(record.input_indices)], moves], axis=1)


def held_system(record: MechanismRecord, joints: FloatArray, poses: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Gaps (N, r) of the loops and to poses (N, m) at joint values (N, n), and D."""
    gaps, derivative = closing_system(record, joints, poses)
    length = characteristic_length(record)
    return gaps / length, derivative * (joint_units(record) / length)


def held_rows(record: MechanismRecord, changes: FloatArray) -> FloatArray:
    """Changes (..., k) of what is held below the rows of the loops (..., 6 v + k), which do not change."""
    loops = np.zeros((*changes.shape[:-1], 6 * len(joint_graph(record).cut)))
    return np.concatenate([loops, changes], axis=-1)


def pose_change(record: MechanismRecord, start: FloatArray, end: FloatArray) -> FloatArray:
    """Change (N, k) from poses to poses (N, m), as `assur.kinematics.pose.error_rates` has it, without dimensions.

    Lengths are in characteristic lengths; angles go the short way; a whole orientation changes by a rotation vector.
    """
    names = record.platform.pose
    first, second = ({name: poses[:, k] for k, name in enumerate(names)} for poses in (start, end))
    rows = [(second[name] - first[name]) / characteristic_length(record) for name in names if name in LENGTHS]
    if whole_orientation(names):
        turn = orientation(names, second) @ np.swapaxes(orientation(names, first), -1, -2)
        rows += list(rotations.to_vector(turn).T)
    else:
        rows += [rotations.nearest_turn(second[name] - first[name]) for name in names if name in ANGLES]
    return np.stack(rows, axis=1)


def input_change(record: MechanismRecord, start: FloatArray, end: FloatArray) -> FloatArray:
    """Change (N, k) of the actuated joint values from printed inputs to others (N, k), without dimensions."""
    units = joint_units(record)[list(record.input_indices)] * [item.sign for item in record.inputs]
    return np.asarray((end - start) / units)
