"""What of a closed form does not agree with its joint graph, each part with its line in the file."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from assur.errors import Problem, cut
from assur.kinematics.contract.algebra import Algebra
from assur.kinematics.contract.dimensions import unrelated
from assur.kinematics.contract.exact import exactness
from assur.kinematics.contract.extent import AT_LOAD, Extent
from assur.kinematics.contract.held import at_other_dimensions, at_places, of_declarations, of_formulas
from assur.kinematics.contract.kernel import questions, recorded
from assur.kinematics.contract.lines import line_of
from assur.kinematics.contract.mismatch import Mismatch
from assur.kinematics.contract.undeclared import own_ends
from assur.model.mechanism import MechanismRecord
from assur.model.registry import CLOSED_FORM

LONG = 600


def exact_problems(record: MechanismRecord) -> tuple[Problem, ...]:
    """What of a closed form, built in or not, exact arithmetic denies.

    >>> from assur.model.registry import load_record
    >>> exact_problems(load_record("fivebar"))
    ()
    """
    mismatches = exactness(record).mismatches if record.closed_form else ()
    return tuple(_problem(record, item) for item in mismatches)


def unproved(record: MechanismRecord) -> tuple[str, ...]:
    """Margins by which a reduced model ends branches, and nothing but the model says where.

    >>> from assur.model.registry import load_record
    >>> unproved(load_record("fivebar")), unproved(load_record("h4_robot"))
    ((), ('near',))
    """
    if record.closed_form is None or record.closed_form.complete_for == "joint_graph":
        return ()
    kernels = (recorded(record, question) for question in questions(record))
    return tuple(dict.fromkeys(name for kernel in kernels for name in own_ends(kernel, Algebra(kernel))))


@lru_cache(maxsize=64)
def problems(record: MechanismRecord, extent: Extent = AT_LOAD) -> tuple[tuple[Problem, ...], bool]:
    """What of a closed form does not agree with the joint graph, each part once, with its line in the file.

    The second answer: whether that was seen with other dimensions too, so that it holds with any.

    >>> from assur.model.registry import load_record
    >>> problems(load_record("fivebar"))
    ((), True)
    """
    with np.errstate(all="ignore"):  # of a wrong form any number may come, and laws are not met by what is none
        found, general = unrelated(record) or at_places(record, extent), False
        if not found:
            found, general = at_other_dimensions(record, extent)
        if not found:
            exact = exactness(record, extent.primes)
            found, general = list(exact.mismatches), general and (exact.general or bool(exact.undecided))
        if not found:
            found, declared = of_declarations(record, extent)
            general = general and declared
        if not found and extent.formulas:
            found = of_formulas(record, extent)
    parts = {(item.part, item.name): item for item in reversed(found)}
    return tuple(_problem(record, item) for item in reversed(parts.values())), general


def _problem(record: MechanismRecord, mismatch: Mismatch) -> Problem:
    path = record.file.parent / CLOSED_FORM
    line = mismatch.line or line_of(path, mismatch)
    return Problem(str(path), line, mismatch.title, cut(mismatch.observed, LONG), mismatch.allowed, mismatch.hint)
