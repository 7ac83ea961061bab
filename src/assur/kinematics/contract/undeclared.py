"""Divisors that vanish and radicands that are negative where nothing says so: numbers that mean nothing are listed.

First by the way they are made (`algebra`); what that leaves in doubt is looked for, so that no right form is refused.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length, joint_scales
from assur.kinematics.closed_form.existence import allows
from assur.kinematics.contract.algebra import Algebra
from assur.kinematics.contract.kernel import Kernel, line_where
from assur.kinematics.contract.mismatch import Mismatch, place_text
from assur.kinematics.contract.solutions import Solutions
from assur.kinematics.status import closed_form_of, scale
from assur.model.pose import LENGTHS

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]

STARTS, STEPS = 48, 60
"""Newton's steps towards a zero, from the solutions that are nearest to one; of a square each halves what is left."""
DIFFERENCE = 1e-6
"""Step of a difference, as a share of the mechanism's length, or in rad."""
LONGEST = 0.2
"""Of a step of Newton's method, the same."""
ZERO = 1e-9
"""A value within this share of what it is usually is zero."""
APART = 1e-5
"""A declared margin or factor within this share of its scale is zero as well: then the status says so."""


def undeclared(kernel: Kernel, found: Solutions) -> list[Mismatch]:
    """What is divided by, or drawn a root of, that is zero or negative at a listed branch.

    Args:
        kernel: of a question that is answered by signs.
        found: its solutions, the more the better.
    """
    if not len(found):
        return []
    known = Algebra(kernel)
    values = kernel.values(found.given, found.signs)
    negative = [_negative(kernel, found, k, values[k]) for k in known.doubtful_radicands()]
    vanishing = [_vanishing(kernel, found, k, values[k]) for k in known.doubtful_divisors()]
    return [item for item in (*negative, *vanishing) if item]


def in_doubt(kernel: Kernel) -> tuple[str, ...]:
    """Divisors and radicands, as formulas, of which it is not known by the way they are made.

    >>> from assur.kinematics.contract.kernel import recorded
    >>> from assur.model.registry import load_record
    >>> in_doubt(recorded(load_record("fivebar"), "inverse"))
    ()
    """
    known = Algebra(kernel)
    return tuple(kernel.text(k) for k in (*known.doubtful_radicands(), *known.doubtful_divisors()))


def _negative(kernel: Kernel, found: Solutions, k: int, values: FloatArray) -> Mismatch | None:
    row = int(np.argmin(values))
    if not values[row] < -ZERO * float(np.max(np.abs(values))):
        return None
    text = (
        f"{kernel.text(k)} is {values[row]:.6g} at {place_text(kernel.record, found.problem, found.given[row])}, where "
        f"the branch {found.labels[row]} of the {found.problem} problem is listed"
    )
    line = line_where(kernel, "root", k, 0)
    return Mismatch("radicand", "", found.problem, text, "a radicand must be a margin, or never negative", line=line)


def _vanishing(kernel: Kernel, found: Solutions, k: int, values: FloatArray) -> Mismatch | None:
    usual = float(np.median(np.abs(values)))
    order = np.argsort(np.abs(values), kind="stable")
    start = np.unique(np.concatenate([order[: STARTS // 2], order[:: max(1, 2 * len(order) // STARTS)]]))
    given, signs = found.given[start], found.signs[start]
    zero = zeros(kernel, found, k, given, signs)
    at = kernel.values(zero, signs)
    unnoticed = (np.abs(at[k]) <= ZERO * usual) & _listed(kernel, at) & ~_declared_zero(kernel, at)
    if not np.any(unnoticed):
        return None
    row = int(np.flatnonzero(unnoticed)[0])
    text = (
        f"{kernel.text(k)} is zero at {place_text(kernel.record, found.problem, zero[row])}, where the branch "
        f"{found.labels[start[row]]} of the {found.problem} problem is listed and no margin or factor vanishes"
    )
    algebra = Algebra(kernel)
    whole = next(divisor for divisor in kernel.divisors if k in algebra.doubts(divisor))
    line = line_where(kernel, "/", whole, 1)
    allowed = "a divisor must be a margin that degenerates, or a factor, or never zero"
    return Mismatch("divisor", "", found.problem, text, allowed, "declare it as a margin that degenerates", line=line)


def zeros(kernel: Kernel, found: Solutions, k: int, given: FloatArray, signs: NDArray[np.int8]) -> FloatArray:
    """Places (N, m) to which Newton's method, for one equation in all coordinates, leads from others."""
    units, entry = _units(found), kernel.entry(k)
    place = entry.tape.outputs["entry"]
    for _ in range(STEPS):
        value, slope = entry.values(given, signs)[place], np.zeros_like(given)
        for j, unit in enumerate(units):
            step = np.zeros_like(units)
            step[j] = DIFFERENCE * unit
            ahead, behind = (entry.values(given + side * step, signs)[place] for side in (1, -1))
            slope[:, j] = (ahead - behind) / (2 * DIFFERENCE)
        with np.errstate(all="ignore"):
            move = -np.nan_to_num(value[:, None] * slope / np.sum(slope**2, axis=-1, keepdims=True))
            size = np.linalg.norm(move, axis=-1, keepdims=True)
            given = given + units * move * np.minimum(1.0, LONGEST / np.maximum(size, 1e-300))
    return given


def _units(found: Solutions) -> FloatArray:
    record, length = found.record, characteristic_length(found.record)
    if found.problem == "direct":
        return joint_scales(record)[list(record.input_indices)]
    return np.array([length if name in LENGTHS else 1.0 for name in record.platform.pose])


def _listed(kernel: Kernel, values: list[FloatArray]) -> BoolArray:
    """Where every margin allows the branch (N,)."""
    result = np.ones(len(values[0]), dtype=bool)
    for item in kernel.margins:
        for k in kernel.outputs["margin"][item.name]:
            result &= allows(kernel.record, item, values[k])
    return result


def _declared_zero(kernel: Kernel, values: list[FloatArray]) -> BoolArray:
    """Where a margin or a factor that is declared is zero (N,)."""
    record, form = kernel.record, closed_form_of(kernel.record)
    result = np.zeros(len(values[0]), dtype=bool)
    for item in kernel.margins:
        power = 2 if item.zero == "merge" else max(item.unit, 1)
        for k in kernel.outputs["margin"][item.name]:
            result |= np.abs(values[k]) <= APART**power * scale(record, item.scale)
    for factor in form.factor_list:
        for k in kernel.outputs["factor"][factor.name]:
            result |= np.abs(values[k]) <= APART * scale(record, factor.scale)
    return result
