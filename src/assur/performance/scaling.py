"""The Jacobian in one unit: where lengths and angles mix, lengths are divided by a stated characteristic length.

With J = Jp^-1 Jq, a row that is a rate of length and a column of an input that is a length are divided by L:
J_L = diag(1/L or 1) J diag(L or 1). Where all rates of the pose are of one kind, and all inputs too, ratios of the
singular values depend on no L, and J is left as it is; they have a unit then (mm/rad, or none).
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar

from assur.errors import UsageError
from assur.kinematics.closure import characteristic_length
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS, rate_names

FloatArray = NDArray[np.float64]
Length = float | Literal["isotropic"] | None

DECADES = 3.0
"""The isotropic length is looked for within this many powers of ten of the mechanism's own length."""

TRIALS = 61


def is_mixed(record: MechanismRecord) -> bool:
    """Whether lengths and angles mix among the rates of the pose, or among the inputs.

    >>> from assur.model.registry import load_record
    >>> [is_mixed(load_record(name)) for name in ("fivebar", "planar_3rrr")]
    [False, True]
    """
    return len(set(_rates_are_lengths(record))) > 1 or len(set(_inputs_are_lengths(record))) > 1


def factor_unit(record: MechanismRecord, length: float | None) -> str:
    """Unit of a singular value of J: "" where it is a number, else as "mm/rad".

    >>> from assur.model.registry import load_record
    >>> factor_unit(load_record("fivebar"), None), factor_unit(load_record("fivebar"), 100.0)
    ('mm/rad', '')
    """
    if length is not None:
        return ""
    rates, inputs = _rates_are_lengths(record)[0], _inputs_are_lengths(record)[0]
    above, below = record.unit if rates else "rad", record.unit if inputs else "rad"
    return "" if rates == inputs else f"{above}/{below}"


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
        return characteristic_length(record) if is_mixed(record) else None
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


def scaled(record: MechanismRecord, matrices: FloatArray, length: float | None) -> FloatArray:
    """J_L (..., k, n) of J (..., k, n), lengths divided by `length`; unchanged where that is None.

    >>> from assur.model.registry import load_record
    >>> scaled(load_record("fivebar"), np.array([[100.0, 0.0], [0.0, 50.0]]), 100.0).tolist()
    [[1.0, 0.0], [0.0, 0.5]]
    """
    if length is None:
        return matrices
    rows = np.where(_rates_are_lengths(record), 1.0 / length, 1.0)
    columns = np.where(_inputs_are_lengths(record), length, 1.0)
    return np.asarray(rows[:, None] * matrices * columns)


def _rates_are_lengths(record: MechanismRecord) -> list[bool]:
    return [name in LENGTHS for name in rate_names(record.platform.pose)]


def _inputs_are_lengths(record: MechanismRecord) -> list[bool]:
    return [item.coordinate.kind == "length" for item in record.inputs]
