"""One zero of the loops for each choice of what is off: Krawczyk's test with parameters, and where its platform is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import joint_scales
from assur.machine.accuracy.toleranced_loops import LoopSlopes, TolerancedLoops
from assur.model.mechanism import MechanismRecord
from assur.model.pose import QUATERNION
from assur.numerics.intervals.interval import Interval
from assur.numerics.intervals.shapes import stack
from assur.numerics.krawczyk import total

FloatArray = NDArray[np.float64]
GROWTH, TRIES = 1.5, 8
"""By how much boxes of joint values are widened until the test holds, and how often."""
FLOOR = 1e-12
"""Half the width of a box at least, in characteristic lengths and rad."""
ROUNDING = 1.0 + 1e-12
"""Above what sums of a few hundred floats are off by, as a share."""


@dataclass(frozen=True, eq=False)
class ProvedZeros:
    """One zero for each d: the box of joints (q,) that holds all of them, bounds of coordinates and of their slopes.

    Attributes:
        graph: of what.
        centre: (q,) joint values.
        unique: (q,) the box in which there is one zero.
        moved: (q, t) change of the joints per what is off, in floats.
        bounds: of each coordinate.
        slopes: (t,) of each coordinate, by what is off.
    """

    graph: TolerancedLoops
    centre: FloatArray
    unique: Interval
    moved: FloatArray
    bounds: dict[str, tuple[float, float]]
    slopes: dict[str, Interval]


def proved_zeros(graph: TolerancedLoops, centre: FloatArray, bounds: FloatArray) -> ProvedZeros | None:
    """Of zeros near joint values (q,) while what is off stays within bounds (t,)."""
    count, scale = len(centre), joint_scales(graph.record)[graph.unknown]
    nominal = graph.slopes(Interval.of(centre), Interval.of(np.zeros(len(bounds))))
    middle = nominal.rows.middle
    answers = np.linalg.lstsq(middle[:, :count], np.column_stack([middle[:, count:], nominal.values.middle]))[0]
    half = GROWTH * np.abs(answers) @ np.append(bounds, 1.0) + FLOOR * scale
    allowed = Interval.of(-bounds, bounds)
    for _ in range(TRIES):
        box = Interval.of(centre - half, centre + half)
        over = graph.slopes(box, allowed)
        parts = _image(nominal, over)
        if parts is None:
            return None
        rest, answer, start = parts
        reach = (_applied(rest, Interval.of(-half, half)) - start - _applied(answer, allowed)).magnitude
        if not np.all(np.isfinite(reach)):
            return None
        if np.all(reach < half):  # proved; what lies in the image is less, and has closer bounds
            closer = graph.slopes(Interval.of(centre - reach, centre + reach), allowed)
            again = _image(nominal, closer)
            if again is None or not over.whole:
                return None
            own, slopes = _bounded(graph.record, nominal, closer, again, allowed, scale)
            return ProvedZeros(graph, centre, box, np.asarray(-answers[:, :-1], dtype=np.float64), own, slopes)
        half = GROWTH * reach + FLOOR * scale
    return None


def _image(nominal: LoopSlopes, over: LoopSlopes) -> tuple[Interval, Interval, Interval] | None:
    """I - Y J, Y G and Y F(m, 0); None where Y does not exist."""
    count = len(nominal.values.low)
    middle = over.rows.middle[:, :count]
    if not np.all(np.isfinite(middle)) or np.linalg.det(middle) == 0.0:
        return None
    inverse = Interval.of(np.linalg.inv(middle))
    rest = Interval.of(np.eye(count)) - _product(inverse, over.rows[:, :count])
    return rest, _product(inverse, over.rows[:, count:]), _applied(inverse, nominal.values)


def _bounded(
    record: MechanismRecord,
    nominal: LoopSlopes,
    over: LoopSlopes,
    parts: tuple[Interval, Interval, Interval],
    allowed: Interval,
    scale: FloatArray,
) -> tuple[dict[str, tuple[float, float]], dict[str, Interval]]:
    """Bounds of the coordinates by the mean value theorem, and of their slopes (t,) by what is off.

    `parts` are I - Y J, Y G and Y F(m, 0).
    """
    rest, answer, start = parts
    count = len(scale)
    whole = stack([*(answer[:, k] for k in range(answer.shape[1])), start], axis=1)  # (q, t + 1)
    size = np.max(whole.magnitude / scale[:, None], axis=0) * ROUNDING
    share = float(np.max(np.sum(rest.magnitude * scale / scale[:, None], axis=1))) * ROUNDING
    more = ROUNDING * share / (1.0 - share) * size * scale[:, None] if share < 1.0 else np.full(whole.shape, np.inf)
    moved = whole + Interval.of(-more, more)
    for _ in range(2):
        moved = whole + _product(rest, moved)  # what it encloses is so made of itself
    bounds, slopes = {}, {}
    for name in record.platform.pose:
        if name in QUATERNION:
            continue
        slope = over.pose[name]
        along = total(moved * slope[:count][:, None], axis=0)
        slopes[name], base = slope[count:] - along[:-1], nominal.pose[f"value {name}"] - along[[-1]]
        reached = base + total(slopes[name] * allowed, axis=-1)
        bounds[name] = (float(np.squeeze(reached.low)), float(np.squeeze(reached.high)))
    return bounds, slopes


def _product(first: Interval, second: Interval) -> Interval:
    """Of matrices (a, b) and (b, c)."""
    terms = first[:, :, None] * second[None]
    return total(terms, axis=1)


def _applied(matrix: Interval, vector: Interval) -> Interval:
    """A matrix (a, b) times a vector (b,)."""
    return total(matrix * vector[None], axis=-1)
