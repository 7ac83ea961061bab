"""What a certificate says of its formulas: whether they close the joint graph exactly, and which factors they have."""

from __future__ import annotations

from typing import Any

from assur.kinematics.contract.exact import inverse_exactness
from assur.kinematics.status import closed_form_of
from assur.model.mechanism import MechanismRecord


def exact_check(record: MechanismRecord) -> dict[str, Any]:
    """The exact check as plain data: nothing but what the verifier finds by itself, and can deny.

    >>> from assur.model.registry import load_record
    >>> exact_check(load_record("fivebar"))["serial"]
    ['arm1', 'arm2']
    """
    factors = closed_form_of(record).factor_list
    own = {kind: [factor.name for factor in factors if factor.kind == kind] for kind in ("parallel", "serial")}
    return {"says": inverse_exactness(record).claim, **own}
