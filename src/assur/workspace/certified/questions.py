"""What may be asked of a pose: that it is reached, and that it is not singular; and single poses that answer no."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.errors import UnknownNameError
from assur.model.mechanism import MechanismRecord
from assur.numerics.intervals.interval import Interval
from assur.workspace.bounds import Stroke, not_reached
from assur.workspace.certified.criteria import Criteria, criteria
from assur.workspace.domain import Box

FloatArray = NDArray[np.float64]

KINDS = ("parallel", "serial", "constraint")
QUESTIONS = ("reached", "regular", *KINDS)
"""`reached` is always part of the question; `regular` stands for all kinds of singularities."""


@dataclass(frozen=True)
class Witness:
    """A pose that shows that something does not hold, with its reason in words.

    Attributes:
        pose: free coordinate -> value, in length units and rad.
        why: "M12 < 0: not reached", "v changes sign on the way: singular, or not reached".
    """

    pose: Mapping[str, float]
    why: str


def asked_of(
    record: MechanismRecord,
    mode: str | None,
    strokes: Mapping[str, Stroke | None] | None,
    held: Mapping[str, float] | None,
    what: Sequence[str],
) -> Criteria:
    """Criteria that no pose with a singularity of the kinds asked for fulfils.

    Errors:
        UnknownNameError: a question that is none of `QUESTIONS`.

    >>> from assur.model.registry import load_record
    >>> asked_of(load_record("zeng2019"), None, None, None, ["reached", "parallel"]).regular
    ('u1_minus_u2', 'w', 'v', 'sin_alpha_minus_beta')
    """
    for name in what:
        if name not in QUESTIONS:
            raise UnknownNameError("question", name, QUESTIONS)
    kinds = tuple(kind for kind in KINDS if kind in what or "regular" in what)
    return criteria(record, mode, strokes, held, kinds).nonsingular


def violations(asked: Criteria, points: Sequence[FloatArray], at: Mapping[str, Interval]) -> NDArray[np.str_]:
    """Why (N,) points certainly fail, "" where that is not certain.

    Args:
        asked: the criteria.
        points: one array (N,) per free coordinate.
        at: the criteria at a pose to which every point is joined by poses that ought to fulfil them too. Where a factor
            has the other sign there, one of those poses is singular or not reached.
    """
    found = asked.over([Interval.of(row) for row in points])
    why = np.full(len(points[0]), "", dtype="<U200")
    for name in asked.margins:
        why[found[name].high < 0] = not_reached(name)
    for name in asked.regular:
        here, there = found[name], at[name]
        changed = (here.negative & there.positive) | (here.positive & there.negative)
        zero = (here.low == 0) & (here.high == 0) & here.defined
        why[(why == "") & changed] = f"{name} changes sign on the way: singular, or not reached"
        why[(why == "") & zero] = f"{name} = 0"
    return why


def columns_of(box: Box, names: Sequence[str], points: FloatArray) -> list[FloatArray]:
    """One array (N,) per coordinate of a box from points (k, N) of the named ones; the others are in their middle."""
    found = dict(zip(names, points, strict=True))
    middle = {name: 0.5 * low + 0.5 * high for name, low, high in zip(box.names, box.low, box.high, strict=True)}
    return [found.get(name, np.full(points.shape[1], middle[name])) for name in box.names]
