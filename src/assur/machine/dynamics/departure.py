"""Where a motion leaves what the mechanism can do, and when."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.following.home_mode import home_mode_at
from assur.kinematics.position import inverse
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Departure:
    """Where a motion leaves the workspace or its mode.

    Attributes:
        kind: as of `assur.kinematics.following.path.Stop`.
        time: in s.
        pose: (m,) the last one before, in the mechanism's unit and rad.
        quantity, margin: what goes to zero there, and what it is at that pose; lengths and rad, or without a unit.
        text: all of it as a sentence.
    """

    kind: str
    time: float
    pose: FloatArray
    quantity: str
    margin: float
    text: str


def not_begun(record: MechanismRecord, time: float, pose: FloatArray, mode: str | None) -> Departure:
    """Of a first pose (m,) that the mode does not reach; with what is negative there."""
    if record.closed_form is None and mode in (None, record.modes.default_working):
        reached = home_mode_at(record, pose)
        text = f"the first pose is not reached in home's mode: {reached.words}"
        return Departure(reached.status.name, time, pose, "", np.nan, text)
    failures = inverse(record, pose, mode or record.modes.default_working).failures
    text = "the mode does not reach the first pose"
    if not failures:
        return Departure("unreachable", time, pose, "", np.nan, text)
    first = failures[0]
    said = f"{text}; {first.quantity} is {first.value:.3g}, which is {first.meaning}"
    return Departure("unreachable", time, pose, first.quantity, float(first.value), said)
