"""The sixth law: a curve of self-motion is one of assemblies with the same inputs."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics import border
from assur.kinematics.answers.at_border import quantity_text
from assur.kinematics.answers.self_motion import self_motion_curves
from assur.kinematics.closed_form.branches import Branches
from assur.kinematics.closure import closure_error
from assur.kinematics.contract.kernel import Kernel
from assur.kinematics.contract.mismatch import Mismatch, place_text
from assur.kinematics.contract.solutions import Solutions
from assur.kinematics.contract.undeclared import zeros
from assur.kinematics.pose import pose_error
from assur.kinematics.position import direct
from assur.kinematics.status import closed_form_of, vanishes
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]

PLACES = 4
"""Inputs at which the margin of the self-motion vanishes that are looked at."""
POINTS = 9
"""Of each curve, its ends among them."""
FINE, NEAR = 400, 0.02
"""Points of a curve, and how near (a share of the characteristic length) one of them is to any pose on it."""
OPEN = 1e-6
"""Share of the characteristic length: the margin is zero to its tolerance only, and curves end at a root of zero."""


def broken_curves(kernel: Kernel, solutions: Solutions) -> list[Mismatch]:
    """Curves of self-motion that do not close the joint graph, or that need other inputs.

    Args:
        kernel: of the direct problem by signs.
        solutions: its solutions, from which inputs of a self-motion are looked for.
    """
    record, curve = solutions.record, closed_form_of(solutions.record).self_motion
    margin = next((item for item in kernel.margins if curve and item.name == curve.margin), None)
    if curve is None or margin is None or not len(solutions):
        return []
    (place,) = kernel.outputs["margin"][margin.name]
    order = np.argsort(np.abs(solutions.margins[margin.name]), kind="stable")[: 4 * PLACES]
    given = zeros(kernel, solutions, place, solutions.given[order], solutions.signs[order])
    value = kernel.values(given, solutions.signs[order])[place]
    given = given[np.asarray(vanishes(record, margin, value))][:PLACES]
    return next((broken for inputs in given for broken in _at(record, inputs)), [])


def _at(record: MechanismRecord, inputs: FloatArray) -> Iterator[list[Mismatch]]:
    """What is wrong with the curves at inputs (n,)."""
    length = characteristic_length(record)
    angular = np.array([item.coordinate.kind == "angle" for item in record.inputs])
    for one in self_motion_curves(record, inputs):
        joints = one.joints(POINTS)
        turned = border.inputs_of(record, joints) - inputs
        turned = np.where(angular, length * ((turned + np.pi) % (2 * np.pi) - np.pi), turned)
        moved = pose_error(record, joints, one.poses(POINTS), length)
        misses = (closure_error(record, joints), np.abs(turned), np.abs(moved))
        worst = float(np.nan_to_num(max(float(np.max(item)) for item in misses), nan=np.inf))
        if worst > OPEN * length:
            text = (
                f"the curve of mode {one.mode or '(one)'} at {place_text(record, 'direct', inputs)} is "
                f"{quantity_text(record, worst, 'length')} off an assembly with these inputs at the poses that it says"
            )
            yield [Mismatch("self-motion", "", "direct", text, "every point of a curve must close all loops")]


def lacking_curves(solutions: Solutions) -> list[Mismatch]:
    """Poses of the inverse problem whose inputs leave the platform free to move, and that lie on no curve."""
    record, form = solutions.record, closed_form_of(solutions.record)
    name = form.self_motion.margin if form.self_motion else ""
    margin = next((item for item in form.direct_margins if item.name == name), None)
    if margin is None or not len(solutions):
        return []
    found = direct(record, solutions.inputs, method="closed form")
    if not isinstance(found, Branches):
        return []
    free = np.all(vanishes(record, margin, found.margins[margin.name]), axis=-1)
    for row in np.flatnonzero(free)[:PLACES]:
        curves = self_motion_curves(record, solutions.inputs[row])
        poses = np.concatenate([np.zeros((0, solutions.poses.shape[-1])), *(curve.poses(FINE) for curve in curves)])
        joints = np.broadcast_to(solutions.joints[row], (len(poses), solutions.joints.shape[-1]))
        length = characteristic_length(record)
        away = np.max(np.abs(pose_error(record, joints, poses, length)), axis=-1, initial=0.0)
        if not len(poses) or np.min(away) > NEAR * length:
            text = (
                "a pose with inputs at which the platform moves, "
                f"{place_text(record, 'inverse', solutions.poses[row])} at "
                f"{place_text(record, 'direct', solutions.inputs[row])}, lies on none of {len(curves)} curves"
            )
            return [Mismatch("self-motion", "", "direct", text, "the curves must hold every pose with these inputs")]
    return []
