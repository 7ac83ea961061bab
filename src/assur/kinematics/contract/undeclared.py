"""The law of declarations: radicands are margins, divisors margins that degenerate or factors, margins nothing else.

What is known by the way an entry is made, and by exact arithmetic, says `algebra`; of the rest it is told where it does
harm, or nearly does.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length, joint_scales
from assur.kinematics.contract.algebra import Algebra
from assur.kinematics.contract.kernel import Kernel, line_where
from assur.kinematics.contract.mismatch import Mismatch, place_text
from assur.kinematics.contract.solutions import Solutions
from assur.kinematics.modes import Problem
from assur.kinematics.status import allows, closed_form_of, scale
from assur.model.closed_form import Margin
from assur.model.pose import LENGTHS

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]

STARTS, STEPS = 48, 60
"""Newton's steps towards a zero, from the solutions that are nearest to one; of a square each halves what is left."""
DIFFERENCE = 1e-6
"""Step of a difference, as a share of the mechanism's length, or in rad."""
LONGEST = 0.2
"""Of a step of Newton's method, the same."""
RADICAND = "a radicand must be a margin, or a positive multiple of one, or never negative by the way it is made"
DIVISOR = "a divisor must be a margin that degenerates, or a factor, or never zero by the way it is made"
ALLOWED = {
    "degenerate": "a margin that degenerates must be a multiple of powers of divisors and factors, exactly",
    "signed": "a margin of a sign must be a positive multiple of the square of what its sign is the sign of, exactly, "
    "with other margins of that sign divided out",
    "unsigned": "a margin without signs leaves assemblies out: only a form that is complete for a reduced model may",
}
ALIKE = 0.1
"""What differs by this share, at more than half of the places, is something else."""
ZERO = 1e-9
"""A value within this share of what it is usually is zero."""
APART = 1e-5
"""A declared margin or factor within this share of its scale is zero as well: then the status says so."""


def is_declared(kernel: Kernel, known: Algebra) -> bool:
    """Whether nothing is left to be told.

    >>> from assur.kinematics.contract.kernel import recorded
    >>> from assur.model.registry import load_record
    >>> kernel = recorded(load_record("fivebar"), "inverse")
    >>> is_declared(kernel, Algebra(kernel))
    True
    """
    margins = [item for item in known.untied() if not _is_own_end(kernel, item)]
    return not (margins or known.doubtful_radicands() or known.doubtful_divisors())


def undeclared(kernel: Kernel, known: Algebra, solutions: Solutions | None = None) -> list[Mismatch]:
    """Margins that are nothing else of the kernel; radicands and divisors that are not declared.

    Args:
        kernel: of a question.
        known: of its entries.
        solutions: solutions, the more the better, of a question that is answered by signs.
    """
    margins = [_untied(kernel, known, item, solutions) for item in known.untied() if not _is_own_end(kernel, item)]
    radicands = [_negative(kernel, k, solutions) for k in known.doubtful_radicands()]
    divisors = [_vanishing(kernel, known, k, solutions) for k in known.doubtful_divisors()]
    return [*margins, *radicands, *divisors]


def own_ends(kernel: Kernel, known: Algebra) -> tuple[str, ...]:
    """Margins by which a reduced model ends branches where it likes.

    >>> from assur.kinematics.contract.kernel import recorded
    >>> from assur.model.registry import load_record
    >>> kernel = recorded(load_record("h4_robot"), "direct")
    >>> own_ends(kernel, Algebra(kernel))
    ('near',)
    """
    return tuple(item.name for item in known.untied() if _is_own_end(kernel, item))


def _is_own_end(kernel: Kernel, claimed: Margin) -> bool:
    """Whether a margin may be what it likes: without signs, of a model that is said to leave assemblies out."""
    reduced = closed_form_of(kernel.record).complete_for == "reduced"
    return reduced and claimed.zero == "merge" and not claimed.signs


def _problem(kernel: Kernel) -> Problem:
    return "inverse" if kernel.question == "inverse" else "direct"


def _untied(kernel: Kernel, known: Algebra, claimed: Margin, solutions: Solutions | None) -> Mismatch:
    """A margin, and what comes nearest to it: where the two differ most, in units of what they usually are."""
    places = known.margin(claimed)
    text = kernel.text(places[0]) if places else "a plain number"
    if places and solutions is not None and len(solutions):
        text += _beside(kernel, solutions, places[0], known.near(claimed))
    kind = "degenerate" if claimed.zero == "degenerate" else "signed" if claimed.signs else "unsigned"
    return Mismatch("margin", claimed.name, _problem(kernel), text, ALLOWED[kind])


