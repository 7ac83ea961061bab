"""Indices over a whole region: means and extremes, and how much of the region transmits motion and force well.

A mean is int f dW / int dW over the region W, as the global condition index of Gosselin and Angeles (1991). The
good-transmission workspace is where the local transmission index is at least 0.7 (Wang, Wu and Liu 2010). Points are
quasi-random, in eight shifts by chance; from the spread of the eight comes every error.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.model.mechanism import MechanismRecord
from assur.performance.indices import INDICES, Indices, indices, indices_at
from assur.performance.scaling import Length
from assur.results.answers.indices import OverallIndex, Share
from assur.work import stage

FloatArray = NDArray[np.float64]
POINTS = 2**12
FINE = 2**15
"""Points of one mean alone."""

SHIFTS = 8
STUDENT = 2.365
"""95 % of Student's distribution lies within this for 7 degrees of freedom."""


class MeasuredRegion(Protocol):
    """What means need of a region, whatever made it."""

    @property
    def mode(self) -> str:
        """Working mode."""

    def interior(self, count: int, rng: np.random.Generator) -> FloatArray:
        """Poses (N, m) of equal weight inside it, of `count` spread over its box with a shift by chance."""

    def inside(self, count: int, rng: np.random.Generator) -> tuple[FloatArray, FloatArray | None]:
        """The same, and the joint values (N, n) there where they are known; else None, and poses are solved."""

    @property
    def volume(self) -> float:
        """Volume (area in a plane)."""

    @property
    def volume_error(self) -> float:
        """Estimate of its error."""

    @property
    def unit(self) -> str:
        """Unit of the volume."""


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


@dataclass(frozen=True)
class OverallIndices:
    """Every index over a region of one working mode.

    Attributes:
        mode: working mode.
        points: how many points were seen; 0 in an empty region, of which nothing is known.
        singular: at how many Jp is singular: the indices of J do not exist there.
        length, factor_unit: characteristic length and unit of a velocity factor, as in `Indices`.
        values: `OverallIndex` by the name of the index.
        good: the good-transmission workspace; None in an empty region.
    """

    mode: str
    points: int
    singular: int
    length: float | None
    factor_unit: str
    values: Mapping[str, OverallIndex]
    good: Share | None


@stage("indices over the workspace")
def overall(
    record: MechanismRecord,
    region: MeasuredRegion,
    count: int = POINTS,
    characteristic_length: Length = None,
    rng: np.random.Generator | None = None,
) -> OverallIndices:
    """Means and extremes of every index over a region, and its good-transmission part.

    Args:
        record: the mechanism.
        region: a workspace (`assur.workspace.region.workspace`).
        count: points spread over the region's box, in all.
        characteristic_length: as of `assur.performance.indices.indices`; "isotropic" is over the whole region.
        rng: where the shifts come from; a generator with a fixed seed where none is given.

    Errors:
        UsageError: too few points, a length that is none.

    Example: the tripteron is isotropic and transmits all, everywhere.

    >>> from assur.model.registry import load_record
    >>> from assur.workspace.region import workspace
    >>> record = load_record("tripteron")
    >>> found = overall(record, workspace(record, resolution=8), 512)
    >>> round(found.values["condition"].least, 9), found.good.share
    (1.0, 1.0)
    """
    poses, shift, joints = _points(region, count, rng)
    if not len(poses):
        return OverallIndices(region.mode, 0, 0, None, "", {}, None)
    at_points = _indices(record, region, poses, joints, characteristic_length)
    values = {name: _overall(at_points[name], poses, shift) for name in INDICES}
    return OverallIndices(
        mode=region.mode,
        points=len(poses),
        singular=int(np.sum(~np.isfinite(at_points["condition"]))),
        length=at_points.length,
        factor_unit=at_points.unit,
        values={name: value for name, value in values.items() if value is not None},
        good=_good(at_points, shift, region),
    )


