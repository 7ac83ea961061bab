"""The characteristic length that lengths are divided by: the mechanism's own, a given one, or the isotropic one.

How J is divided by it stands in `assur.kinematics.rates.units`.
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar

from assur.errors import UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.rates.units import is_mixed, scaled, unit_length
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
Length = float | Literal["isotropic"] | None

DECADES = 3.0
"""The isotropic length is looked for within this many powers of ten of the mechanism's own length."""

TRIALS = 61


def chosen_length(record: MechanismRecord, length: Length, matrices: FloatArray) -> float | None:
    """The length (in the mechanism's unit) by which lengths are divided; None where nothing is.

    Args:
        record: the mechanism.
        length: a length; "isotropic" for the one at which the mean of 1/cond2(J_L) over the matrices is largest; None
            for the mechanism's own characteristic length where lengths and angles mix, and for none elsewhere.
        matrices: (N, k, n), J in the mechanism's units.

    Errors:
        UsageError: a length that is not positive; "isotropic" where no length changes anything, or nothing is regular.
    """
    if length is None:
        return unit_length(record)
    if length == "isotropic":
        return isotropic_length(record, matrices)
    if isinstance(length, (bool, str)) or not np.isfinite(length) or length <= 0:
        raise UsageError(
            f"characteristic length: {length!r} is not a positive length", hint='or "isotropic", or leave it out'
        )
    return float(length)


def isotropic_length(record: MechanismRecord, matrices: FloatArray) -> float:
    """The length L at which the mean of 1/cond2(J_L) over matrices (N, k, n) is largest, by search over log L.

    At one configuration it is the characteristic length of Angeles: there J_L is as near to isotropy as it gets.
    """
    if not is_mixed(record):
        raise UsageError(f"{record.name}: no length makes its Jacobian more isotropic", hint="its units do not mix")
    regular = matrices[np.all(np.isfinite(matrices), axis=(-1, -2))]
    if not len(regular):
        raise UsageError(f"{record.name}: no isotropic length where no pose is reached and regular")
    own = characteristic_length(record)

    def worse(power: float) -> float:
        values = np.linalg.svd(scaled(record, regular, own * 10.0**power), compute_uv=False)
        return -float(np.mean(values[..., -1] / np.maximum(values[..., 0], np.finfo(float).tiny)))

    trials = np.linspace(-DECADES, DECADES, TRIALS)
    best = int(np.argmin([worse(power) for power in trials]))
    around = (trials[max(best - 1, 0)], trials[min(best + 1, TRIALS - 1)])
    found = minimize_scalar(worse, bounds=around, method="bounded", options={"xatol": 1e-10})
    return float(own * 10.0**found.x)
