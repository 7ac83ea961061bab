"""Interval Newton's method with a preconditioner (Krawczyk): a box holds exactly one zero of n equations, or none.

With m in the box X, Y any matrix and J(X) bounds of the derivative over X, every zero in X lies in

    K(X) = m - Y F(m) + (I - Y J(X)) (X - m);

if K(X) lies in the interior of X there is exactly one (R. Krawczyk 1969; R. E. Moore 1977). Y is the inverse of the
middle of J(X), in floats: whatever its error, the statements hold.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Sequence
from functools import lru_cache, reduce
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.numerics.dual import Dual, DualIntervals
from assur.numerics.intervals.interval import Interval, as_interval, common
from assur.numerics.intervals.shapes import broadcast, stack
from assur.numerics.number_types import Intervals
from assur.numerics.recording.interval_program import IntervalProgram, repaid
from assur.numerics.recording.tape import Recorded, Recorder

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
Equations = Callable[[Any, tuple[Any, ...]], Sequence[Any]]
"""(namespace, n numbers of any type) -> n numbers that are to be zero, elementwise over a batch (N,)."""

SMALL = 6
"""Unknowns up to which an image may be worked out by a program, whose length grows with their cube."""

NARROWINGS, NARROW = 4, 1e-13
"""Images by which a box is made as narrow as rounding lets it: each takes its width to the square, nearly. And the
width, as a part of its largest coordinate, at which rounding has been reached."""

INFLATION = 0.1
"""Part of its width by which a box is widened before it is tested: a zero on its border is then inside."""


def image(equations: Equations, box: Interval) -> Interval:
    """K(X) of boxes X (N, n): every zero in X is in it; not defined where the derivative has no bounds.

    Example: the root of 2 in [1, 2].

    >>> found = image(lambda ns, x: [x[0] * x[0] - 2], Interval.of([[1.0]], [[2.0]]))
    >>> bool(found.within(Interval.of([[1.0]], [[2.0]]))[0, 0]), bool(found.contains(2**0.5)[0, 0])
    (True, True)
    """
    middle = box.middle
    size = middle.shape[-1]
    values = stacked(equations(Intervals(), parts(Interval.of(middle))), len(middle))
    slopes = derivative(equations, box)
    centre = slopes.middle
    sound = np.all(slopes.defined & np.isfinite(slopes.width), axis=(-2, -1))
    singular = np.linalg.det(np.where(sound[:, None, None], centre, np.eye(size))) == 0
    invertible = (sound & ~singular)[:, None, None]
    inverse = np.linalg.inv(np.where(invertible, centre, np.eye(size)))
    moved = _moved(middle, box - middle, values, slopes, inverse)
    return Interval(moved.low, moved.high, moved.defined & invertible[..., 0])


def _moved(middle: FloatArray, offset: Interval, values: Interval, slopes: Interval, inverse: FloatArray) -> Interval:
    """The image (N, n), m - Y F(m) + (I - Y J) (X - m): by machine code where that is repaid, of the same bits."""
    count, size = middle.shape
    if size <= SMALL and repaid(len(_operator(size).tape.operations), count):
        numbers = [*parts(Interval.of(middle)), *parts(offset), *parts(values)]
        numbers += [slopes[:, i, j] for i in range(size) for j in range(size)]
        numbers += [as_interval(inverse[:, i, j]) for i in range(size) for j in range(size)]
        components = _operator(size)(numbers, [], "compiled")
        return stacked([components[f"K{i}"] for i in range(size)], count)
    rest = np.eye(size) - total(Interval.of(inverse[..., None]) * _rows(slopes[:, None]))
    moved = total(Interval.of(inverse) * values[:, None, :], axis=-1)
    spread = total(rest * _rows(offset)[:, None, :], axis=-1)
    return Interval.of(middle) - moved + spread


@lru_cache(maxsize=SMALL)
def _operator(size: int) -> IntervalProgram:
    """The same for so many unknowns as a program."""
    recorder, every = Recorder(), range(size)
    middle, offset, values = ([recorder.varying(f"{name}{i}") for i in every] for name in "mdF")
    slopes, inverse = ([[recorder.varying(f"{name}{i}{j}") for j in every] for i in every] for name in "JY")
    outputs: dict[str, Recorded] = {}
    for i in every:
        rest = [float(i == j) - reduce(operator.add, [inverse[i][k] * slopes[k][j] for k in every]) for j in every]
        moved = reduce(operator.add, [inverse[i][k] * values[k] for k in every])
        spread = reduce(operator.add, [rest[j] * offset[j] for j in every])
        outputs[f"K{i}"] = middle[i] - moved + spread
    return IntervalProgram(recorder.tape(outputs))


def derivative(equations: Equations, box: Interval) -> Interval:
    """Bounds (N, n, n) of the derivative over boxes (N, n): row by row the equations, column by column the unknowns.

    >>> found = derivative(lambda ns, x: [x[0] * x[1], ns.sqrt(x[0])], Interval.of([[1.0, 2.0]], [[4.0, 3.0]]))
    >>> found.low[0].round(6).tolist()[0], found.high[0].round(6).tolist()
    ([2.0, 1.0], [[3.0, 4.0], [0.5, 0.0]])
    """
    count, size = box.shape
    unit = np.eye(size)
    numbers = tuple(Dual(part, Interval.of(unit[:, [k]])) for k, part in enumerate(parts(box)))
    rows = []
    for value in equations(DualIntervals(), numbers):
        slope = as_interval(value.derivative if isinstance(value, Dual) else 0.0)
        rows.append(broadcast(slope, (size, count)))
    columns = stack(rows)  # (unknowns, N, equations)
    return Interval(columns.low.transpose(1, 2, 0), columns.high.transpose(1, 2, 0), columns.defined.transpose(1, 2, 0))


def proves(image: Interval, box: Interval) -> BoolArray:
    """Where (N,) an image proves that its box holds exactly one zero."""
    return np.asarray(np.all(image.within(box), axis=-1))


def refutes(image: Interval, box: Interval) -> BoolArray:
    """Where (N,) an image proves that its box holds no zero."""
    apart = common(box, image)[1]
    return np.asarray(np.any(apart, axis=-1) & np.all(image.defined, axis=-1))


def inflated(box: Interval, floor: FloatArray | float = 0.0) -> Interval:
    """Boxes (N, n) widened by a part of their width, and by `floor` at least."""
    more = np.maximum(INFLATION * box.width, floor)
    return Interval(box.low - more, box.high + more, box.defined)


def tightened(equations: Equations, box: Interval) -> Interval:
    """Boxes (N, n) with one zero each, made as narrow as rounding lets them by taking the image again."""
    for _ in range(NARROWINGS):
        narrowed, apart = common(image(equations, box), box)
        usable = narrowed.defined & ~apart
        box = Interval(np.where(usable, narrowed.low, box.low), np.where(usable, narrowed.high, box.high), box.defined)
        if np.all(np.max(box.width, axis=-1) <= NARROW * np.max(box.magnitude, axis=-1)):
            break
    return box


def stacked(numbers: Sequence[Any], count: int) -> Interval:
    """Numbers (N,) one after the other as one interval (N, n)."""
    return stack([broadcast(as_interval(number), (count,)) for number in numbers])


def parts(box: Interval) -> tuple[Interval, ...]:
    """The coordinates (N,) of boxes (N, n), an object of its own each."""
    return tuple(box[..., k] for k in range(box.shape[-1]))


def _rows(number: Interval) -> Interval:
    """The same, definedness as wide as the bounds."""
    return broadcast(number, number.shape)


def total(terms: Interval, axis: int = -2) -> Interval:
    """Sum along an axis; of nothing it is zero."""
    terms = _rows(terms)
    if not terms.low.shape[axis]:
        return Interval.of(terms.low.sum(axis=axis))
    low, high = np.moveaxis(terms.low, axis, 0), np.moveaxis(terms.high, axis, 0)
    defined = np.moveaxis(terms.defined, axis, 0)
    total = Interval(low[0], high[0], defined[0])
    for k in range(1, len(low)):
        total = total + Interval(low[k], high[k], defined[k])
    return total
