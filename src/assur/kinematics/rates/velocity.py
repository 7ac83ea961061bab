"""Velocity: Jp v = Jq qdot (Eq. 25), both ways, with condition number and determinants."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UsageError
from assur.kinematics import border
from assur.kinematics.border import Named
from assur.kinematics.closed_form.mode_reading import ModeReading, mode_reading_at
from assur.kinematics.rates.instantaneous import Instant, instantaneous
from assur.kinematics.rates.units import scaled, unit_length
from assur.kinematics.status import FACTOR_TOLERANCE, closed_form_of
from assur.model.kernel_dimensions import kernel_dimensions
from assur.model.mechanism import MechanismRecord
from assur.model.pose import rate_names
from assur.results.notebook import Entries, Tabulated

FloatArray = NDArray[np.float64]
ARRAYS = ("jp", "jq", "singular_output", "singular_input", "exists", "no_rates")
"""What a velocity map has one of at each pose."""


@dataclass(frozen=True, eq=False)
class VelocityMap(Tabulated):
    """Jp (..., r, k) and Jq (..., r, n) with Jp v = Jq qdot at poses in one working mode, or at joint values.

    v are the rates of the pose as `assur.model.pose.rate_names` names them, for a quaternion the angular velocity; qdot
    are those of the printed inputs. `exists` (...) says where the mode reaches the pose, or the joint values close the
    loops; elsewhere every number is NaN. `singular_output` (...) marks where Jp is singular, `singular_input` where Jq
    is, judged by the factors of the closed form or by the ranks of the joint graph. Of a mechanism with more or fewer
    inputs than rates, Jq is not square: it has no determinant (NaN) and is solved by least squares. `no_rates` (...)
    marks where theta is a right angle, so that phi and psi have no rates of their own: J does not exist there, though
    the mechanism need not be singular. `length` is the characteristic length that lengths are divided by in velocity
    factors and condition number, None where units do not mix (`assur.kinematics.rates.units`).
    """

    record: MechanismRecord

    jp: FloatArray
    jq: FloatArray
    singular_output: NDArray[np.bool_]
    singular_input: NDArray[np.bool_]
    exists: NDArray[np.bool_]
    no_rates: NDArray[np.bool_]

    @classmethod
    def of(cls, record: MechanismRecord, instant: Instant) -> VelocityMap:
        """The velocity map of a first-order motion on the joint graph.

        >>> import assur
        >>> fivebar = assur.load("fivebar")
        >>> VelocityMap.of(fivebar, fivebar.instantaneous(fivebar.home_values)).matrix.shape
        (2, 2)
        """
        singular = (instant.singular_output, instant.singular_input)
        return cls(record, instant.jp, instant.jq, *singular, instant.closed, instant.no_rates)

    @property
    def length(self) -> float | None:
        """The characteristic length by which lengths are divided, in the mechanism's unit; None where nothing is."""
        return unit_length(self.record)

    def _title(self) -> str:
        return f"rates of the pose of {self.record.name} by rates of its inputs"

    def _entries(self) -> Entries:
        names = [f"{rate}/{own.name}" for rate in rate_names(self.record.platform.pose) for own in self.record.drives]
        numbers = self.matrix.reshape(-1, len(names)).tolist()
        rest = zip(self.condition.ravel().tolist(), self.singular_output.ravel().tolist(), strict=True)
        return [
            dict(zip(names, row, strict=True)) | {"condition": condition, "singular": singular}
            for row, (condition, singular) in zip(numbers, rest, strict=True)
        ]

    @cached_property
    def det_jp(self) -> FloatArray:
        """Determinant (...) of Jp."""
        return self._determinant(self.jp)

    @cached_property
    def det_jq(self) -> FloatArray:
        """Determinant (...) of Jq."""
        return self._determinant(self.jq)

    def rows(self, rows: NDArray[Any]) -> VelocityMap:
        """The same at some poses of a batch (N,).

        >>> import assur
        >>> velocities = assur.load("fivebar").velocity_map([[0.0, 200.0], [0.0, 224.0], [20.0, 224.0]])
        >>> velocities.rows([0, 2]).det_jp.shape
        (2,)
        """
        parts = {name: getattr(self, name)[rows] for name in ARRAYS}
        return VelocityMap(self.record, **parts)

    def _determinant(self, matrix: FloatArray) -> FloatArray:
        if matrix.shape[-1] != matrix.shape[-2]:
            return np.full(matrix.shape[:-2], np.nan)
        finite = np.all(np.isfinite(matrix), axis=(-1, -2))
        return np.where(finite, np.linalg.det(np.where(finite[..., None, None], matrix, 0.0)), np.nan)

    @cached_property
    def matrix(self) -> FloatArray:
        """J = Jp^-1 Jq (..., k, n), with v = J qdot; NaN where `singular_output` or `no_rates`.

        With redundant inputs the pseudoinverse of K = Jq^-1 Jp, with K v = qdot: v at rates that belong together.
        """
        if self.record.redundant_inputs:
            unknown = self.singular_output | self.no_rates
            return _solve(_solve(self.jq, self.jp, unknown | self.singular_input), np.eye(self.jq.shape[-1]), unknown)
        return _solve(self.jp, self.jq, self.singular_output | self.no_rates)

    @cached_property
    def velocity_factors(self) -> FloatArray:
        """Singular values of J_L (..., min(k, n)), largest first: how much faster than inputs; NaN where singular.

        Where all inputs have one unit and all rates have one unit J_L is J, and they have a unit, as mm/rad; elsewhere
        lengths are divided by `length`, and they have none.
        """
        unknown = self.singular_output | self.no_rates | ~self.exists
        safe = np.where(unknown[..., None, None], 0.0, scaled(self.record, self.matrix, self.length))
        factors: FloatArray = np.linalg.svd(safe, compute_uv=False)
        return np.where(unknown[..., None], np.nan, factors)

    @cached_property
    def condition(self) -> FloatArray:
        """Condition number (...) of J_L in the 2-norm; inf where Jp or Jq is singular, NaN where it does not exist.

        The quotient of the largest and the smallest velocity factor, and one over the local condition index.
        """
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = self.velocity_factors[..., 0] / self.velocity_factors[..., -1]
        return np.where(self.singular_output | self.singular_input, np.inf, ratio)

    def output(self, input_rates: ArrayLike) -> FloatArray:
        """Rates v (..., k) of the pose at input rates (..., n); NaN where `singular_output`.

        >>> import assur
        >>> velocities = assur.load("fivebar").velocity_map([0.0, 224.0])
        >>> velocities.output(velocities.input([1.0, 2.0])).round(9).tolist()
        [1.0, 2.0]
        """
        rates = np.asarray(input_rates, dtype=float)
        product: FloatArray = (self.matrix @ rates[..., None])[..., 0]
        return product

    def input(self, output_rates: ArrayLike) -> FloatArray:
        """Input rates (..., n) at pose rates v (..., k); NaN where `singular_input`.

        >>> import assur
        >>> velocities = assur.load("fivebar").velocity_map([0.0, 224.0])  # symmetric: upwards the cranks turn alike
        >>> float(velocities.input([0.0, 1.0]).sum()).__round__(9) + 0.0
        0.0
        """
        rates = np.asarray(output_rates, dtype=float)
        return _solve(self.jq, self.jp @ rates[..., None], self.singular_input)[..., 0]


