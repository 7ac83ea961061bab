"""Limits of the file: strokes of inputs, limits of joint values, cones of spherical joints; how far inside they are."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.turns import periodic
from assur.model.mechanism import MechanismRecord
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
NO_LIMITS = "no limits are stated"


@dataclass(frozen=True, eq=False)
class Limit:
    """One bound. Inside, low <= sign * value + offset <= high, in rad or lengths.

    Attributes:
        what, of: what the file calls it, and the input, joint value or joint that it bounds.
        index: of the joint value; for a cone, of the first part of the rotation vector.
        axis: (3,) axis of a cone, else None; then the value is the tilt of this axis.
        angular: whether the value is an angle.
    """

    what: Literal["stroke", "limit", "cone"]
    of: str
    index: int
    low: float
    high: float
    angular: bool
    sign: float = 1.0
    offset: float = 0.0
    axis: FloatArray | None = None

    @property
    def name(self) -> str:
        """As a person reads it: "stroke of q1" or "limit of leg1.A"."""
        return f"{self.what} of {self.of}"

    def value(self, joints: FloatArray) -> FloatArray:
        """The bounded value (...) at joint values (..., n)."""
        if self.axis is None:
            return np.asarray(self.sign * joints[..., self.index] + self.offset)
        turn = rotations.from_vector(joints[..., self.index : self.index + 3])
        tilted = turn @ self.axis
        across = np.linalg.norm(rotations.cross(tilted, self.axis), axis=-1)
        return np.asarray(np.arctan2(across, tilted @ self.axis))

    def margin(self, joints: FloatArray) -> FloatArray:
        """How far inside (...) joint values (..., n) are; negative outside."""
        value = self.value(joints)
        return np.asarray(np.minimum(value - self.low, self.high - value))


def limits(record: MechanismRecord, joints: FloatArray) -> tuple[Limit, ...]:
    """Every bound of the file, for motions that begin at joint values (n,).

    An angle is counted from there on without jumps; where a whole turn leaves it as it was, turns are added so that it
    begins as near to the middle of its bounds as it can.

    >>> from assur.model.registry import load_record
    >>> limits(load_record("fivebar"), np.zeros(5))
    ()
    """
    return tuple(
        replace(limit, offset=limit.offset + float(turns_to(record, limit, limit.value(joints))))
        for limit in stated_limits(record)
    )


def stated_limits(
    record: MechanismRecord, strokes: Mapping[str, tuple[float, float] | None] | None = None
) -> tuple[Limit, ...]:
    """Every bound as the file states it: strokes of inputs, limits of joint values, cones.

    Strokes that are given stand for those of the file, None for no stroke.

    >>> from assur.model.registry import load_record
    >>> [item.name for item in stated_limits(load_record("three_rps"), {"rho1": None})]
    ['stroke of rho2', 'stroke of rho3']
    """
    given, driven = strokes or {}, []
    for item in record.drives:
        stroke, place = given.get(item.name, item.stroke), item.coordinate
        if stroke is not None:
            angular = place.kind == "angle"
            driven.append(Limit("stroke", item.name, place.index, *stroke, angular, item.sign, item.offset))
    return (*driven, *_of_joints(record))


@lru_cache(maxsize=64)
def _of_joints(record: MechanismRecord) -> tuple[Limit, ...]:
    """Limits of joint values, and cones."""
    stated = []
    for coordinate in record.coordinates:
        joint = record.joints[coordinate.joint]
        place = coordinate.index - record.joint_coordinates(joint.name)[0].index
        bounds = joint.limits[place] if joint.limits else None
        if bounds is not None:
            name = record.coordinate_label(coordinate)
            stated.append(Limit("limit", name, coordinate.index, *bounds, coordinate.kind == "angle"))
    for joint in record.joints.values():
        if joint.cone is not None and joint.cone_axis is not None:
            index = record.joint_coordinates(joint.name)[0].index
            stated.append(Limit("cone", joint.name, index, 0.0, joint.cone, True, axis=joint.cone_axis))
    return tuple(stated)


def joint_limits(record: MechanismRecord) -> list[str]:
    """Which limits of joints and cones the file states, besides strokes of inputs.

    >>> from assur.model.registry import load_record
    >>> joint_limits(load_record("three_rps"))
    []
    """
    return [item.name for item in _of_joints(record)]


def limits_stated(record: MechanismRecord, strokes: Mapping[str, object] | None = None) -> bool:
    """Whether the file states any stroke, joint limit or cone; `strokes` of inputs stand for those of the file.

    >>> from assur.model.registry import load_record
    >>> limits_stated(load_record("fivebar")), limits_stated(load_record("three_rps"))
    (False, True)
    >>> limits_stated(load_record("fivebar"), {"theta1": (0.0, 1.0)})
    True
    """
    given = dict(strokes or {})
    driven = any(given.get(item.name, item.stroke) is not None for item in record.inputs)
    return driven or bool(_of_joints(record))


def limits_note(record: MechanismRecord, strokes: Mapping[str, object] | None = None) -> str:
    """What is to be said beside a claim of reach: that no limits are stated, where none are; else nothing.

    >>> from assur.model.registry import load_record
    >>> limits_note(load_record("fivebar")), limits_note(load_record("three_rps"))
    ('no limits are stated', '')
    """
    return "" if limits_stated(record, strokes) else NO_LIMITS


def turns_to(record: MechanismRecord, limit: Limit, value: FloatArray) -> FloatArray:
    """Angles (...) to add to values of a limit that bring them as near to the middle of its bounds as whole turns can.

    Zero for a length, a tilt, and an angle whose turns count (`assur.joint_graph.turns`).
    """
    if limit.axis is not None or not periodic(record)[limit.index]:
        return np.zeros(np.shape(value))
    return np.asarray(2 * np.pi * np.round(((limit.low + limit.high) / 2 - value) / (2 * np.pi)))
