"""The first law: every solution closes all loops, at the pose and the inputs that it is for."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.tree import joint_graph
from assur.kinematics import border
from assur.kinematics.answers.at_border import quantity_text
from assur.kinematics.closure import CLOSED, residuals
from assur.kinematics.contract.blame import blamed
from assur.kinematics.contract.mismatch import Mismatch, place_text
from assur.kinematics.contract.solutions import Solutions
from assur.kinematics.pose import pose_error

FloatArray = NDArray[np.float64]

ROUNDING = 1e-13
"""What rounding does where a margin is zero: its root, or a quotient by it, has lost as many digits as it is near."""
ROOTS = 1e-7
"""Gaps of poses from the roots of a polynomial: two that lie near each other have lost half of the digits."""
TOLD = 3
"""So many parts of a closed form are named; one wrong number often spoils several."""


def gap_tolerance(solutions: Solutions) -> FloatArray:
    """The gap (S,) that counts as closed, in length units.

    Where two branches merge the root is known to `lost` alone; counted as zero, it misses by itself as well.
    """
    by_roots = solutions.problem == "direct" and not callable(_kernel(solutions))
    least = ROOTS if by_roots else CLOSED
    lost = ROUNDING / np.maximum(solutions.near, ROUNDING)
    merged = np.char.find(solutions.labels.astype(str), "0") >= 0  # their root counts as zero, though it is `near`
    of_zero = np.where(merged & (not by_roots), np.minimum(solutions.near, lost), 0.0)
    return np.asarray(solutions.size * (least + lost + of_zero))


def _kernel(solutions: Solutions) -> object:
    form = solutions.record.closed_form
    return form.direct if form else None


def gaps(solutions: Solutions) -> FloatArray:
    """Largest gap (S, cut joints), in length units; of joint values that are no numbers, infinite."""
    pairs = residuals(solutions.record, solutions.joints).reshape(len(solutions), -1, 2, 3)
    return np.asarray(np.nan_to_num(np.max(np.linalg.norm(pairs, axis=-1), axis=-1), nan=np.inf))


def open_loops(solutions: Solutions) -> list[Mismatch]:
    """Solutions that do not close the joint graph, by the parts of the closed form that are to blame."""
    if not len(solutions):
        return []
    gap, tolerance = gaps(solutions), gap_tolerance(solutions)
    share = np.max(gap, axis=-1, initial=0.0) / tolerance
    told: dict[tuple[str, str], Mismatch] = {}
    for row in _worst_of_each_mode(share, solutions.labels):
        for part, name in blamed(solutions, row):
            cut = joint_graph(solutions.record).cut[int(np.argmax(gap[row]))]
            text = (
                f"the branch {solutions.labels[row]} of the {solutions.problem} problem does not close at "
                f"{place_text(solutions.record, solutions.problem, solutions.given[row])}: "
                f"a gap of {quantity_text(solutions.record, float(np.max(gap[row])), 'length')} at joint {cut.name}"
            )
            told.setdefault(
                (part, name), Mismatch(part, name, solutions.problem, text, "every branch must close all loops")
            )
        if len(told) >= TOLD:
            break
    named = [item for item in told.values() if item.part != "branch"]
    return named or list(told.values())


def other_questions(solutions: Solutions) -> list[Mismatch]:
    """Solutions whose joint values put the platform elsewhere, or the inputs, than the solution says."""
    if not len(solutions):
        return []
    record, tolerance = solutions.record, gap_tolerance(solutions)
    asked = {"direct": (solutions.poses, solutions.given), "inverse": (solutions.given, solutions.inputs)}[
        solutions.problem
    ]
    length = characteristic_length(record)
    away = pose_error(record, solutions.joints, asked[0], length)
    turned = border.inputs_of(record, solutions.joints) - asked[1]
    angular = np.array([item.coordinate.kind == "angle" for item in record.inputs])
    turned = np.where(angular, length * ((turned + np.pi) % (2 * np.pi) - np.pi), turned)
    mismatches = []
    for what, names, missed in (
        ("coordinate", record.platform.pose, away),
        ("input", tuple(item.name for item in record.inputs), turned),
    ):
        share = np.max(np.abs(missed), axis=-1) / tolerance
        row = int(np.argmax(share))
        if share[row] > 1:
            k = int(np.argmax(np.abs(missed[row])))
            name = names[k] if k < len(names) else "the orientation"
            text = (
                f"{what} {name} is {quantity_text(record, float(np.abs(missed[row, k])), 'length')} off what the joint "
                f"values say, in the {solutions.problem} problem at "
                f"{place_text(record, solutions.problem, solutions.given[row])}"
            )
            hint = "are they in the order of the file, and each of its own joint?"
            mismatches.append(
                Mismatch(
                    "branch",
                    str(solutions.labels[row]),
                    solutions.problem,
                    text,
                    "pose, inputs and joints must agree",
                    hint,
                )
            )
    return mismatches


def _worst_of_each_mode(share: FloatArray, labels: NDArray[np.str_]) -> list[int]:
    """Rows beyond tolerance: of each mode the worst, these by how bad they are."""
    worst: dict[str, int] = {}
    for row in np.argsort(-share, kind="stable"):
        if share[row] > 1:
            worst.setdefault(str(labels[row]), int(row))
    return list(worst.values())
