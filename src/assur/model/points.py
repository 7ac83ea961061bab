"""Lettered points and named quantities of the joint graph: where C1 is, what sin(D1) is."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.errors import UnknownNameError
from assur.model.formula import Formula
from assur.model.joint_graph import frames
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]


def point(record: MechanismRecord, name: str, joint_values: FloatArray) -> FloatArray:
    """Position (..., 3) of a lettered point or of a joint, in the base frame, at joint values (..., n).

    >>> from assur.model.registry import load_record
    >>> record = load_record("zeng2019")
    >>> point(record, "B3", np.zeros(17)).tolist()
    [150.0, 0.0, 30.0]
    """
    placed = frames(record, joint_values)
    if name in record.points:
        letter = record.points[name]
        rotation, origin = placed[letter.link]
        return np.asarray(rotation @ letter.at + origin)
    if any(name in (joint.name, joint.alias) for joint in record.joints.values()):
        joint = record.joint(name)
        rotation, origin = placed[joint.parent]
        return np.asarray(rotation @ joint.at + origin)
    raise UnknownNameError(f"point of {record.name}", name, (*record.points, *record.joints))


def quantity(record: MechanismRecord, formula: Formula, joint_values: FloatArray) -> FloatArray:
    """Value (...) of a formula over parameters, joint values (rad or length) and point coordinates like `C1.y`."""
    lookup = {name: _named(record, name, joint_values) for name in formula.names}
    return np.asarray(formula.evaluate(lookup), dtype=float)


def _named(record: MechanismRecord, name: str, joint_values: FloatArray) -> FloatArray:
    if name in record.parameters:
        return np.asarray(record.parameters[name].inside)
    if name in record.angles:
        return joint_values[..., record.angles[name].index]
    letter, _, axis = name.rpartition(".")
    if axis in ("x", "y", "z") and (letter in record.points or letter in record.joints):
        return point(record, letter, joint_values)[..., "xyz".index(axis)]
    for item in record.coordinates:
        if name in (item.joint, f"{item.joint}.{item.component}"):
            return joint_values[..., item.index]
    raise UnknownNameError(f"quantity of {record.name}", name, (*record.points, *record.joints, *record.parameters))