def _beside(kernel: Kernel, solutions: Solutions, own: int, near: int | None) -> str:
    """What a margin is at a solution, and what it should be if it were a multiple of another entry."""
    values = kernel.values(solutions.given, solutions.signs)
    share = values[own] / values[near] if near is not None else np.full(len(solutions), np.nan)
    usual = float(np.nanmedian(share))
    expected = usual * values[near] if near is not None else values[own]
    apart = np.nan_to_num(np.abs(values[own] - expected))
    row = int(np.argmax(apart))
    text = f" is {values[own][row]:.6g} at {place_text(kernel.record, solutions.problem, solutions.given[row])}"
    if near is None or not np.nanmean(np.abs(share - usual) <= ALIKE * abs(usual)) > 1 / 2:
        return text
    size = f"{apart[row]:.3g}" if apart[row] > ZERO * abs(expected[row]) else "less than floats tell"
    return f"{text}, off {kernel.text(near)}, times {usual:.6g}, by {size}, and by exact arithmetic no multiple of it"


def _negative(kernel: Kernel, k: int, solutions: Solutions | None) -> Mismatch:
    """Where a radicand is least."""
    text, line = f"{kernel.text(k)} is not declared", line_where(kernel, "root", k, 0)
    if solutions is not None and len(solutions):
        values = kernel.values(solutions.given, solutions.signs)[k]
        row = int(np.argmin(np.nan_to_num(values, nan=np.inf)))
        text = (
            f"{kernel.text(k)} is {values[row]:.6g} at "
            f"{place_text(kernel.record, solutions.problem, solutions.given[row])}, "
            f"where the branch {solutions.labels[row]} of the {solutions.problem} problem is listed"
        )
    return Mismatch("radicand", "", _problem(kernel), text, RADICAND, "declare it as a margin", line=line)


def _vanishing(kernel: Kernel, known: Algebra, k: int, solutions: Solutions | None) -> Mismatch:
    """Where a divisor is zero unnoticed, else where it is nearest to it."""
    text = f"{kernel.text(k)} is not declared"
    if solutions is not None and len(solutions):
        text = _zero(kernel, solutions, k) or _smallest(kernel, solutions, k)
    whole = next(divisor for divisor in kernel.divisors if k in known.doubts(divisor))
    line = line_where(kernel, "/", whole, 1)
    hint = "declare it as a margin that degenerates, or write it as a sum of squares"
    return Mismatch("divisor", "", _problem(kernel), text, DIVISOR, hint, line=line)


def _zero(kernel: Kernel, solutions: Solutions, k: int) -> str:
    values = kernel.values(solutions.given, solutions.signs)[k]
    usual = float(np.median(np.abs(values)))
    order = np.argsort(np.abs(values), kind="stable")
    start = np.unique(np.concatenate([order[: STARTS // 2], order[:: max(1, 2 * len(order) // STARTS)]]))
    signs = solutions.signs[start]
    zero = zeros(kernel, solutions, k, solutions.given[start], signs)
    at = kernel.values(zero, signs)
    unnoticed = (np.abs(at[k]) <= ZERO * usual) & _listed(kernel, at) & ~_declared_zero(kernel, at)
    if not np.any(unnoticed):
        return ""
    row = int(np.flatnonzero(unnoticed)[0])
    return (
        f"{kernel.text(k)} is zero at {place_text(kernel.record, solutions.problem, zero[row])}, where the branch "
        f"{solutions.labels[start[row]]} of the {solutions.problem} problem is listed and no margin or factor vanishes"
    )


def _smallest(kernel: Kernel, solutions: Solutions, k: int) -> str:
    values = kernel.values(solutions.given, solutions.signs)[k]
    row = int(np.argmin(np.nan_to_num(np.abs(values), nan=np.inf)))
    place = place_text(kernel.record, solutions.problem, solutions.given[row])
    return f"{kernel.text(k)} is {values[row]:.6g} at {place}, and nothing says that it is zero nowhere"


def zeros(kernel: Kernel, solutions: Solutions, k: int, given: FloatArray, signs: NDArray[np.int8]) -> FloatArray:
    """Places (N, m) to which Newton's method, for one equation in all coordinates, leads from others."""
    units, entry = _units(solutions), kernel.entry(k)
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


def _units(solutions: Solutions) -> FloatArray:
    record, length = solutions.record, characteristic_length(solutions.record)
    if solutions.problem == "direct":
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
