"""Which formulas an answer was made with, in a few letters: what is kept of an unfinished grid is theirs alone."""

from __future__ import annotations

from importlib.metadata import version

from assur.kinematics.closed_form.recorded import recording
from assur.kinematics.closed_form.sweep import ALL_WANTED
from assur.kinematics.modes import Problem
from assur.kinematics.status import closed_form_of
from assur.model.mechanism import MechanismRecord
from assur.numerics.recording.source import digest


def formulas(record: MechanismRecord, problem: Problem) -> dict[str, str]:
    """What answers depend on beside dimensions, mode and grid: the closed form as recorded, and the version of assur.

    Args:
        record: a mechanism with a closed form.
        problem: which one; the direct problem needs a closed form by signs.

    Returns:
        "formulas": a digest of the tapes, of what is made of their numbers, and of the sizes against which zero is
        judged; comments do not count. "version": that of assur.

    >>> from assur.model.registry import load_record
    >>> inverse, direct = (formulas(load_record("fivebar"), problem) for problem in ("inverse", "direct"))
    >>> inverse == formulas(load_record("fivebar"), "inverse"), inverse == direct
    (True, False)
    """
    found = [recording(record, "inverse", ALL_WANTED)]  # a status needs the factors, whichever problem it is of
    if problem == "direct":
        found.append(recording(record, "direct", every=True))
    tapes = [
        (item.tape.operations, item.tape.varying, item.tape.uniform, dict(item.tape.outputs), dict(item.rows))
        for item in found
    ]
    form = closed_form_of(record)
    judged = (form.inverse_margins, form.direct_margins, form.factor_list, record.angle)
    return {"formulas": digest(repr((tapes, judged))), "version": version("assur")}
