"""The same mechanism with other dimensions: a closed form must hold there too, where there is a mechanism at all."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from assur.errors import MechanismFileError, UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closure import CLOSED, RANK_GAP
from assur.kinematics.contract.mismatch import Mismatch
from assur.kinematics.home import home_values
from assur.kinematics.rates.motions import motions
from assur.model.dimensions import with_parameters
from assur.model.formula import parse
from assur.model.mechanism import MechanismRecord, Parameter

SHARES = (0.15, 0.03)
"""By how much dimensions are changed at most; by less where nothing closes."""


def changed(record: MechanismRecord, random: np.random.Generator) -> MechanismRecord | None:
    """The mechanism with all dimensions changed, each by chance; None where it has no such neighbour.

    A neighbour closes from home and has as many freedoms: a linkage that moves only by special dimensions has none.

    >>> from assur.model.registry import load_record
    >>> other = changed(load_record("fivebar"), np.random.default_rng(0))
    >>> sorted(other.overrides) == sorted(other.parameters)
    True
    """
    own = [item for item in record.parameters.values() if not item.drawn_only]
    for share in SHARES:
        values = {item.name: _value(record, item, share * random.uniform(-1, 1)) for item in own}
        found = with_dimensions(record, values)
        if found is not None:
            return found
    return None


def unrelated(record: MechanismRecord) -> list[Mismatch]:
    """Relations of dimensions that a closed form states and the file's numbers do not have.

    >>> from assur.model.registry import load_record
    >>> unrelated(load_record("fivebar"))
    []
    """
    form, numbers = record.closed_form, {name: own.inside for name, own in record.parameters.items()}
    gaps = {text: _gap(text, numbers) for text in (form.relations if form else ())}
    allowed = "a relation is <dimension> = <formula of others>, which the file's numbers have"
    return [
        Mismatch("relation", text, "inverse", f"it is off by {gap:.3g}", allowed)
        for text, gap in gaps.items()
        if not gap <= CLOSED * characteristic_length(record)
    ]


def _gap(text: str, numbers: Mapping[str, float]) -> float:
    """By how much a relation is off; NaN where it is none."""
    name, _, formula = text.partition(" = ")
    try:
        return float(abs(parse(formula).evaluate(numbers) - numbers[name]))
    except (KeyError, UsageError, ArithmeticError):
        return float("nan")


def with_dimensions(record: MechanismRecord, values: dict[str, float]) -> MechanismRecord | None:
    """The mechanism with these dimensions; None where it does not close from home with as many freedoms."""
    try:
        found = with_parameters(record, **values)
        ranks = [int(motions(item, home_values(item), RANK_GAP).ranks.closure) for item in (record, found)]
    except (UsageError, MechanismFileError):
        return None
    return found if ranks[0] == ranks[1] else None


def _value(record: MechanismRecord, parameter: Parameter, share: float) -> float:
    """A changed value; what is zero grows to a share of the mechanism's length."""
    if parameter.value:
        return parameter.value * (1 + share)
    return abs(share) * (characteristic_length(record) if parameter.unit == record.unit else 1.0)
