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

LEAST = 1e-9
"""Damping after a step that made things worse, at least: then it is felt. Towards a root that is nearly double, one
singular value of which is smaller than the root of this, steps are far too short."""

LOWERED, RAISED = 0.03, 2.0
"""After a step that did as well as its linear model said damping falls to this share; after one that made things worse
it rises by this factor, twice as much each time in a row (Nielsen 1999, Damping parameter in Marquardt's method)."""

FAR, LEVEL = 1e-3, 1e-3
"""Where a residual is above the first and the slope of the sum of squares, as a share of what the residuals and the
columns' mean length allow, is below the second, there is a valley that ends above zero: a root that near, even a double
one, makes the slope sixty times as steep. So stopped, the residual is within 1e-6 of itself of the valley's."""


@dataclass(frozen=True)
class LeastSquaresResult:
    """Result per problem: `x` (N, n), what its residuals (N, r) are there, `converged` (N,), steps taken."""

    x: FloatArray
    residual: FloatArray
    converged: NDArray[np.bool_]
    steps: int


def minimise(
    system: Callable[[FloatArray, IndexArray], tuple[FloatArray, FloatArray]],
    start: FloatArray,
    *,
    tolerance: float,
    max_steps: int = 60,
    enough: float = 1.0,
    max_change: float = np.inf,
    damping: float = DAMPING,
    least: float = LEAST,
    same: Callable[[FloatArray], FloatArray] | None = None,
) -> LeastSquaresResult:
    """Drive the residuals of a batch of systems to zero, from (N, n) starts.

    `system(x, rows)` returns residuals (k, r) and Jacobians (k, r, n) of the k problems with those row
    numbers, at x (k, n). A problem has converged when every residual is at most `tolerance`; one that has
    not is reported as it stands, never dropped. With `enough` below 1 no more steps are made once this share
    has converged: of starts by chance the last few take most of them. `damping` is that of the first step, as
    a share of the mean square of the Jacobian's columns: small where the start is known to be near. It is `least` or
    more after a step that failed. `same(x)`
    may say (k, n) better unknowns for the same thing.

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
        if len(active) <= (1.0 - enough) * len(x):
            break
        model = _LinearModels.of(residual[active], jacobian[active])
        if np.any(model.in_valley):
            active = active[~model.in_valley]
            model = _LinearModels.of(residual[active], jacobian[active])
        if not len(active):
            break
        steps += 1
        change = model.step(damped[active], max_change)
        trial = x[active] + change if same is None else same(x[active] + change)
        new_residual, new_jacobian = system(trial, active)
        new_error = np.einsum("ni,ni->n", new_residual, new_residual)
        gain = error[active] - model.error(change)
        ratio = np.clip((error[active] - new_error) / np.maximum(gain, 1e-300), -1.0, 1.0)
        better = new_error < error[active]
        accepted, refused = active[better], active[~better]
        x[accepted], residual[accepted] = trial[better], new_residual[better]
        jacobian[accepted], error[accepted] = new_jacobian[better], new_error[better]
        lowered = np.maximum(LOWERED, 1.0 - (2.0 * ratio[better] - 1.0) ** 3)
        damped[accepted] = np.maximum(damped[accepted] * lowered, 1e-15)
        damped[refused] = np.minimum(np.maximum(damped[refused], least) * raised[refused], 1e8)
        raised[accepted], raised[refused] = RAISED, raised[refused] * 2.0
        if np.all(damped[active] >= 1e8):
            break
    return LeastSquaresResult(x, residual, np.max(np.abs(residual), axis=1, initial=0.0) <= tolerance, steps)


@dataclass(frozen=True, eq=False)
class _LinearModels:
    """Systems as they are near a place: residuals (N, r), Jacobians (N, r, n), slopes J^T r (N, n), traces of J^T J."""

    residual: FloatArray
    jacobian: FloatArray
    slope: FloatArray
    trace: FloatArray

    @classmethod
    def of(cls, residual: FloatArray, jacobian: FloatArray) -> _LinearModels:
        slope = (residual[:, None, :] @ jacobian)[:, 0]
        return cls(residual, jacobian, slope, np.einsum("nij,nij->n", jacobian, jacobian))

    @property
    def in_valley(self) -> BoolArray:
        """Where (N,) the sum of squares is at a minimum that is no root."""
        column = np.sqrt(self.trace / max(self.jacobian.shape[-1], 1))
        far = np.max(np.abs(self.residual), axis=1, initial=0.0) > FAR
        level = np.linalg.norm(self.slope, axis=1) <= LEVEL * column * np.linalg.norm(self.residual, axis=1)
        return np.asarray(far & level)

    def error(self, change: FloatArray) -> FloatArray:
        """The sums of squares (N,) after changes (N, n)."""
        expected = self.residual + (self.jacobian @ change[..., None])[..., 0]
        return np.asarray(np.einsum("ni,ni->n", expected, expected))

    def step(self, damping: FloatArray, max_change: float) -> FloatArray:
        """Changes (N, n); damping is a share of the mean square of the columns."""
        equations, unknowns = self.jacobian.shape[-2:]
        turned = np.swapaxes(self.jacobian, -1, -2)
        damped = damping * (self.trace / unknowns + 1e-300)
        wide = equations < unknowns  # J^T (J J^T + d)^-1 = (J^T J + d)^-1 J^T: the smaller of the two is solved
        normal = self.jacobian @ turned if wide else turned @ self.jacobian
        normal[:, range(len(normal[0])), range(len(normal[0]))] += damped[:, None]
        try:
            if wide:
                change = -(turned @ np.linalg.solve(normal, self.residual[..., None]))[..., 0]
            else:
                change = -np.linalg.solve(normal, self.slope[..., None])[..., 0]
        except np.linalg.LinAlgError:  # damping that is lost in the rounding of long columns
            change = self._step_by_singular_values(damped)
        length = np.max(np.abs(change), axis=1, keepdims=True)
        limited: FloatArray = change * np.minimum(1.0, max_change / np.maximum(length, 1e-300))
        return limited

    def _step_by_singular_values(self, damped: FloatArray) -> FloatArray:
        """The same steps (N, n) without a product of the Jacobian with itself, a pivot of which may be zero."""
        left, singular, turned = np.linalg.svd(self.jacobian, full_matrices=False)
        gain = singular / (singular**2 + damped[:, None])
        step: FloatArray = -((self.residual[:, None, :] @ left)[:, 0] * gain)[:, None, :] @ turned
        return step[:, 0]
