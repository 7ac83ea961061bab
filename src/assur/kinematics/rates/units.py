"""Units of J = Jp^-1 Jq: where lengths and angles mix, lengths are divided by a stated characteristic length L.

A row that is a rate of length and a column of an input that is a length are divided by L: J_L = diag(1/L or 1) J
diag(L or 1). Where all rates of the pose are of one kind, and all inputs too, ratios of the singular values depend on
no L, and J is left as it is; they have a unit then (mm/rad, or none).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS, rate_names

FloatArray = NDArray[np.float64]


def is_mixed(record: MechanismRecord) -> bool:
    """Whether lengths and angles mix among the rates of the pose, or among the inputs.

    >>> from assur.model.registry import load_record
    >>> [is_mixed(load_record(name)) for name in ("fivebar", "planar_3rrr")]
    [False, True]
    """
    return len(set(_rates_are_lengths(record))) > 1 or len(set(_inputs_are_lengths(record))) > 1


def unit_length(record: MechanismRecord) -> float | None:
    """What lengths are divided by where nothing else is asked for: the mechanism's own where they mix with angles.

    >>> from assur.model.registry import load_record
    >>> [unit_length(load_record(name)) for name in ("fivebar", "planar_3rrr")]
    [None, 200.0]
    """
    return characteristic_length(record) if is_mixed(record) else None


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


def scaled(record: MechanismRecord, matrices: FloatArray, length: float | None) -> FloatArray:
    """J_L (..., k, n) of J (..., k, n), lengths divided by `length`; unchanged where that is None.

    >>> from assur.model.registry import load_record
    >>> scaled(load_record("fivebar"), np.array([[100.0, 0.0], [0.0, 50.0]]), 100.0).tolist()
    [[1.0, 0.0], [0.0, 0.5]]
    """
    if length is None:
        return matrices
    rows = np.where(_rates_are_lengths(record), 1.0 / length, 1.0)
    columns = np.where(_inputs_are_lengths(record)[: matrices.shape[-1]], length, 1.0)
    return np.asarray(rows[:, None] * matrices * columns)


def _rates_are_lengths(record: MechanismRecord) -> list[bool]:
    return [name in LENGTHS for name in rate_names(record.platform.pose)]


def _inputs_are_lengths(record: MechanismRecord) -> list[bool]:
    return [item.coordinate.kind == "length" for item in record.drives]
