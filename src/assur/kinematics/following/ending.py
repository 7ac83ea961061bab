"""Ending: where a working mode ends on straight ways from poses that it reaches to poses that it does not.

Nearly always it turns back into another branch (`turning`), which is found to rounding nearly. Where it does not, as
where a sign that names the mode changes by itself, the way is halved.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.following.neighbours import FURTHEST, SignGuard, Steps, steps_at
from assur.kinematics.following.stepping import Pace, followed
from assur.kinematics.following.turning import turnings
from assur.kinematics.following.ways import Straight
from assur.kinematics.pose import whole_orientation
from assur.kinematics.turns import joint_units
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IntArray = NDArray[np.intp]
Poses = Callable[[FloatArray], FloatArray]
"""Points (N, d) of a grid to poses (N, m)."""

SHORTEST = 2.0**-8
"""Share of the way of the shortest step where a mode does not turn back: its end is found to half of that."""

BLOCK = 1024


@dataclass(frozen=True, eq=False)
class Mode:
    """A working mode over points of a grid.

    Attributes:
        record: the mechanism.
        signs: (s,) the signs that name the mode.
        poses: points (N, d) to poses (N, m).
    """

    record: MechanismRecord
    signs: NDArray[np.int8]
    poses: Poses

    def steps(self, joints: FloatArray, points: FloatArray) -> Steps:
        """Steps from assemblies (N, n) at points (N, d)."""
        return steps_at(SignGuard(self.record, self.signs), self.poses(points), joints)

    def stepped(self, joints: FloatArray, start: FloatArray, end: FloatArray) -> tuple[FloatArray, BoolArray]:
        """Joint values (N, n) after a step between points (N, d), and where the step may be taken (N,)."""
        steps, good = self.steps(joints, start).to(self.poses(end))
        return steps.places.joints, good

    def ends(self, joints: FloatArray, inside: FloatArray, outside: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Where the mode ends between points (N, d) that it reaches, with joint values (N, n), and others.

        Returns:
            share (N,) of the way, and joint values (N, n) a little before.
        """
        shares, last = np.ones(len(joints)), joints.copy()
        for rows in blocks(np.arange(len(joints))):
            shares[rows], last[rows], located = self._turnings(joints[rows], inside[rows], outside[rows])
            other = rows[~located]
            if len(other):
                shares[other], last[other] = self._halved(joints[other], inside[other], outside[other])
        return shares, last

    def _turnings(
        self, joints: FloatArray, inside: FloatArray, outside: FloatArray
    ) -> tuple[FloatArray, FloatArray, BoolArray]:
        if whole_orientation(self.record.platform.pose):  # its rates change along the way
            return np.ones(len(joints)), joints, np.zeros(len(joints), dtype=bool)
        start, end = self.poses(inside), self.poses(outside)
        turned = turnings(Straight(self.record, start, end), joints)
        far = np.max(np.abs(turned.joints - joints) / joint_units(self.record), axis=1, initial=0.0) > FURTHEST
        rows = np.flatnonzero(turned.located & ~far)
        located = np.zeros(len(joints), dtype=bool)
        share, guard = turned.share[rows, None], SignGuard(self.record, self.signs)
        before = steps_at(guard, start[rows], joints[rows])
        after = steps_at(guard, start[rows] + share * (end[rows] - start[rows]), turned.joints[rows])
        located[rows] = guard.kept(before.places, after.places)
        return turned.share, turned.joints, located

    def _halved(self, joints: FloatArray, inside: FloatArray, outside: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Steps along the way that are halved where they fail, down to the shortest."""
        start = self.steps(joints, inside)
        at, steps = start.places.of(np.arange(len(joints))), np.full(len(joints), 0.5)
        followed(Straight(self.record, start.poses, self.poses(outside)), at, start.guard, Pace(SHORTEST), steps)
        return np.minimum(at.shares + 0.5 * SHORTEST, 1.0), at.joints


def blocks(rows: IntArray) -> Iterator[IntArray]:
    """Rows (N, ..) in blocks; none where there are no rows."""
    for first in range(0, len(rows), BLOCK):
        yield rows[first : first + BLOCK]
