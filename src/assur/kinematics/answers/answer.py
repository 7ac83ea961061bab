"""Answers of the position problem: the shapes that `--json` prints and that others rely on."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from assur.kinematics import border
from assur.kinematics.answers.at_border import (
    angle_at_border,
    coordinates_at_border,
    inputs_at_border,
    mechanism_header,
    pose_at_border,
    power,
)
from assur.kinematics.answers.excess import limits_at_border
from assur.kinematics.answers.remarks import angles_remark, doubles
from assur.kinematics.answers.solution import Failure, Solution
from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.following.home_solution import home_solution
from assur.kinematics.limits import limits_stated
from assur.kinematics.naming import sign_meanings
from assur.kinematics.parasitic import all_coordinates, moving
from assur.kinematics.position import modes_at
from assur.kinematics.status import Status
from assur.model.mechanism import MechanismRecord
from assur.results.answers.position import (
    DirectAnswer,
    DoubleSolution,
    InputsSolution,
    InverseAnswer,
    LimbWays,
    NegativeQuantity,
    PoseCurve,
    PoseSolution,
)

if TYPE_CHECKING:
    from assur.kinematics.limbs.solving import LimbSolutions


def answer(solutions: SolutionSet) -> DirectAnswer | InverseAnswer:
    """The answer to one direct or inverse problem; angles in the mechanism's angle unit.

    >>> from assur.kinematics.position import direct
    >>> from assur.model.registry import load_record
    >>> said = answer(direct(load_record("zeng2019"), [162.6907, -143.3209, -24.6776]))
    >>> said.status, said.complete, said.solutions[0].mode
    ('regular', True, '+++')
    """
    found = _all_but_known_modes(solutions)
    if found.of_one_mode and found.status == "unreachable":
        return replace(found, known_modes=modes_at(solutions.record, solutions.problem, solutions.given))
    return found


def _all_but_known_modes(solutions: SolutionSet) -> DirectAnswer | InverseAnswer:
    record = solutions.record
    listed, home = list(solutions), home_solution(solutions)
    shared: dict[str, Any] = {
        **mechanism_header(record),
        "input_names": border.drive_names(record),
        "architecture": _architecture(record),
        "status": Status(int(solutions.overall_status)).name,
        "complete": solutions.complete,
        "complete_for": solutions.complete_for,
        "right": solutions.right,
        "limits_stated": limits_stated(record),
        "doubles": tuple(
            DoubleSolution((listed[a].mode, listed[b].mode), apart)
            for a, b, apart in doubles(record, solutions.joints[solutions.exists])
        ),
        "home_by": home.words,
        "known_modes": (),
        "signs": _signs(solutions),
        "curves": tuple(
            PoseCurve(
                curve.parameter,
                angle_at_border(record, np.array(curve.interval)).tolist(),
                curve.mode,
                pose_at_border(record, curve.poses(9)).tolist(),
            )
            for curve in solutions.curves
        ),
        "failures": missing(record, solutions.failures),
    }
    marked = [(item, _said(record, item, mark)) for item, mark in zip(listed, home.marks, strict=True)]
    if solutions.problem == "direct":
        count = len(record.inputs)
        poses = (
            PoseSolution(
                **said,
                pose=pose_at_border(record, item.pose).tolist(),
                working_mode=item.working_mode,
                following=dict(
                    zip(
                        border.drive_names(record)[count:],
                        inputs_at_border(record, item.inputs).tolist()[count:],
                        strict=True,
                    )
                ),
            )
            for item, said in marked
        )
        return DirectAnswer(**shared, inputs=inputs_at_border(record, solutions.given).tolist(), solutions=tuple(poses))
    inputs = (
        InputsSolution(**said, inputs=inputs_at_border(record, item.inputs).tolist(), assembly_mode=item.assembly_mode)
        for item, said in marked
    )
    return InverseAnswer(
        **shared,
        pose=pose_at_border(record, solutions.given).tolist(),
        solutions=tuple(inputs),
        limbs=tuple(_ways(record, limb) for limb in solutions.limbs),
    )


def _ways(record: MechanismRecord, limb: LimbSolutions) -> LimbWays:
    """The inputs of each way, printed."""
    values = np.full((len(limb.values), len(record.drives)), np.nan)
    own = [k for k, driven in enumerate(record.drives) if driven.coordinate.index in limb.indices]
    for k in own:
        driven = record.drives[k]
        values[:, k] = driven.printed(limb.values[:, limb.indices.index(driven.coordinate.index)])
    names, printed = border.drive_names(record), inputs_at_border(record, values)
    return LimbWays(limb.limb.joints, tuple({names[k]: float(row[k]) for k in own} for row in printed))


def _architecture(record: MechanismRecord) -> str:
    """That a mechanism without closed form is architecturally singular; one with a closed form has regular branches."""
    if record.closed_form is not None:
        return ""
    from assur.kinematics.rates.architecture import architecture_text  # not loaded where it is not asked

    return architecture_text(record)


def _signs(solutions: SolutionSet) -> dict[str, str]:
    """The signs of the modes; on a curve of poses those that name its arcs."""
    form = solutions.record.closed_form
    if solutions.curves and form is not None and form.self_motion is not None:
        return {name: f"{name} > 0" for name in form.self_motion.signs}
    return dict(sign_meanings(solutions.record, solutions.problem))


def missing(record: MechanismRecord, failures: tuple[Failure, ...]) -> tuple[NegativeQuantity, ...]:
    """Why there is no solution, with units."""
    return tuple(
        NegativeQuantity(item.quantity, item.value, power(record.unit, item.unit), item.meaning, item.branches)
        for item in failures
    )


def _said(record: MechanismRecord, solution: Solution, home: bool | None) -> dict[str, Any]:
    return {
        "mode": solution.mode,
        "residual": solution.residual,
        "status": solution.status.name,
        "open_loop": solution.open_loop,
        "limits": limits_at_border(record, solution.within_limits, solution.excesses),
        "angles": angles_remark(record, solution.pose),
        "parasitic": _parasitic(record, solution),
        "home": home,
    }


def _parasitic(record: MechanismRecord, solution: Solution) -> dict[str, float]:
    """Those of the platform's coordinates that the pose leaves out and that move."""
    if not (names := moving(record)):
        return {}
    every = all_coordinates(record, np.array(list(solution.joints.values())))
    return coordinates_at_border(record, {name: float(every[name]) for name in names})
