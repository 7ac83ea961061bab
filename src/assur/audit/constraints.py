"""Which constraint a printed pose breaks: the lengths that it would need beside those that the links have."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.kinematics import border
from assur.kinematics.modes import sign_axes, sign_names
from assur.kinematics.position import inverse
from assur.kinematics.status import closed_form_of
from assur.model.kernel_dimensions import kernel_dimensions
from assur.model.mechanism import MechanismRecord
from assur.numerics.number_types import Floats

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Need:
    """A length that a pose and inputs need (`needed`) where the mechanism has another (`actual`)."""

    name: str
    needed: float
    actual: float


def needs(record: MechanismRecord, pose: FloatArray, inputs: FloatArray) -> tuple[Need, ...]:
    """Every constrained length at a pose (m,) and inputs (n,), for the working signs that need the least change.

    Example: row 1 of Table 1 of Zeng et al. 2019 is no solution (E2).

    >>> from assur.model.registry import load_record
    >>> row, inputs = np.array([64.6353, 175.6965, 370.1818]), np.array([162.6907, -143.3209, -24.6776])
    >>> [f"{need.name} {need.needed:.2f} {need.actual:g}" for need in needs(load_record("zeng2019"), row, inputs)]
    ['B1C1 280.00 280', 'B2C2 365.40 280', 'B3C3 230.00 230']
    """
    form = closed_form_of(record)
    if form.constraints is None:
        return ()
    names = sign_names(record, "inverse")
    branch = form.inverse(
        Floats(), kernel_dimensions(record), border.pose_components(record, pose[None, :]), sign_axes(names)
    )
    components = border.input_components(record, inputs[None, :])
    pairs = form.constraints(Floats(), kernel_dimensions(record), branch.core, components)
    shape = (*(2 for _ in names), 1)
    lengths = {name: np.broadcast_to(pair[0], shape).ravel() for name, pair in pairs.items()}
    fixed = {name: float(np.max(pair[1])) for name, pair in pairs.items()}
    change = np.sum([(lengths[name] - fixed[name]) ** 2 for name in pairs], axis=0)
    best = int(np.argmin(change))
    return tuple(Need(name, float(lengths[name][best]), fixed[name]) for name in pairs)


def broken(
    record: MechanismRecord, pose: FloatArray, inputs: FloatArray, pose_half: FloatArray, inputs_half: FloatArray
) -> str:
    """In words: what a pose at given inputs breaks beyond the half units of their last places; empty if nothing."""
    reasons = [
        f"{failure.meaning} ({failure.quantity} = {failure.value:.4g})" for failure in inverse(record, pose).failures
    ]
    exact = needs(record, pose, inputs)
    slack = np.zeros(len(exact))
    for step_pose, step_inputs in _steps(pose_half, inputs_half):
        shifted = needs(record, pose + step_pose, inputs + step_inputs)
        slack += np.abs([near.needed - need.needed for near, need in zip(shifted, exact, strict=True)])
    lengths = [
        f"|{need.name}| = {need.needed:.2f} instead of {need.actual:g}"
        for need, room in zip(exact, slack, strict=True)
        if abs(need.needed - need.actual) > room
    ]
    return "; ".join([*reasons, *([f"needs {', '.join(lengths)}"] if lengths else [])])


def _steps(pose_half: FloatArray, inputs_half: FloatArray) -> list[tuple[FloatArray, FloatArray]]:
    """Half a unit of each printed number, one at a time."""
    count = len(pose_half)
    return [(step[:count], step[count:]) for step in np.diag(np.concatenate([pose_half, inputs_half]))]
