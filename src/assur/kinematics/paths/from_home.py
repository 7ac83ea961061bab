"""Poses that home's working mode reaches along the straight way from home: many at once, each by its own way."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.border import checked_poses
from assur.kinematics.home import home_values
from assur.kinematics.paths.neighbours import Steps, working_signs
from assur.kinematics.paths.platform_held import platform_held
from assur.kinematics.pose import pose_of
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]

FIRST, LEAST = 2.0**-2, 2.0**-10
"""Share of the way of the first step, and of the shortest one that is tried."""
MOST = 100
"""Steps on a way, taken or not, at most."""


def followed_from_home(record: MechanismRecord, poses: FloatArray) -> tuple[FloatArray, BoolArray]:
    """Assemblies of home's working mode at poses, each followed along the straight way of coordinates from home.

    A step is taken where the loops close, no joint moves far, the signs that name the mode stay and no two branches
    merge (`Steps`); else it is halved. What a pose gets depends on that pose alone. A pose that is not reached may be
    reached by another way: nothing is proved of it.

    Args:
        record: the mechanism.
        poses: (N, m) in lengths and rad, not by quaternions.

    Returns:
        joint values (N, n), NaN where the way ended before, and whether a pose was reached (N,).

    Example: the five-bar, up to where its elbows straighten, and beyond.

        >>> from assur.model.registry import load_record
        >>> _, reached = followed_from_home(load_record("fivebar"), np.array([[0.0, 280.0], [0.0, 290.0]]))
        >>> reached.tolist()
        [True, False]
    """
    home = home_values(record)
    start, signs = pose_of(record, home), working_signs(record, home)
    joints = np.tile(home, (len(poses), 1))
    share, step = np.zeros(len(poses)), np.full(len(poses), FIRST)
    rows = np.arange(len(poses))
    for _ in range(MOST):
        if not len(rows):
            break
        ahead = np.minimum(share[rows] + step[rows], 1.0)
        before, after = (_on_the_way(record, start, poses[rows], part) for part in (share[rows], ahead))
        steps = Steps(record, signs, joints[rows], before, platform_held(record, joints[rows]))
        values, good = steps.to(after)
        joints[rows[good]], share[rows[good]] = values[good], ahead[good]
        step[rows] *= np.where(good, 2.0, 0.5)
        rows = rows[(share[rows] < 1.0) & (step[rows] >= LEAST)]
    reached = share == 1.0
    joints[~reached] = np.nan
    return joints, reached


def _on_the_way(record: MechanismRecord, start: FloatArray, poses: FloatArray, share: FloatArray) -> FloatArray:
    """Poses (N, m) at shares (N,) of the ways; at the end the very poses."""
    between = start + share[:, None] * (poses - start)
    return checked_poses(record, np.where(share[:, None] == 1.0, poses, between))
