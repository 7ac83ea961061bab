"""Closed forms by signs over intervals: every branch exists or does not, with certainty, or its margin is near zero."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
from numpy.typing import NDArray

from assur.kinematics import position
from assur.kinematics.certified.branches import grouped, judged
from assur.kinematics.certified.given import joint_inputs, parameters, pose_meant, pose_numbers
from assur.kinematics.certified.legs import Legs
from assur.kinematics.certified.matching import Candidates, matched
from assur.kinematics.certified.proofs import proofs
from assur.kinematics.certified.result import CertifiedSolutions, ProvedSolution
from assur.kinematics.modes import Problem, mode_text, sign_names, sign_rows
from assur.kinematics.status import branch_kernel, closed_form_of
from assur.model.mechanism import MechanismRecord
from assur.numerics.krawczyk import parts

FloatArray = NDArray[np.float64]
RIGHT = "the closed form, every branch of its roots over intervals"


def direct_by_signs(record: MechanismRecord, inputs: FloatArray) -> CertifiedSolutions:
    """Every pose at printed inputs (n,); each is proved from the legs too, where they have signs."""
    signs, sign = _every(record, "direct")
    kernel, p, given = branch_kernel(record), parameters(record), joint_inputs(record, inputs)
    margins = closed_form_of(record).direct_margins
    branches = judged(record, lambda ns: kernel(ns, p, given, sign), margins, len(signs))
    floats = position.direct(record, inputs)
    names = tuple(mode_text(row) for row in signs.astype(int))
    candidates = Candidates(branches, names, tuple(str(text) for text in floats.other_labels))
    return matched(record, inputs, candidates, proofs(Legs(record, inputs), floats), floats, RIGHT)


def inverse_by_signs(record: MechanismRecord, pose: FloatArray) -> CertifiedSolutions:
    """All inputs at a pose (m,)."""
    signs, sign = _every(record, "inverse")
    form = closed_form_of(record)
    asked = pose_meant(record, pose)
    p, given = parameters(record), pose_numbers(record, parts(asked))
    branches = judged(record, lambda ns: form.inverse(ns, p, given, sign), form.inverse_margins, len(signs))
    others = position.inverse(record, pose).other_labels
    solutions = tuple(
        ProvedSolution(
            pose=asked,
            inputs=branches.inputs[k],
            mode=mode_text(signs[k].astype(int)),
            working_mode=mode_text(signs[k].astype(int)),
            assembly_mode=str(others[k]),
            how="the legs over intervals",
        )
        for k in np.flatnonzero(branches.exists)
    )
    return CertifiedSolutions(
        record, "inverse", pose, solutions, grouped(branches.doubts), True, form.complete_for, RIGHT, branches.by
    )  # fmt: skip


def _every(record: MechanismRecord, problem: Problem) -> tuple[FloatArray, SimpleNamespace]:
    """Signs (K, s) of every branch, and the kernel's argument with an array (K,) per sign."""
    signs = sign_rows(record, problem)
    return signs, SimpleNamespace(**dict(zip(sign_names(record, problem), signs.T, strict=True)))
