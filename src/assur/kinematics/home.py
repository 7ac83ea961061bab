"""Home: the assembled configuration near the values of the file, followed when dimensions change."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.kinematics.closure import assemble
from assur.kinematics.modes import mode_text
from assur.model.mechanism import MechanismRecord
from assur.model.points import quantity

FloatArray = NDArray[np.float64]


@lru_cache(maxsize=64)
def home_values(record: MechanismRecord) -> FloatArray:
    """Joint values (n,) of the assembled home: the file's values, moved as little as closes every loop.

    Raises `UsageError` where the loops cannot be closed from there, with the gap that remains, or where they
    close in another mode than the file's default.

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
    _refuse_other_modes(record, found.values)
    found.values.flags.writeable = False
    return found.values


def _refuse_other_modes(record: MechanismRecord, values: FloatArray) -> None:
    """Home belongs to the file's default modes; an assembly that has left them is not the mechanism that was drawn."""
    modes = record.modes
    for kind, formulas, default in (
        ("working", modes.working, modes.default_working),
        ("assembly", modes.assembly, modes.default_assembly),
    ):
        found = mode_text([int(np.sign(quantity(record, formula, values))) for formula in formulas.values()])
        if default and found != default:
            raise UsageError(
                f"{record.name}: from home the loops close in the {kind} mode {found}, not in the default {default}",
                hint="change the dimensions in smaller steps, or give another home or default mode in the file",
            )
