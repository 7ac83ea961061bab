"""Dexterity: how evenly the inputs move the platform, from the singular values of J = Jp^-1 Jq.

The local condition index is 1 / cond2(J), between 0 (singular) and 1 (isotropic); its mean over a region
is the global one, eta = int (1 / cond2(J)) dW / int dW (Gosselin and Angeles 1991). Where inputs or pose
coordinates mix lengths and angles, lengths are divided by the characteristic length of the mechanism
(`assur.kinematics.rates.units`), as by `assur.performance.indices`, which takes other lengths too.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UsageError
from assur.kinematics import border
from assur.kinematics.position import branches_at
from assur.kinematics.rates.velocity import VelocityMap, velocity_map_at, velocity_map_of
from assur.kinematics.status import Status
from assur.model.mechanism import MechanismRecord
from assur.performance.indices import status_of

FloatArray = NDArray[np.float64]
BLOCK = 2**15
POINTS = 2**15
SHIFTS = 8
STUDENT = 2.365
"""95 % of Student's distribution lies within this for 7 degrees of freedom."""


class SampledRegion(Protocol):
    """What a mean needs of a region, whatever made it."""

    @property
    def mode(self) -> str:
        """Working mode."""

    def interior(self, count: int, rng: np.random.Generator) -> FloatArray:
        """Poses (N, m) of equal weight inside it, of `count` spread over its box with a shift by chance."""

    def inside(self, count: int, rng: np.random.Generator) -> tuple[FloatArray, FloatArray | None]:
        """The same, and the joint values (N, n) there where they are known; else None, and poses are solved."""


@dataclass(frozen=True, eq=False)
class Dexterity:
    """Dexterity at poses (..., m).

    Attributes:
        poses: (..., m).
        status: (...) `Status` of each pose in the working mode; it says why a number is missing.
        condition_index: (...) 1 / cond2(J); NaN where the pose is unreachable or Jp is singular.
        velocity_factors: (..., k) singular values of J, largest first: by how much the inputs' speed is
            multiplied in the fastest and in the slowest direction; NaN in the same places.
    """

    poses: FloatArray
    status: NDArray[np.int8]
    condition_index: FloatArray
    velocity_factors: FloatArray

    @property
    def defined(self) -> NDArray[np.bool_]:
        """Where (...) the numbers exist."""
        return np.isfinite(self.condition_index)


@dataclass(frozen=True)
class GlobalIndex:
    """Mean of the local condition index over a region.

    Attributes:
        value: the mean; None where the region holds no point.
        error: half of its 95 % interval, from eight independent shifts of the points; None without a value.
        points: how many points the mean is taken over.
        singular: how many points were left out because Jp is singular there.
    """

    value: float | None
    error: float | None
    points: int
    singular: int


def dexterity(record: MechanismRecord, poses: ArrayLike, mode: str | None = None) -> Dexterity:
    """Local condition index and velocity factors at poses (..., m) in a working mode (the file's default).

    Example: at the first pose of Table 1 of Zeng et al. 2019 that is right (row 3).

    >>> from assur.model.registry import load_record
    >>> here = dexterity(load_record("zeng2019"), [-15.4714, 9.6849, 456.3315])
    >>> bool(abs(here.condition_index - here.velocity_factors[-1] / here.velocity_factors[0]) < 1e-12)
    True
    """
    given = border.checked_poses(record, poses)
    flat = given.reshape(-1, given.shape[-1])
    parts = [_block(record, flat[start : start + BLOCK], mode) for start in range(0, max(1, len(flat)), BLOCK)]
    status, index, factors = (np.concatenate(column) for column in zip(*parts, strict=True))
    batch = given.shape[:-1]
    return Dexterity(given, status.reshape(batch), index.reshape(batch), factors.reshape(*batch, factors.shape[-1]))


def global_condition_index(
    record: MechanismRecord, region: SampledRegion, count: int = POINTS, rng: np.random.Generator | None = None
) -> GlobalIndex:
    """Mean of the local condition index over a region, by quasi-random points shifted eight times by chance.

    Args:
        record: the mechanism.
        region: a workspace (`assur.workspace.region.workspace`).
        count: points spread over the region's box, in all.
        rng: where the shifts come from; a generator with a fixed seed where none is given.

    Example:
        >>> from assur.model.registry import load_record
        >>> from assur.workspace.region import workspace
        >>> record = load_record("zeng2019")
        >>> found = global_condition_index(record, workspace(record, resolution=16))
        >>> round(found.value, 2), found.error < 0.01
        (0.14, True)
    """
    if isinstance(count, bool) or not isinstance(count, (int, np.integer)) or count < 16 * SHIFTS:
        raise UsageError(f"count: {count!r} is not a whole number of at least {16 * SHIFTS}")
    rng = rng or np.random.default_rng(20190719)
    found = [_of_region(record, *region.inside(int(count) // SHIFTS, rng), region.mode) for _ in range(SHIFTS)]
    sums = np.array([np.sum(part.condition_index[part.defined]) for part in found])
    counts = np.array([np.sum(part.defined) for part in found])
    total, missing = int(np.sum(counts)), int(sum(np.sum(~part.defined) for part in found))
    if total == 0:
        return GlobalIndex(None, None, 0, missing)
    value = float(np.sum(sums)) / total
    # standard error of a ratio of means, by its residuals
    spread = float(np.std(sums - value * counts, ddof=1)) * SHIFTS**0.5 / total
    return GlobalIndex(value, STUDENT * spread, total, missing)


def _of_region(record: MechanismRecord, poses: FloatArray, joints: FloatArray | None, mode: str) -> Dexterity:
    """As `dexterity`; where joint values (N, n) are known nothing is solved."""
    if joints is None:
        return dexterity(record, poses, mode)
    here = velocity_map_at(record, joints)
    return Dexterity(poses, status_of(here), *_condition(here, here.singular_output | ~here.exists))


def _block(
    record: MechanismRecord, poses: FloatArray, mode: str | None
) -> tuple[NDArray[np.int8], FloatArray, FloatArray]:
    solved = branches_at(record, poses, mode or record.modes.default_working)
    status, here = solved.status[..., 0], velocity_map_of(solved.reading, (len(poses),))
    missing = here.singular_output | (status == Status.unreachable) | (status == Status.undecided)
    return status, *_condition(here, missing)


def _condition(velocity: VelocityMap, missing: NDArray[np.bool_]) -> tuple[FloatArray, FloatArray]:
    """Condition indices (N,) and velocity factors (N, k), NaN where `missing`."""
    factors = np.where(missing[:, None], np.nan, velocity.velocity_factors)
    # a J without any motion at all has index 0
    largest = np.where(factors[:, 0] == 0.0, 1.0, factors[:, 0])
    return factors[:, -1] / largest, factors
