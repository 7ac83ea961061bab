"""Dimensions that are off, as intervals or as arrays: each copy adds what is off where it is written."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any

import numpy as np

from assur.joint_graph.geometry import Geometry, JointGeometry, written_joint
from assur.joints.steps import STILL
from assur.kinematics.certified.given import turn
from assur.model.mechanism import Joint, MechanismRecord, Parameter
from assur.model.written import NumberReading
from assur.numerics.dual import Dual, DualIntervals
from assur.numerics.intervals.functions import TURN, from_degrees
from assur.numerics.intervals.interval import Interval, as_interval


@dataclass(frozen=True)
class SizeNumbers:
    """How dimensions are numbers: what formulas call, and the number of one of them in lengths or rad."""

    functions: SimpleNamespace
    size: Callable[[Parameter], Any]


INTERVALS = SizeNumbers(
    SimpleNamespace(
        sqrt=DualIntervals().sqrt,
        cos=lambda angle: turn(angle if isinstance(angle, Dual) else as_interval(angle))[0],
        sin=lambda angle: turn(angle if isinstance(angle, Dual) else as_interval(angle))[1],
        pi=0.5 * TURN,
    ),
    lambda parameter: from_degrees(parameter.value) if parameter.unit == "deg" else Interval.of(parameter.value),
)
FLOATS = SizeNumbers(SimpleNamespace(sqrt=np.sqrt, cos=np.cos, sin=np.sin, pi=np.pi), lambda own: own.inside)


def toleranced_geometry(record: MechanismRecord, off: Mapping[str, Any], numbers: SizeNumbers = INTERVALS) -> Geometry:
    """The dimensions of a record with what copies of dimensions are off by.

    Args:
        record: the mechanism.
        off: copy of a dimension, as `assur.machine.accuracy.geometry_errors` names it, -> a number in lengths or rad.
        numbers: intervals, about which what is off may be a dual number, or floats, about which it may be an array.

    >>> from assur.model.registry import load_record
    >>> own = toleranced_geometry(load_record("fivebar"), {"crank1.l1": Interval.of(-0.5, 0.5)})
    >>> [round(float(own.joints[name].at[0].width), 9) for name in ("B1", "B2")]
    [1.0, 0.0]
    """
    joints = {name: _joint(record, joint, off, numbers) for name, joint in record.joints.items()}
    point = record.platform.written
    own = point.vector(_reading(record, off, ("", record.platform.link), numbers)) if point else STILL
    return Geometry(joints, own, 1)


def _joint(record: MechanismRecord, joint: Joint, off: Mapping[str, Any], numbers: SizeNumbers) -> JointGeometry:
    limb = joint.name.rpartition(".")[0]
    in_parent, in_child = (
        written_joint(joint, _reading(record, off, (limb, link), numbers)) for link in (joint.parent, joint.child)
    )
    return replace(in_parent, child_at=in_child.child_at)


def _reading(
    record: MechanismRecord, off: Mapping[str, Any], owners: tuple[str, str], numbers: SizeNumbers
) -> NumberReading:
    """What formulas read in a limb, if any, and a link."""
    names: dict[str, Any] = {}
    for name, parameter in record.parameters.items():
        number = numbers.size(parameter)
        for copy in dict.fromkeys([name, *(f"{owner}.{name}" for owner in owners if owner)]):
            if copy in off:
                number = off[copy] + number
        names[name] = number
    return NumberReading(names, numbers.functions, float)
