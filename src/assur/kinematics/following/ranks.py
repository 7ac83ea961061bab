"""The guard of a single way: the mode is kept, as no rank is lost between two points and no limit is broken.

A step is taken where the loops close, the correction is small against the step, no limit is broken, and neither the
matrix with the inputs locked nor the one with the platform locked loses its rank on the way
(`assur.kinematics.following.locked`).
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.kinematics.following.course import Prescribed
from assur.kinematics.following.locked import Locked, locked, own
from assur.kinematics.following.stepping import Places, tried
from assur.kinematics.following.ways import Way, other_side
from assur.kinematics.limits import Limit
from assur.kinematics.turns import joint_units, whole_turns_less
from assur.model.mechanism import MechanismRecord
from assur.work import WorkStage

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IntArray = NDArray[np.intp]
Bounds = Callable[[MechanismRecord, FloatArray], Sequence[Limit]]
CLOSE = 0.1
"""A correction is at most this share of its step; half the angle, in rad, by which the tangent may turn."""

AIM = 0.7
"""The next step is meant to need a correction of this share of the largest allowed; at most twice the step before."""

FURTHEST = 0.25
"""How far the joint values move in one step at most, in rad or characteristic lengths, all of them together."""

NEARER = 1.0 - 1e-9
"""A step that is too long is made so much shorter than it may be, so that rounding does not make it too long again."""

KEPT = 0.2
"""What must be left of the rank after a step."""

MERGING = 0.9
"""Where less is left of a rank that the wanted rates need, two branches are foreseen to merge."""

AHEAD, BEFORE = 0.9, 0.7
"""Share of the way to a foreseen merging, and to another foreseen singularity, that the next step takes at most."""

SAFE = 3.0
"""A singular value that is not so many times the noise may as well be zero."""

FLOOR = 1e-6
"""A smallest singular value below which the corrector cannot tell two branches from each other."""

SINGULAR = 1e-6
"""A smallest singular value up to here is zero to begin with."""

FIRST = 1e-3
"""Share of the way of the first step from a start that is singular where nothing is prescribed: what lies nearer to it
than that is not told apart from it."""

FINE, COARSE = 1e-14, 1e-12
"""Tolerances of the corrector: the coarse one where it is enough for ACCURACY."""

ROUNDING = 1e-13
"""Residuals up to this, relative to the largest joint value, are rounding."""

ACCURACY = 1e-9
"""How exact joint values shall be, in rad or characteristic lengths; they are worse near singularities only."""

MISSED = 1e-6
"""Rates of which a larger share cannot be produced are those of no motion."""


@dataclass(frozen=True)
class Blocked:
    """What forbade the last step that was tried.

    Attributes:
        why: open (the loops did not close), far (the correction was large against the step), lost (a rank would be
            lost on the way), missed (no motion has these rates), limit, refused (there is no such mechanism),
            interrupted (by Ctrl-C).
        limit: the one that is broken.
        text: why there is no such mechanism.
    """

    why: Literal["open", "far", "lost", "missed", "limit", "refused", "interrupted"]
    limit: Limit | None = None
    text: str = ""


@dataclass(frozen=True, eq=False)
class PathPoint:
    """A place on the way.

    Attributes:
        share, joints: of the way, and joint values (n,).
        own, other: the matrix of what is held, and that of what is not.
        ahead: share of the way after which two branches are foreseen to merge; inf where nothing is foreseen.
    """

    share: float
    joints: FloatArray
    own: Locked
    other: Locked
    ahead: float = np.inf

    @property
    def tolerance(self) -> float:
        """What the residual may be at the next point, relative to the characteristic length."""
        return min(COARSE, max(FINE, ACCURACY * float(self.own.sizes[-1])))

    @property
    def noise(self) -> float:
        """By how much the next point's joint values may be wrong then."""
        return self.tolerance / float(self.own.sizes[-1])

    def along(self, step: float) -> float:
        """How much of the tangent a step takes: all of it, or less and less than the step where a merging is `ahead`.

        The joint values are q* - a sqrt(s* - s) there, so that a step h goes 2 ahead (1 - sqrt(1 - h / ahead)) far.
        """
        if step >= self.ahead:
            return 2 * self.ahead
        return step if np.isinf(self.ahead) else 2 * self.ahead * (1.0 - float(np.sqrt(1.0 - step / self.ahead)))


