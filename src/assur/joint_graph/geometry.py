"""Dimensions of joints as numbers of any type: points, unit vectors, turns and pitches.

What is 0, 1 or -1 is that integer, in every number type: planar and parallel structure costs nothing where these fold.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.joints.steps import STILL, UNTURNED
from assur.model.mechanism import Joint, MechanismRecord
from assur.model.written import NumberReading
from assur.numerics.vectors import Matrix, Vector

FloatArray = NDArray[np.float64]
WRITTEN = 1e-6
"""Cosine of axes that are meant to be square, or sine of parallel ones: files write six digits and more."""
ROUNDED = 1e-15
"""What is smaller than this in a unit vector, or as a share of a point's distance, is rounding of a turned limb."""


@dataclass(frozen=True)
class JointGeometry:
    """Dimensions of one joint.

    Attributes:
        at, child_at: the joint's point in the parent's and in the child's frame.
        axes: its unit vectors.
        turn: orientation of the child's frame in the parent's where every value is zero.
        advance: of a screw, in length per rad.
    """

    at: Vector
    child_at: Vector
    axes: tuple[Vector, ...]
    turn: Matrix
    advance: Any

    def mapped(self, change: Callable[[Any], Any]) -> JointGeometry:
        """The same with every number that is no integer changed."""
        a, b, c = (_mapped(row, change) for row in self.turn)
        advance = self.advance if type(self.advance) is int else change(self.advance)
        points = _mapped(self.at, change), _mapped(self.child_at, change)
        return JointGeometry(*points, tuple(_mapped(axis, change) for axis in self.axes), (a, b, c), advance)


@dataclass(frozen=True)
class Geometry:
    """Dimensions of all joints by their names, the platform's point O' in its frame, and the characteristic length."""

    joints: Mapping[str, JointGeometry]
    platform: Vector
    length: Any

    def mapped(self, change: Callable[[Any], Any]) -> Geometry:
        """The same with every number that is no integer changed, in an order that depends on nothing else."""
        joints = {name: own.mapped(change) for name, own in self.joints.items()}
        length = self.length if type(self.length) is int else change(self.length)
        return Geometry(joints, _mapped(self.platform, change), length)

    @property
    def key(self) -> tuple[object, ...]:
        """All numbers, to be compared and looked up by."""
        return (*self.joints.items(), self.platform, self.length)


@lru_cache(maxsize=64)
def geometry(record: MechanismRecord) -> Geometry:
    """The floats of a record.

    >>> from assur.model.registry import load_record
    >>> geometry(load_record("fivebar")).joints["A1"].axes
    ((0, 0, 1),)
    """
    joints = {name: joint_geometry(joint) for name, joint in record.joints.items()}
    return Geometry(joints, _point(record.platform.point), _plain(characteristic_length(record)))


def written_geometry(record: MechanismRecord, reading: NumberReading) -> Geometry:
    """The dimensions of a record over any number type, by their formulas; the length is 1.

    >>> import math
    >>> from assur.model.registry import load_record
    >>> reading = NumberReading({"g": 70.0, "l1": 100.0, "l2": 194.0}, math, float)
    >>> written_geometry(load_record("fivebar"), reading).joints["A1"].at
    (-70.0, 0, 0)
    """
    joints = {name: written_joint(joint, reading) for name, joint in record.joints.items()}
    point = record.platform.written
    return Geometry(joints, point.vector(reading) if point else STILL, 1)


def written_joint(joint: Joint, reading: NumberReading) -> JointGeometry:
    """The dimensions of one joint over any number type, by its formulas."""
    own = joint.written
    if own is None:
        raise ValueError(f"no formulas of joint {joint.name}")
    advance = reading.value(own.pitch) / (2 * reading.functions.pi) if own.pitch else 0
    axes = own.units(reading, joint.type.directions)
    return JointGeometry(own.at.vector(reading), own.child_at.vector(reading), axes, own.turn(reading), advance)


@lru_cache(maxsize=256)
def characteristic_length(record: MechanismRecord) -> float:
    """The length that turns an angle into a length: the largest distance of a joint from its link's origin."""
    spans = [np.linalg.norm(vector) for joint in record.joints.values() for vector in (joint.at, joint.child_at)]
    return float(max(spans)) or 1.0


@lru_cache(maxsize=256)
def joint_scales(record: MechanismRecord) -> FloatArray:
    """What a change of one is of each joint value (n,), so that lengths mix fairly with angles.

    It is the characteristic length of a length, and a rad of an angle.

    >>> from assur.model.registry import load_record
    >>> joint_scales(load_record("orthoglide"))[:2] == [characteristic_length(load_record("orthoglide")), 1.0]
    array([ True,  True])
    """
    length = characteristic_length(record)
    scales = np.array([length if item.kind == "length" else 1.0 for item in record.coordinates])
    scales.flags.writeable = False
    return scales


def joint_geometry(joint: Joint) -> JointGeometry:
    """The floats of one joint."""
    a, b, c = map(_unit, joint.turn)
    turn = (a, b, c) if joint.turned else UNTURNED
    advance = float(joint.pitch / (2 * np.pi)) if joint.pitch else 0
    return JointGeometry(_point(joint.at), _point(joint.child_at), tuple(map(_unit, joint.axes)), turn, advance)


def _mapped(numbers: Vector, change: Callable[[Any], Any]) -> Vector:
    x, y, z = (number if type(number) is int else change(number) for number in numbers)
    return x, y, z


def _point(values: FloatArray) -> Vector:
    size = ROUNDED * float(np.max(np.abs(values)))
    x, y, z = (0 if abs(value) <= size else _plain(value) for value in values.tolist())
    return (x, y, z) if np.any(values) else STILL


def _unit(values: FloatArray) -> Vector:
    x, y, z = (round(value) if abs(value - round(value)) <= ROUNDED else value for value in values.tolist())
    return x, y, z


def _plain(value: float) -> Any:
    return int(value) if value in (1.0, -1.0) else value
