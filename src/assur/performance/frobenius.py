"""The smooth condition index: that of the Frobenius norm with its exact gradient, for optimising.

With G = J_L J_L^T (J_L^T J_L where J_L has more rows than columns), r by r, and the singular values s_1 >= ... >= s_r

    c_F = r / (|J_L|_F |J_L^+|_F) = r / sqrt(tr G  tr G^-1),      c <= c_F <= r / (r - 2 + c + 1/c),

where c = s_r / s_1 is the index of the 2-norm: both are 1 at isotropy and 0 where J_L loses rank. But c has a kink
where the largest or the smallest singular values coincide, as at isotropy, and c_F a derivative wherever it is > 0:

    dc_F = -c_F/2 (tr dG / tr G  -  tr(G^-1 dG G^-1) / tr G^-1),  dJ = Jp^-1 (dJq - dJp J).

dJp and dJq come from dual numbers through the closed form, without a step size.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.kinematics import border
from assur.kinematics.closed_form.mode_reading import mode_reading
from assur.kinematics.rates.units import scaled
from assur.kinematics.rates.velocity import velocity_map
from assur.kinematics.status import closed_form_of
from assur.model.mechanism import MechanismRecord
from assur.model.pose import QUATERNION, has_quaternion, is_angle, rate_names
from assur.numerics import rotations
from assur.numerics.dual import Dual, Duals
from assur.performance.scaling import Length, chosen_length

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class SmoothCondition:
    """The Frobenius condition index at poses (...) and its gradient.

    Attributes:
        value: (...) c_F; NaN where the pose is out of reach or Jp is singular, 0 where Jq is.
        gradient: (..., k) along the rates of the pose (`assur.model.pose.rate_names`), per length unit or rad; for a
            quaternion along rotations about the base's axes. NaN where `value` is not positive.
        length: the characteristic length that was held, None where none is.
    """

    value: FloatArray
    gradient: FloatArray
    length: float | None


def smooth_condition(
    record: MechanismRecord, poses: ArrayLike, mode: str | None = None, characteristic_length: Length = None
) -> SmoothCondition:
    """c_F and its gradient at poses (..., m) in a working mode (the file's default), by the closed form.

    Errors:
        UsageError: no closed form, a length that is none, poses of the wrong shape, an unknown mode.

    Example: in the middle of the Orthoglide all is isotropic, and the index cannot grow there.

    >>> from assur.model.registry import load_record
    >>> here = smooth_condition(load_record("orthoglide"), [0.0, 0.0, 0.0])
    >>> float(here.value.round(9)), bool(np.abs(here.gradient).max() < 1e-12)
    (1.0, True)
    """
    closed_form_of(record)
    given = border.checked_poses(record, poses)
    flat = given.reshape(-1, given.shape[-1])
    here = velocity_map(record, flat, mode)
    length = chosen_length(record, characteristic_length, here.matrix)
    known = np.all(np.isfinite(here.matrix), axis=(-1, -2)) & here.exists
    regular = np.flatnonzero(known & ~here.singular_input)
    components = _moving(record, flat[regular])
    jp, jq = mode_reading(record, mode, components, Duals()).jacobians
    size = (len(rate_names(record.platform.pose)), len(regular))
    signs = np.array([item.sign for item in record.inputs])
    matrix = here.matrix[regular]
    change = np.linalg.solve(here.jp[regular], _slopes(jq, size) * signs - _slopes(jp, size) @ matrix)  # (k, N, k, n)
    value, gradient = np.where(known, 0.0, np.nan), np.full((len(flat), size[0]), np.nan)
    value[regular], gradient[regular] = _index(scaled(record, matrix, length), scaled(record, change, length))
    batch = given.shape[:-1]
    return SmoothCondition(value.reshape(batch), gradient.reshape(*batch, size[0]), length)


def _index(matrix: FloatArray, change: FloatArray) -> tuple[FloatArray, FloatArray]:
    """c_F (N,) of matrices (N, k, n) and its derivatives (N, d) along changes (d, N, k, n)."""
    if matrix.shape[-2] > matrix.shape[-1]:
        matrix, change = np.swapaxes(matrix, -1, -2), np.swapaxes(change, -1, -2)
    gram = matrix @ np.swapaxes(matrix, -1, -2)  # (N, r, r)
    inverse = np.linalg.inv(gram)
    moved = 2.0 * change @ np.swapaxes(matrix, -1, -2)  # (d, N, r, r): dG but for its antisymmetric part
    total, total_inverse = np.trace(gram, axis1=-2, axis2=-1), np.trace(inverse, axis1=-2, axis2=-1)
    value = matrix.shape[-2] / np.sqrt(total * total_inverse)
    first = np.trace(moved, axis1=-2, axis2=-1) / total
    second = np.trace(inverse @ moved @ inverse, axis1=-2, axis2=-1) / total_inverse
    return value, (-0.5 * value * (first - second)).T


def _moving(record: MechanismRecord, poses: FloatArray) -> tuple[Any, ...]:
    """The kernel's pose at poses (N, m), with derivatives (k, N) along the rates."""
    names = record.platform.pose
    values = border.pose_components(record, poses)
    rates = rate_names(names)
    ways = {name: np.zeros((len(rates), len(poses))) for name in names}
    for k, rate in enumerate(rates):
        if rate in ways:
            ways[rate][k] = 1.0
    if has_quaternion(names):
        quaternion = poses[:, [names.index(name) for name in QUATERNION]]
        for name, angular in zip(("wx", "wy", "wz"), np.eye(3), strict=True):
            slopes = rotations.quaternion_rates(quaternion, angular).T
            for part, slope in zip(QUATERNION, slopes, strict=True):
                ways[part][rates.index(name)] = slope
    return tuple(
        (Dual(value[0], -value[1] * ways[name]), Dual(value[1], value[0] * ways[name]))
        if is_angle(name)
        else Dual(value, ways[name])
        for name, value in zip(names, values, strict=True)
    )


def _slopes(rows: Any, size: tuple[int, int]) -> FloatArray:
    """Derivatives (d, N, r, k) of a matrix of components."""
    found = np.zeros((*size, len(rows), len(rows[0])))
    for r, row in enumerate(rows):
        for k, entry in enumerate(row):
            if isinstance(entry, Dual):
                found[:, :, r, k] = entry.derivative
    return found
