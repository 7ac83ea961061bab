"""Assemblies of the joint graph proved by Krawczyk's test on its loops, for mechanisms without a closed form too.

As many independent equations of the loops are taken as joint values are unknown. Where there are no more equations than
that, or the rest are zero for every configuration (as across the plane of a planar loop), the assembly is proved. In an
overconstrained mechanism the rest hold by special dimensions, which floats only have to some digits: then a zero of the
independent equations alone is proved, and the answer says so, and what the others come to there at most. A rod that may
spin between its ball joints is held where it is: an assembly is proved with it, and all that differ by its spin alike.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.configuration import Placed
from assur.joint_graph.geometry import joint_scales
from assur.joint_graph.tree import joint_graph
from assur.kinematics import position
from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.certified.enclosed import enclosed, loop_rows
from assur.kinematics.certified.given import inputs_meant, number, pose_meant
from assur.kinematics.certified.platform import pose_parts, pose_rows
from assur.kinematics.certified.result import CertifiedSolutions, Doubt, ProvedSolution, at_most
from assur.kinematics.closure import closing_system
from assur.kinematics.configurations import distinct
from assur.kinematics.modes import Method, Problem
from assur.kinematics.rates.motions import general, motions
from assur.kinematics.turns import in_one_turn, periodic
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, LENGTHS
from assur.numerics import rotations
from assur.numerics.intervals.interval import Interval, as_interval
from assur.numerics.krawczyk import Equations, derivative, image, parts, proves, stacked
from assur.results.plain_text import count
from assur.work import stage

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
RADII = (1e-9, 1e-7, 1e-5)
"""Half widths of the boxes that are tried, in rad and in characteristic lengths."""
DEPENDENT = 1e-7
"""Length of a row, the largest entry of all being 1, below which an equation counts as dependent on those before."""
TINY = 1e-300
SINGULAR, TWICE = "singular, or joints that turn about themselves", "one assembly or two"
"""Why an assembly is not proved."""


@dataclass(frozen=True, eq=False)
class _Assemblies:
    """The loops, and the pose if it is given, near K assemblies; unknown are the joint values that are not given.

    `spins` (K, s, n) are rates of the unknowns at which rods spin: more equations say that they do not.
    """

    record: MechanismRecord
    problem: Problem
    given: FloatArray
    near: FloatArray
    spins: FloatArray

    @property
    def asked(self) -> Interval:
        """Bounds of what is given, (n,) or (m,)."""
        return (inputs_meant if self.problem == "direct" else pose_meant)(self.record, self.given)

    @property
    def unknown(self) -> list[int]:
        """Indices of the unknown joint values."""
        held = self.record.input_indices if self.problem == "direct" else ()
        return [k for k in range(self.near.shape[-1]) if k not in held]

    @property
    def told(self) -> tuple[list[int], BoolArray]:
        """Which unknowns do not count from where they are thought to be, and whether each is the same after a turn."""
        items = [self.record.coordinates[k] for k in self.unknown]
        told = [k for k, item in enumerate(items) if not self.record.joints[item.joint].type.ball]
        return told, periodic(self.record)[np.array([self.unknown[k] for k in told], dtype=int)]

    def of(self, rows: NDArray[np.intp]) -> _Assemblies:
        """Some of them."""
        return replace(self, near=self.near[rows], spins=self.spins[rows])

    def spinning(self) -> _Assemblies:
        """The same with the spins of rods, as many as turn while inputs and platform stand; none where more moves."""
        internal = int(general(self.record).internal)
        if not internal or not len(self.near):
            return self
        rows = len(self.evaluated([as_interval(value) for value in self.centre().T])[0])
        slopes = derivative(self.equations([*range(rows)]), Interval.of(self.centre())).middle * self.scale()
        _, sizes, right = np.linalg.svd(slopes)
        regular = np.sum(sizes > DEPENDENT * sizes[:, :1], axis=1) == len(self.unknown) - internal
        regular &= motions(self.record, self.near).ranks.internal == internal
        return replace(self, spins=np.where(regular[:, None, None], right[:, -internal:] / self.scale(), 0.0))

    def centre(self) -> FloatArray:
        """Where the unknowns (K, n) are thought to be; those of a ball joint count from there."""
        values = self.near.copy()
        for name, joint in self.record.joints.items():
            if joint.type.ball:
                values[:, joint_graph(self.record).slices[name]] = 0.0
        return values[:, self.unknown]

    def scale(self) -> FloatArray:
        """Size (n,) of each unknown."""
        return joint_scales(self.record)[self.unknown]

    def evaluated(self, numbers: Sequence[Any]) -> tuple[list[Any], list[Any], Placed]:
        """Equations, what must be positive, and the platform's frame at O', at unknowns (K,) of any number type."""
        values: list[Any] = [None] * self.near.shape[-1]
        for k, value in zip(self.unknown, numbers, strict=True):
            values[k] = value
        if self.problem == "direct":
            for item, printed in zip(self.record.inputs, parts(self.asked), strict=True):
                values[item.coordinate.index] = item.joint_value(printed)
        configuration = enclosed(self.record, self.near, values)
        rows, positive = loop_rows(configuration)
        if self.problem == "inverse":
            own, more = pose_rows(self.record.platform.pose, configuration.platform, self.asked)
            rows, positive = rows + own, positive + more
        return [*rows, *self._spun(numbers)], positive, configuration.platform

    def _spun(self, numbers: Sequence[Any]) -> Iterator[Any]:
        """How far rods have spun, in the measure of `spins`."""
        middle = self.centre()
        for spin in np.moveaxis(self.spins, 1, 0):
            turning = np.flatnonzero(np.any(np.abs(spin) > TINY, axis=0)).tolist()
            yield sum((as_interval(spin[:, k]) * (numbers[k] - middle[:, k]) for k in turning), as_interval(0.0))

    def equations(self, chosen: list[int]) -> Equations:
        """Some of the equations alone."""

        def values(_: Any, numbers: Sequence[Any]) -> list[Any]:
            rows = self.evaluated(numbers)[0]
            return [rows[k] for k in chosen]

        return values


@dataclass(frozen=True, eq=False)
class _Proof:
    """A solution with middles and widths (t,) of bounds of joint values and the pose, and which of these are angles.

    Where all unknown joints are balls, the pose alone tells it from others.
    """

    solution: ProvedSolution
    middle: FloatArray
    width: FloatArray
    turning: BoolArray

    def may_be(self, other: _Proof) -> bool:
        """Whether both may be one assembly, angles but for whole turns: certainly so where they are."""
        apart = self.middle - other.middle
        apart = np.where(self.turning, rotations.nearest_turn(apart), apart)
        slack = 1e-12 * (1 + np.abs(self.middle) + np.abs(other.middle))
        return bool(np.all(np.abs(apart) <= self.width + other.width + slack))


@stage("proof of each assembly")
def certified_assemblies(
    record: MechanismRecord, problem: Problem, given: FloatArray, method: Method = "auto"
) -> CertifiedSolutions:
    """Which float answers to a problem (n,) or (m,) certainly are assemblies; that they are all is not proved.

    Of the mechanism whose points and axes are the record's floats, and whose joints are turned by the rotations next to
    its floats. `left` of a solution is not zero where only some of its equations are proved.

    Errors:
        UsageError: as for `assur.kinematics.position.direct`.

    Example:
    >>> from assur.model.registry import load_record
    >>> found = certified_assemblies(load_record("fivebar"), "direct", np.array([2.2, 0.9]), "loops")
    >>> found.headline
    '2 solutions proved, whether there are others is not'
    """
    answer = (position.direct if problem == "direct" else position.inverse)(record, given, method=method)
    rows = np.flatnonzero(answer.exists)
    if len(rows):  # a configuration that was found twice counts once
        rows = rows[distinct(record, in_one_turn(record, answer.joints[rows]))]
    near = answer.joints[rows]
    every = _Assemblies(record, problem, given, near, np.zeros((len(near), 0, 0))).spinning()
    solutions: dict[int, _Proof] = {}
    tried: list[list[int]] = []
    for k in range(len(rows)):
        chosen = None if k in solutions else _independent(every, k)
        if chosen is None or chosen in tried:
            continue
        tried.append(chosen)
        open_ = np.array([j for j in range(len(rows)) if j not in solutions], dtype=np.intp)
        solutions |= _proved(every, open_, chosen, answer, rows)
    twice = [k for k in solutions if any(solutions[k].may_be(solutions[j]) for j in solutions if j < k)]
    doubts = tuple(
        Doubt("pose", answer.poses[row], answer.poses[row], TWICE if k in twice else SINGULAR)
        for k, row in enumerate(rows)
        if k not in solutions or k in twice
    )
    model: Literal["reduced", "joint_graph"] = "reduced" if answer.complete_for == "reduced" else "joint_graph"
    listed = tuple(solutions[k].solution for k in sorted(solutions) if k not in twice)
    what = "a zero of the independent equations" if any(item.left for item in listed) else "each assembly"
    right = f"{what} is proved on the joint graph, that there are no others only in floats ({answer.right})"
    return CertifiedSolutions(record, problem, given, listed, doubts, False, model, right)


def _proved(
    every: _Assemblies, open_: NDArray[np.intp], chosen: list[int], answer: SolutionSet, rows: NDArray[np.intp]
) -> dict[int, _Proof]:
    """Those of some assemblies that are proved by the chosen equations."""
    found: dict[int, _Proof] = {}
    for radius in RADII:
        open_ = np.array([k for k in open_ if k not in found], dtype=np.intp)
        if not len(open_):
            break
        near = every.of(open_)
        centre, half = near.centre(), radius * near.scale()
        box = Interval.of(centre - half, centre + half)
        picture = image(near.equations(chosen), box)
        one = proves(picture, box)
        if not np.any(one):
            continue
        near, narrow, proved = near.of(np.flatnonzero(one)), picture[one], open_[one]
        values, positive, platform = near.evaluated(parts(narrow))
        sure = np.ones(len(proved), dtype=bool)
        for value in positive:
            sure &= as_interval(value).positive
        rest = [as_interval(value) for k, value in enumerate(values) if k not in chosen and type(value) is not int]
        left = float(max((np.max(value.magnitude) for value in rest), default=0.0))
        spins = every.spins.shape[1]
        how = _how(near.record, len(chosen) - spins, len(rest), left, spins)
        bounds = _bounds(near, narrow, platform)
        told, turning = near.told
        pose = near.record.platform.pose  # a quaternion and its negative are one orientation
        compared = [k for k, name in enumerate(pose) if name in (*LENGTHS, *ANGLES)]
        turning = np.concatenate([turning, [pose[k] in ANGLES for k in compared]])
        for j in np.flatnonzero(sure):
            row = rows[proved[j]]
            mode, other = str(answer.labels[row]), str(answer.other_labels[row])
            names = (mode, other, mode) if near.problem == "direct" else (mode, mode, other)
            given, own = near.asked, bounds[j]
            pair = (own, given) if near.problem == "direct" else (given, own)
            solution = ProvedSolution(*pair, *names, how, left)
            placed = solution.pose[compared]
            middle = np.concatenate([narrow.middle[j, told], placed.middle])
            width = np.concatenate([narrow.width[j, told], placed.width])
            found[int(proved[j])] = _Proof(solution, middle, width, turning)
    return found


def _how(record: MechanismRecord, equations: int, more: int, left: float, spins: int) -> str:
    """By what assemblies are proved, and what the equations that are no part of the proof come to."""
    how = f"Krawczyk on {equations} independent equations of the loops"
    how += f", {count(spins, 'rod')} held that may spin between ball joints" if spins else ""
    return f"{how}; {more} dependent ones hold to {at_most(left)} ({record.unit} or rad), unproved" if left else how


def _independent(every: _Assemblies, k: int) -> list[int] | None:
    """As many independent equations as unknowns, by elimination in floats; None where there are not so many."""
    poses = every.given[None] if every.problem == "inverse" else None
    slopes = closing_system(every.record, every.near[[k]], poses)[1][0][:, every.unknown] * every.scale()
    left = slopes / np.max(np.abs(slopes), initial=TINY)
    if every.spins.size:
        spins = every.spins[k] * every.scale()
        left = np.concatenate([left, spins / np.max(np.abs(spins), initial=TINY)])
    chosen: list[int] = []
    for _ in range(slopes.shape[1]):
        size = np.linalg.norm(left, axis=1)
        best = int(np.argmax(size))
        if size[best] <= DEPENDENT:
            return None
        chosen.append(best)
        direction = left[best] / size[best]
        left = left - np.outer(left @ direction, direction)
    return sorted(chosen)


def _bounds(near: _Assemblies, narrow: Interval, platform: Placed) -> Interval:
    """What was asked for, (K, m) or (K, n): the poses, or every printed input."""
    if near.problem == "direct":
        return stacked([number(value) for value in pose_parts(near.record.platform.pose, platform)], len(near.near))
    columns = [narrow[:, near.unknown.index(item.coordinate.index)] for item in near.record.drives]
    printed = [item.printed(value) for value, item in zip(columns, near.record.drives, strict=True)]
    return stacked(printed, len(near.near))
