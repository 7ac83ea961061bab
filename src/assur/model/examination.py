"""Every fault of a mechanism's file and of the closed form beside it, told at once."""

from __future__ import annotations

import os
from pathlib import Path

from assur.errors import MechanismFileError, Problem
from assur.model.closed_form_file import disagreements, read_closed_form
from assur.model.file.description import description_text
from assur.model.file.faults import Faults
from assur.model.file.reader import examined
from assur.model.mechanism import MechanismRecord
from assur.model.registry import CLOSED_FORM, file_of
from assur.results.reading import file_text

_TABLES = ("base", "platform", "links", "joints", "parameters", "inputs", "home", "unit", "angle", "repeat")
_LOOPS = tuple((table,) for table in (*_TABLES, "generalised"))
"""What loops are made of: where a fault leaves unknown whether they close and move."""


def examine(name_or_path: str | Path, /) -> tuple[MechanismRecord | None, tuple[Problem, ...]]:
    """Every fault of a mechanism's file and of the closed form beside it, and the record where its loops are known.

    Loops are known where no fault touches what they are made of, so that the joint graph can be looked at as well.

    Errors:
        UnknownNameError, UsageError: as `load_record`.

    Example:
        >>> record, problems = examine("fivebar")
        >>> record.name, problems
        ('fivebar', ())
    """
    path = file_of(name_or_path)
    beside = path.parent / CLOSED_FORM
    try:
        record, faults = examined(description_text(path), path)
    except MechanismFileError as error:
        return None, (*error.problems, *_faults_beside(beside, None, None))
    problems = (*faults.told(), *_faults_beside(beside, record, faults))
    return (record if faults.spares(*_LOOPS) and not faults.more else None), problems


def _faults_beside(path: Path, record: MechanismRecord | None, faults: Faults | None) -> tuple[Problem, ...]:
    """Faults of a closed form; what it claims of a mechanism where that is known."""
    try:
        name = record.name if record else path.parent.name
        form = read_closed_form(path, name, file_text(path)) if os.path.lexists(path) else None
    except MechanismFileError as error:
        return error.problems
    if form is None or record is None or faults is None:
        return ()
    known = {"signs": faults.spares(("modes",)), "scales": faults.spares(("parameters",), ("unit",))}
    if (told := disagreements(record, form, path, **known)) or faults.told():
        return told
    from assur.model.closed_form_answers import answer_faults  # recorders, for what passed so far

    return answer_faults(record, form, path)
