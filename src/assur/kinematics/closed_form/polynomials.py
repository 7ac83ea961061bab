"""Direct problems that end in polynomials: one of them, or a system."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.assemblies import ANOTHER, assemblies
from assur.kinematics.closed_form.branches import branches
from assur.kinematics.closed_form.roots import roots_of
from assur.kinematics.closed_form.systems import solutions_of
from assur.kinematics.configurations import places
from assur.kinematics.joint_graph_solutions import JointGraphSolutions
from assur.kinematics.modes import Method
from assur.kinematics.pose import pose_of
from assur.kinematics.status import Status, closed_form_of
from assur.model.closed_form import Eliminant, PolynomialSystem
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]


def polynomial_solutions(
    record: MechanismRecord, kernel: Eliminant | PolynomialSystem, given: FloatArray, only: str, method: Method
) -> SolutionSet:
    """The roots of a polynomial or of a system of them.

    A single problem that the roots of one polynomial leave open goes to the loops in turn, where they do not; what they
    find beside the model of the closed form is left out, as its roots leave it out.
    """
    if isinstance(kernel, PolynomialSystem):
        return solutions_of(record, kernel, given, only)
    if method == "auto" and given.ndim == 1 and not roots_of(record, kernel, given, "").complete:
        found = assemblies(record, "direct", given, only, "loops", crossed=False)
        if found.all_known:
            return _of_model(record, found)
    return roots_of(record, kernel, given, only)


def _of_model(record: MechanismRecord, solutions: JointGraphSolutions) -> JointGraphSolutions:
    """Without assemblies that a reduced closed form leaves out: at their poses it has others, and knows them all."""
    if closed_form_of(record).complete_for == "joint_graph" or not len(solutions.assemblies):
        return solutions
    own = branches(record, "inverse", pose_of(record, solutions.assemblies))
    where, unsure = (
        places(record, solutions.assemblies),
        np.isin(own.overall_status, (Status.not_closed, Status.undecided)),
    )
    kept = np.array([
        open_question or bool(np.any(np.max(np.abs(places(record, joints[real]) - place), axis=1) < ANOTHER))
        for place, joints, real, open_question in zip(where, own.joints, own.exists, unsure, strict=True)
    ], dtype=bool)  # fmt: skip
    if np.all(kept):
        return solutions
    left_out = f"{np.sum(~kept)} beside the model of the closed form left out"
    return replace(solutions, assemblies=solutions.assemblies[kept], reason=f"{solutions.reason}; {left_out}")
