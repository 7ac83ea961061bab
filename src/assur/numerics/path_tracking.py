"""Following solutions of a homogeneous system along t: a predictor and a corrector for a whole batch of paths.

A solution is a line through the origin, kept at length 1, so nothing runs away to infinity. Every path has its own t
and its own step: Runge-Kutta's rule on dx/dt, then two steps of Newton's method.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.numerics.expanded import ExpandedSystem

ComplexArray = NDArray[np.complex128]
FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IndexArray = NDArray[np.intp]

CONTRACTION = 0.01
"""Newton's second step must be this part of the first one."""
CONVERGED = 1e-10
AIM = 0.1
"""The part of the largest correction that a step is aimed at."""
FIRST_STEP = 0.1
SMALLEST_STEP = 1e-9
MOST_STEPS = 1000
POLISHINGS = 8


def along(
    system: ExpandedSystem,
    x: ComplexArray,
    problem: IndexArray,
    start: NDArray[np.inexact],
    stop: NDArray[np.inexact],
    close: float,
    first: float = FIRST_STEP,
) -> tuple[ComplexArray, BoolArray, int]:
    """Follow solutions x (N, n) of problems (N,) from t = start to t = stop (N,) on straight lines.

    The first step is the share `first` of the way. A step whose prediction needs a larger correction than `close`, at
    length 1, is taken again, shorter.

    Returns:
        The points (N, n), of length 1; whether they arrived (N,); the number of steps of the slowest.

    Example: a square root of 1 followed to one of 4.

        >>> from assur.numerics.expanded import expand, unknowns
        >>> x, y, t = unknowns(3)
        >>> system = expand([x * x - (4 - 3 * t) * y * y])
        >>> start = np.array([[1.0, 1.0]], dtype=complex)
        >>> end, arrived, _ = along(system, start, np.zeros(1, dtype=int), np.ones(1), np.zeros(1), 1e-4)
        >>> float((end[0, 0] / end[0, 1]).real.round(9)), bool(arrived[0])
        (2.0, True)
    """
    x = x / np.linalg.norm(x, axis=1, keepdims=True)
    span = stop - start
    done, step = np.zeros(len(x)), np.full(len(x), first)
    active = np.arange(len(x))
    steps = 0
    while len(active) and steps < MOST_STEPS:
        steps += 1
        own, here = problem[active], start[active] + done[active] * span[active]
        length = np.minimum(step[active], 1.0 - done[active])
        change = length * span[active]
        after, error, good = _corrected(system, _predicted(system, x[active], here, change, own), here + change, own)
        good &= error <= close
        moved = active[good]
        x[moved] = after[good]
        last = length[good] == 1.0 - done[moved]
        done[moved] = np.where(last, 1.0, done[moved] + length[good])
        # the error grows with the fifth power of a step
        growth = 0.8 * (AIM * close / np.maximum(error, 1e-300)) ** 0.2
        step[active] = length * np.where(good, np.clip(growth, 0.3, 3.0), 0.35)
        active = active[(done[active] < 1.0) & (step[active] > SMALLEST_STEP)]
    return x, done >= 1.0, steps


def _predicted(
    system: ExpandedSystem, x: ComplexArray, t: NDArray[np.inexact], change: NDArray[np.inexact], problem: IndexArray
) -> ComplexArray:
    """Points (N, n) at t + change, by the classical Runge-Kutta rule on dx/dt."""
    h = change[:, None]
    first = _tangent(system, x, t, problem)
    second = _tangent(system, x + h / 2 * first, t + change / 2, problem)
    third = _tangent(system, x + h / 2 * second, t + change / 2, problem)
    fourth = _tangent(system, x + h * third, t + change, problem)
    return np.asarray(x + h / 6 * (first + 2 * second + 2 * third + fourth))


def _tangent(system: ExpandedSystem, x: ComplexArray, t: NDArray[np.inexact], problem: IndexArray) -> ComplexArray:
    """dx/dt (N, n) of the solutions, orthogonal to x."""
    _, slope, rate = system.evaluate(x, t, problem)
    return _across(slope, -rate, x)


def _across(slope: ComplexArray, right: ComplexArray, x: ComplexArray) -> ComplexArray:
    """The change (N, n) with slope change = right (N, E) that is orthogonal to x (N, n)."""
    matrix = np.concatenate([slope, x.conj()[:, None, :]], axis=1)  # (N, n, n)
    column = np.concatenate([right, np.zeros((len(x), 1))], axis=1)[..., None]
    try:
        return np.asarray(np.linalg.solve(matrix, column)[..., 0])
    except np.linalg.LinAlgError:  # one of the batch is singular to the last bit
        return np.asarray((np.linalg.pinv(matrix) @ column)[..., 0])


def _corrected(
    system: ExpandedSystem, x: ComplexArray, t: NDArray[np.inexact], problem: IndexArray
) -> tuple[ComplexArray, FloatArray, BoolArray]:
    """Points (N, n) after two Newton steps, the size of the first step (N,), and whether the second was far smaller."""
    first, size = _newton_step(system, x, t, problem)
    second, rest = _newton_step(system, first, t, problem)
    return second, size, rest <= np.maximum(CONTRACTION * size, CONVERGED)


def _newton_step(
    system: ExpandedSystem, x: ComplexArray, t: NDArray[np.inexact], problem: IndexArray
) -> tuple[ComplexArray, FloatArray]:
    x = x / np.linalg.norm(x, axis=1, keepdims=True)
    value, slope, _ = system.evaluate(x, t, problem)
    change = _across(slope, -value, x)
    return x + change, np.linalg.norm(change, axis=1)


def polished(
    system: ExpandedSystem, x: ComplexArray, t: NDArray[np.inexact], problem: IndexArray
) -> tuple[ComplexArray, BoolArray]:
    """Points (N, n) of length 1 after Newton's steps at t (N,), and whether the last one changed next to nothing."""
    x = x / np.linalg.norm(x, axis=1, keepdims=True)
    rows, size = np.arange(len(x)), np.full(len(x), np.inf)
    for _ in range(POLISHINGS):
        x[rows], size[rows] = _newton_step(system, x[rows], t[rows], problem[rows])
        rows = rows[size[rows] > CONVERGED]
        if not len(rows):
            break
    return x / np.linalg.norm(x, axis=1, keepdims=True), size <= CONVERGED
