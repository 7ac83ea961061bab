"""The law of statuses: what the factors call singular, of a kind, is singular, and of that kind, on the joint graph.

A factor may be right, and its scale or a group of `constraint_singular` or `self_motion_singular` wrong: then every
number is right and the word beside it is not.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.closure import RANK_GAP
from assur.kinematics.contract.mismatch import Mismatch, place_text
from assur.kinematics.contract.solutions import Solutions
from assur.kinematics.rates.finite_motion import has_finite_motion
from assur.kinematics.rates.motions import InstantaneousMotion, general, general_share, motions
from assur.kinematics.status import FACTOR_TOLERANCE, Status, classify, closed_form_of, relative_factors

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]

REGULAR = 1e-3
"""A configuration whose singular values (sines) are all above this is regular."""
MOVED = 4
"""So many that are called a self-motion are moved by finite steps."""


def false_statuses(solutions: Solutions, motion: InstantaneousMotion | None = None) -> list[Mismatch]:
    """Solutions that factors call singular and that are not, with the factors by which they do.

    Args:
        solutions: solutions at any places, at the ends of their branches above all: there factors vanish.
        motion: the joint graph's at their joint values, where it is known.
    """
    if not len(solutions):
        return []
    status = classify(solutions.record, solutions.factors, (len(solutions),))
    told = np.flatnonzero(status >= Status.serial)
    if not len(told):
        return []
    chosen = motions(solutions.record, solutions.joints, RANK_GAP) if motion is None else motion
    serial, parallel, whole = _regular(solutions, chosen)
    both = {
        Status.serial: serial & whole,
        Status.parallel: parallel & whole,
        Status.comprehensive: (serial | parallel) & whole,
        Status.constraint: whole,
        Status.self_motion: parallel & whole,
    }
    false = np.zeros(len(solutions), dtype=bool)
    for kind, denied in both.items():
        false |= (status == kind) & denied
    moving = np.flatnonzero((status == Status.self_motion) & ~false)[:MOVED]
    if len(moving):
        false[moving] = ~has_finite_motion(solutions.record, solutions.joints[moving])
    wrong = np.flatnonzero(false)
    return [_told(solutions, int(wrong[0]), Status(int(status[wrong[0]])))] if len(wrong) else []


def _regular(solutions: Solutions, motion: InstantaneousMotion) -> tuple[BoolArray, BoolArray, BoolArray]:
    """Where (S,) the platform keeps its freedoms, the inputs hold it, and the closure keeps its rank, beyond doubt."""
    record = solutions.record
    least = [np.linalg.svd(part, compute_uv=False)[..., part.shape[-2] - 1] for part in (motion.pose, motion.inputs)]
    share = motion.values[:, int(general(record).closure) - 1] / motion.values[:, 0]
    return least[0] > REGULAR, least[1] > REGULAR, share > REGULAR * general_share(record)


def _told(solutions: Solutions, row: int, status: Status) -> Mismatch:
    form, record = closed_form_of(solutions.record), solutions.record
    zero = {
        name: abs(float(value[row])) <= FACTOR_TOLERANCE
        for name, value in relative_factors(record, solutions.factors).items()
    }
    groups = {Status.constraint: form.constraint_singular, Status.self_motion: form.self_motion_singular}.get(status)
    if groups is None:
        kinds = ("serial", "parallel") if status == Status.comprehensive else (status.name,)
        names: tuple[str, ...] = tuple(item.name for item in form.factor_list if zero[item.name] and item.kind in kinds)
        allowed = "a factor may be zero, within its scale, only where the joint graph is singular"
        hint = "is its scale the size that it has?"
    else:
        names = next(group for group in groups if all(zero[name] for name in group))
        listed = "constraint_singular" if status == Status.constraint else "self_motion_singular"
        says = (
            "the closure loses rank" if status == Status.constraint else "the platform moves while every input stands"
        )
        allowed, hint = f"{listed} may name a group only where {says} at its zero", ""
    place = place_text(record, solutions.problem, solutions.given[row])
    text = (
        f"{' and '.join(names)} count as zero and the status is {status.name} in mode {solutions.labels[row]} of the "
        f"{solutions.problem} problem at {place}, where the joint graph is not"
    )
    return Mismatch("status", names[0], solutions.problem, text, allowed, hint)
