"""Turning: where on a straight way of poses a working mode ends because it meets another branch and turns back.

Along the way the joints move ever faster towards such an end, and no step to a pose beyond it can close. With the
joint value that moves fastest to lead, and the share of the way to follow it, the curve runs smoothly through the
end, where the share is largest: its slope is brought to zero by the secant method, always from the near side.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.following.stepping import Places, tried
from assur.kinematics.following.ways import Led, Way
from assur.numerics.newton import solved

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IntArray = NDArray[np.intp]
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
        located: (N,) whether it does so on the way, as far as was found; elsewhere the rest says nothing.
    """

    share: FloatArray
    joints: FloatArray
    located: BoolArray


def turnings(way: Way, joints: FloatArray) -> Turnings:
    """Where ways of poses from assemblies (N, n) turn back.

    Args:
        way: what the platform does, evenly over a share of it.
        joints: assemblies where the ways start.

    Example: the five-bar straight up; its elbows straighten where P is 294 from both motors, 285.5 above them.

    >>> from assur.kinematics.home import home_values
    >>> from assur.kinematics.following.ways import Straight
    >>> from assur.kinematics.pose import pose_of
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> home = home_values(record)[None]
    >>> start, up = pose_of(record, home), np.array([[0.0, 100.0]])
    >>> found = turnings(Straight(record, start, start + up), home)
    >>> bool(found.located[0])
    True
    >>> float((start + found.share[:, None] * up)[0, 1].round(2)), round((294**2 - 70**2) ** 0.5, 2)
    (285.55, 285.55)
    """
    rows = np.arange(len(joints))
    curves, here = _started(way, joints, rows)
    slopes = _slopes(here.known)
    sense = np.where(slopes[:, -1] < 0.0, -1.0, 1.0)
    other = np.full((2, len(rows)), np.nan)  # leading value and slope of the share at another point, before or beyond
    going, shorter = np.ones(len(rows), dtype=bool), np.ones(len(rows))
    for _ in range(ROUNDS):
        ahead = _ahead(here.shares, slopes[:, -1], other, sense)
        going &= (np.abs(slopes[:, -1] * ahead) > ENOUGH) & (here.joints[:, -1] < 1.0)
        rows = np.flatnonzero(going)
        if not len(rows):
            break
        step = NEARING * shorter[rows] * ahead[rows]
        trial = tried(curves, here.of(rows), here.shares[rows] + step, step[:, None] * slopes[rows], rows)
        after = _slopes(trial.places.known)
        before = trial.closed & (after[:, -1] * sense[rows] > 0.0)
        beyond, taken = trial.closed & ~before, rows[before]
        shorter[rows] = np.where(trial.closed, 1.0, 0.3 * shorter[rows])
        other[:, rows[beyond]] = trial.places.shares[beyond], after[beyond, -1]
        other[:, taken] = here.shares[taken], slopes[taken, -1]
        here.put(taken, trial.places.of(before))
        slopes[taken] = after[before]
    left = 0.5 * slopes[:, -1] * _ahead(here.shares, slopes[:, -1], other, sense)
    share = here.joints[:, -1] + left
    return Turnings(share, here.joints[:, :-1], (np.abs(left) <= ENOUGH) & (share > 0.0) & (share < 1.0))


def _started(way: Way, joints: FloatArray, rows: IntArray) -> tuple[Led, Places]:
    """Ways that are led by the joint value that moves fastest on each, and where they start."""
    start = np.zeros(len(rows))
    matrix = way.system(joints, start, rows)[1]
    move = -solved(matrix, way.gaps(joints, start, start + 1.0, rows)[..., None])[..., 0]
    curves = Led(way, np.argmax(np.abs(move), axis=1))
    leading = (joints / way.units(0.0))[rows, curves.lead]
    unknowns = np.concatenate([joints, start[:, None]], axis=1)
    return curves, Places(leading, unknowns, curves.bordered(matrix, joints, rows))


def _slopes(matrix: FloatArray) -> FloatArray:
    """Derivatives (N, n + 1) of joint values and share by the leading joint value, without dimensions."""
    ahead = np.zeros((*matrix.shape[:2], 1))
    ahead[:, -1] = 1.0
    return solved(matrix, ahead)[..., 0]


def _ahead(leading: FloatArray, slope: FloatArray, other: FloatArray, sense: FloatArray) -> FloatArray:
    """How far (N,) the leading joint value is from where the slope of the share vanishes, foreseen by the secant."""
    with np.errstate(divide="ignore", invalid="ignore"):
        foreseen = sense * slope * (other[0] - leading) / (slope - other[1])
        plain = 1.0 / np.abs(slope)
    known = np.isfinite(foreseen) & (foreseen > 0.0)
    return sense * np.minimum(np.where(known, foreseen, plain), LONG)
