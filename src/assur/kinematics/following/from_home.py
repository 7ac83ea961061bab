"""Poses that home's working mode reaches: many at once, each along the straight way from home, or by its neighbours."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.following.neighbours import SignGuard, steps_at, working_signs
from assur.kinematics.following.stepping import Pace, followed
from assur.kinematics.following.ways import Straight, pose_change
from assur.kinematics.home import home_values
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
    home, count = home_values(record), len(poses)
    begun = steps_at(SignGuard(record, working_signs(record, home)), pose_of(record, home[None]), home[None])
    begun = begun.of(np.zeros(count, dtype=np.intp))
    here, pace = begun.places, Pace(least, most=MOST)
    reached = followed(Straight(record, begun.poses, poses), here, begun.guard, pace, np.full(count, FIRST))
    here.joints[~reached] = np.nan
    return here.joints, reached


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
    guard = SignGuard(record, working_signs(record, home_values(record)))
    joints = np.full((len(poses), len(record.coordinates)), np.nan)
    reached = np.zeros(len(poses), dtype=bool)
    seeds = np.arange(0, len(poses), APART)
    joints[seeds], reached[seeds] = followed_from_home(record, poses[seeds])
    distance = np.linalg.norm(pose_change(record, poses[:-1], poses[1:]), axis=1)
    adjacent = distance <= WIDE * np.median(distance) if len(distance) else np.zeros(0, dtype=bool)
    begun = seeds[reached[seeds]]
    for sense in (1, -1):
        front, steps = begun, steps_at(guard, poses[begun], joints[begun])
        for _ in range(APART - 1):
            heads = front + sense
            inside = (heads >= 0) & (heads < len(poses))
            onward = np.zeros(len(front), dtype=bool)
            onward[inside] = ~reached[heads[inside]] & adjacent[np.minimum(front, heads)[inside]]
            if not np.any(onward):
                break
            heads = heads[onward]
            steps, good = steps.of(onward).to(poses[heads])
            front, steps = heads[good], steps.of(good)
            joints[front], reached[front] = steps.places.joints, True
    left = np.flatnonzero(~reached & ~np.isin(np.arange(len(poses)), seeds))
    joints[left], reached[left] = followed_from_home(record, poses[left], COARSE)
    return joints, reached
