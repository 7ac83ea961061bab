"""How much of what actuators can a motion asks for: largest and mean values, and shares of the limits of the file."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Utilisation:
    """Shares (d,) of each actuator's largest force and speed, of their product as its power; NaN without a limit."""

    force: FloatArray
    speed: FloatArray
    power: FloatArray


def utilisation(record: MechanismRecord, forces: FloatArray, rates: FloatArray) -> Utilisation:
    """Of forces and rates (N, d) of the inputs, in SI units."""
    force, speed = stated(record, "force"), stated(record, "speed")
    return Utilisation(peak(forces) / force, peak(rates) / speed, peak(forces * rates) / (force * speed))


def stated(record: MechanismRecord, name: Literal["force", "speed"]) -> FloatArray:
    """The largest force, or speed, (d,) of each actuator; NaN of one for which the file says none.

    >>> from assur.model.registry import load_record
    >>> stated(load_record("delta_4s"), "force").tolist()
    [120.0, 120.0, 120.0]
    """
    known = [record.machine.actuators.get(record.coordinate_label(item.coordinate)) for item in record.drives]
    return np.array([(getattr(item, name) if item else None) or np.nan for item in known], dtype=float)


def peak(values: FloatArray) -> FloatArray:
    """The largest (d,) of each column (N, d), either way; NaN of no rows."""
    return np.max(np.abs(values), axis=0) if len(values) else np.full(values.shape[1], np.nan)


def rms(times: FloatArray, values: FloatArray) -> FloatArray:
    """The root of the mean square (d,) over times (N,) of values (N, d), which heats a motor; NaN of fewer than two.

    >>> rms(np.array([0.0, 1.0, 4.0]), np.array([[3.0], [3.0], [-3.0]])).tolist()
    [3.0]
    """
    if len(times) < 2:
        return np.full(values.shape[1], np.nan)
    return np.asarray(np.sqrt(np.trapezoid(values**2, times, axis=0) / (times[-1] - times[0])))
