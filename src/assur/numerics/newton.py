"""Newton's method in a batch, from starts that are near; what does not come nearer fast is given up at once.

`assur.numerics.least_squares` tries hard from anywhere. Beside a solution every step brings residuals down many
times, at a fold of two branches still four times; where they stay there is nothing near, and most steps of a search
that is more patient are spent there.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IntArray = NDArray[np.intp]
NewtonMap = Callable[[FloatArray, IntArray], tuple[FloatArray, FloatArray]]
"""Unknowns (k, n) and row numbers (k,) to the largest residuals (k,), and to the unknowns a step further (k, n)."""
Equations = Callable[[FloatArray, IntArray], tuple[FloatArray, FloatArray]]
"""Unknowns (k, n) and row numbers (k,) to residuals (k, r) and derivatives (k, r, n)."""
Residuals = Callable[[FloatArray, IntArray], FloatArray]
"""Unknowns (k, n) and row numbers (k,) to the largest residuals (k,)."""

CLOSED = 1e-9
"""Residuals up to this count as closed. One more step, of a derivative that is known, takes them to rounding."""

NEAR = 1e-4
"""After a step from residuals up to this they may be rounding."""

FALL, FREE = 0.5, 1
"""What is left of a residual after a step at most; so many steps are free of this."""

STEPS = 12
BLOCK = 256
"""Problems that are worked on at a time: their matrices stay in the cache."""

DAMPING = 1e-14
"""Share of the mean square of the columns of a derivative."""


@dataclass(frozen=True, eq=False)
class NewtonResult:
    """Unknowns (N, n), or the nearest to a solution that were seen; residuals (N,), those before the last step.

    `closed` (N,) says which solve the equations, `derivative` (N, r, n) is that where they were evaluated last, or what
    stands for it (empty where none was asked for), `steps` is how many were made at most.
    """

    values: FloatArray
    residual: FloatArray
    closed: BoolArray
    derivative: FloatArray
    steps: int


def iterated(
    step: NewtonMap,
    start: FloatArray,
    tolerance: float | FloatArray = CLOSED,
    residuals: Residuals | None = None,
    block: int = BLOCK,
) -> NewtonResult:
    """Solutions near starts (N, n) by a map that makes steps; residuals up to `tolerance`, (N,) or one, are closed.

    Where residuals are told without a step they are told of the solutions; else each is one step further.
    """
    values, residual = np.array(start, dtype=float), np.full(len(start), np.inf)
    enough, steps = np.broadcast_to(tolerance, len(start)), 0
    for first in range(0, len(start), block):
        rows = np.arange(first, min(first + block, len(start)))
        trial = values[rows]
        for turn in range(STEPS + 1):
            size, after = step(trial, rows)
            done, on = size <= enough[rows], (size < FALL * residual[rows]) | (turn <= FREE)
            nearer = size < residual[rows]
            values[rows[nearer]], residual[rows[nearer]] = trial[nearer], size[nearer]
            ahead = done
            if residuals is not None and np.any(ahead := ~done & (size <= NEAR)):
                size[ahead] = residuals(after[ahead], rows[ahead])
                ahead &= size <= enough[rows]
                residual[rows[ahead]] = size[ahead]
            values[rows[ahead]], done = after[ahead], done | ahead
            steps = max(steps, turn)
            rows, trial = rows[on & ~done], after[on & ~done]
            if not len(rows):
                break
    return NewtonResult(values, residual, residual <= enough, np.empty((len(start), 0, 0)), steps)


def corrected(equations: Equations, start: FloatArray, tolerance: float | FloatArray = CLOSED) -> NewtonResult:
    """Solutions near starts (N, n) of equations whose derivative is known.

    >>> def square_root(x, rows):
    ...     return x**2 - np.array([[2.0], [-1.0]])[rows], 2.0 * x[:, :, None]
    >>> roots = corrected(square_root, np.array([[1.5], [1.5]]))
    >>> roots.values[0].round(12).tolist(), roots.closed.tolist()
    ([1.414213562373], [True, False])
    """
    derivative = np.empty((len(start), 0, 0))

    def step(values: FloatArray, rows: IntArray) -> tuple[FloatArray, FloatArray]:
        nonlocal derivative
        residuals, matrix = equations(values, rows)
        if derivative.shape[1:] != matrix.shape[1:]:
            derivative = np.empty((len(start), *matrix.shape[1:]))
        derivative[rows] = matrix
        return np.max(np.abs(residuals), axis=1, initial=0.0), values - solved(matrix, residuals[..., None])[..., 0]

    found = iterated(step, start, tolerance)
    return NewtonResult(found.values, found.residual, found.closed, derivative, found.steps)


def solved(matrix: FloatArray, right: FloatArray) -> FloatArray:
    """Least-squares solutions (N, n, k) of matrix (N, r, n) times x = right (N, r, k), nearly the smallest ones.

    By normal equations with a trace of damping, so that redundant rows and free unknowns do no harm; a singular value
    decomposition would cost ten times as much.
    """
    transposed = np.swapaxes(matrix, -1, -2)
    return np.asarray(np.linalg.solve(damped(transposed @ matrix, matrix), transposed @ right))


def damped(square: FloatArray, matrix: FloatArray) -> FloatArray:
    """Square matrices (N, n, n) and a trace of the identity, by the size of `matrix` (N, r, n)."""
    count = square.shape[-1]
    scale = DAMPING * np.einsum("nij,nij->n", matrix, matrix) / count
    result = square.copy()
    result[:, range(count), range(count)] += scale[:, None]
    return np.asarray(result)
