"""Home of a mechanism whose dimensions are not its file's: near the file's values, or carried there step by step."""

from __future__ import annotations

import numpy as np

from assur.errors import UsageError
from assur.kinematics.closure import Assembly, assemble, gap_left
from assur.kinematics.named_signs import written_modes
from assur.model.dimensions import of_file, with_parameters
from assur.model.mechanism import MechanismRecord

STEPS = 24
OTHERS_HINT = "write these dimensions into a copy of the file, with a [home] near the assembly that is wanted"


def carried_home(record: MechanismRecord, near: Assembly) -> Assembly:
    """The assembly near the file's values where it is of home's mode, else home carried to the changed dimensions.

    Errors:
        UsageError: that fails too; with the gap that remains or the mode in which the loops close.
    """
    if not _fault(record, near):
        return near
    carried = _carried(record)
    fault = _fault(record, carried)
    if fault:
        raise UsageError(f"{record.name}: {fault}", hint=OTHERS_HINT)
    return carried


def _carried(record: MechanismRecord) -> Assembly:
    """Home carried from the file's dimensions to the changed ones, each step starting from the last."""
    # nothing is held here and home may be far: damped steps, where the follower holds inputs or a pose by Newton's
    original = of_file(record)
    assembly = assemble(original, original.home)
    for share in np.linspace(0.0, 1.0, STEPS + 1)[1:]:
        between = {
            name: _between(original.parameters[name].value, record.parameters[name].value, float(share))
            for name in record.overrides
        }
        assembly = assemble(with_parameters(original, **between), assembly.values)
    return assembly


def _between(start: float, end: float, share: float) -> float:
    """Geometric where both are positive, so that a change of scale is even; else linear."""
    if share == 1.0:
        return end
    return float(start * (end / start) ** share) if start > 0 and end > 0 else start + share * (end - start)


def _fault(record: MechanismRecord, assembly: Assembly) -> str:
    """What keeps an assembly from being the home of the file with other dimensions; empty where nothing does."""
    if not bool(assembly.closed):
        return gap_left(record, assembly)
    original = of_file(record)
    before, now = (
        written_modes(original, assemble(original, original.home).values),
        written_modes(record, assembly.values),
    )
    if now == before:
        return ""
    names = [" ".join(filter(None, pair)) for pair in (now, before)]
    return f"from home the loops close in the mode {names[0]}, not in {names[1]} as before"
