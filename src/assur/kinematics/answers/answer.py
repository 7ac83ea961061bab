"""Answers of the position problem as plain data: the shapes that `--json` prints and that others rely on."""

from __future__ import annotations

from typing import Any

import numpy as np

from assur.kinematics import border
from assur.kinematics.answers.at_border import (
    angle_at_border,
    inputs_at_border,
    limits_at_border,
    pose_at_border,
    power,
)
from assur.kinematics.answers.remarks import angles_remark, doubles
from assur.kinematics.answers.solution import Solution
from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.limits import limits_stated
from assur.kinematics.parasitic import all_coordinates, moving
from assur.kinematics.paths.home_solution import home_solution
from assur.kinematics.status import Status
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle
from assur.results.json_text import plain


def answer(found: SolutionSet) -> dict[str, Any]:
    """The answer to one direct or inverse problem; angles in the mechanism's angle unit.

    >>> from assur.kinematics.position import direct
    >>> from assur.model.registry import load_record
    >>> data = answer(direct(load_record("zeng2019"), [162.6907, -143.3209, -24.6776]))
    >>> data["status"], data["complete"], data["solutions"][0]["mode"]
    ('regular', True, '+++')
    """
    record = found.record
    listed, home = list(found), home_solution(found)
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
        "solutions": [
            {**_solution(record, found, item), "home": mark} for item, mark in zip(listed, home.marks, strict=True)
        ],
        "doubles": [{"modes": [listed[a].mode, listed[b].mode], "apart": apart} for a, b, apart in pairs],
        "home_by": home.words,
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


def _parasitic(record: MechanismRecord, item: Solution) -> dict[str, Any]:
    """Those of the platform's coordinates that the pose leaves out and that move."""
    if not (names := moving(record)):
        return {}
    found = all_coordinates(record, np.array(list(item.joints.values())))
    return {name: plain(angle_at_border(record, found[name]) if is_angle(name) else found[name]) for name in names}