def velocity_map(record: MechanismRecord, poses: ArrayLike, mode: str | None = None) -> VelocityMap:
    """The velocity map at poses (..., m) in a working mode (the file's default where none is given).

    Example: moving all three inputs of the paper's mechanism at one speed moves the platform along Y.

    >>> from assur.model.registry import load_record
    >>> here = velocity_map(load_record("zeng2019"), [-15.4714, 9.6849, 456.3315])
    >>> here.output([1.0, 1.0, 1.0]).round(9) + 0.0
    array([0., 1., 0.])
    """
    given = border.checked_poses(record, poses)
    return velocity_map_of(mode_reading_at(record, mode, given), given.shape[:-1])


def velocity_map_of(read: ModeReading, batch: tuple[int, ...]) -> VelocityMap:
    """The velocity map of a reading in floats, of as many poses as a batch (...) has.

    >>> from assur.model.registry import load_record
    >>> here = velocity_map_of(mode_reading_at(load_record("zeng2019"), None, [[-15.4714, 9.6849, 456.3315]]), (1,))
    >>> here.output([1.0, 1.0, 1.0]).round(9) + 0.0
    array([[0., 1., 0.]])
    """
    return _velocity_map(read, batch, *read.jacobians)


def velocity_map_at(record: MechanismRecord, joints: Named) -> VelocityMap:
    """The velocity map at joint values (..., coordinates), or by name, from the joint graph alone: for any mechanism.

    Jp and Jq are those of `assur.kinematics.rates.instantaneous`: the same relation as a closed form's, in other rows.

    Example: at the same configuration as above all inputs at one speed move the platform along Y.

    >>> from assur.kinematics.position import inverse
    >>> from assur.model.registry import load_record
    >>> record = load_record("zeng2019")
    >>> found = inverse(record, [-15.4714, 9.6849, 456.3315], "++-++")
    >>> velocity_map_at(record, found.joints[0]).output([1.0, 1.0, 1.0]).round(9) + 0.0
    array([0., 1., 0.])
    """
    return VelocityMap.of(record, instantaneous(record, joints))


