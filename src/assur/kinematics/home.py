"""Home: the assembled configuration near the values of the file, followed when dimensions change."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.kinematics.closure import assemble
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]


@lru_cache(maxsize=64)
def home_values(record: MechanismRecord) -> FloatArray:
    """Joint values (n,) of the assembled home: the file's values, moved as little as closes every loop.

    Raises `UsageError` where the loops cannot be closed from there, with the gap that remains.

    >>> from assur.model.registry import load_record
    >>> record = load_record("zeng2019")
    >>> bool(np.max(np.abs(home_values(record) - record.home)) < 2.0)
    True
    """
    found = assemble(record, record.home)
    if not bool(found.closed):
        raise UsageError(
            f"{record.name}: the loops do not close from home: "
            f"a gap of {float(found.residual):.3g} {record.unit} remains",
            hint="these dimensions may have no assembly near home; change them in smaller steps or give another home",
        )
    found.values.flags.writeable = False
    return found.values
