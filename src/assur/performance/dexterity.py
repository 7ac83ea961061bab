"""Dexterity: how evenly the inputs move the platform, from the singular values of J = Jp^-1 Jq.

The local condition index is 1 / cond2(J), between 0 (singular) and 1 (isotropic); its mean over a region
is the global one, eta = int (1 / cond2(J)) dW / int dW (Gosselin and Angeles 1991). Where inputs or pose
coordinates mix lengths and angles the singular values mix units, and only their zeros mean anything.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UsageError
from assur.kinematics import border
from assur.kinematics.position import inverse
from assur.kinematics.status import Status
from assur.kinematics.velocity import velocity_map
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
BLOCK = 2**15
CELLS = 32


class Region(Protocol):
    """What a mean needs of a region, whatever made it."""

    @property
    def mode(self) -> str:
        """Working mode."""

    def interior(self, cells: int) -> FloatArray:
        """Points (N, m) of equal weight that fill it, of `cells` along each coordinate."""


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

    def to_json(self) -> dict[str, Any]:
        """Plain numbers, with None for what does not exist."""
        return {
            "poses": self.poses.tolist(),
            "status": np.vectorize(lambda code: Status(code).name, otypes=[object])(self.status).tolist(),
            "condition_index": _nullable(self.condition_index),
            "velocity_factors": _nullable(self.velocity_factors),
        }


@dataclass(frozen=True)
class GlobalIndex:
    """Mean of the local condition index over a region.

    Attributes:
        value: the mean; None where the region holds no point.
        error: estimate of its error, the difference to half the resolution; None where that has no point.
        points: how many points the mean is taken over.
        singular: how many of the points were left out because Jp is singular there.
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
    given = border.checked(poses, record.platform.pose, f"pose of {record.name}")
    flat = given.reshape(-1, given.shape[-1])
    parts = [_block(record, flat[start : start + BLOCK], mode) for start in range(0, max(1, len(flat)), BLOCK)]
    status, index, factors = (np.concatenate(column) for column in zip(*parts, strict=True))
    batch = given.shape[:-1]
    return Dexterity(given, status.reshape(batch), index.reshape(batch), factors.reshape(*batch, -1))


def global_condition_index(record: MechanismRecord, region: Region, cells: int = CELLS) -> GlobalIndex:
    """Mean of the local condition index over a region, by the midpoint rule with `cells` along each coordinate.

    >>> from assur.model.registry import load_record
    >>> from assur.workspace.region import workspace
    >>> record = load_record("zeng2019")
    >>> found = global_condition_index(record, workspace(record, resolution=16), cells=16)
    >>> 0.0 < found.value < 1.0 and found.error < 0.05 * found.value
    True
    """
    if isinstance(cells, bool) or not isinstance(cells, (int, np.integer)) or cells < 4:
        raise UsageError(f"cells: {cells!r} is not a whole number of at least 4")
    fine, points, singular = _mean(record, region, int(cells))
    coarse, _, _ = _mean(record, region, int(cells) // 2)
    error = None if fine is None or coarse is None else abs(fine - coarse)
    return GlobalIndex(fine, error, points, singular)


def _mean(record: MechanismRecord, region: Region, cells: int) -> tuple[float | None, int, int]:
    poses = region.interior(cells)
    found = dexterity(record, poses, region.mode)
    count = int(np.sum(found.defined))
    mean = float(np.mean(found.condition_index[found.defined])) if count else None
    return mean, count, len(poses) - count


def _block(
    record: MechanismRecord, poses: FloatArray, mode: str | None
) -> tuple[NDArray[np.int8], FloatArray, FloatArray]:
    status = inverse(record, poses, mode or record.modes.default_working).status[..., 0]
    here = velocity_map(record, poses, mode)
    missing = here.singular_output | (status == Status.unreachable) | (status == Status.undecided)
    factors = np.where(missing[:, None], np.nan, here.velocity_factors)
    # a J without any motion at all has index 0
    largest = np.where(factors[:, 0] == 0.0, 1.0, factors[:, 0])
    return status, factors[:, -1] / largest, factors


def _nullable(values: FloatArray) -> Any:
    return np.where(np.isfinite(values), values, None).tolist()
