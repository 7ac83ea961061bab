"""Trajectories: a way through waypoints, or a round about the pose that is shown, followed in one mode."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.kinematics.following.course import course
from assur.kinematics.following.following import follow
from assur.kinematics.following.path import Path
from assur.model.pose import LENGTHS
from assur.view import dials
from assur.view.explain import Reason, explain
from assur.view.snapshot import TOLERANCE, Snapshot

FloatArray = NDArray[np.float64]
CORNERS = 24
"""Vertices of a round."""

SHARE = 0.06
"""Its radius, as a share of the range of the coordinates."""

TRIES = 4
"""Where the round cannot be gone it is tried with half the radius, so often."""


@dataclass(frozen=True, eq=False, repr=False)
class Trajectory:
    """Configurations in the order of time.

    Attributes:
        shares: (N,) from 0 up, times as shares of the whole way that was wanted. joints: (N, n) joint values.
        reason: why it stops before its end; None where it does not.
    """

    shares: FloatArray
    joints: FloatArray
    reason: Reason | None

    @property
    def end(self) -> float:
        """The share at which it ends: 1 where nothing stops it."""
        return 1.0 if self.reason is None else float(self.shares[-1])

    def at(self, share: float) -> FloatArray:
        """Joint values (n,) of the configuration that is nearest in time; an assembly, never something between two."""
        return np.asarray(self.joints[int(np.argmin(np.abs(self.shares - share)))])


def through(snapshot: Snapshot, poses: Sequence[FloatArray]) -> Trajectory:
    """From what is shown straight from pose (m,) to pose, and back to the first.

    >>> from assur.model.registry import load_record
    >>> from assur.view.snapshot import start
    >>> here = start(load_record("fivebar"))
    >>> found = through(here, [here.pose + [20.0, 0.0]])
    >>> found.reason, bool(np.max(np.abs(found.at(1.0) - here.values)) < 1e-6)
    (None, True)
    """
    if not poses:
        raise UsageError("a trajectory needs a pose to go to", hint="keep one, or play the round")
    corners = np.array([*poses, snapshot.pose])
    step = 1.0 / (2 * len(corners))
    path = follow(snapshot.record, snapshot.values, poses=corners, tolerance=TOLERANCE, largest_step=step)
    return Trajectory(path.shares, path.joints, _reason(path, corners))


def _reason(path: Path, corners: FloatArray) -> Reason | None:
    """Why a path through corners (K, m) stops: what is said of the corner that it is on its way to."""
    if path.stopped is None:
        return None
    way = course(path.record, "poses", path.poses[0], corners)
    ahead = int(np.searchsorted(way.shares, path.stopped.share, side="right"))
    return explain(path, way.vertices[min(ahead, len(way.vertices) - 1)])


def around(snapshot: Snapshot) -> Trajectory:
    """A round about a point beside the pose that is shown, in its first two lengths; to and fro where there is one.

    >>> from assur.model.registry import load_record
    >>> from assur.view.snapshot import start
    >>> around(start(load_record("fivebar"))).reason is None
    True
    """
    sliders = dials.dials(snapshot.record)
    columns = [k for k, name in enumerate(snapshot.record.platform.pose) if name in LENGTHS][:2] or [0]
    size = SHARE * min(sliders[k].high - sliders[k].low for k in columns)
    angles = np.linspace(0.0, 2 * np.pi, CORNERS + 1)[1:-1]
    for radius in size * 0.5 ** np.arange(TRIES):
        poses = np.tile(snapshot.pose, (len(angles), 1))
        for column, wave in zip(columns, (np.sin(angles), 1 - np.cos(angles)), strict=False):
            poses[:, column] += radius * wave
        way = through(snapshot, list(poses))
        if way.reason is None:
            break
    return way
