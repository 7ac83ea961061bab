"""The law of a polynomial system: every pose solves it, and is what comes back of its solution."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics import border
from assur.kinematics.contract.mismatch import Mismatch, place_text
from assur.kinematics.contract.solutions import Solutions
from assur.kinematics.pose import pose_error
from assur.kinematics.status import closed_form_of
from assur.model.closed_form import PolynomialSystem
from assur.model.kernel_dimensions import kernel_dimensions
from assur.numerics.number_types import Floats

FloatArray = NDArray[np.float64]

UNSOLVED = 1e-9
"""What an equation leaves, as a share of what it is at unknowns that solve nothing."""
AWAY = 1e-7
"""A pose that comes back may be so far off, as a share of the characteristic length."""


def unsolved(solutions: Solutions) -> list[Mismatch]:
    """Equations of the direct problem that the poses of the inverse problem do not solve."""
    record, system = solutions.record, closed_form_of(solutions.record).direct
    if not isinstance(system, PolynomialSystem) or not len(solutions):
        return []
    ns, p = Floats(), kernel_dimensions(record)
    inputs = border.input_components(record, solutions.inputs)
    unknowns = tuple(np.asarray(item, dtype=float) for item in system.lift(ns, p, _pose(solutions)))
    random = np.random.default_rng(0).normal(size=(len(unknowns), len(solutions)))
    others = tuple(np.mean(np.abs(item)) * row for item, row in zip(unknowns, random, strict=True))
    left, usual = (np.array(system.equations(ns, p, inputs, given), dtype=float) for given in (unknowns, others))
    share = np.abs(left) / np.median(np.abs(usual), axis=-1, keepdims=True)
    equation, row = np.unravel_index(int(np.argmax(share)), share.shape)
    place = place_text(record, "direct", solutions.inputs[row])
    if not share[equation, row] <= UNSOLVED:
        text = (
            f"equation {equation + 1} is not zero at a pose that has these inputs, {place}: {left[equation, row]:.3g}"
        )
        return [Mismatch("branch", "", "direct", text, "every pose must solve the system of the direct problem")]
    back = system.back(ns, p, inputs, unknowns).pose
    poses = np.stack([np.broadcast_to(border.scalar(value), (len(solutions),)) for value in back], axis=-1)
    length = characteristic_length(record)
    away = np.max(np.abs(pose_error(record, solutions.joints, poses, length)), axis=-1)
    worst = int(np.argmax(away))
    if not away[worst] <= AWAY * length:
        place = place_text(record, "direct", solutions.inputs[worst])
        text = f"what comes back of the unknowns of a pose is another, {away[worst]:.3g} {record.unit} off, at {place}"
        return [Mismatch("branch", "", "direct", text, "`back` must undo `lift`")]
    return []


def _pose(solutions: Solutions) -> tuple[FloatArray, ...]:
    return border.pose_components(solutions.record, solutions.poses)
