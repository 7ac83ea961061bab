"""Poses that home's working mode reaches: many at once, each along the straight way from home, or by its neighbours."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.border import checked_poses
from assur.kinematics.home import home_values
from assur.kinematics.paths.neighbours import Steps, pose_change, working_signs
from assur.kinematics.paths.platform_held import platform_held
from assur.kinematics.pose import pose_of
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]

FIRST, LEAST = 2.0**-2, 2.0**-10
"""Share of the way of the first step, and of the shortest one that is tried."""
MOST = 100
"""Steps on a way, taken or not, at most."""
COARSE = 2.0**-5
"""The shortest step to a pose that its neighbours do not lead to: nearly all of these are out of reach."""
APART = 64
"""Of poses in a row every so many is followed to from home, which takes some ten times as long as from a neighbour."""
WIDE = 1.5
"""Poses that are apart by more than this times the median distance are no neighbours: a line of a grid ends there."""


def followed_from_home(
    record: MechanismRecord, poses: FloatArray, least: float = LEAST
) -> tuple[FloatArray, BoolArray]:
    """Assemblies of home's working mode at poses, each followed along the straight way of coordinates from home.

    A step is taken where the loops close, no joint moves far, the signs that name the mode stay and no two branches
    merge (`Steps`); else it is halved. What a pose gets depends on that pose alone. A pose that is not reached may be
    reached by another way: nothing is proved of it.

    Args:
        record: the mechanism.
        poses: (N, m) in lengths and rad, not by quaternions.
        least: share of the way of the shortest step that is tried.

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
        rows = rows[(share[rows] < 1.0) & (step[rows] >= least)]
    reached = share == 1.0
    joints[~reached] = np.nan
    return joints, reached


def followed_in_a_row(record: MechanismRecord, poses: FloatArray) -> tuple[FloatArray, BoolArray]:
    """As `followed_from_home`, of poses (N, m) that follow one another, as on the lines of a grid.

    Every `APART`-th is followed to from home, the others from their neighbours on both sides, and what is then left
    from home again. What a pose gets depends on the poses of the row alone.

    Example: the five-bar along a line, the last pose beyond its reach.

        >>> from assur.model.registry import load_record
        >>> line = np.stack([np.zeros(6), np.linspace(240.0, 290.0, 6)], axis=1)
        >>> followed_in_a_row(load_record("fivebar"), line)[1].tolist()
        [True, True, True, True, True, False]
    """
    signs = working_signs(record, home_values(record))
    joints = np.full((len(poses), len(record.coordinates)), np.nan)
    reached = np.zeros(len(poses), dtype=bool)
    seeds = np.arange(0, len(poses), APART)
    joints[seeds], reached[seeds] = followed_from_home(record, poses[seeds])
    distance = np.linalg.norm(pose_change(record, poses[:-1], poses[1:]), axis=1)
    adjacent = distance <= WIDE * np.median(distance) if len(distance) else np.zeros(0, dtype=bool)
    for sense in (1, -1):
        front = seeds
        for _ in range(APART - 1):
            heads = front + sense
            inside = (heads >= 0) & (heads < len(poses))
            front, heads = front[inside], heads[inside]
            onward = reached[front] & ~reached[heads] & adjacent[np.minimum(front, heads)]
            front, heads = front[onward], heads[onward]
            if not len(front):
                break
            steps = Steps(record, signs, joints[front], poses[front], platform_held(record, joints[front]))
            values, good = steps.to(poses[heads])
            joints[heads[good]], reached[heads[good]] = values[good], True
            front = heads[good]
    left = np.flatnonzero(~reached & ~np.isin(np.arange(len(poses)), seeds))
    joints[left], reached[left] = followed_from_home(record, poses[left], COARSE)
    return joints, reached


def _on_the_way(record: MechanismRecord, start: FloatArray, poses: FloatArray, share: FloatArray) -> FloatArray:
    """Poses (N, m) at shares (N,) of the ways; at the end the very poses."""
    between = start + share[:, None] * (poses - start)
    return checked_poses(record, np.where(share[:, None] == 1.0, poses, between))
