"""Which coordinates say where a platform is: the first ones, as people write them, that its motions can all change."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from assur.model.pose import ANGLES, LENGTHS, QUATERNION, Pose

FloatArray = NDArray[np.float64]

ROWS = {"psi": 0, "theta": 1, "phi": 2, "x": 3, "y": 4, "z": 5}
"""The part of a twist (angular velocity, velocity of the point) that is each coordinate's rate at home."""

FAIR, GOOD = 0.05, 0.3
"""Shares of the best choice's least singular value: enough for a choice with more lengths, enough among its equals."""


def pose_for(twists: FloatArray, count: int, *, still: bool = False, turns: bool = False) -> Pose | None:
    """Coordinates for a platform with some freedoms; None where no choice of so many is independent.

    Args:
        twists: (6, n) platform's twists at home, one for each motion, lengths scaled to numbers.
        count: how many coordinates are required; six are x, y, z and a quaternion.
        still: whether the platform keeps its orientation, so that only x, y, z count.
        turns: whether its rotations are as many as its freedoms, so that angles come first: lengths come with them.

    >>> plane = np.eye(6)[:, [2, 3, 4]]
    >>> pose_for(plane, 3), pose_for(np.eye(6), 6)[2:4], pose_for(plane, 4)
    (('x', 'y', 'phi'), ('z', 'qw'), None)
    >>> about_a_point = np.vstack([np.eye(3), [[0, 1, 0], [-1, 0, 0], [0, 0, 0.5]]])
    >>> pose_for(about_a_point, 3), pose_for(about_a_point, 3, turns=True)
    (('x', 'y', 'z'), ('phi', 'theta', 'psi'))
    """
    if turns and (angles := pose_among(ANGLES, twists, count)):
        return angles
    return pose_among(LENGTHS if still else (*LENGTHS, *ANGLES), twists, count)


def pose_among(names: Sequence[str], twists: FloatArray, count: int) -> Pose | None:
    """The same, of some coordinates."""
    if count > len(names):
        return None
    choices = list(combinations(names, count))
    clear = [_clearance(twists, choice) for choice in choices]
    best = max(clear)
    if best < 1e-6:
        return None
    if count == len(ROWS):
        return (*LENGTHS, *QUATERNION)
    for lengths in range(len(LENGTHS), -1, -1):
        alike = [pair for pair in zip(choices, clear, strict=True) if len(set(pair[0]) & set(LENGTHS)) == lengths]
        most = max((value for _, value in alike), default=0.0)
        if most >= FAIR * best:
            return next(choice for choice, value in alike if value >= GOOD * most)
    return None


def _clearance(twists: FloatArray, choice: Pose) -> float:
    """Least singular value of the rates of some coordinates; 0 where they are dependent."""
    rows = twists[[ROWS[name] for name in choice]]
    return float(np.linalg.svd(rows, compute_uv=False)[-1]) if rows.shape[0] <= rows.shape[1] else 0.0