def printed_velocity_map(record: MechanismRecord, poses: ArrayLike, mode: str | None = None) -> VelocityMap:
    """The velocity map with Jp and Jq as the source prints them; where it divides by zero the rows are not finite."""
    form, given = closed_form_of(record), border.checked_poses(record, poses)
    if form.as_printed is None:
        raise UsageError(f"{record.name} has no printed Jacobian that differs from the regular one")
    read = mode_reading_at(record, mode, given)
    with np.errstate(divide="ignore", invalid="ignore"):
        jp, jq = form.as_printed(read.ns, kernel_dimensions(record), read.branch.core)
    return _velocity_map(read, given.shape[:-1], jp, jq)


def _input_signs(record: MechanismRecord) -> FloatArray:
    """d(joint value)/d(printed input), per input."""
    return np.array([driven.sign for driven in record.inputs])


def _velocity_map(read: ModeReading, batch: tuple[int, ...], jp: Sequence[Any], jq: Sequence[Any]) -> VelocityMap:
    record, sizes = read.record, read.relative_factors
    form = closed_form_of(record)
    count = int(np.prod(batch, dtype=int))
    zero = {name: np.broadcast_to(np.abs(size) <= FACTOR_TOLERANCE, (count,)) for name, size in sizes.items()}
    real = np.broadcast_to(read.exists, (count,))
    output = np.any([zero[factor.name] for factor in form.factor_list if factor.kind == "parallel"], axis=0)
    inputs = np.any([zero[factor.name] for factor in form.factor_list if factor.kind == "serial"], axis=0)
    exists = real.reshape(batch)
    return VelocityMap(
        record,
        np.where(exists[..., None, None], _matrix(jp, batch), np.nan),
        np.where(exists[..., None, None], _matrix(jq, batch) * _input_signs(record), np.nan),
        (np.asarray(output) & real).reshape(batch),
        (np.asarray(inputs) & real).reshape(batch),
        exists,
        np.zeros(batch, dtype=bool),
    )


def _matrix(rows: Sequence[Any], batch: tuple[int, ...]) -> FloatArray:
    """Rows of components (N,) as (..., r, k)."""
    count = int(np.prod(batch, dtype=int))
    matrix = np.empty((count, len(rows), len(rows[0])))
    for r, row in enumerate(rows):
        for k, entry in enumerate(row):
            matrix[:, r, k] = entry
    return matrix.reshape(*batch, len(rows), len(rows[0]))


def _solve(matrix: FloatArray, right: FloatArray, singular: NDArray[np.bool_]) -> FloatArray:
    """Solution of matrix X = right, by least squares where it is not square; NaN where `singular`."""
    mask = singular[..., None, None] | ~np.all(np.isfinite(matrix), axis=(-1, -2), keepdims=True)
    safe = np.where(mask, np.eye(*matrix.shape[-2:]), matrix)
    given = np.where(mask, 0.0, right)
    square = matrix.shape[-2] == matrix.shape[-1]
    solved = np.linalg.solve(safe, given) if square else np.linalg.pinv(safe) @ given
    return np.where(mask, np.nan, solved)
