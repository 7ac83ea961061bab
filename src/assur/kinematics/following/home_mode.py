"""Home's mode elsewhere: the configuration to which home is followed, which numbers of solutions cannot name.

Without a closed form the solutions of a pose are told apart by a search, whose numbers begin anew at every pose. Which
of them belongs to home's mode is decided by following: straight from home, and where that stops by a few detours, else
through singularities that are none of that mode: parallel ones of a working mode, serial ones of an assembly mode. What
no path leads to may still belong to it. That it does not is proved where

- all solutions are known, and each has another sign than home among those that name modes, or another value of what
  stands still in all of home's mode (`assur.kinematics.following.exclusion`); or there is none at all;
- there is one coordinate to follow, and home's branch folds back before the target whichever way it is followed.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UsageError
from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.border import inputs_of
from assur.kinematics.configurations import SAME, places
from assur.kinematics.following import from_home
from assur.kinematics.following.course import Prescribed, Turns
from assur.kinematics.following.exclusion import MERGED, of_other_signs
from assur.kinematics.following.following import follow
from assur.kinematics.following.locked import ranks_from
from assur.kinematics.following.path import Path, Stop
from assur.kinematics.home import home_values
from assur.kinematics.modes import mode_text
from assur.kinematics.naming import declared_signs
from assur.kinematics.pose import pose_of
from assur.kinematics.position import direct, inverse
from assur.kinematics.status import Status
from assur.kinematics.still import otherwise
from assur.kinematics.turns import periodic_inputs
from assur.model.mechanism import MechanismRecord
from assur.numerics import rotations
from assur.results.plain_text import count
from assur.work import WorkStage, stage

FloatArray = NDArray[np.float64]
CLEARLY = 1e-5
"""Share of the way that must be left where a branch folds back: nearer than that the target may be its end."""

LISTED = 12
"""Modes that a sentence names."""


@dataclass(frozen=True, eq=False)
class HomeMode:
    """What following from home says of a pose or of inputs.

    Attributes:
        joints: (n,) joint values of home's mode there; None where no path led there.
        paths: how many paths were followed.
        stopped: before what the straight one stopped; None where it did not.
        never: what proves that home's mode does not reach it; empty where that is not proved.
        others: where it is not reached, the modes of the solutions that are known.
        all_known: whether these are known to be all.
        through: the kind of singularity through which it was followed; empty where the path is regular.
    """

    joints: FloatArray | None
    paths: int
    stopped: Stop | None
    never: str = ""
    others: tuple[str, ...] = ()
    all_known: bool = False
    through: str = ""

    @property
    def reached(self) -> bool:
        """Whether a path from home leads there."""
        return self.joints is not None

    @property
    def status(self) -> Status:
        """Of a place that is not reached: `unreachable` where that is proved, else `undecided`."""
        return Status.unreachable if self.never else Status.undecided

    @property
    def words(self) -> str:
        """By what it is decided.

        >>> print(HomeMode(np.zeros(3), 1, None).words)
        home's mode, followed straight from home
        """
        if self.reached:
            return f"home's mode, {self.how}"
        if self.never:
            return f"home's mode does not reach it, which is proved: {self.never}{self._elsewhere}"
        straight = f": the straight one {self.stopped}" if self.stopped is not None else ""
        return f"none of {self.paths} paths from home leads there in home's mode, which is no proof{straight}"

    @property
    def how(self) -> str:
        """How home was followed to it."""
        if self.through:
            return f"followed from home, with {self.through} singularities let through"
        return "followed straight from home" if self.paths == 1 else "followed by a detour"

    @property
    def other_words(self) -> str:
        """What is said of an assembly that is not the one that was followed to.

        >>> HomeMode(np.zeros(3), 1, None).other_words, HomeMode(None, 7, None).other_words[-29:]
        ('another assembly than that of home, as far as 1 path from home tells', 'far as 7 paths from home tell')
        """
        tell = f"{count(self.paths, 'path')} from home tell{'s' if self.paths == 1 else ''}"
        return f"another assembly than that of home, as far as {tell}"

    @property
    def _elsewhere(self) -> str:
        """The solutions in other modes."""
        if not self.others:
            return ""
        more = f" and {len(self.others) - LISTED} more" if len(self.others) > LISTED else ""
        return f"; {'the' if self.all_known else 'a search met'} solutions in other modes: {_modes(self.others)}{more}"

    def is_home(self, record: MechanismRecord, joints: FloatArray) -> bool:
        """Whether joint values (n,) are the configuration that was followed to; rods may spin."""
        if self.joints is None:
            return False
        here, there = places(record, np.stack([self.joints, joints]))
        return bool(np.max(np.abs(here - there)) <= 10 * SAME)


def home_mode_at(
    record: MechanismRecord,
    target: ArrayLike,
    prescribed: Prescribed = "poses",
    detours: int = from_home.DETOURS,
    known: SolutionSet | None = None,
) -> HomeMode:
    """Home's mode at a pose (m,) or at printed inputs (n,), in lengths and rad, by paths from home.

    Strokes and limits are left aside. Where no path leads there it says whether that is proved.

    Args:
        record: the mechanism.
        target: the pose or the inputs.
        prescribed: which of the two.
        detours: how many are tried where the straight way stops.
        known: all solutions there that are known, in every mode; by default they are looked for where they are needed.

    >>> from assur.model.registry import load_record
    >>> found = home_mode_at(load_record("fivebar"), [10.0, 220.0])
    >>> found.reached, found.words
    (True, "home's mode, followed straight from home")
    """
    with stage("way of home's mode to the pose") as work:
        return _home_mode_at(record, np.asarray(target, dtype=float), prescribed, detours, known, work)


def _home_mode_at(
    record: MechanismRecord,
    goal: FloatArray,
    prescribed: Prescribed,
    detours: int,
    known: SolutionSet | None,
    work: WorkStage,
) -> HomeMode:
    home = home_values(record)
    straight = _path(record, home, goal, prescribed)
    if straight.stopped is None:
        return HomeMode(straight.joints[-1], 1, None)
    work.at(1, 1 + detours, f"the straight path {straight.stopped}")
    solve = direct if prescribed == "inputs" else inverse
    # loops in turn are quick, and all of them may prove that no way leads there
    solutions = known or solve(record, goal, method="auto" if record.closed_form else "loops")
    never, stops, tried = _all_excluded(record, solutions), [straight.stopped], 1
    for way, turns in () if never else _other_ways(record, prescribed, home, goal, detours):
        work.at(tried, 1 + detours)
        tried += 1
        try:
            path = _path(record, home, way, prescribed, turns)
        except UsageError:  # a pose by chance that is none
            continue
        if path.stopped is None:
            return HomeMode(path.joints[-1], tried, straight.stopped)
        stops.append(path.stopped)
    beyond = None if never else _beyond(record, goal, prescribed, detours)
    if beyond is not None:
        return HomeMode(beyond, tried, straight.stopped, through=_passed(prescribed))
    if not never and len(goal) == 1:
        never = _folded(prescribed, stops)
    if known is None and not solutions.complete:
        solutions = solve(record, goal)
    modes = tuple(str(label) for label in solutions.labels[solutions.exists])
    return HomeMode(None, tried, straight.stopped, never, modes, solutions.complete)


def _beyond(record: MechanismRecord, goal: FloatArray, prescribed: Prescribed, detours: int) -> FloatArray | None:
    """Joint values (n,) to which the signs and branches of home's mode alone are followed; None where no way leads."""
    if prescribed == "poses" and detours:
        joints = from_home.followed_by_ways(record, goal[None])
    else:
        joints, _ = from_home.followed_from_home(record, goal[None], held=prescribed)
    return joints[0] if np.all(np.isfinite(joints[0])) else None


