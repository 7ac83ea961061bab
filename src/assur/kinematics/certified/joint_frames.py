"""Frames of the joint graph over any number type, as rows of numbers: bounds, and bounds of derivatives, of its loops.

Points of joints are the floats that the record holds, an axis is the unit vector along its floats, and a turn the
rotation next to its floats, both with bounds. A ball joint turns by a unit quaternion q0 (1, u), u its three unknowns
and q0 where it is thought to be.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.tree import joint_graph
from assur.joints.cylindrical import CYLINDRICAL
from assur.joints.helical import HELICAL
from assur.joints.prismatic import PRISMATIC
from assur.joints.revolute import REVOLUTE
from assur.joints.spherical import SPHERICAL
from assur.joints.universal import UNIVERSAL
from assur.kinematics.certified.given import turn
from assur.model.mechanism import Joint, MechanismRecord
from assur.numerics import rotations
from assur.numerics.intervals.functions import TURN
from assur.numerics.intervals.interval import Interval
from assur.numerics.sparse_vectors import (
    Matrix,
    Vector,
    add,
    apply,
    cross,
    dot,
    minus,
    plus,
    product,
    scaled,
    subtract,
    times,
    transposed,
)

FloatArray = NDArray[np.float64]
Placed = tuple[Matrix, Vector]
UNTURNED: Matrix = ((1, 0, 0), (0, 1, 0), (0, 0, 1))


@dataclass(frozen=True, eq=False)
class JointFrames:
    """Frames of all links near joint values (K, coordinates), and how far apart the ends of each loop are."""

    record: MechanismRecord
    near: FloatArray

    def frames(self, values: Sequence[Any]) -> dict[str, Placed]:
        """Frame of every link along the spanning tree: rows of its orientation, and its origin.

        `values` are one number per joint coordinate; of a ball joint the three small ones of its quaternion.
        """
        graph = joint_graph(self.record)
        placed: dict[str, Placed] = {self.record.base: (UNTURNED, (0, 0, 0))}
        for joint, forward in graph.tree:
            near, far = (joint.parent, joint.child) if forward else (joint.child, joint.parent)
            move = self._child if forward else self._parent
            placed[far] = move(joint, placed[near], values[graph.slices[joint.name]])
        return placed

    def loops(self, placed: Mapping[str, Placed], values: Sequence[Any]) -> tuple[list[Any], list[Any]]:
        """Six numbers per cut joint that are zero where its loop closes, and one that is then positive.

        Three lengths, and the skew part of the turn from one frame to the other: where it vanishes that turn is none,
        or a half one, and its trace tells these apart.
        """
        graph = joint_graph(self.record)
        rows: list[Any] = []
        positive: list[Any] = []
        for joint in graph.cut:
            reached, origin = self._child(joint, placed[joint.parent], values[graph.slices[joint.name]])
            rotation, own = placed[joint.child]
            at = _vector(joint.child_at)
            rows += subtract(add(apply(reached, at), origin), add(apply(rotation, at), own))
            gap = product(transposed(reached), rotation)
            rows += [minus(gap[2][1], gap[1][2]), minus(gap[0][2], gap[2][0]), minus(gap[1][0], gap[0][1])]
            positive.append(plus(plus(gap[0][0], gap[1][1]), gap[2][2]))
        return rows, positive

    def _child(self, joint: Joint, parent: Placed, values: Sequence[Any]) -> Placed:
        turned, shift = self._motion(joint, values)
        orientation = product(parent[0], turned)
        if joint.turned:
            orientation = product(orientation, _rotation(joint.turn))
        origin = add(parent[1], apply(parent[0], add(_vector(joint.at), shift)))
        return orientation, subtract(origin, apply(orientation, _vector(joint.child_at)))

    def _parent(self, joint: Joint, child: Placed, values: Sequence[Any]) -> Placed:
        turned, shift = self._motion(joint, values)
        orientation = product(child[0], transposed(_rotation(joint.turn))) if joint.turned else child[0]
        orientation = product(orientation, transposed(turned))
        origin = add(child[1], apply(child[0], _vector(joint.child_at)))
        return orientation, subtract(origin, apply(orientation, add(_vector(joint.at), shift)))

    def _motion(self, joint: Joint, values: Sequence[Any]) -> tuple[Matrix, Vector]:
        """Turn and shift of the child's joint frame in the parent's."""
        if joint.type is SPHERICAL:
            return self._ball(joint, values), (0, 0, 0)
        axes = [_unit(axis) for axis in joint.axes]
        if joint.type is PRISMATIC:
            return UNTURNED, scaled(axes[0], values[0])
        if joint.type is UNIVERSAL:
            return product(_about(axes[0], values[0]), _about(axes[1], values[1])), (0, 0, 0)
        if joint.type is CYLINDRICAL:
            return _about(axes[0], values[1]), scaled(axes[0], values[0])
        if joint.type is HELICAL:
            return _about(axes[0], values[0]), scaled(axes[0], values[0] * (joint.pitch / TURN))
        if joint.type is REVOLUTE:
            return _about(axes[0], values[0]), (0, 0, 0)
        raise AssertionError(f"no motion for joint type {joint.type.name}")

    def _ball(self, joint: Joint, values: Sequence[Any]) -> Matrix:
        w, x, y, z = self._quaternions[joint.name]
        first, small = (x, y, z), (values[0], values[1], values[2])
        scalar = w - dot(first, small)
        vector = add(add(first, scaled(small, w)), cross(first, small))
        twice = 2 / (scalar * scalar + dot(vector, vector))
        a, b, c = vector
        return (
            (1 - twice * (b * b + c * c), twice * (a * b - scalar * c), twice * (a * c + scalar * b)),
            (twice * (a * b + scalar * c), 1 - twice * (a * a + c * c), twice * (b * c - scalar * a)),
            (twice * (a * c - scalar * b), twice * (b * c + scalar * a), 1 - twice * (a * a + b * b)),
        )

    @cached_property
    def _quaternions(self) -> dict[str, FloatArray]:
        """Where each ball joint is thought to be."""
        graph = joint_graph(self.record)
        return {
            name: rotations.to_quaternion(rotations.from_vector(self.near[:, graph.slices[name]])).T
            for name, joint in self.record.joints.items()
            if joint.type is SPHERICAL
        }


def _about(axis: Vector, angle: Any) -> Matrix:
    """The turn about a unit axis by an angle in rad."""
    cosine, sine = turn(angle)
    x, y, z = axis
    own = [[times(a, b) for b in axis] for a in axis]
    across = ((0, minus(0, z), y), (z, 0, minus(0, x)), (minus(0, y), x, 0))
    rows = [
        tuple(
            plus(plus(times(cosine, minus(int(i == j), own[i][j])), own[i][j]), times(sine, across[i][j]))
            for j in range(3)
        )
        for i in range(3)
    ]
    return rows[0], rows[1], rows[2]


def _unit(axis: FloatArray) -> Vector:
    """A written axis as a unit vector: exact where it is one of the frame's, else with bounds."""
    if np.count_nonzero(axis) == 1:
        return _vector(np.sign(axis))
    parts = [Interval.of(value) for value in axis.tolist()]
    size = (parts[0].square() + parts[1].square() + parts[2].square()).sqrt()
    found = [0 if value == 0 else part / size for value, part in zip(axis.tolist(), parts, strict=True)]
    return found[0], found[1], found[2]


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
