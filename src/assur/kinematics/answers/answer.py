"""Answers of the position problem: the shapes that `--json` prints and that others rely on."""

from __future__ import annotations

from typing import Any

import numpy as np

from assur.kinematics import border
from assur.kinematics.answers.at_border import (
    angle_at_border,
    coordinates_at_border,
    inputs_at_border,
    limits_at_border,
    pose_at_border,
    power,
)
from assur.kinematics.answers.remarks import angles_remark, doubles
from assur.kinematics.answers.solution import Failure, Solution
from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.limits import limits_stated
from assur.kinematics.parasitic import all_coordinates, moving
from assur.kinematics.paths.home_solution import home_solution
from assur.kinematics.status import Status
from assur.model.mechanism import MechanismRecord
from assur.results.answers.position import (
    DirectAnswer,
    DoubleSolution,
    InputsSolution,
    InverseAnswer,
    NegativeQuantity,
    PoseCurve,
    PoseSolution,
    WidestGap,
)


def answer(found: SolutionSet) -> DirectAnswer | InverseAnswer:
    """The answer to one direct or inverse problem; angles in the mechanism's angle unit.

    >>> from assur.kinematics.position import direct
    >>> from assur.model.registry import load_record
    >>> said = answer(direct(load_record("zeng2019"), [162.6907, -143.3209, -24.6776]))
    >>> said.status, said.complete, said.solutions[0].mode
    ('regular', True, '+++')
    """
    record = found.record
    listed, home = list(found), home_solution(found)
    shared: dict[str, Any] = {
        "mechanism": record.name,
        "unit": record.unit,
        "angle": record.angle,
        "coordinates": record.platform.pose,
        "input_names": border.input_names(record),
        "status": Status(int(found.overall_status)).name,
        "complete": found.complete,
        "complete_for": found.complete_for,
        "right": found.right,
        "limits_stated": limits_stated(record),
        "doubles": tuple(
            DoubleSolution((listed[a].mode, listed[b].mode), apart)
            for a, b, apart in doubles(record, found.joints[found.exists])
        ),
        "home_by": home.words,
        "curves": tuple(
            PoseCurve(
                curve.parameter,
                angle_at_border(record, np.array(curve.interval)).tolist(),
                curve.mode,
                pose_at_border(record, curve.poses(9)).tolist(),
            )
            for curve in found.curves
        ),
        "failures": missing(record, found.failures),
    }
    marked = [(item, _said(record, item, mark)) for item, mark in zip(listed, home.marks, strict=True)]
    if found.problem == "direct":
        poses = (
            PoseSolution(**said, pose=pose_at_border(record, item.pose).tolist(), working_mode=item.working_mode)
            for item, said in marked
        )
        return DirectAnswer(**shared, inputs=inputs_at_border(record, found.given).tolist(), solutions=tuple(poses))
    inputs = (
        InputsSolution(**said, inputs=inputs_at_border(record, item.inputs).tolist(), assembly_mode=item.assembly_mode)
        for item, said in marked
    )
    return InverseAnswer(**shared, pose=pose_at_border(record, found.given).tolist(), solutions=tuple(inputs))


def missing(record: MechanismRecord, failures: tuple[Failure, ...]) -> tuple[NegativeQuantity, ...]:
    """Why there is no solution, with units."""
    return tuple(
        NegativeQuantity(item.quantity, item.value, power(record.unit, item.unit), item.meaning, item.branches)
        for item in failures
    )


def _said(record: MechanismRecord, item: Solution, home: bool | None) -> dict[str, Any]:
    loop = item.open_loop
    return {
        "mode": item.mode,
        "residual": item.residual,
        "status": item.status.name,
        "open_loop": None if loop is None else WidestGap(loop.loop, loop.joint, loop.gap),
        "limits": limits_at_border(record, item),
        "angles": angles_remark(record, item.pose),
        "parasitic": _parasitic(record, item),
        "home": home,
    }


def _parasitic(record: MechanismRecord, item: Solution) -> dict[str, float]:
    """Those of the platform's coordinates that the pose leaves out and that move."""
    if not (names := moving(record)):
        return {}
    every = all_coordinates(record, np.array(list(item.joints.values())))
    return coordinates_at_border(record, {name: float(every[name]) for name in names})