def _passed(prescribed: Prescribed) -> str:
    """The kind of singularity at which no branches of this problem merge."""
    return "serial" if prescribed == "inputs" else "parallel"


def _all_excluded(record: MechanismRecord, solutions: SolutionSet) -> str:
    """Why none of all solutions is of home's mode; empty where these are not all, or one of them may be."""
    if not solutions.complete or solutions.curves or solutions.overall_status == Status.undecided:
        return ""
    joints = solutions.joints[solutions.exists]
    if not len(joints):
        return "there is no solution in any mode"
    signed = of_other_signs(record, solutions.problem, joints)
    reasons = otherwise(record, joints[~signed])
    if not all(reasons):
        return ""
    parts = []
    if np.any(signed):
        home = mode_text(declared_signs(record, solutions.problem, home_values(record), MERGED))
        parts.append(f"none of all {len(joints)} has its signs {home}" if np.all(signed) else f"its signs are {home}")
    if reasons:
        parts.append(f"in all of it {' and '.join(dict.fromkeys(reasons))} stays as at home, in these it is another")
    return "; ".join(parts)


def _folded(prescribed: Prescribed, stops: Sequence[Stop]) -> str:
    """Why no path along one coordinate leads there: home's branch folds back before it on every way."""
    kind = "parallel" if prescribed == "inputs" else "serial"  # at which branches of this problem merge
    ended = all(stop.kind == kind and stop.turns_back and stop.share < 1.0 - CLEARLY for stop in stops)
    ways = "" if len(stops) == 1 else ", either way round"
    return f"its branch ends before it{ways}, where it folds back at a {kind} singularity" if ended else ""


def _modes(names: Sequence[str]) -> str:
    return ", ".join(names[:LISTED])


def _path(
    record: MechanismRecord, home: FloatArray, goal: FloatArray, prescribed: Prescribed, turns: Turns = "short"
) -> Path:
    ranks = ranks_from(record, home, prescribed)
    if prescribed == "poses":
        return follow(record, home, poses=goal, turns=turns, use_limits=False, ranks=ranks)
    return follow(record, home, inputs=goal, turns=turns, use_limits=False, ranks=ranks)


def _other_ways(
    record: MechanismRecord, prescribed: Prescribed, home: FloatArray, goal: FloatArray, detours: int
) -> Iterator[tuple[FloatArray, Turns]]:
    """Ways beside the straight one; of a single coordinate there is the other way round alone, if it is an angle."""
    start = pose_of(record, home) if prescribed == "poses" else inputs_of(record, home)
    if len(goal) > 1:
        for aside in from_home.detours(record, prescribed, start, goal[None], detours):
            yield np.stack([aside[0], goal]), "short"
        return
    turning = (
        record.platform.pose[0] in from_home.ALL_ROUND if prescribed == "poses" else bool(periodic_inputs(record)[0])
    )
    if turning:
        short = float(rotations.nearest_turn(goal[0] - start[0]))
        yield np.array([start[0] + short - np.copysign(2 * np.pi, short)]), "given"
