"""Home: the assembled configuration near the values of the file, followed when dimensions change."""

from __future__ import annotations

import dataclasses
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.kinematics.closure import Assembly, assemble
from assur.kinematics.modes import mode_text
from assur.model.mechanism import MechanismRecord
from assur.model.points import quantity
from assur.model.registry import with_parameters

FloatArray = NDArray[np.float64]
STEPS = 24


@lru_cache(maxsize=64)
def home_values(record: MechanismRecord) -> FloatArray:
    """Joint values (n,) of the assembled home: the file's values, moved as little as closes every loop.

    Where changed dimensions do not close from there in the file's default modes, home is followed from the
    file's dimensions to the changed ones in steps. Raises `UsageError` where that fails too, with the gap
    that remains or the mode in which the loops close.

    >>> from assur.model.registry import load_record
    >>> record = load_record("zeng2019")
    >>> bool(np.max(np.abs(home_values(record) - record.home)) < 2.0)
    True
    """
    found = assemble(record, record.home)
    if _fault(record, found) and record.overrides:
        found = _followed(record)
    fault = _fault(record, found)
    if fault:
        hint = "these dimensions may have no assembly near home; give another home or default mode in the file"
        raise UsageError(f"{record.name}: {fault}", hint=hint)
    found.values.flags.writeable = False
    return found.values


def _followed(record: MechanismRecord) -> Assembly:
    """Home carried from the file's dimensions to the changed ones, each step starting from the last."""
    original = with_parameters(dataclasses.replace(record, overrides={}))
    found = assemble(original, original.home)
    for share in np.linspace(0.0, 1.0, STEPS + 1)[1:]:
        between = {
            name: _between(original.parameters[name].value, record.parameters[name].value, float(share))
            for name in record.overrides
        }
        found = assemble(with_parameters(original, **between), found.values)
    return found


def _between(start: float, end: float, share: float) -> float:
    """Geometric where both are positive, so that a change of scale is even; else linear."""
    if share == 1.0:
        return end
    return float(start * (end / start) ** share) if start > 0 and end > 0 else start + share * (end - start)


def _fault(record: MechanismRecord, found: Assembly) -> str:
    """What keeps an assembly from being home; empty where nothing does."""
    if not bool(found.closed):
        return f"the loops do not close from home: a gap of {float(found.residual):.3g} {record.unit} remains"
    modes = record.modes
    for kind, formulas, default in (
        ("working", modes.working, modes.default_working),
        ("assembly", modes.assembly, modes.default_assembly),
    ):
        signs = mode_text([int(np.sign(quantity(record, formula, found.values))) for formula in formulas.values()])
        if default and signs != default:
            return f"from home the loops close in the {kind} mode {signs}, not in the default {default}"
    return ""