def global_condition_index(
    record: MechanismRecord, region: MeasuredRegion, count: int = FINE, rng: np.random.Generator | None = None
) -> GlobalIndex:
    """Mean of the local condition index over a region: arguments and errors are as for `overall`.

    Example:
        >>> from assur.model.registry import load_record
        >>> from assur.workspace.region import workspace
        >>> record = load_record("zeng2019")
        >>> found = global_condition_index(record, workspace(record, resolution=16))
        >>> round(found.value, 2), found.error < 0.01
        (0.14, True)
    """
    poses, shift, joints = _points(region, count, rng)
    field = _indices(record, region, poses, joints)["condition"] if len(poses) else np.empty(0)
    known = np.isfinite(field)
    if not np.any(known):
        return GlobalIndex(None, None, 0, len(field))
    value, error = _mean(np.where(known, field, 0.0), known, shift)
    return GlobalIndex(value, error, int(np.sum(known)), int(np.sum(~known)))


def _points(
    region: MeasuredRegion, count: int, rng: np.random.Generator | None
) -> tuple[FloatArray, NDArray[np.intp], FloatArray | None]:
    """Poses (N, m) inside a region, which of the shifts each is of, and joint values (N, n) where they are known."""
    if isinstance(count, bool) or not isinstance(count, (int, np.integer)) or count < 16 * SHIFTS:
        raise UsageError(f"count: {count!r} is not a whole number of at least {16 * SHIFTS}")
    rng = rng or np.random.default_rng(20190719)
    shifts, known = zip(*(region.inside(int(count) // SHIFTS, rng) for _ in range(SHIFTS)), strict=True)
    joints = [part for part in known if part is not None]
    shift = np.repeat(np.arange(SHIFTS), [len(part) for part in shifts])
    return np.concatenate(shifts), shift, np.concatenate(joints) if len(joints) == SHIFTS else None


def _indices(
    record: MechanismRecord, region: MeasuredRegion, poses: FloatArray, joints: FloatArray | None, length: Length = None
) -> Indices:
    if joints is not None:
        return indices_at(record, joints, length)
    return indices(record, poses, region.mode, length)


def _overall(field: FloatArray, poses: FloatArray, shift: NDArray[np.int_]) -> OverallIndex | None:
    known = np.isfinite(field)
    if not np.any(known):
        return None
    mean, error = _mean(np.where(known, field, 0.0), known, shift)
    low, high = (int(np.argmin(np.where(known, sign * field, np.inf))) for sign in (1.0, -1.0))
    return OverallIndex(
        mean=mean,
        mean_error=error,
        least=float(field[low]),
        least_error=_beyond(field[known], shift[known]),
        least_at=tuple(poses[low].tolist()),
        most=float(field[high]),
        most_error=_beyond(-field[known], shift[known]),
        most_at=tuple(poses[high].tolist()),
    )


def _mean(field: FloatArray, counted: NDArray[np.bool_], shift: NDArray[np.int_]) -> tuple[float, float]:
    """Mean over the counted points, and half of its 95 % interval by the residuals of a ratio of means."""
    sums = np.bincount(shift, field * counted, SHIFTS)
    counts = np.bincount(shift, counted, SHIFTS)
    total = float(np.sum(counts))
    mean = float(np.sum(sums)) / total
    spread = float(np.std(sums - mean * counts, ddof=1)) * SHIFTS**0.5 / total
    return mean, STUDENT * spread


def _beyond(field: FloatArray, shift: NDArray[np.int_]) -> float:
    """How far below the least value that was seen the true one may lie: the jackknife's estimate for an extreme."""
    least = np.sort([np.min(field[shift == k], initial=np.inf) for k in range(SHIFTS)])
    return float((SHIFTS - 1) / SHIFTS * (least[1] - least[0])) if np.isfinite(least[1]) else float("nan")


def _good(indices: Indices, shift: NDArray[np.int_], region: MeasuredRegion) -> Share:
    good = indices.transmission.good.astype(float)
    share, error = _mean(good, np.ones(len(good), dtype=bool), shift)
    volume = share * region.volume
    return Share(share, error, volume, error * region.volume + share * region.volume_error, region.unit)
