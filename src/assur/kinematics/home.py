"""Home: the assembled configuration near the values of the file, followed when dimensions change."""

from __future__ import annotations

import dataclasses
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.errors import MechanismFileError, Problem, UsageError
from assur.joint_graph.points import quantity
from assur.kinematics.closure import Assembly, assemble
from assur.kinematics.modes import mode_text
from assur.model.mechanism import MechanismRecord
from assur.model.registry import with_parameters

FloatArray = NDArray[np.float64]
STEPS = 24
HINT = "these dimensions may have no assembly near home: give a home near one, or other dimensions"
OTHERS_HINT = "write these dimensions into a copy of the file, with a [home] near the assembly that is wanted"


@lru_cache(maxsize=64)
def home_values(record: MechanismRecord) -> FloatArray:
    """Joint values (n,) of the assembled home: the file's values, moved as little as closes every loop.

    Where changed dimensions do not close from there, or close in another mode, home is followed from the
    file's dimensions to the changed ones in steps. Raises `UsageError` (for a file as it stands
    `MechanismFileError`) where that fails too, with the gap that remains or the mode in which the loops close.

    >>> from assur.model.registry import load_record
    >>> record = load_record("zeng2019")
    >>> bool(np.max(np.abs(home_values(record) - record.home)) < 2.0)
    True
    """
    found = assemble(record, record.home)
    if not record.overrides:
        if not bool(found.closed):
            problem = Problem(str(record.file), None, "home", _gap(record, found), "the loops must close", HINT)
            raise MechanismFileError([problem])
    elif _fault(record, found):
        found = _followed(record)
        fault = _fault(record, found)
        if fault:
            raise UsageError(f"{record.name}: {fault}", hint=OTHERS_HINT)
    found.values.flags.writeable = False
    return found.values


def _original(record: MechanismRecord) -> MechanismRecord:
    """The mechanism with the dimensions of its file."""
    return with_parameters(dataclasses.replace(record, overrides={}))


def _followed(record: MechanismRecord) -> Assembly:
    """Home carried from the file's dimensions to the changed ones, each step starting from the last."""
    original = _original(record)
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
    """What keeps an assembly from being the home of the file with other dimensions; empty where nothing does."""
    if not bool(found.closed):
        return _gap(record, found)
    original = _original(record)
    before, now = _modes(original, assemble(original, original.home).values), _modes(record, found.values)
    return "" if now == before else f"from home the loops close in the mode {now}, not in {before} as before"


def _gap(record: MechanismRecord, found: Assembly) -> str:
    return f"the loops do not close from home: a gap of {float(found.residual):.3g} {record.unit} remains"


def _modes(record: MechanismRecord, values: FloatArray) -> str:
    """Working and assembly mode of joint values (n,), by the quantities that the file names."""
    formulas = (record.modes.working, record.modes.assembly)
    signs = [[int(np.sign(quantity(record, item, values))) for item in group.values()] for group in formulas]
    return " ".join(mode_text(row) for row in signs if row)
