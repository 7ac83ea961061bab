"""The joints along a motion of the platform that is prescribed in time, the mode kept; where it leaves that or reach.

The poses at its moments are followed from the first on, straight from one to the next.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.border import checked_poses
from assur.kinematics.following.course import course
from assur.kinematics.following.following import follow
from assur.kinematics.following.path import WORDS, Path, Stop
from assur.kinematics.pose import pose_of
from assur.kinematics.rates.acceleration import joints_in_mode
from assur.kinematics.rates.motions import pose_units
from assur.machine.dynamics.departure import Departure, not_begun
from assur.machine.dynamics.prescribed_motion import PrescribedMotion
from assur.model.mechanism import MechanismRecord
from assur.model.pose import rate_names

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.intp]
STANDING = 1e-9
"""Moments between which no coordinate moves further, in characteristic lengths and rad, have the same joint values."""
FINER = 64
"""Into so many parts the time between two moments is divided to tell when a motion leaves."""


def followed_motion(
    record: MechanismRecord, motion: PrescribedMotion, mode: str | None, *, use_limits: bool = True
) -> tuple[FloatArray, Departure | None]:
    """Joint values (N, n) at the moments of a motion that begins in a working mode, or where it leaves.

    >>> from assur.machine.dynamics.prescribed_motion import harmonic
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> up = harmonic(record, [0, 200], [0, 100], 1.0)
    >>> _, departure = followed_motion(record, up, "-+")
    >>> departure.kind, round(departure.time, 3), round(float(np.arcsin(0.85545)), 3)
    ('serial', 1.026, 1.026)
    """
    start = checked_poses(record, motion.at(motion.times[:1])[0])
    first = joints_in_mode(record, start, mode)[0]
    if not np.all(np.isfinite(first)):
        return first[None], not_begun(record, float(motion.times[0]), start[0], mode)
    joints, path, time = _along(record, motion, motion.times, first, use_limits)
    if path.stopped is None:
        return joints, None
    between = np.searchsorted(motion.times, time, side="right") - 1
    finer = np.linspace(motion.times[between], motion.times[between + 1], FINER + 1)
    stopped = path.stopped
    _, path, nearer = _along(record, motion, finer, joints[between], use_limits)
    if path.stopped is not None:  # along the finer polyline; where that gets by, the coarse one tells
        stopped, time = path.stopped, nearer
    return joints, _departure(stopped, time)


def _along(
    record: MechanismRecord, motion: PrescribedMotion, times: FloatArray, first: FloatArray, use_limits: bool
) -> tuple[FloatArray, Path, float]:
    """Joint values at times (N,) from those of the first (n,) on, the path through the poses, and when it ends."""
    poses = checked_poses(record, motion.at(times)[0])
    kept = _apart(record, poses)
    if len(kept) == 1:
        kept = np.array([0, len(poses) - 1])
    path = follow(record, first, poses=poses[kept[1:]], use_limits=use_limits)
    way = course(record, "poses", pose_of(record, first), poses[kept[1:]])
    moments = np.concatenate([[times[0]], times[kept[1:]]])[: len(way.shares)]
    reached = np.searchsorted(way.shares, path.shares[-1], side="right")
    at = np.searchsorted(path.shares, way.shares[:reached])
    which = np.minimum(np.searchsorted(kept, np.arange(len(poses)), side="right") - 1, reached - 1)
    return path.joints[at[which]], path, float(np.interp(path.shares[-1], way.shares, moments))


def _apart(record: MechanismRecord, poses: FloatArray) -> IntArray:
    """Which of poses (N, m) are not where the last of these was; the first among them."""
    units = np.ones(poses.shape[1])
    if len(units) == len(rate_names(record.platform.pose)):
        units = pose_units(record)
    else:
        units[: len(units) - 4] = pose_units(record)[: len(units) - 4]
    scaled, kept = poses / units, [0]
    for place in range(1, len(poses)):
        if np.max(np.abs(scaled[place] - scaled[kept[-1]])) > STANDING:
            kept.append(place)
    return np.array(kept)


def _departure(stop: Stop, time: float) -> Departure:
    text = "; ".join([f"at {time:.6g} s it comes to {WORDS[stop.kind]}", *stop.reasons])
    return Departure(stop.kind, time, stop.pose, stop.quantity, stop.value, text)
