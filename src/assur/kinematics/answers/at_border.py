"""Answers of the position problem as plain data: the shapes that `--json` prints and that others rely on."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.kinematics import border
from assur.kinematics.answers.remarks import angles_remark, doubles
from assur.kinematics.answers.solution import Solution
from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.limits import limits_stated
from assur.kinematics.near_home import is_home
from assur.kinematics.parasitic import all_coordinates, moving
from assur.kinematics.status import Status
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle
from assur.results.json_text import plain

FloatArray = NDArray[np.float64]


def answer(found: SolutionSet) -> dict[str, Any]:
    """The answer to one direct or inverse problem; angles in the mechanism's angle unit.

    >>> from assur.kinematics.position import direct
    >>> from assur.model.registry import load_record
    >>> data = answer(direct(load_record("zeng2019"), [162.6907, -143.3209, -24.6776]))
    >>> data["status"], data["complete"], data["solutions"][0]["mode"]
    ('regular', True, '+++')
    """
    record = found.record
    listed = list(found)
    pairs = doubles(record, found.joints[found.exists])
    asked = "inputs" if found.problem == "direct" else "pose"
    to_border = inputs_at_border if found.problem == "direct" else pose_at_border
    return {
        "mechanism": record.name,
        "unit": record.unit,
        "angle": record.angle,
        "coordinates": list(record.platform.pose),
        "input_names": list(border.input_names(record)),
        asked: plain(to_border(record, found.given)),
        "status": Status(int(found.overall_status)).name,
        "complete": found.complete,
        "complete_for": found.complete_for,
        "right": found.right,
        "limits_stated": limits_stated(record),
        "solutions": [_solution(record, found, item) for item in listed],
        "doubles": [{"modes": [listed[a].mode, listed[b].mode], "apart": apart} for a, b, apart in pairs],
        "home": [str(label) for label in found.labels[found.exists][is_home(record, found.joints[found.exists])]],
        "curves": [
            {
                "parameter": curve.parameter,
                "interval": plain(angle_at_border(record, np.array(curve.interval))),
                "mode": curve.mode,
                "poses": plain(pose_at_border(record, curve.poses(9))),
            }
            for curve in found.curves
        ],
        "failures": [
            {
                "quantity": failure.quantity,
                "value": plain(failure.value),
                "unit": power(record.unit, failure.unit),
                "meaning": failure.meaning,
                "branches": failure.branches,
            }
            for failure in found.failures
        ],
    }


def _solution(record: MechanismRecord, found: SolutionSet, item: Solution) -> dict[str, Any]:
    if found.problem == "direct":
        own = {"pose": plain(pose_at_border(record, item.pose))}
        other = {"working_mode": item.working_mode}
    else:
        own = {"inputs": plain(inputs_at_border(record, item.inputs))}
        other = {"assembly_mode": item.assembly_mode}
    return {
        **own,
        "mode": item.mode,
        **other,
        "residual": plain(item.residual),
        "status": item.status.name,
        "open_loop": None if item.open_loop is None else plain(item.open_loop),
        "limits": limits_at_border(record, item),
        "angles": angles_remark(record, item.pose),
        "parasitic": _parasitic(record, item),
    }


def limits_at_border(record: MechanismRecord, item: Solution) -> dict[str, Any]:
    """Whether a solution keeps the limits of the file (None where it states none), and each that it does not keep."""
    outside = []
    for each in item.excesses:
        value, low, high, by = (
            plain(angle_at_border(record, number) if each.angular else number)
            for number in (each.value, each.low, each.high, each.by)
        )
        unit = record.angle if each.angular else record.unit
        outside.append(
            {"limit": each.limit, "joint": each.joint, "value": value, "low": low, "high": high, "by": by, "unit": unit}
        )
    return {"within": item.within_limits, "outside": outside}


def _parasitic(record: MechanismRecord, item: Solution) -> dict[str, Any]:
    """Those of the platform's coordinates that the pose leaves out and that move."""
    if not (names := moving(record)):
        return {}
    found = all_coordinates(record, np.array(list(item.joints.values())))
    return {name: plain(angle_at_border(record, found[name]) if is_angle(name) else found[name]) for name in names}


def angle_at_border(record: MechanismRecord, angle: Any) -> Any:
    """Angles in rad as the mechanism's angle unit."""
    return np.degrees(angle) if record.angle == "deg" else angle


def inputs_at_border(record: MechanismRecord, inputs: Any) -> FloatArray:
    """Inputs (..., n) with angles in the mechanism's angle unit."""
    angular = np.array([item.coordinate.kind == "angle" for item in record.inputs])
    return np.asarray(np.where(angular, angle_at_border(record, np.asarray(inputs)), inputs))


def inputs_from_border(record: MechanismRecord, inputs: Any) -> FloatArray:
    """Inputs (..., n) in rad and lengths, from the mechanism's angle unit."""
    angular = np.array([item.coordinate.kind == "angle" for item in record.inputs])
    factor = np.pi / 180 if record.angle == "deg" else 1.0
    return np.asarray(np.asarray(inputs, dtype=float) * np.where(angular, factor, 1.0))


def pose_at_border(record: MechanismRecord, pose: Any) -> FloatArray:
    """Poses (..., m) with angles in the mechanism's angle unit."""
    angular = np.array([is_angle(name) for name in record.platform.pose])
    return np.asarray(np.where(angular, angle_at_border(record, np.asarray(pose)), pose))


def pose_from_border(record: MechanismRecord, pose: Any) -> FloatArray:
    """Poses (..., m) in rad and lengths, from the mechanism's angle unit."""
    angular = np.array([is_angle(name) for name in record.platform.pose])
    factor = np.pi / 180 if record.angle == "deg" else 1.0
    given = np.asarray(pose, dtype=float)
    theta = np.array([name == "theta" for name in record.platform.pose])
    if given.shape[-1:] == theta.shape and np.any(np.abs(given[..., theta]) * factor > np.pi / 2):
        raise UsageError(f"pose of {record.name}: theta is between -90 and 90 deg", hint="turn phi and psi instead")
    return np.asarray(given * np.where(angular, factor, 1.0))


def power(unit: str, exponent: int) -> str:
    """A unit to a power: "", "mm", "mm^2"."""
    return "" if exponent == 0 else unit if exponent == 1 else f"{unit}^{exponent}"
