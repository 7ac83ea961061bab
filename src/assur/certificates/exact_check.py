"""What a certificate records of the exact check: what of its formulas holds on the joint graph, and how surely."""

from __future__ import annotations

from typing import Any

from assur.kinematics.contract.exact import exactness
from assur.kinematics.status import closed_form_of
from assur.model.mechanism import MechanismRecord

CHECKED = ("loops", "platform", "inputs", "velocities", "determinants", "equations of the direct problem")


def exact_check(record: MechanismRecord) -> dict[str, Any]:
    """The exact check as plain data; floats are in hex, primes are decimals.

    >>> from assur.model.registry import load_record
    >>> found = exact_check(load_record("fivebar"))
    >>> found["says"], found["serial"]
    ('the formulas close the joint graph: exact, error < 1e-15', ['arm1', 'arm2'])
    """
    exact = exactness(record)
    factors = closed_form_of(record).factor_list
    return {
        "says": exact.text,
        "proved": exact.proved,
        "any_dimensions": exact.general,
        "guards_left_out": exact.guarded,
        "checked": list(CHECKED) if exact.proved else [],
        "primes": [str(p) for p in exact.primes],
        "places": exact.places,
        "degree": float(exact.degree).hex(),
        "error": (exact.error if exact.proved else 1.0).hex(),
        **{kind: [item.name for item in factors if item.kind == kind] for kind in ("parallel", "serial")},
    }
