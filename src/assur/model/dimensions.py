"""The same mechanism with other dimensions: its file, evaluated anew."""

from __future__ import annotations

import dataclasses
from typing import Any, TypeVar

from assur.errors import MechanismFileError, UsageError
from assur.model.file.build import build
from assur.model.file.faults import Faults
from assur.model.file.parameters import checked_overrides
from assur.model.mechanism import MechanismRecord

Record = TypeVar("Record", bound=MechanismRecord)


def with_parameters(record: Record, /, **overrides: Any) -> Record:
    """The same mechanism with other values of some parameters; those changed before stay changed.

    Errors:
        UnknownNameError: no parameter of that name.
        UsageError: a value that the parameter may not have, or with which the file has a fault.

    Example:
        >>> from assur.model.registry import load_record
        >>> with_parameters(load_record("zeng2019"), l2=300, l7=20).values.l7
        20.0
    """
    checked = checked_overrides(record.name, record.parameters, overrides)
    description = record.description
    if description is None:
        raise UsageError(f"{record.name} was not read from a file, so its parameters cannot be changed")
    faults = Faults(str(record.file), description.source)
    try:
        changed = build(description, {**record.overrides, **checked}, faults)
    except MechanismFileError as error:
        given = ", ".join(f"{name} = {value:g}" for name, value in checked.items())
        problem = error.problems[0]
        place = f"{problem.path}: {problem.given}; {problem.allowed}"
        raise UsageError(f"{record.name} cannot be with {given}: {place}", hint=problem.hint) from None
    parts = {item.name: getattr(changed, item.name) for item in dataclasses.fields(MechanismRecord)}
    same = dataclasses.replace(record, **{**parts, "thickness": record.thickness})
    return same.with_closed_form(record.closed_form, record.closed_form_text, not_run=record.closed_form_not_run)


def of_file(record: MechanismRecord) -> MechanismRecord:
    """The mechanism with the dimensions of its file.

    >>> from assur.model.registry import load_record
    >>> of_file(load_record("fivebar", l1=130)).values.l1 == load_record("fivebar").values.l1
    True
    """
    return with_parameters(dataclasses.replace(record, overrides={})) if record.overrides else record
