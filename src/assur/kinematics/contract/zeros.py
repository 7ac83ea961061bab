"""Where a factor vanishes the joint graph must be singular: any other zero would be told as a singularity."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.closure import RANK_GAP
from assur.kinematics.contract.borders import REGULAR
from assur.kinematics.contract.kernel import Kernel
from assur.kinematics.contract.mismatch import Mismatch, place_text
from assur.kinematics.contract.solutions import Solutions, solutions
from assur.kinematics.rates.motions import motions
from assur.kinematics.status import closed_form_of
from assur.model.closed_form import Factor

FloatArray = NDArray[np.float64]

PAIRS = 6
"""Ways between solutions of one mode at which a factor has opposite signs, for each factor."""
HALVINGS = 60


def false_zeros(kernel: Kernel, found: Solutions) -> list[Mismatch]:
    """Factors of the determinants that vanish at a regular configuration of the joint graph.

    Args:
        kernel: of the inverse problem.
        found: its solutions.
    """
    form = closed_form_of(found.record)
    factors = [item for item in form.factor_list if item.kind != "other" and kernel.outputs["factor"][item.name]]
    return [mismatch for item in factors for mismatch in _of_factor(kernel, found, item)]


def _of_factor(kernel: Kernel, found: Solutions, factor: Factor) -> list[Mismatch]:
    record, (place,) = found.record, kernel.outputs["factor"][factor.name]
    plus, minus, signs = _opposite(found, factor.name)
    for _ in range(HALVINGS if len(plus) else 0):
        middle = (plus + minus) / 2
        positive = (kernel.values(middle, signs)[place] > 0)[:, None]
        plus, minus = np.where(positive, middle, plus), np.where(positive, minus, middle)
    if not len(plus):
        return []
    zeros = solutions(record, "inverse", plus)
    own = zeros.at(np.all((zeros.signs == signs[zeros.rows]) | (zeros.signs == 0), axis=-1))
    if not len(own):
        return []
    motion = motions(record, own.joints, RANK_GAP)
    part = motion.inputs if factor.kind == "parallel" else motion.pose
    least = np.linalg.svd(part, compute_uv=False)[..., part.shape[-2] - 1]
    usual = motion.ranks.closure == int(motions(record, found.spread(8).joints, RANK_GAP).ranks.closure.max())
    crossed = np.abs(own.factors[factor.name]) <= _jump(found, factor.name)
    wrong = np.flatnonzero((least > REGULAR) & usual & crossed)
    if not len(wrong):
        return []
    row = int(wrong[0])
    label = {"parallel": "det Jp", "serial": "det Jq"}[factor.kind]
    text = (
        f"it is zero, and {label} with it, in mode {own.labels[row]} at "
        f"{place_text(record, 'inverse', own.given[row])}, where the joint graph is regular "
        f"(smallest singular value {least[row]:.3g})"
    )
    return [Mismatch("factor", factor.name, "inverse", text, "where it is zero the joint graph must be singular")]


def _opposite(found: Solutions, name: str) -> tuple[FloatArray, FloatArray, NDArray[np.int8]]:
    """Places (N, m) of one mode at which a factor is positive, others at which it is negative, and the mode's signs."""
    value, pairs = found.factors[name], []
    for label in dict.fromkeys(found.labels.tolist()):
        own = found.labels == label
        plus, minus = np.flatnonzero(own & (value > 0)), np.flatnonzero(own & (value < 0))
        pairs += [(p, m) for p, m in zip(plus[:2], minus[:2], strict=False)]
    chosen = np.array(pairs[:PAIRS], dtype=int).reshape(-1, 2)
    return found.given[chosen[:, 0]], found.given[chosen[:, 1]], found.signs[chosen[:, 0]]


def _jump(found: Solutions, name: str) -> float:
    """A value this small is zero; larger where the sign changed over a gap between two parts of a mode."""
    return 1e-9 * float(np.max(np.abs(found.factors[name])))
