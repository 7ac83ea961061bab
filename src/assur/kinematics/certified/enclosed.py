"""The joint graph over intervals: bounds of its dimensions, and of where its joints stand.

Points of joints are the floats that the record holds, an axis is the unit vector along its floats, and a turn the
rotation next to its floats, both with bounds. A ball joint turns by a quaternion q0 (1, u), u its three unknowns and q0
where it is thought to be.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.configuration import Configuration
from assur.joint_graph.geometry import Geometry, JointGeometry, characteristic_length
from assur.joint_graph.tree import joint_graph
from assur.joints.steps import UNTURNED, Step, quaternions
from assur.kinematics.certified.given import turn
from assur.model.mechanism import Joint, MechanismRecord
from assur.numerics.intervals.functions import TURN
from assur.numerics.intervals.interval import Interval
from assur.numerics.vectors import Matrix, Vector, add, cross, dot, minus, plus, scaled

FloatArray = NDArray[np.float64]


def enclosed(record: MechanismRecord, near: FloatArray, values: Sequence[Any]) -> Configuration:
    """The joint graph at one number for each joint coordinate, intervals or what is made of them.

    Those of a ball joint are the three small ones of its quaternion, from joint values (K, n) near by.
    """
    slices = joint_graph(record).slices
    state = {
        name: [
            number
            for step, first in joint.type.places
            for number in _state(step, *_own(slices[name].start + first, step, values, near))
        ]
        for name, joint in record.joints.items()
    }
    return Configuration(joint_graph(record), interval_geometry(record), state)


def _own(first: int, step: Step, values: Sequence[Any], near: FloatArray) -> tuple[Sequence[Any], FloatArray]:
    last = first + len(step.kinds)
    return values[first:last], near[:, first:last]


def _state(step: Step, values: Sequence[Any], near: FloatArray) -> tuple[Any, ...]:
    match step.kind:
        case "slide":
            return (values[0],)
        case "turn":
            return turn(values[0])
        case "screw":
            return (*turn(values[0]), values[0])
        case "ball":
            w, *first = quaternions(near.T)
            vector, small = (first[0], first[1], first[2]), (values[0], values[1], values[2])
            return (w - dot(vector, small), *add(add(vector, scaled(small, w)), cross(vector, small)))


def loop_rows(configuration: Configuration) -> tuple[list[Any], list[Any]]:
    """Six numbers per cut joint that are zero where its loop closes, and one that is then positive.

    Three lengths, and the skew part of the turn from one frame to the other: where it vanishes that turn is none, or a
    half one, and its trace tells these apart.
    """
    rows: list[Any] = []
    positive: list[Any] = []
    for joint in configuration.graph.cut:
        distance, gap = configuration.gap(joint)
        rows += [*distance, minus(gap[2][1], gap[1][2]), minus(gap[0][2], gap[2][0]), minus(gap[1][0], gap[0][1])]
        positive.append(plus(plus(gap[0][0], gap[1][1]), gap[2][2]))
    return rows, positive


@lru_cache(maxsize=64)
def interval_geometry(record: MechanismRecord) -> Geometry:
    """Bounds of the dimensions of a record."""
    joints = {name: _of_joint(joint) for name, joint in record.joints.items()}
    return Geometry(joints, _vector(record.platform.point), Interval.of(characteristic_length(record)))


def _of_joint(joint: Joint) -> JointGeometry:
    turned = _rotation(joint.turn) if joint.turned else UNTURNED
    axes = tuple(_unit(axis) for axis in joint.axes)
    return JointGeometry(_vector(joint.at), _vector(joint.child_at), axes, turned, joint.pitch / TURN)


def _unit(axis: FloatArray) -> Vector:
    """A written axis as a unit vector: exact where it is one of the frame's, else with bounds."""
    if np.count_nonzero(axis) == 1:
        return _vector(np.sign(axis))
    parts = [Interval.of(value) for value in axis.tolist()]
    size = (parts[0].square() + parts[1].square() + parts[2].square()).sqrt()
    vector = [0 if value == 0 else part / size for value, part in zip(axis.tolist(), parts, strict=True)]
    return vector[0], vector[1], vector[2]


def _vector(values: FloatArray) -> Vector:
    """Floats as exact numbers, zeros and ones as the integers that they are."""
    x, y, z = (int(value) if value in (0.0, 1.0, -1.0) else Interval.of(value) for value in values.tolist())
    return x, y, z


def _rotation(values: FloatArray) -> Matrix:
    """Bounds of the rotation next to floats (3, 3), the orthogonal factor R of their polar decomposition M = R P.

    With s the singular values of M, |M - R| = |s - 1| <= |s^2 - 1| = |M'M - 1|. What stands alone in its row and column
    is 1 or -1 in R.
    """
    filled = values != 0
    alone = filled & (np.sum(filled, axis=0) == 1) & (np.sum(filled, axis=1, keepdims=True) == 1)
    exact = np.any(alone, axis=0) | np.any(alone, axis=1, keepdims=True)
    rows = [[Interval.of(value) for value in row] for row in values.tolist()]
    gap = Interval.of(0.0)
    for i in range(3):
        for j in range(3):
            entry = rows[0][i] * rows[0][j] + rows[1][i] * rows[1][j] + rows[2][i] * rows[2][j] - float(i == j)
            gap = gap + entry.square()
    off = float(gap.sqrt().high)
    spread = Interval.of(-off, off)

    def row(i: int) -> Vector:
        x, y, z = (int(np.sign(values[i, j])) if exact[i, j] else rows[i][j] + spread for j in range(3))
        return x, y, z

    return row(0), row(1), row(2)
