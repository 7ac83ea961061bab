"""The other modes: every set of inputs at home's pose, every pose at each of these inputs, the current one first."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.border import inputs_of
from assur.kinematics.closure import assemble
from assur.kinematics.home import home_values
from assur.kinematics.modes import all_modes, mode_signs, sign_names
from assur.kinematics.paths.following import mode_names
from assur.kinematics.pose import pose_of
from assur.kinematics.position import direct, inverse
from assur.kinematics.search import SAME, places
from assur.kinematics.status import Status
from assur.model.mechanism import MechanismRecord
from assur.topology.joints import SPHERICAL

FloatArray = NDArray[np.float64]


def branches(record: MechanismRecord) -> dict[str, list[dict[str, Any]]]:
    """Assembly modes at home's inputs and working modes at home's pose: label, joint values and status of each.

    Home itself stands first in both, with its joint values as they are; it is called "home" where no solution is it
    (an arc of a self-motion, a crossed parallelogram). Every other working mode has "assembly" too: the assembly modes
    at its own inputs, itself first; it is alone there where the inputs do not hold the platform. Angles are those
    nearest to home's.

    >>> from assur.model.registry import load_record
    >>> found = branches(load_record("fivebar"))
    >>> [len(found["assembly"]), len(found["working"])]
    [2, 4]
    >>> {item["label"]: [pose["label"] for pose in item["assembly"]] for item in found["working"][1:]}
    {'++': ['+', '-'], '+-': ['-', '+'], '--': ['+', '-']}
    """
    home = home_values(record)
    working = _listed(record, home, inverse(record, pose_of(record, home)), "home")
    return {
        "assembly": _listed(record, home, direct(record, inputs_of(record, home)), "home"),
        "working": [working[0], *({**item, "assembly": _assembly(record, home, item)} for item in working[1:])],
    }


def _assembly(record: MechanismRecord, home: FloatArray, item: dict[str, Any]) -> list[dict[str, Any]]:
    """Assembly modes at the inputs of another working mode, itself first."""
    values = np.array(item["values"])
    label = mode_names(record, values)[1] or "this one"
    if item["status"] != "regular":  # the platform moves by itself there, or as good as
        return [{"label": label, "values": item["values"], "status": item["status"]}]
    rows = _listed(record, values, direct(record, inputs_of(record, values)), label)
    return [rows[0], *({**row, "values": unwound(record, np.array(row["values"]), home).tolist()} for row in rows[1:])]


def modes(record: MechanismRecord) -> dict[str, Any]:
    """Names of the signs of working and assembly modes, and every row of signs of a working mode."""
    rows = [list(mode_signs(record, "inverse", text)) for text in all_modes(record, "inverse")]
    return {
        "working": {
            "names": list(sign_names(record, "inverse")),
            "all": rows if sign_names(record, "inverse") else [[]],
            "default": record.modes.default_working,
        },
        "assembly": {"names": list(sign_names(record, "direct"))},
    }


def _listed(record: MechanismRecord, current: FloatArray, found: SolutionSet, name: str) -> list[dict[str, Any]]:
    """Solutions, the current one (n,) first with its values as they are; it has the given name where none is it."""
    values, labels, status = found.joints[found.exists], found.labels[found.exists], found.status[found.exists]
    rows = [
        {"label": str(label), "values": unwound(record, row, current).tolist(), "status": Status(int(kind)).name}
        for label, row, kind in zip(labels, _closed(record, values), status, strict=True)
    ]
    here = np.flatnonzero(_away(record, values, current) <= SAME).tolist() if rows else []
    first = rows.pop(here[0]) if here else {"label": name, "status": "regular"}
    return [{**first, "values": current.tolist()}, *rows]


def _away(record: MechanismRecord, values: FloatArray, current: FloatArray) -> FloatArray:
    """How far configurations (K, n) are from the current one (n,), as `assur.kinematics.near_home` measures it."""
    return np.asarray(np.linalg.norm(places(record, values) - places(record, current[None]), axis=1))


def _closed(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """Joint values (K, n) with their loops closed to the last digits, inputs held."""
    return assemble(record, values, held=record.input_indices, near=True).values if len(values) else values


def unwound(record: MechanismRecord, values: FloatArray, home: FloatArray) -> FloatArray:
    """Joint values (n,) whose angles are within half a turn of home's; rotation vectors of S joints stay.

    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> unwound(record, np.full(5, 7.0), np.zeros(5)).round(4).tolist()
    [0.7168, 0.7168, 0.7168, 0.7168, 0.7168]
    """
    turns = np.array(
        [item.kind == "angle" and record.joints[item.joint].type is not SPHERICAL for item in record.coordinates]
    )
    return np.where(turns, values - 2 * np.pi * np.round((values - home) / (2 * np.pi)), values)
