"""The joint graph with its platform held: how joints follow the pose, what is singular, whether branches merge between.

Joint values change by the smallest rates T v at rates v of the pose for which the loops stay closed. The columns of T
span what motions leave the loops closed, those that leave the platform at rest excepted.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.following.course import Prescribed
from assur.kinematics.newton import Newton
from assur.kinematics.newton_step import NewtonStep
from assur.kinematics.pose import pose_of
from assur.kinematics.rates.motions import input_units
from assur.kinematics.turns import joint_units
from assur.model.mechanism import MechanismRecord
from assur.numerics.newton import damped

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
RESTS = 1e-3
"""Rate of an input per rate of the pose, without dimensions, below which the input counts as resting."""


@dataclass(frozen=True, eq=False)
class PlatformHeld:
    """Joint rates at assemblies.

    Attributes:
        record: the mechanism.
        rates: T (N, n, k), without dimensions; a ball joint's are its angular velocity in the parent's frame.
    """

    record: MechanismRecord
    rates: FloatArray

    @cached_property
    def inputs(self) -> FloatArray:
        """Rates (N, F, k) of the printed inputs per rate of the pose, without dimensions: Jq^-1 Jp."""
        driven = list(self.record.input_indices)
        signs = np.array([item.sign for item in self.record.inputs])
        own = signs * joint_units(self.record)[driven] / input_units(self.record)
        return np.asarray(self.rates[:, driven, :] * own[:, None])

    @cached_property
    def serial(self) -> FloatArray:
        """Square (N,) of the sine that vanishes where joints must move infinitely fast: two branches merge.

        It falls to zero linearly towards the border of what a working mode reaches.
        """
        largest = np.linalg.svd(self.rates, compute_uv=False)[..., 0]
        return np.asarray(1.0 / (1.0 + largest**2))

    @cached_property
    def output(self) -> FloatArray:
        """The determinant (N,) of Jp with rows of length 1, one per input, for det Jq > 0; NaN where not square.

        Rows of (Jp, -Jq) may be multiplied by anything. With these the determinant runs evenly up to where an element
        of Jq vanishes and on from there; where an input rests (`RESTS`) it falls to zero with its row.
        """
        if self.inputs.shape[-1] != self.inputs.shape[-2]:
            return np.full(len(self.inputs), np.nan)
        size = np.sqrt(np.sum(self.inputs**2, axis=-1, keepdims=True) + RESTS**2)
        return np.asarray(np.linalg.det(self.inputs / size))


def platform_held(record: MechanismRecord, values: FloatArray) -> PlatformHeld:
    """Joint rates at assemblies (N, n).

    Example: the determinant of Jp for rows of length 1, as the null space of the closure gives Jp.

    >>> from assur.kinematics.home import home_values
    >>> from assur.kinematics.rates.instantaneous import instantaneous
    >>> from assur.kinematics.rates.motions import pose_units
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> home = home_values(record)[None]
    >>> there = instantaneous(record, home)
    >>> rows = np.linalg.solve(there.jq, there.jp * pose_units(record))
    >>> wanted = np.linalg.det(rows / np.linalg.norm(rows, axis=-1, keepdims=True))
    >>> bool(np.abs(platform_held(record, home).output - wanted)[0] < 1e-6)
    True
    """
    return PlatformHeld(record, holding(record, "poses").rates(values, pose_of(record, values)))


@lru_cache(maxsize=64)
def holding(record: MechanismRecord, held: Prescribed) -> Newton:
    """Newton's method with the platform or the inputs held."""
    step = NewtonStep((), record.platform.pose) if held == "poses" else NewtonStep(record.input_indices)
    return Newton(record, step, joint_units(record))


def passes_zero(before: FloatArray, after: FloatArray) -> BoolArray:
    """Whether two branches merge (N,) between near assemblies with T `before` and `after` (N, n, k).

    Where they merge the rates grow beyond bounds and come back from the other side: with T = N / (M N), N the motions
    that keep the loops closed and M what they do to the platform, det(T1' T2) has the sign of det(M N1) det(M N2). It
    tells an odd number of singular values of M N that pass zero. Where the closure passes, T runs on evenly: the branch
    goes on through a constraint singularity, and none has merged.

    >>> rates = np.array([[[1.0, 0.0], [0.0, 1.0], [0.5, 0.5]]])
    >>> passes_zero(rates, 1.1 * rates).tolist(), passes_zero(rates, rates * [1.0, -1.0]).tolist()
    ([False], [True])
    """
    # damped for poses with more coordinates than freedoms, whose T is not of full rank
    sign, _ = np.linalg.slogdet(damped(np.swapaxes(before, -1, -2) @ after, before))
    return np.asarray(sign < 0.0)
