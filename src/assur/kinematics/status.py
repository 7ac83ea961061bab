"""What mathematics answers: the status of a solution, and the one function that turns margins and factors into it.

Zero is judged relative to a scale that the closed form states. A root merges at MARGIN_TOLERANCE of its
radicand; the factor that is this root is then at most the root of that tolerance, hence FACTOR_TOLERANCE.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from enum import IntEnum
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.model.closed_form import Branch, ClosedForm, Eliminant, Margin, PolynomialSystem
from assur.model.formula import parse
from assur.model.mechanism import MechanismRecord

MARGIN_TOLERANCE = 1e-13
"""A radicand within this share of its scale counts as zero: two branches merge."""

FACTOR_TOLERANCE = 4e-7
"""A factor within this share of its scale counts as zero: singular."""

NEAR_SINGULAR = 1e-3
"""A factor within this share of its scale makes a solution near_singular."""

NO_CLOSED_FORM = (
    "proofs over regions need one beside the file (docs/closed-form.md says how it is written); "
    "direct, inverse, singularity, follow, sweeps and workspace without a proof work on the joint graph"
)
"""What to do where a mechanism has none."""

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]


class Status(IntEnum):
    """Status of a solution in order of severity; where several hold, the most severe is reported."""

    regular = 0
    near_singular = 1
    serial = 2
    parallel = 3
    comprehensive = 4
    constraint = 5
    self_motion = 6
    not_closed = 7
    unreachable = 8
    undecided = 9
    no_mechanism = 10


@lru_cache(maxsize=256)
def scale(record: MechanismRecord, formula: str) -> float:
    """Value of a scale formula of the closed form at the record's parameters.

    >>> from assur.model.registry import load_record
    >>> scale(load_record("zeng2019"), "2*l2")
    560.0
    """
    return float(parse(formula).evaluate(vars(record.values)))


def relative_factors(record: MechanismRecord, factors: Mapping[str, FloatArray]) -> dict[str, FloatArray]:
    """Factors divided by their scales: numbers of order one, zero where singular."""
    form = closed_form_of(record)
    return {item.name: factors[item.name] / scale(record, item.scale) for item in form.factor_list}


def classify(record: MechanismRecord, factors: Mapping[str, FloatArray], shape: tuple[int, ...]) -> NDArray[np.int8]:
    """Status (*shape) of existing solutions from the factors of det Jp and det Jq; a mechanism may have none.

    serial: a factor of det Jq vanishes; parallel: one of det Jp; comprehensive: both; constraint: a
    group of factors that lowers the rank of the whole closure; self_motion: a factor that lets the
    platform move with every input locked.
    """
    form = closed_form_of(record)
    size = {name: np.abs(value) for name, value in relative_factors(record, factors).items()}
    zero = {name: value <= FACTOR_TOLERANCE for name, value in size.items()}
    of_kind = {kind: [item.name for item in form.factor_list if item.kind == kind] for kind in ("serial", "parallel")}
    serial, parallel = (_any([zero[name] for name in names], shape) for names in of_kind.values())
    alone = [group[0] for group in form.constraint_singular if len(group) == 1]
    watched = [*of_kind["serial"], *of_kind["parallel"], *alone]
    near = _any([size[name] <= NEAR_SINGULAR for name in watched], shape)
    levels = (
        (Status.near_singular, near),
        (Status.serial, serial),
        (Status.parallel, parallel),
        (Status.comprehensive, serial & parallel),
        (Status.constraint, _any_group(form.constraint_singular, zero, shape)),
        (Status.self_motion, _any_group(form.self_motion_singular, zero, shape)),
    )
    status = np.zeros(shape, dtype=np.int8)
    for level, holds in levels:
        status[holds] = level
    return status


def _any(conditions: Sequence[BoolArray], shape: tuple[int, ...]) -> BoolArray:
    holds = np.zeros(shape, dtype=bool)
    for condition in conditions:
        holds |= condition
    return holds


def _any_group(groups: Sequence[tuple[str, ...]], zero: Mapping[str, BoolArray], shape: tuple[int, ...]) -> BoolArray:
    """Where every factor of at least one group vanishes."""
    return _any([np.logical_and.reduce([zero[name] for name in group]) for group in groups], shape)


def _not_run(record: MechanismRecord) -> str:
    return " that assur can read: the one beside its file is Python, and was not run" * record.closed_form_not_run


def closed_form_of(record: MechanismRecord) -> ClosedForm:
    """The closed form, or a clear refusal where the mechanism has none."""
    if record.closed_form is None:
        raise UsageError(f"{record.name} has no closed form{_not_run(record)}", hint=NO_CLOSED_FORM)
    return record.closed_form


def branch_kernel(record: MechanismRecord) -> Callable[..., Branch]:
    """The kernel of the direct problem by branches of signs, or a clear refusal where the mechanism has none."""
    kernel = closed_form_of(record).direct
    if kernel is None or isinstance(kernel, Eliminant | PolynomialSystem):
        has = "one polynomial" if kernel else "none"
        raise UsageError(f"{record.name} has no closed direct solution by signs (it has {has})")
    return kernel


HIGHEST = 4
"""No margin's zero is of a higher order: the square of a product of two lengths."""


def tolerance(record: MechanismRecord, margin: Margin) -> float:
    """Within what a margin is zero, in its own unit.

    A radicand: MARGIN_TOLERANCE of its scale. A quantity at whose zero the formulas degenerate: FACTOR_TOLERANCE
    to the power of its unit, as the factor that vanishes with it, but for what it is multiplied with beyond that.
    """
    share = MARGIN_TOLERANCE if margin.zero == "merge" else FACTOR_TOLERANCE ** min(max(margin.unit, 1), HIGHEST)
    return share * scale(record, margin.scale)


def vanishes(record: MechanismRecord, margin: Margin, value: Any) -> BoolArray:
    """Where a margin (...) is zero within its tolerance."""
    return np.asarray(np.abs(value) <= tolerance(record, margin))


def allows(record: MechanismRecord, margin: Margin, value: Any) -> BoolArray:
    """Where a margin (...) lets its branch exist: not negative, or not zero where the formulas degenerate.

    >>> from assur.model.registry import load_record
    >>> allows(load_record("zeng2019"), Margin("M", "l2*l2", "reach", unit=2), [1.0, 0.0, -1e-3])
    array([ True,  True, False])

    A margin that is no number allows nothing.
    """
    if margin.zero == "degenerate":
        return np.asarray(np.abs(value) > tolerance(record, margin))
    return np.asarray(np.asarray(value) >= -tolerance(record, margin))


def exists(record: MechanismRecord, margins: Sequence[Margin], values: Mapping[str, Any]) -> BoolArray:
    """Where every margin allows the branch; values (...) broadcast against each other."""
    result: Any = True
    for margin in margins:
        result = result & allows(record, margin, values[margin.name])
    return np.asarray(result)
