"""Correcting: Newton steps in a batch from starts that are near; what does not come nearer fast is given up at once.

`assur.numerics.least_squares` tries hard from anywhere. Beside an assembly every step brings the gaps down many
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
Equations = Callable[[FloatArray, NDArray[np.intp]], tuple[FloatArray, FloatArray]]
"""Unknowns (k, n) and row numbers (k,) to residuals (k, r) and derivatives (k, r, n)."""

CLOSED = 1e-9
"""Residuals up to this count as closed. One more step, of a derivative that is known, takes them to rounding."""

FALL, FREE = 0.5, 1
"""What is left of a residual after a step at most; so many steps are free of this."""

STEPS = 12
BLOCK = 512
"""Problems that are corrected at a time: their matrices stay in the cache."""

DAMPING = 1e-14
"""Share of the mean square of the columns of a derivative."""


@dataclass(frozen=True, eq=False)
class Corrected:
    """Unknowns (N, n), where they solve the equations (N,), and the derivative there (N, r, n)."""

    values: FloatArray
    closed: BoolArray
    derivative: FloatArray


def corrected(equations: Equations, start: FloatArray) -> Corrected:
    """Solutions near starts (N, n); where none is found the values are the nearest that were seen.

    >>> def square_root(x, rows):
    ...     return x**2 - np.array([[2.0], [-1.0]])[rows], 2.0 * x[:, :, None]
    >>> found = corrected(square_root, np.array([[1.5], [1.5]]))
    >>> found.values[0].round(12).tolist(), found.closed.tolist()
    ([1.414213562373], [True, False])
    """
    parts = [_block(equations, start, first) for first in range(0, max(len(start), 1), BLOCK)]
    values, closed, derivative = (np.concatenate(column) for column in zip(*parts, strict=True))
    return Corrected(values, closed, derivative)


def _block(equations: Equations, start: FloatArray, first: int) -> tuple[FloatArray, BoolArray, FloatArray]:
    trial = np.array(start[first : first + BLOCK], dtype=float)
    rows = np.arange(len(trial))
    residual, matrix = equations(trial, rows + first)
    nearest, derivative = trial.copy(), matrix.copy()
    size = np.max(np.abs(residual), axis=1, initial=0.0)
    closed = np.zeros(len(trial), dtype=bool)
    for turn in range(STEPS):
        done = size[rows] <= CLOSED
        trial[rows] -= solved(matrix, residual[..., None])[..., 0]
        closed[rows[done]] = True
        nearest[rows[done]] = trial[rows[done]]
        rows = rows[~done]
        if not len(rows):
            break
        residual, matrix = equations(trial[rows], rows + first)
        now = np.max(np.abs(residual), axis=1, initial=0.0)
        nearer = now < size[rows]
        nearest[rows[nearer]], derivative[rows[nearer]] = trial[rows[nearer]], matrix[nearer]
        on = (now < FALL * size[rows]) | (now <= CLOSED) | (turn < FREE)
        size[rows] = np.where(nearer, now, size[rows])
        rows, residual, matrix = rows[on], residual[on], matrix[on]
    return nearest, closed, derivative


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
