"""Steps along ways: foreseen, corrected, and taken where a guard allows it; else made shorter, down to the tolerance.

This is the one loop that follows and the one control of its steps. What varies is the way's
(`assur.kinematics.following.ways`), what must not be passed is the guard's.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.following.ways import Way
from assur.numerics.newton import CLOSED, corrected

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IntArray = NDArray[np.intp]
OwnWay = TypeVar("OwnWay", bound=Way)
GuardedWay = TypeVar("GuardedWay", bound=Way, contravariant=True)

CLEAR = 10.0
"""In so many tolerances from the start steps may be shorter."""

ROUNDED = 1.01
"""A step counts as the shortest where rounding of the shares makes it a little longer."""


@dataclass(frozen=True, eq=False)
class Places:
    """Assemblies on N ways.

    Attributes:
        shares: (N,) of the ways.
        joints: (N, n) joint values.
        known: (N, ..) what guards know of the first-order motion there, D (N, r, n) or rates (N, n, k).
    """

    shares: FloatArray
    joints: FloatArray
    known: FloatArray

    def of(self, rows: IntArray | BoolArray) -> Places:
        """Those on some of the ways, which may repeat; these themselves where all are told true."""
        if rows.dtype == np.bool_ and np.all(rows):
            return self
        return Places(self.shares[rows], self.joints[rows], self.known[rows])

    def put(self, rows: IntArray | BoolArray, others: Places) -> None:
        """Others in the place of some."""
        self.shares[rows], self.joints[rows], self.known[rows] = others.shares, others.joints, others.known


@dataclass(frozen=True, eq=False)
class TriedStep:
    """A step that was tried on N ways.

    Attributes:
        places: where it ends, the nearest approach where the loops stay open.
        closed: (N,) whether they close.
        residual: (N,) the largest gap that was seen last.
        away: (N,) the correction, in rad and characteristic lengths.
    """

    places: Places
    closed: BoolArray
    residual: FloatArray
    away: FloatArray


class StepGuard(Protocol[GuardedWay]):
    """What allows steps, and how long the next ones may be."""

    def step(
        self, way: GuardedWay, places: Places, ends: FloatArray, rows: IntArray
    ) -> tuple[Places, BoolArray, FloatArray]:
        """Where steps from places (k,) on some ways to shares (k,), or to nearer ones, lead.

        Beside that which of them (k,) may be taken, and the steps (k,) that may follow these.
        """
        ...


@dataclass(frozen=True)
class Pace:
    """How long steps are, in shares of the way.

    Attributes:
        tolerance: the shortest that is tried.
        largest: the longest.
        leaving: share of the tolerance to which steps may go down in the first ten tolerances, where another path may
            have stopped.
        most: so many steps are tried on a way.
    """

    tolerance: float
    largest: float = 1.0
    leaving: float = 1.0
    most: float = np.inf

    def least(self, shares: FloatArray) -> FloatArray:
        """The shortest step (N,) at shares (N,)."""
        return self.tolerance * np.where(shares > CLEAR * self.tolerance, 1.0, self.leaving)

    def ends(self, shares: FloatArray, steps: FloatArray, end: float) -> FloatArray:
        """Shares (N,) after steps on ways up to an end, of which nothing is left that is too short to be gone."""
        ends = shares + np.minimum(steps, self.largest)
        return np.where(ends > end - 0.5 * self.least(shares), end, ends)


def followed(
    way: OwnWay, at: Places, guard: StepGuard[OwnWay], pace: Pace, steps: FloatArray, end: float = 1.0
) -> BoolArray:
    """Ways followed from `at`, which moves along them, by `steps` (N,), which change; which come to an end (N,)."""
    rows, made = np.flatnonzero(at.shares < end), 0
    while len(rows) and made < pace.most:
        now, asked, made = at.of(rows), steps[rows], made + 1
        places, good, after = guard.step(way, now, pace.ends(now.shares, asked, end), rows)
        gone, least = places.shares - now.shares, pace.least(now.shares)
        at.put(rows[good], places.of(good))
        steps[rows] = np.maximum(np.where(good, after, 0.5 * gone), least)
        shortest = ~good & (np.minimum(asked, gone) <= ROUNDED * least)
        rows = rows[~shortest & (at.shares[rows] < end)]
    return np.asarray(at.shares >= end)


def tried(
    way: Way, at: Places, ends: FloatArray, move: FloatArray, rows: IntArray, tolerance: float = CLOSED
) -> TriedStep:
    """Steps to shares (k,) by foreseen moves (k, n), without dimensions, and corrections of these."""
    size = way.units(float(ends[0]))
    foreseen = at.joints / size + move

    def system(values: FloatArray, some: IntArray) -> tuple[FloatArray, FloatArray]:
        return way.system(values * size, ends[some], rows[some])

    near = corrected(system, foreseen, tolerance)
    places = Places(ends, near.values * size, near.derivative)
    return TriedStep(places, near.closed, near.residual, np.linalg.norm(near.values - foreseen, axis=1))
