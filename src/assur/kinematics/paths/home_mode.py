"""Home's mode elsewhere: the configuration to which home is followed, which numbers of solutions cannot name.

Without a closed form the solutions of a pose are told apart by a search, whose numbers begin anew at every pose. Which
of them belongs to home's mode is decided by following: straight from home, and where that stops by a few detours. What
no path leads to may still belong to it, so that a "no" is never proved here.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UsageError
from assur.kinematics.border import in_range, inputs_of
from assur.kinematics.home import home_values
from assur.kinematics.paths.course import Prescribed
from assur.kinematics.paths.following import follow
from assur.kinematics.paths.path import Path, Stop
from assur.kinematics.pose import pose_of
from assur.kinematics.search import SAME, places
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
DETOURS = 6
"""Ways by a pose by chance that are tried where the straight one stops."""

ASIDE = 0.5
"""How far aside these poses lie, as a share of the way, and of the file's box where it has one."""


@dataclass(frozen=True, eq=False)
class HomeMode:
    """What following from home says of a pose or of inputs.

    Attributes:
        joints: (n,) joint values of home's mode there; None where no path led there.
        paths: how many paths were followed.
        stopped: before what the straight one stopped; None where it did not.
    """

    joints: FloatArray | None
    paths: int
    stopped: Stop | None

    @property
    def reached(self) -> bool:
        """Whether a path from home leads there."""
        return self.joints is not None

    @property
    def words(self) -> str:
        """By what it is decided.

        >>> print(HomeMode(np.zeros(3), 1, None).words)
        home's mode, followed straight from home
        """
        if self.joints is not None:
            return (
                "home's mode, followed straight from home" if self.paths == 1 else "home's mode, followed by a detour"
            )
        straight = f": the straight one {self.stopped}" if self.stopped is not None else ""
        return f"none of {self.paths} paths from home leads there in home's mode, which is no proof{straight}"

    def is_home(self, record: MechanismRecord, joints: FloatArray) -> bool:
        """Whether joint values (n,) are the configuration that was followed to; rods may spin."""
        if self.joints is None:
            return False
        here, there = places(record, np.stack([self.joints, joints]))
        return bool(np.max(np.abs(here - there)) <= 10 * SAME)


def home_mode_at(record: MechanismRecord, target: ArrayLike, prescribed: Prescribed = "poses") -> HomeMode:
    """Home's mode at a pose (m,) or at printed inputs (n,), in lengths and rad, by paths from home.

    Strokes and limits are left aside.

    >>> from assur.model.registry import load_record
    >>> found = home_mode_at(load_record("fivebar"), [10.0, 220.0])
    >>> found.reached, found.words
    (True, "home's mode, followed straight from home")
    """
    home, goal = home_values(record), np.asarray(target, dtype=float)
    straight = _path(record, home, goal, prescribed)
    if straight.stopped is None:
        return HomeMode(straight.joints[-1], 1, None)
    tried = 1
    for aside in _detours(record, prescribed, home, goal):
        tried += 1
        try:
            path = _path(record, home, np.stack([aside, goal]), prescribed)
        except UsageError:  # a pose by chance that is none
            continue
        if path.stopped is None:
            return HomeMode(path.joints[-1], tried, straight.stopped)
    return HomeMode(None, tried, straight.stopped)


def _path(record: MechanismRecord, home: FloatArray, goal: FloatArray, prescribed: Prescribed) -> Path:
    if prescribed == "poses":
        return follow(record, home, poses=goal, use_limits=False)
    return follow(record, home, inputs=goal, use_limits=False)


def _detours(
    record: MechanismRecord, prescribed: Prescribed, home: FloatArray, goal: FloatArray
) -> Iterator[FloatArray]:
    """Places beside the way."""
    rng = np.random.default_rng(0)
    start = pose_of(record, home) if prescribed == "poses" else inputs_of(record, home)
    size = np.full(len(goal), float(np.max(np.abs(goal - start))))
    if prescribed == "poses":
        spans = [np.subtract(*record.box[name][::-1]) if name in record.box else 0.0 for name in record.platform.pose]
        size = np.where(np.array(spans) > 0, spans, np.abs(goal - start))
    for _ in range(DETOURS):
        aside = 0.5 * (start + goal) + ASIDE * size * rng.uniform(-1.0, 1.0, len(goal))
        yield in_range(record, aside) if prescribed == "poses" else aside
