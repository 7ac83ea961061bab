"""Lettered points and named quantities of the joint graph: where C1 is, what sin(D1) is."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
from numpy.typing import NDArray

from assur.errors import UnknownNameError
from assur.joint_graph.frames import Frame, frames
from assur.model.formula import Formula
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]


def point(record: MechanismRecord, name: str, joint_values: FloatArray) -> FloatArray:
    """Position (..., 3) of a lettered point or of a joint, in the base frame, at joint values (..., n).

    >>> from assur.model.registry import load_record
    >>> record = load_record("zeng2019")
    >>> point(record, "B3", np.zeros(17)).tolist()
    [150.0, 0.0, 30.0]
    """
    return _placed(record, name, frames(record, joint_values))


def points(record: MechanismRecord, names: Iterable[str], joint_values: FloatArray) -> dict[str, FloatArray]:
    """Positions (..., 3) of several by their names, as `point`; links are placed once for them all."""
    placed = frames(record, joint_values)
    return {name: _placed(record, name, placed) for name in names}


def quantity(record: MechanismRecord, formula: Formula, joint_values: FloatArray) -> FloatArray:
    """Value (...) of a formula over parameters, joint values (rad or length) and point coordinates like `C1.y`."""
    return quantities(record, [formula], joint_values)[0]


def quantities(record: MechanismRecord, formulas: Iterable[Formula], joint_values: FloatArray) -> list[FloatArray]:
    """Values (...) of several formulas at joint values (..., n), as `quantity`; links are placed once for them all.

    >>> from assur.model.formula import parse
    >>> from assur.model.registry import load_record
    >>> [float(value) for value in quantities(load_record("zeng2019"), [parse("B3.x"), parse("B3.z/2")], np.zeros(17))]
    [150.0, 15.0]
    """
    asked = list(formulas)
    placed: dict[str, Frame] = {}
    lookup: dict[str, FloatArray] = {}
    for name in sorted(frozenset[str]().union(*(formula.names for formula in asked))):
        lookup[name] = _named(record, name, joint_values, placed)
    return [np.asarray(formula.evaluate(lookup), dtype=float) for formula in asked]


def _named(record: MechanismRecord, name: str, joint_values: FloatArray, placed: dict[str, Frame]) -> FloatArray:
    """What a name stands for; `placed` is filled when a link is first asked for."""
    if name in record.parameters:
        return np.asarray(record.parameters[name].inside)
    if name in record.angles:
        return joint_values[..., record.angles[name].index]
    letter, _, axis = name.rpartition(".")
    if axis in ("x", "y", "z") and (letter in record.points or letter in record.joints):
        placed.update(placed or frames(record, joint_values))
        return _placed(record, letter, placed)[..., "xyz".index(axis)]
    for item in record.coordinates:
        if name in (item.joint, f"{item.joint}.{item.component}"):
            return joint_values[..., item.index]
    raise UnknownNameError(f"quantity of {record.name}", name, (*record.points, *record.joints, *record.parameters))


def _placed(record: MechanismRecord, name: str, placed: Mapping[str, Frame]) -> FloatArray:
    """Position (..., 3) of a point or a joint on the link that bears it."""
    if name in record.points:
        letter = record.points[name]
        rotation, origin = placed[letter.link]
        return np.asarray(rotation @ letter.at + origin)
    if any(name in (joint.name, joint.alias) for joint in record.joints.values()):
        joint = record.joint(name)
        rotation, origin = placed[joint.parent]
        return np.asarray(rotation @ joint.at + origin)
    raise UnknownNameError(f"point of {record.name}", name, (*record.points, *record.joints))
