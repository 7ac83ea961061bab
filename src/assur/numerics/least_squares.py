"""Damped Gauss-Newton (Levenberg-Marquardt) in batches: every problem of a batch steps at its own pace.

Redundant and rank-deficient rows are ordinary here; overconstrained mechanisms have both.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.intp]


@dataclass(frozen=True)
class LeastSquaresResult:
    """Result per problem: `x` (N, n), `cost` (N,) = largest |residual|, `converged` (N,), steps taken."""

    x: FloatArray
    cost: FloatArray
    converged: NDArray[np.bool_]
    steps: int


def minimise(
    system: Callable[[FloatArray, IndexArray], tuple[FloatArray, FloatArray]],
    start: FloatArray,
    *,
    tolerance: float,
    max_steps: int = 60,
    max_change: float = np.inf,
) -> LeastSquaresResult:
    """Drive the residuals of a batch of systems to zero, from (N, n) starts.

    `system(x, rows)` returns residuals (k, r) and Jacobians (k, r, n) of the k problems with those row
    numbers, at x (k, n). A problem has converged when every residual is at most `tolerance`; one that has
    not is reported as it stands, never dropped.

    Example: the root of x^2 = 2.

    >>> def system(x, rows):
    ...     return x**2 - 2.0, 2.0 * x[:, :, None]
    >>> minimise(system, np.array([[1.0]]), tolerance=1e-14).x.round(6)
    array([[1.414214]])
    """
    x = np.array(start, dtype=float)
    damping = np.full(len(x), 1e-3)
    residual, jacobian = system(x, np.arange(len(x)))
    error = np.einsum("ni,ni->n", residual, residual)
    steps = 0
    while steps < max_steps:
        active = np.flatnonzero(np.max(np.abs(residual), axis=1, initial=0.0) > tolerance)
        if not len(active):
            break
        steps += 1
        change = _step(residual[active], jacobian[active], damping[active], max_change)
        trial = x[active] + change
        new_residual, new_jacobian = system(trial, active)
        new_error = np.einsum("ni,ni->n", new_residual, new_residual)
        better = new_error < error[active]
        accepted = active[better]
        x[accepted], residual[accepted] = trial[better], new_residual[better]
        jacobian[accepted], error[accepted] = new_jacobian[better], new_error[better]
        damping[accepted] = np.maximum(damping[accepted] * 0.02, 1e-15)
        damping[active[~better]] = np.minimum(damping[active[~better]] * 8.0, 1e8)
        if np.all(damping[active] >= 1e8):
            break
    cost = np.max(np.abs(residual), axis=1, initial=0.0)
    return LeastSquaresResult(x, cost, cost <= tolerance, steps)


def _step(residual: FloatArray, jacobian: FloatArray, damping: FloatArray, max_change: float) -> FloatArray:
    normal = np.einsum("nri,nrj->nij", jacobian, jacobian)
    scale = np.einsum("nii->n", normal) / normal.shape[-1] + 1e-300
    normal += (damping * scale)[:, None, None] * np.eye(normal.shape[-1])
    gradient = np.einsum("nri,nr->ni", jacobian, residual)
    change = -np.linalg.solve(normal, gradient[..., None])[..., 0]
    length = np.max(np.abs(change), axis=1, keepdims=True)
    limited: FloatArray = change * np.minimum(1.0, max_change / np.maximum(length, 1e-300))
    return limited
