"""Whether a closed form may be used: built in, or held against its joint graph here or earlier on this machine."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from assur.errors import MechanismFileError, Problem, cut
from assur.kinematics.contract.dimensions import of_file
from assur.kinematics.contract.exact import exactness
from assur.kinematics.contract.held import (
    AT_LOAD,
    EXTENTS,
    IN_FULL,
    Extent,
    at_other_dimensions,
    at_places,
    of_formulas,
)
from assur.kinematics.contract.kept import SCOPES, has_passed, keep_passed
from assur.kinematics.contract.kernel import questions, recorded
from assur.kinematics.contract.lines import line_of
from assur.kinematics.contract.mismatch import Mismatch
from assur.kinematics.contract.undeclared import in_doubt
from assur.kinematics.status import closed_form_of
from assur.model.closed_form import ClosedForm
from assur.model.mechanism import MechanismRecord
from assur.model.registry import CLOSED_FORM, is_built_in

LONG = 600


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
    wider = EXTENTS[EXTENTS.index(extent) :]
    if trusted or any(has_passed(record, item, scope) for item in wider for scope in SCOPES):
        return ()
    found, general = problems(of_file(record), extent)
    if not found and not general and record.overrides:
        found, _ = problems(record, extent)
    if not found:
        keep_passed(record, extent, "any" if general else "own")
    return found


def exact_problems(record: MechanismRecord) -> tuple[Problem, ...]:
    """What of a closed form, built in or not, exact arithmetic denies.

    >>> from assur.model.registry import load_record
    >>> exact_problems(load_record("fivebar"))
    ()
    """
    mismatches = exactness(record).mismatches if record.closed_form else ()
    return tuple(_problem(record, item) for item in mismatches)


def unproved(record: MechanismRecord) -> tuple[str, ...]:
    """Divisors and radicands of which the way they are made does not show that they mean something.

    >>> from assur.model.registry import load_record
    >>> unproved(load_record("fivebar"))
    ()
    """
    return tuple(dict.fromkeys(text for question in questions(record) for text in in_doubt(recorded(record, question))))


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


@lru_cache(maxsize=64)
def problems(record: MechanismRecord, extent: Extent = AT_LOAD) -> tuple[tuple[Problem, ...], bool]:
    """What of a closed form does not agree with the joint graph, each part once, with its line in the file.

    The second answer: whether that was seen with other dimensions too, so that it holds with any.

    >>> from assur.model.registry import load_record
    >>> problems(load_record("fivebar"))
    ((), True)
    """
    with np.errstate(all="ignore"):  # of a wrong form any number may come, and laws are not met by what is none
        found, general = at_places(record, extent), False
        if not found:
            found, general = at_other_dimensions(record, extent)
        if not found:
            exact = exactness(record)
            found, general = list(exact.mismatches), general and (exact.general or bool(exact.undecided))
        if not found and extent.formulas:
            found = of_formulas(record, extent)
    parts = {(item.part, item.name): item for item in reversed(found)}
    return tuple(_problem(record, item) for item in reversed(parts.values())), general


def _problem(record: MechanismRecord, mismatch: Mismatch) -> Problem:
    path = record.file.parent / CLOSED_FORM
    line = mismatch.line or line_of(path, mismatch)
    return Problem(str(path), line, mismatch.title, cut(mismatch.found, LONG), mismatch.allowed, mismatch.hint)
