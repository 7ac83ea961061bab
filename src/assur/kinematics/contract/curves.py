"""The sixth law: a curve of self-motion is one of assemblies with the same inputs."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.kinematics import border
from assur.kinematics.answers.self_motion import self_motion_curves
from assur.kinematics.closed_form.existence import vanishes
from assur.kinematics.closure import characteristic_length, closure_error
from assur.kinematics.contract.kernel import Kernel
from assur.kinematics.contract.mismatch import Mismatch, place_text, quantity_text
from assur.kinematics.contract.solutions import Solutions
from assur.kinematics.contract.undeclared import zeros
from assur.kinematics.status import closed_form_of

FloatArray = NDArray[np.float64]

PLACES = 4
"""Inputs at which the margin of the self-motion vanishes that are looked at."""
POINTS = 9
"""Of each curve, its ends among them."""
OPEN = 1e-6
"""Share of the characteristic length: the margin is zero to its tolerance only, and curves end at a root of zero."""


def broken_curves(kernel: Kernel, found: Solutions) -> list[Mismatch]:
    """Curves of self-motion that do not close the joint graph, or that need other inputs.

    Args:
        kernel: of the direct problem by signs.
        found: its solutions, from which inputs of a self-motion are looked for.
    """
    record, curve = found.record, closed_form_of(found.record).self_motion
    margin = next((item for item in kernel.margins if curve and item.name == curve.margin), None)
    if curve is None or margin is None or not len(found):
        return []
    (place,) = kernel.outputs["margin"][margin.name]
    order = np.argsort(np.abs(found.margins[margin.name]), kind="stable")[: 4 * PLACES]
    given = zeros(kernel, found, place, found.given[order], found.signs[order])
    value = kernel.values(given, found.signs[order])[place]
    given = given[np.asarray(vanishes(record, margin, value))][:PLACES]
    for inputs in given:
        for one in self_motion_curves(record, inputs):
            joints = one.joints(POINTS)
            gap = closure_error(record, joints)
            turned = border.inputs_of(record, joints) - inputs
            angular = np.array([item.coordinate.kind == "angle" for item in record.inputs])
            length = characteristic_length(record)
            turned = np.where(angular, length * ((turned + np.pi) % (2 * np.pi) - np.pi), turned)
            worst = float(np.nan_to_num(np.max([gap, np.max(np.abs(turned), axis=-1)]), nan=np.inf))
            if worst > OPEN * length:
                text = (
                    f"the curve of mode {one.mode or '(one)'} at {place_text(record, 'direct', inputs)} is "
                    f"{quantity_text(record, worst, 'length')} off an assembly with these inputs"
                )
                return [Mismatch("self-motion", "", "direct", text, "every point of a curve must close all loops")]
    return []
