"""Whether a closed form may be used: built in, or held against its joint graph here or earlier on this machine."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from assur.errors import MechanismFileError, Problem
from assur.kinematics.contract.extent import AT_LOAD, EXTENTS, IN_FULL, Extent
from assur.kinematics.status import closed_form_of
from assur.model.closed_form import ClosedForm
from assur.model.mechanism import MechanismRecord
from assur.model.registry import is_built_in, load_record


def admitted_record(name_or_path: str | Path, /, **overrides: Any) -> MechanismRecord:
    """The record of a mechanism, as `assur.model.registry.load_record`, whose closed form may be used.

    Errors:
        UnknownNameError, UsageError: as `load_record`.
        MechanismFileError: the file has faults, or its closed form does not agree with the joint graph.

    >>> admitted_record("zeng2019", l2=300).values.l2
    300.0
    """
    record = load_record(name_or_path, **overrides)
    check_closed_form(record)
    return record


def check_closed_form(record: MechanismRecord, extent: Extent = AT_LOAD) -> None:
    """Raise `MechanismFileError` where a closed form does not agree with its joint graph.

    A mechanism without one, and one that is built in (its closed form is held to the same laws by the tests of assur),
    pass at once; any other is checked on its first use, and what passed is kept in the user's cache. What holds with
    dimensions changed by chance holds with any; else every choice of dimensions is checked by itself.

    >>> from assur.model.registry import load_record
    >>> check_closed_form(load_record("fivebar"))
    """
    found = closed_form_problems(record, extent)
    if found:
        raise MechanismFileError(found)


def closed_form_problems(
    record: MechanismRecord, extent: Extent = AT_LOAD, *, built_in: bool = False
) -> tuple[Problem, ...]:
    """The faults for which `check_closed_form` refuses a mechanism; what passes is kept.

    Args:
        record: the mechanism.
        extent: how much is looked at; what passed a wider check has passed.
        built_in: whether one that is built in is looked at as well.

    >>> from assur.model.registry import load_record
    >>> closed_form_problems(load_record("fivebar"))
    ()
    """
    trusted = record.closed_form is None or (is_built_in(record) and not built_in)
    if trusted:
        return ()
    from assur.kinematics.contract.kept import SCOPES, has_passed, keep_passed  # for what is not trusted

    if any(has_passed(record, item, scope) for item in EXTENTS[EXTENTS.index(extent) :] for scope in SCOPES):
        return ()
    from assur.kinematics.contract.check import problems  # twenty modules of laws, for what has not passed
    from assur.model.dimensions import of_file

    found, general = problems(of_file(record), extent)
    if not found and not general and record.overrides:
        found, _ = problems(record, extent)
    if not found:
        keep_passed(record, extent, "any" if general else "own")
    return found


def checked_form(record: MechanismRecord, extent: Extent = IN_FULL) -> ClosedForm:
    """The closed form, once it has passed in full: what proofs are made with.

    Errors:
        UsageError: the mechanism has none. MechanismFileError: it does not agree with its joint graph.

    >>> from assur.model.registry import load_record
    >>> checked_form(load_record("fivebar")).complete_for
    'joint_graph'
    """
    form = closed_form_of(record)
    check_closed_form(record, extent)
    return form
