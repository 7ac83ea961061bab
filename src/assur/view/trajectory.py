"""Trajectories: a way through poses that were kept, or a round about the pose that is shown, followed in one mode."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.kinematics.paths.following import follow
from assur.model.pose import LENGTHS
from assur.view import dials
from assur.view.explain import Reason, explain
from assur.view.state import TOLERANCE, State

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
        shares: (N,) from 0 to 1, times. joints: (N, n) joint values.
        reason: why it stops early; None where it does not.
    """

    shares: FloatArray
    joints: FloatArray
    reason: Reason | None

    def at(self, share: float) -> FloatArray:
        """Joint values (n,) of the configuration that is nearest in time; an assembly, never something between two."""
        return np.asarray(self.joints[int(np.argmin(np.abs(self.shares - share)))])


def through(state: State, poses: Sequence[FloatArray]) -> Trajectory:
    """From the state that is shown straight from pose (m,) to pose, and back to the first.

    >>> from assur.model.registry import load_record
    >>> from assur.view.state import start
    >>> here = start(load_record("fivebar"))
    >>> found = through(here, [here.pose + [20.0, 0.0]])
    >>> found.reason, bool(np.max(np.abs(found.at(1.0) - here.values)) < 1e-6)
    (None, True)
    """
    if not poses:
        raise UsageError("a trajectory needs a pose to go to", hint="keep one, or play the round")
    corners = np.array([*poses, state.pose])
    path = follow(state.record, state.values, poses=corners, tolerance=TOLERANCE, largest_step=1.0 / (2 * len(corners)))
    return Trajectory(path.shares / max(float(path.shares[-1]), 1e-300), path.joints, explain(path, corners[-1]))


def around(state: State) -> Trajectory:
    """A round about a point beside the pose that is shown, in its first two lengths; to and fro where there is one.

    >>> from assur.model.registry import load_record
    >>> from assur.view.state import start
    >>> around(start(load_record("fivebar"))).reason is None
    True
    """
    found = dials.dials(state.record)
    columns = [k for k, name in enumerate(state.record.platform.pose) if name in LENGTHS][:2] or [0]
    size = SHARE * min(found[k].high - found[k].low for k in columns)
    angles = np.linspace(0.0, 2 * np.pi, CORNERS + 1)[1:-1]
    for radius in size * 0.5 ** np.arange(TRIES):
        poses = np.tile(state.pose, (len(angles), 1))
        for column, wave in zip(columns, (np.sin(angles), 1 - np.cos(angles)), strict=False):
            poses[:, column] += radius * wave
        way = through(state, list(poses))
        if way.reason is None:
            break
    return way
