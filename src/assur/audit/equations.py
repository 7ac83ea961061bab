"""Printed equations, tried on random assembled configurations of the joint graph."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from assur.audit.configurations import configurations
from assur.audit.reference import Components
from assur.audit.rows import Row
from assur.errors import UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.points import quantity
from assur.kinematics.answers.at_border import power
from assur.model.file.schema import Entry
from assur.model.formula import Formula, parse
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
Letters = Mapping[str, Formula]
RATE = "rate."
STEP = 1e-3
ROUNDING = 1e-8
"""Share of the characteristic length (to the power of the equation's unit) that closing the loops may leave."""


class PrintedEquation(Entry):
    """left = right: formulas of the joint graph; `unit` is the power of the length in both.

    A list of formulas is an equation of vectors. `rate.q` is the time derivative of a quantity q.
    """

    source: str
    printed: str
    left: Components
    right: Components
    unit: int = 1
    erratum: str = ""


def equation_rows(record: MechanismRecord, entry: PrintedEquation, letters: Letters) -> list[Row]:
    """One row: the largest difference of the two sides, over configurations and components."""
    if len(entry.left) != len(entry.right):
        raise UsageError(f"{entry.source}: {len(entry.left)} formulas on the left, {len(entry.right)} on the right")
    sampled = configurations(record)
    gaps = [
        evaluate(record, left, sampled.values, sampled.rates, letters)
        - evaluate(record, right, sampled.values, sampled.rates, letters)
        for left, right in zip(entry.left, entry.right, strict=True)
    ]
    worst = float(max(np.max(np.abs(gap)) for gap in gaps))
    tolerance = ROUNDING * characteristic_length(record) ** entry.unit
    holds = worst <= tolerance
    count = len(sampled.values)
    return [
        Row(
            source=entry.source,
            quantity="left - right",
            printed=entry.printed,
            computed=worst,
            verdict="ok" if holds else "wrong",
            erratum="" if holds else entry.erratum,
            tolerance=tolerance,
            off_by=worst,
            unit=power(record.unit, entry.unit),
            note=f"{'holds on' if holds else 'the largest of'} {count} random configurations of the joint graph",
        )
    ]


def rates_of(record: MechanismRecord, formulas: Sequence[str], values: FloatArray, rates: FloatArray) -> FloatArray:
    """Time derivatives (k,) of quantities of the joint graph at joint values (n,) and rates (n,)."""
    return np.array([evaluate(record, parse(RATE + text), values, rates, {}) for text in formulas])


def evaluate(
    record: MechanismRecord, formula: Formula, values: FloatArray, rates: FloatArray, letters: Letters
) -> FloatArray:
    """Value (...) of a formula over quantities of the joint graph, letters of the source, and their rates.

    Joint values and rates are (..., n); `letters` are the source's definitions.
    """
    lookup = {name: _named(record, name, values, rates, letters) for name in formula.names}
    return np.asarray(formula.evaluate(lookup), dtype=float)


def _named(record: MechanismRecord, name: str, values: FloatArray, rates: FloatArray, letters: Letters) -> FloatArray:
    if name.startswith(RATE):
        inner = name.removeprefix(RATE)
        return _rate(lambda at: _named(record, inner, at, rates, letters), values, rates)
    if name in letters:
        return evaluate(record, letters[name], values, rates, letters)
    return quantity(record, parse(name), values)


def _rate(of: Callable[[FloatArray], FloatArray], values: FloatArray, rates: FloatArray) -> FloatArray:
    """Derivative along the rates by central differences of fourth order."""
    weights: Sequence[tuple[int, float]] = ((1, 8.0), (-1, -8.0), (2, -1.0), (-2, 1.0))
    terms = [weight * of(values + side * STEP * rates) for side, weight in weights]
    return np.asarray(np.sum(terms, axis=0) / (12 * STEP))
