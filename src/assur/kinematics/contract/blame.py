"""Which part of a closed form makes a branch that does not close: by what the wrong numbers have in common."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import joint_scales
from assur.kinematics.closure import assemble
from assur.kinematics.contract.borders import named_by_signs
from assur.kinematics.contract.kernel import Kernel, recorded
from assur.kinematics.contract.mismatch import Part
from assur.kinematics.contract.solutions import Solutions

FloatArray = NDArray[np.float64]

DIFFERS = 1e-6
"""Joint values further than this (rad, or share of the characteristic length) from an assembly are wrong."""
COMMON = 0.6
"""A margin is to blame where the joints that its signs are in and the wrong ones are this much the same set."""
TINY = 1e-9
"""A radicand below zero by no more than this is one that rounding made so."""
FEW = 1 / 2
"""Where no more than this share of the joints is wrong, these are named."""


def blamed(solutions: Solutions, row: int) -> list[tuple[Part, str]]:
    """Margins, joints, or the branch as a whole, to blame for one solution that does not close."""
    branch: list[tuple[Part, str]] = [("branch", str(solutions.labels[row]))]
    by_signs = named_by_signs(solutions.record, solutions.problem)
    kernel = recorded(solutions.record, solutions.problem) if by_signs else None
    negative = _negative(kernel, solutions, row) if kernel else ""
    if negative:
        return [("margin", negative)]
    wrong = _wrong_joint(solutions, row) or _wrong_joints(solutions, row)
    if not wrong:
        return branch
    margin = _margin(kernel, wrong) if kernel else ""
    if margin:
        return [("margin", margin)]
    if len(wrong) <= FEW * len(solutions.record.joints):
        return [("joint", name) for name in sorted(wrong)]
    return branch


def _wrong_joint(solutions: Solutions, row: int) -> set[str]:
    """The joint that alone has to move for the loops to close; none where none or several do."""
    record, values = solutions.record, solutions.joints[row]
    poses = solutions.given[row] if solutions.problem == "inverse" else None
    closing = set[str]()
    for name in record.joints:
        held = [item.index for item in record.coordinates if item.joint != name]
        if bool(assemble(record, values, held=held, poses=poses, max_steps=20).closed):
            closing.add(name)
    return closing if len(closing) == 1 else set()


def _wrong_joints(solutions: Solutions, row: int) -> set[str]:
    """Joints whose values are not those of the assembly nearest to a solution; none where none is near."""
    record, values = solutions.record, solutions.joints[row]
    if solutions.problem == "inverse":
        right = assemble(record, values, poses=solutions.given[row])
    else:
        right = assemble(record, values, held=record.input_indices)
    if not bool(right.closed):
        right = assemble(record, values)
    if not bool(right.closed):
        return set()
    scale = joint_scales(record)
    change = right.values - values
    angular = np.array([item.kind == "angle" for item in record.coordinates])
    change = np.where(angular, (change + np.pi) % (2 * np.pi) - np.pi, change)
    return {item.joint for item in record.coordinates if abs(change[item.index]) > DIFFERS * scale[item.index]}


def _negative(kernel: Kernel, solutions: Solutions, row: int) -> str:
    """The margin of a radicand that is negative though the branch is listed: what it says is not what it is."""
    with np.errstate(all="ignore"):
        values = kernel.values(solutions.given[[row]], solutions.signs[[row]])
    below = {k for k in kernel.roots if float(values[k][0]) < -TINY * float(np.max(np.abs(values[k]) + 1))}
    if not below:
        return ""
    made = {
        item.name: sum(bool(kernel.needs[k] & below) for k in kernel.outputs["margin"][item.name])
        for item in kernel.margins
    }
    merging = [item.name for item in kernel.margins if item.zero == "merge" and made[item.name]]
    return merging[-1] if merging else ""


def _margin(kernel: Kernel, wrong: set[str]) -> str:
    """The radicand whose root, with its sign, is in just the wrong joints."""
    best, name = COMMON, ""
    for item in kernel.margins:
        source = {kernel.uniform[f"sign.{sign}"] for sign in item.signs if f"sign.{sign}" in kernel.uniform}
        made = {
            joint if joint in kernel.record.joints else joint.rpartition(".")[0]
            for joint, places in kernel.outputs["joint"].items()
            if any(kernel.needs[k] & source for k in places)
        }
        share = len(made & wrong) / len(made | wrong)
        if share > best:
            best, name = share, item.name
    return name
