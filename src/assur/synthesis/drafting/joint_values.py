"""Values of a joint at which its child is turned against its parent in a given way, and the angles that they are of."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from assur.numerics.rotations import about_axis, to_vector
from assur.synthesis.drafting.tables import DraftJoint

FloatArray = NDArray[np.float64]
EXACT = 1e-9
"""Sine below which directions are parallel, and part of a rotation below which there is none."""


def angle_about(axis: FloatArray, start: FloatArray, end: FloatArray) -> float:
    """The angle in rad about an axis from one direction to another, as seen along it."""
    return math.atan2(float(axis @ np.cross(start, end)), float(across(start, axis) @ across(end, axis)))


def across(vector: FloatArray, axis: FloatArray) -> FloatArray:
    """The part of a vector across a unit vector."""
    return np.asarray(vector - (vector @ axis) * axis)


def joint_values(joint: DraftJoint, relative: FloatArray, stroke: float) -> tuple[float, ...] | None:
    """Values, in deg and mm, at which a joint turns its child like this; None where it cannot."""
    if joint.type.ball:
        return tuple(np.degrees(to_vector(relative)).tolist())
    axes = [np.array(axis) for axis in joint.type.directions(joint.axes)]
    angles: list[float] = []
    rest = relative
    for step in joint.type.steps:
        if step.kind == "slide":
            continue
        axis = axes[step.direction]
        last = len(angles) == joint.type.turns - 1
        fixed = _any_across(axis) if last else axes[1]
        angle = angle_about(axis, fixed, rest @ fixed)
        angles.append(angle)
        rest = about_axis(axis, np.array(-angle)) @ rest
    if np.max(np.abs(rest - np.eye(3))) > EXACT or (joint.type.screw and abs(angles[0]) > EXACT):
        return None
    turned = iter(np.degrees(angles).tolist())
    return tuple(stroke if step.kind == "slide" else next(turned) for step in joint.type.steps)


def _any_across(axis: FloatArray) -> FloatArray:
    unit = np.eye(3)[int(np.argmin(np.abs(axis)))]
    return np.asarray(across(unit, axis))
