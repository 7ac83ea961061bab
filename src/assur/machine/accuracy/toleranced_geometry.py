"""Dimensions within their tolerances, over any number type: each copy adds what is off where it is written."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

from assur.joint_graph.geometry import Geometry, JointGeometry, written_joint
from assur.joints.steps import STILL
from assur.kinematics.certified.given import turn
from assur.model.mechanism import Joint, MechanismRecord
from assur.model.written import NumberReading
from assur.numerics.dual import Dual, DualIntervals
from assur.numerics.intervals.functions import TURN, from_degrees
from assur.numerics.intervals.interval import Interval, as_interval

FUNCTIONS = SimpleNamespace(
    sqrt=DualIntervals().sqrt,
    cos=lambda angle: turn(angle if isinstance(angle, Dual) else as_interval(angle))[0],
    sin=lambda angle: turn(angle if isinstance(angle, Dual) else as_interval(angle))[1],
    pi=0.5 * TURN,
)


def toleranced_geometry(record: MechanismRecord, off: Mapping[str, Any]) -> Geometry:
    """The dimensions of a record, an interval each, with what copies of dimensions are off by.

    Args:
        record: the mechanism.
        off: copy of a dimension, as `assur.machine.accuracy.geometry_errors` names it, -> a number in lengths or rad.

    >>> from assur.model.registry import load_record
    >>> own = toleranced_geometry(load_record("fivebar"), {"crank1.l1": Interval.of(-0.5, 0.5)})
    >>> [round(float(own.joints[name].at[0].width), 9) for name in ("B1", "B2")]
    [1.0, 0.0]
    """
    joints = {name: _joint(record, joint, off) for name, joint in record.joints.items()}
    point = record.platform.written
    own = point.vector(_reading(record, off, "", record.platform.link)) if point else STILL
    return Geometry(joints, own, 1)


def _joint(record: MechanismRecord, joint: Joint, off: Mapping[str, Any]) -> JointGeometry:
    limb = joint.name.rpartition(".")[0]
    in_parent = written_joint(joint, _reading(record, off, limb, joint.parent))
    return replace(in_parent, child_at=written_joint(joint, _reading(record, off, limb, joint.child)).child_at)


def _reading(record: MechanismRecord, off: Mapping[str, Any], limb: str, link: str) -> NumberReading:
    names: dict[str, Any] = {}
    for name, parameter in record.parameters.items():
        value = parameter.value
        number: Any = from_degrees(value) if parameter.unit == "deg" else Interval.of(value)
        owners = dict.fromkeys(["", *([f"{limb}."] if limb else []), f"{link}."])
        for copy in (f"{owner}{name}" for owner in owners):
            if copy in off:
                number = off[copy] + number
        names[name] = number
    return NumberReading(names, FUNCTIONS, float)
