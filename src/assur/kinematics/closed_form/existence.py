"""Whether a branch exists: the one place where margins of floats are judged against zero."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.status import FACTOR_TOLERANCE, MARGIN_TOLERANCE, scale
from assur.model.closed_form import Margin
from assur.model.mechanism import MechanismRecord

BoolArray = NDArray[np.bool_]


HIGHEST = 4
"""No margin's zero is of a higher order: the square of a product of two lengths."""


def tolerance(record: MechanismRecord, margin: Margin) -> float:
    """Within what a margin is zero, in its own unit.

    A radicand: MARGIN_TOLERANCE of its scale. A quantity at whose zero the formulas degenerate: FACTOR_TOLERANCE
    to the power of its unit, as the factor that vanishes with it, but for what it is multiplied with beyond that.
    """
    share = MARGIN_TOLERANCE if margin.zero == "merge" else FACTOR_TOLERANCE ** min(max(margin.unit, 1), HIGHEST)
    return share * scale(record, margin.scale)


def vanishes(record: MechanismRecord, margin: Margin, value: Any) -> BoolArray:
    """Where a margin (...) is zero within its tolerance."""
    return np.asarray(np.abs(value) <= tolerance(record, margin))


def allows(record: MechanismRecord, margin: Margin, value: Any) -> BoolArray:
    """Where a margin (...) lets its branch exist: not negative, or not zero where the formulas degenerate.

    >>> from assur.model.registry import load_record
    >>> allows(load_record("zeng2019"), Margin("M", "l2*l2", "reach", unit=2), [1.0, 0.0, -1e-3])
    array([ True,  True, False])

    A margin that is no number allows nothing.
    """
    if margin.zero == "degenerate":
        return np.asarray(np.abs(value) > tolerance(record, margin))
    return np.asarray(np.asarray(value) >= -tolerance(record, margin))


def exists(record: MechanismRecord, margins: Sequence[Margin], values: Mapping[str, Any]) -> BoolArray:
    """Where every margin allows the branch; values (...) broadcast against each other."""
    result: Any = True
    for margin in margins:
        result = result & allows(record, margin, values[margin.name])
    return np.asarray(result)
