"""Where a factor vanishes the joint graph must be singular: any other zero would be told as a singularity."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.contract.borders import REGULAR
from assur.kinematics.contract.kernel import Kernel
from assur.kinematics.contract.mismatch import Mismatch, place_text
from assur.kinematics.contract.solutions import Solutions, solutions
from assur.kinematics.rates.motions import general, motions
from assur.kinematics.status import Status, classify, closed_form_of, relative_factors
from assur.model.closed_form import Factor

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]

PAIRS = 6
"""Ways between solutions of one mode at which a factor has opposite signs, for each factor."""
HALVINGS = 60
SAME = 1e-6
"""A factor within this share of its scale is zero too."""


def false_zeros(kernel: Kernel, solutions: Solutions) -> list[Mismatch]:
    """Factors of the determinants that vanish at a regular configuration of the joint graph.

    Args:
        kernel: of the inverse problem.
        solutions: its solutions.
    """
    form = closed_form_of(solutions.record)
    factors = [item for item in form.factor_list if item.kind != "other" and kernel.outputs["factor"][item.name]]
    return [mismatch for item in factors for mismatch in _of_factor(kernel, solutions, item)]


def zeros_of(kernel: Kernel, answer: Solutions, name: str) -> Solutions:
    """Solutions of the inverse problem at which a factor vanishes, on ways between those where its sign differs."""
    (place,) = kernel.outputs["factor"][name]
    plus, minus, signs = _opposite(answer, name)
    for _ in range(HALVINGS if len(plus) else 0):
        middle = (plus + minus) / 2
        positive = (kernel.values(middle, signs)[place] > 0)[:, None]
        plus, minus = np.where(positive, middle, plus), np.where(positive, minus, middle)
    if not len(plus):
        return answer.at(np.zeros(0, dtype=int))
    zeros = solutions(answer.record, "inverse", plus)
    return zeros.at(np.all((zeros.signs == signs[zeros.rows]) | (zeros.signs == 0), axis=-1))


def _of_factor(kernel: Kernel, answer: Solutions, factor: Factor) -> list[Mismatch]:
    record, own = answer.record, zeros_of(kernel, answer, factor.name)
    if not len(own):
        return []
    motion = motions(record, own.joints)
    part = motion.inputs if factor.kind == "parallel" else motion.pose
    least = np.linalg.svd(part, compute_uv=False)[..., part.shape[-2] - 1]
    usual = motion.ranks.closure == int(general(record).closure)
    crossed = np.abs(own.factors[factor.name]) <= _jump(answer, factor.name)
    told = _unnamed(own, factor, usual, crossed) or _unseen(own, factor, (least <= REGULAR) & crossed)
    wrong = np.flatnonzero((least > REGULAR) & usual & crossed)
    if told or not len(wrong):
        return told
    row = int(wrong[0])
    label = {"parallel": "det Jp", "serial": "det Jq"}[factor.kind]
    text = (
        f"it is zero, and {label} with it, in mode {own.labels[row]} at "
        f"{place_text(record, 'inverse', own.given[row])}, where the joint graph is regular "
        f"(smallest singular value {least[row]:.3g})"
    )
    return [Mismatch("factor", factor.name, "inverse", text, "where it is zero the joint graph must be singular")]


def _unnamed(own: Solutions, factor: Factor, usual: BoolArray, crossed: BoolArray) -> list[Mismatch]:
    """Zeros at which the closure loses rank and no group says so, or the other way round."""
    record, form = own.record, closed_form_of(own.record)
    zero = {name: np.abs(value) <= SAME for name, value in relative_factors(record, own.factors).items()}
    groups = [np.logical_and.reduce([zero[name] for name in group]) for group in form.constraint_singular]
    named = np.logical_or.reduce(groups) if groups else np.zeros(len(own), dtype=bool)
    wrong = np.flatnonzero(crossed & (named == usual))
    if not len(wrong):
        return []
    row = int(wrong[0])
    what = "keeps its rank, and constraint_singular says that it loses it" if named[row] else "loses rank"
    place = place_text(record, "inverse", own.given[row])
    text = f"where it is zero the closure {what}: in mode {own.labels[row]} at {place}"
    allowed = "constraint_singular must name where the closure loses rank"
    return [Mismatch("factor", factor.name, "inverse", text, allowed)]


def _unseen(own: Solutions, factor: Factor, singular: BoolArray) -> list[Mismatch]:
    """Zeros, to the last digit of a pose, at which the status is regular: the scale is far less than the factor."""
    status = classify(own.record, own.factors, (len(own),))
    wrong = np.flatnonzero(singular & (status < Status.near_singular))
    if not len(wrong):
        return []
    row = int(wrong[0])
    size = float(relative_factors(own.record, own.factors)[factor.name][row])
    place = place_text(own.record, "inverse", own.given[row])
    text = (
        f"it changes sign in mode {own.labels[row]} at {place}, where it is {size:.3g} of its scale and called regular"
    )
    hint = "is its scale the size that it has?"
    return [Mismatch("factor", factor.name, "inverse", text, "where it is zero the status must be singular", hint)]


def _opposite(solutions: Solutions, name: str) -> tuple[FloatArray, FloatArray, NDArray[np.int8]]:
    """Places (N, m) of one mode at which a factor is positive, others at which it is negative, and the mode's signs."""
    value, pairs = solutions.factors[name], []
    for label in dict.fromkeys(solutions.labels.tolist()):
        own = solutions.labels == label
        plus, minus = np.flatnonzero(own & (value > 0)), np.flatnonzero(own & (value < 0))
        pairs += [(p, m) for p, m in zip(plus[:2], minus[:2], strict=False)]
    chosen = np.array(pairs[:PAIRS], dtype=int).reshape(-1, 2)
    return solutions.given[chosen[:, 0]], solutions.given[chosen[:, 1]], solutions.signs[chosen[:, 0]]


def _jump(solutions: Solutions, name: str) -> float:
    """A value this small is zero; larger where the sign changed over a gap between two parts of a mode."""
    return 1e-9 * float(np.max(np.abs(solutions.factors[name])))
