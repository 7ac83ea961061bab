"""Damped Gauss-Newton (Levenberg-Marquardt) in batches: every problem of a batch steps at its own pace.

Redundant and rank-deficient rows are ordinary here; overconstrained mechanisms have both.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IndexArray = NDArray[np.intp]

DAMPING = 1e-3
"""Damping of the first step from any start."""

LOWERED, RAISED = 0.03, 2.0
"""After a step that did as well as its linear model said damping falls to this share; after one that made things worse
it rises by this factor, twice as much each time in a row (Nielsen 1999, Damping parameter in Marquardt's method)."""

FAR, LEVEL = 1e-3, 1e-3
"""Where a residual is above the first and the slope of the sum of squares, as a share of what the residuals and the
columns' mean length allow, is below the second, there is a valley that ends above zero: a root that near, even a double
one, makes the slope sixty times as steep. So stopped, the residual is within 1e-6 of itself of the valley's."""


@dataclass(frozen=True)
class LeastSquaresResult:
    """Result per problem: `x` (N, n), `converged` (N,), steps taken."""

    x: FloatArray
    converged: NDArray[np.bool_]
    steps: int


def minimise(
    system: Callable[[FloatArray, IndexArray], tuple[FloatArray, FloatArray]],
    start: FloatArray,
    *,
    tolerance: float,
    max_steps: int = 60,
    max_change: float = np.inf,
    damping: float = DAMPING,
    same: Callable[[FloatArray], FloatArray] | None = None,
) -> LeastSquaresResult:
    """Drive the residuals of a batch of systems to zero, from (N, n) starts.

    `system(x, rows)` returns residuals (k, r) and Jacobians (k, r, n) of the k problems with those row
    numbers, at x (k, n). A problem has converged when every residual is at most `tolerance`; one that has
    not is reported as it stands, never dropped. `damping` is that of the first step, as a share of the mean square of
    the Jacobian's columns: small where the start is known to be near. `same(x)` may say (k, n) better unknowns for the
    same thing.

    Example: the root of x^2 = 2.

    >>> def system(x, rows):
    ...     return x**2 - 2.0, 2.0 * x[:, :, None]
    >>> minimise(system, np.array([[1.0]]), tolerance=1e-14).x.round(6)
    array([[1.414214]])
    """
    x = np.array(start, dtype=float)
    damped, raised = np.full(len(x), damping), np.full(len(x), RAISED)
    residual, jacobian = system(x, np.arange(len(x)))
    error = np.einsum("ni,ni->n", residual, residual)
    steps = 0
    while steps < max_steps:
        active = np.flatnonzero(np.max(np.abs(residual), axis=1, initial=0.0) > tolerance)
        active = active[~_in_valley(residual[active], jacobian[active])]
        if not len(active):
            break
        steps += 1
        change = _step(residual[active], jacobian[active], damped[active], max_change)
        trial = x[active] + change if same is None else same(x[active] + change)
        new_residual, new_jacobian = system(trial, active)
        new_error = np.einsum("ni,ni->n", new_residual, new_residual)
        expected = residual[active] + (jacobian[active] @ change[..., None])[..., 0]
        gain = error[active] - np.einsum("ni,ni->n", expected, expected)
        ratio = np.clip((error[active] - new_error) / np.maximum(gain, 1e-300), -1.0, 1.0)
        better = new_error < error[active]
        accepted, refused = active[better], active[~better]
        x[accepted], residual[accepted] = trial[better], new_residual[better]
        jacobian[accepted], error[accepted] = new_jacobian[better], new_error[better]
        lowered = np.maximum(LOWERED, 1.0 - (2.0 * ratio[better] - 1.0) ** 3)
        damped[accepted] = np.maximum(damped[accepted] * lowered, 1e-15)
        damped[refused] = np.minimum(np.maximum(damped[refused], 1e-9) * raised[refused], 1e8)
        raised[accepted], raised[refused] = RAISED, raised[refused] * 2.0
        if np.all(damped[active] >= 1e8):
            break
    return LeastSquaresResult(x, np.max(np.abs(residual), axis=1, initial=0.0) <= tolerance, steps)


def _in_valley(residual: FloatArray, jacobian: FloatArray) -> BoolArray:
    """Where (N,) the sum of squares is at a minimum that is no root."""
    slope = np.linalg.norm((residual[:, None, :] @ jacobian)[:, 0], axis=1)
    column = np.sqrt(np.einsum("nij,nij->n", jacobian, jacobian) / max(jacobian.shape[-1], 1))
    far = np.max(np.abs(residual), axis=1, initial=0.0) > FAR
    return np.asarray(far & (slope <= LEVEL * column * np.linalg.norm(residual, axis=1)))


def _step(residual: FloatArray, jacobian: FloatArray, damping: FloatArray, max_change: float) -> FloatArray:
    normal = np.swapaxes(jacobian, -1, -2) @ jacobian
    scale = np.einsum("nii->n", normal) / normal.shape[-1] + 1e-300
    normal += (damping * scale)[:, None, None] * np.eye(normal.shape[-1])
    gradient = (residual[:, None, :] @ jacobian)[:, 0]
    try:
        change = -np.linalg.solve(normal, gradient[..., None])[..., 0]
    except np.linalg.LinAlgError:  # damping that is lost in the rounding of long columns
        change = _step_by_singular_values(residual, jacobian, damping * scale)
    length = np.max(np.abs(change), axis=1, keepdims=True)
    limited: FloatArray = change * np.minimum(1.0, max_change / np.maximum(length, 1e-300))
    return limited


def _step_by_singular_values(residual: FloatArray, jacobian: FloatArray, damping: FloatArray) -> FloatArray:
    """The same steps (N, n) without a product of the Jacobian with itself, a pivot of which may be zero."""
    left, singular, turned = np.linalg.svd(jacobian, full_matrices=False)
    gain = singular / (singular**2 + damping[:, None])
    step: FloatArray = -((residual[:, None, :] @ left)[:, 0] * gain)[:, None, :] @ turned
    return step[:, 0]