@dataclass(frozen=True, eq=False)
class RankGuard:
    """The guard of one way, with the points that it has let by.

    Attributes:
        held: what the way holds.
        bounds: limits that must not be broken, of a mechanism about joint values (n,).
        ranks: of both matrices in general.
        work: whose stage the points are.
        points: the first and those that follow.
        refused: what forbade steps.
    """

    held: Prescribed
    bounds: Bounds
    ranks: Mapping[str, int]
    work: WorkStage = field(default_factory=lambda: WorkStage("way"))
    points: list[PathPoint] = field(default_factory=list)
    refused: list[Blocked] = field(default_factory=list)

    def begun(self, way: Way, places: Places) -> bool:
        """Whether a way can be begun; not where what is prescribed is singular at the start, nor outside the limits."""
        record = way.mechanism(float(places.shares[0]))
        self.points.append(self._point(places, other_side(record, self.held, places.joints, places.known)))
        if self.points[0].own.sizes[-1] <= SINGULAR:
            self.refused.append(Blocked("lost"))
        else:
            self.refused.extend(self._outside(record, places.joints[0]))
        return not self.refused

    @property
    def leaving(self) -> bool:
        """Whether the start is singular where nothing is prescribed, and no step is taken yet: what is lost already can
        neither be lost nor kept.
        """
        return len(self.points) == 1 and bool(self.points[0].other.sizes[-1] <= SINGULAR)

    def step(self, way: Way, places: Places, ends: FloatArray, rows: IntArray) -> tuple[Places, BoolArray, FloatArray]:
        """Where a step leads, what forbids it, and the step that may follow."""
        try:
            gaps = way.gaps(places.joints, places.shares, ends, rows)[0]
            change, missed = self.points[-1].own.change(-gaps)
            far = float(np.linalg.norm(change))
            if way.linear and missed > MISSED:
                return self._refused(places, places.shares, Blocked("missed"))
            if far > FURTHEST:
                return self.step(way, places, places.shares + NEARER * FURTHEST / far * (ends - places.shares), rows)
            return self._judged(way, places, ends, change, gaps, rows)
        except UsageError as error:  # between two mechanisms that are allowed there may be one that is not
            return self._refused(places, ends, Blocked("refused", text=error.message))

    def _judged(
        self, way: Way, at: Places, ends: FloatArray, change: FloatArray, gaps: FloatArray, rows: IntArray
    ) -> tuple[Places, BoolArray, FloatArray]:
        """The same of a step whose change (n,) in first order is known."""
        record, last, step = way.mechanism(float(ends[0])), self.points[-1], float(ends[0] - at.shares[0])
        move = change * (last.along(step) / step)
        trial, moved = tried(way, at, ends, move[None], rows, last.tolerance), float(np.linalg.norm(move))
        reach = 1.0 + float(np.max(np.abs(trial.places.joints / joint_units(record))))
        if trial.residual[0] > max(10 * last.tolerance, ROUNDING * reach):
            return self._refused(at, ends, Blocked("open"))
        away = float(trial.away[0])
        if away > CLOSE * moved + last.noise:
            return self._refused(at, ends, Blocked("far"))
        other = other_side(record, self.held, trial.places.joints, trial.places.known)
        kept = last.own.kept(trial.places.known[0])
        kept_other = 1.0 if self.leaving else last.other.kept(other[0])
        if min(kept, kept_other) < KEPT:
            return self._refused(at, ends, Blocked("lost"))
        broken = self._outside(record, trial.places.joints[0])
        if broken:
            return self._refused(at, ends, broken[0])
        places = _settled(way, trial.places, rows)
        if places.known is not trial.places.known:
            other = other_side(record, self.held, places.joints, places.known)
        point = self._point(places, other)
        least_other = SINGULAR if self.leaving else SAFE * point.noise
        if point.own.sizes[-1] < FLOOR or point.other.sizes[-1] < least_other:
            return self._refused(at, ends, Blocked("lost"))
        bent = away - last.noise  # a way as short as the noise is straight for all that can be seen
        after = step * min(2.0, AIM * CLOSE * moved / bent if bent > 0.0 else 2.0)
        if kept < MERGING and point.own.needs(gaps):
            # near a merging the square of the singular value goes to zero linearly
            point = dataclasses.replace(point, ahead=step * kept**2 / (1.0 - kept**2))
            after, kept = AHEAD * point.ahead, 1.0
        least = min(kept, kept_other)
        if least < 1.0:
            # were the singular value to go on like this, it would vanish after step * least / (1 - least)
            after = min(after, BEFORE * step * least / (1.0 - least))
        self.points.append(point)
        self.work.at(len(self.points), result=f"{point.share:.0%} of the way")
        return places, np.ones(1, dtype=bool), np.array([after])

    def _refused(self, places: Places, ends: FloatArray, why: Blocked) -> tuple[Places, BoolArray, FloatArray]:
        """A step to shares (1,) that is not taken."""
        self.refused.append(why)
        return Places(ends, places.joints, places.known), np.zeros(1, dtype=bool), ends - places.shares

    def _point(self, places: Places, other: FloatArray) -> PathPoint:
        """An assembly with its matrices, that of what is held and the other one (1, r, n)."""
        names = own(self.held)
        mine, others = (
            locked(matrix[0], self.ranks[name]) for name, matrix in zip(names, (places.known, other), strict=True)
        )
        return PathPoint(float(places.shares[0]), places.joints[0].copy(), mine, others)

    def _outside(self, record: MechanismRecord, joints: FloatArray) -> list[Blocked]:
        """The limit that joint values (n,) break most, if any."""
        rooms = {float(limit.margin(joints)): limit for limit in self.bounds(record, joints)}
        least = min(rooms, default=0.0)
        return [Blocked("limit", rooms[least])] if least < 0.0 else []


def _settled(way: Way, places: Places, rows: IntArray) -> Places:
    """The same assemblies with every rotation vector well inside one turn, where its rates are those of a rotation."""
    joints = whole_turns_less(way.mechanism(float(places.shares[0])), places.joints)
    if joints is places.joints:
        return places
    turned, known = np.flatnonzero(np.any(joints != places.joints, axis=1)), places.known.copy()
    known[turned] = way.system(joints[turned], places.shares[turned], rows[turned])[1]
    return Places(places.shares, joints, known)
