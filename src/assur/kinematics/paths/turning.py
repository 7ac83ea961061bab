"""Turning: where on a straight way of poses a working mode ends because it meets another branch and turns back.

Along the way the joints move ever faster towards such an end, and no step to a pose beyond it can close. With the
joint value that moves fastest to lead, and the share of the way to follow it, the curve runs smoothly through the
end, where the share is largest: its slope is brought to zero by the secant method, always from the near side.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.paths.locked import units
from assur.kinematics.paths.platform_held import PlatformHeld
from assur.kinematics.paths.ways import held_system
from assur.model.mechanism import MechanismRecord
from assur.numerics.newton import corrected, solved

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IntArray = NDArray[np.intp]
Way = Callable[[FloatArray, IntArray], FloatArray]
"""Shares (k,) of the way and row numbers (k,) to poses (k, m)."""

LONG = 0.3
"""Largest step of the leading joint value, in rad or characteristic lengths."""

NEARING = 0.95
"""Share of the foreseen way to the end that is gone at a time, so that the mode is not left."""

ENOUGH = 2e-3
"""Share of the way that may be left where the search ends; what a parabola leaves is added, so the error is smaller."""

ROUNDS = 12


@dataclass(frozen=True, eq=False)
class Turnings:
    """Where N ways turn back.

    Attributes:
        share: (N,) of the way at which it does.
        joints: (N, n) joint values a little before.
        matrix: D (N, r, n) there, as of `PlatformHeld`.
        found: (N,) whether it does so on the way, as far as was found; elsewhere the rest says nothing.
    """

    share: FloatArray
    joints: FloatArray
    matrix: FloatArray
    found: BoolArray


@dataclass(frozen=True, eq=False)
class _Points:
    """One point on each of N curves, without dimensions.

    Attributes:
        values: (N, n) joint values, but the share of the way in the place of the leading one.
        leading: (N,) the leading joint value.
        slopes: (N, n) derivatives of `values` by it.
        matrix: D (N, r, n).
    """

    values: FloatArray
    leading: FloatArray
    slopes: FloatArray
    matrix: FloatArray

    def of(self, rows: IntArray) -> _Points:
        return _Points(self.values[rows], self.leading[rows], self.slopes[rows], self.matrix[rows])

    def put(self, rows: IntArray, others: _Points) -> None:
        self.values[rows], self.leading[rows] = others.values, others.leading
        self.slopes[rows], self.matrix[rows] = others.slopes, others.matrix


@dataclass(frozen=True, eq=False)
class _Curves:
    """N curves of assemblies along ways: the change (N, k) of the pose over each, and which joint value (N,) leads."""

    record: MechanismRecord
    way: Way
    change: FloatArray
    lead: IntArray

    def moved(self, rows: IntArray, start: _Points, step: FloatArray) -> tuple[_Points, BoolArray]:
        """Points of some curves after steps (k,) of the leading joint value, and whether the loops close there."""
        leading = start.leading + step
        latest = start.matrix.copy()

        def system(values: FloatArray, some: IntArray) -> tuple[FloatArray, FloatArray]:
            joints, each = values.copy(), np.arange(len(some))
            lead = self.lead[rows[some]]
            joints[each, lead] = leading[some]
            poses = self.way(values[each, lead], rows[some])
            gaps, latest[some] = held_system(self.record, joints * units(self.record), poses)
            return gaps, self.led(rows[some], latest[some])

        found = corrected(system, start.values + step[:, None] * start.slopes)
        column = latest[np.arange(len(rows)), :, self.lead[rows]]
        slopes = -solved(found.derivative, column[..., None])[..., 0]
        return _Points(found.values, leading, slopes, latest), found.closed

    def led(self, rows: IntArray, matrix: FloatArray) -> FloatArray:
        """D (k, r, n) with the column of the leading joint value exchanged for that of the share."""
        result, size = matrix.copy(), self.change.shape[1]
        each, lead = np.arange(len(rows)), self.lead[rows]
        result[each, :, lead] = 0.0
        result[each, -size:, lead] = -self.change[rows]
        return result


def turnings(record: MechanismRecord, joints: FloatArray, held: PlatformHeld, change: FloatArray, way: Way) -> Turnings:
    """Where ways of poses from assemblies (N, n) turn back.

    Args:
        record: the mechanism.
        joints: assemblies (N, n) where the ways start.
        held: their first-order motion.
        change: (N, k) of the pose over each whole way, no dimensions; its rates are the same all along.
        way: the poses on them.

    Example: the five-bar straight up; its elbows straighten where P is 294 from both motors, 285.5 above them.

    >>> from assur.kinematics.home import home_values
    >>> from assur.kinematics.paths.platform_held import platform_held
    >>> from assur.kinematics.pose import pose_of
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> home = home_values(record)[None]
    >>> start = pose_of(record, home)
    >>> up = np.array([[0.0, 100.0]])
    >>> found = turnings(
    ...     record, home, platform_held(record, home), up / 194.0, lambda share, rows: start[rows] + share[:, None] * up
    ... )
    >>> bool(found.found[0])
    True
    >>> float((start + found.share[:, None] * up)[0, 1].round(2)), round((294**2 - 70**2) ** 0.5, 2)
    (285.55, 285.55)
    """
    count, each = len(joints), np.arange(len(joints))
    curves, here = _started(record, joints, held, change, way)
    lead = curves.lead
    sense = np.where(here.slopes[each, lead] < 0.0, -1.0, 1.0)
    other = np.full((2, count), np.nan)  # leading value and slope of the share at another point, before or beyond
    going, shorter = np.ones(count, dtype=bool), np.ones(count)
    for _ in range(ROUNDS):
        ahead = _ahead(here.leading, here.slopes[each, lead], other, sense)
        going &= (np.abs(here.slopes[each, lead] * ahead) > ENOUGH) & (here.values[each, lead] < 1.0)
        rows = np.flatnonzero(going)
        if not len(rows):
            break
        new, closed = curves.moved(rows, here.of(rows), NEARING * shorter[rows] * ahead[rows])
        slope = new.slopes[np.arange(len(rows)), lead[rows]]
        before, beyond = closed & (slope * sense[rows] > 0.0), closed & (slope * sense[rows] <= 0.0)
        shorter[rows] = np.where(closed, 1.0, 0.3 * shorter[rows])
        other[:, rows[beyond]] = new.leading[beyond], slope[beyond]
        taken = rows[before]
        other[:, taken] = here.leading[taken], here.slopes[taken, lead[taken]]
        here.put(taken, new.of(np.flatnonzero(before)))
    ahead = _ahead(here.leading, here.slopes[each, lead], other, sense)
    left = 0.5 * here.slopes[each, lead] * ahead
    share = here.values[each, lead] + left
    values = here.values.copy()
    values[each, lead] = here.leading
    found = (np.abs(left) <= ENOUGH) & (share > 0.0) & (share < 1.0)
    return Turnings(share, values * units(record), here.matrix, found)


def _started(
    record: MechanismRecord, joints: FloatArray, held: PlatformHeld, change: FloatArray, way: Way
) -> tuple[_Curves, _Points]:
    """Which joint value leads on each way, and where it starts."""
    each = np.arange(len(joints))
    move = np.einsum("nij,nj->ni", held.rates, change)
    lead = np.argmax(np.abs(move), axis=1)
    speed = move[each, lead]
    speed = np.where(np.abs(speed) < 1e-12, 1e-12, speed)  # a way on which nothing moves never turns
    values, slopes = joints / units(record), move / speed[:, None]
    leading = values[each, lead]
    values[each, lead], slopes[each, lead] = 0.0, 1.0 / speed
    return _Curves(record, way, change, lead), _Points(values, leading, slopes, held.matrix.copy())


def _ahead(leading: FloatArray, slope: FloatArray, other: FloatArray, sense: FloatArray) -> FloatArray:
    """How far (N,) the leading joint value is from where the slope of the share vanishes, foreseen by the secant."""
    with np.errstate(divide="ignore", invalid="ignore"):
        foreseen = sense * slope * (other[0] - leading) / (slope - other[1])
        plain = 1.0 / np.abs(slope)
    known = np.isfinite(foreseen) & (foreseen > 0.0)
    return sense * np.minimum(np.where(known, foreseen, plain), LONG)
