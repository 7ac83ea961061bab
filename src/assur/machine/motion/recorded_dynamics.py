"""What the forces of actuators ask of a configuration, as a straight line: by pivots instead of singular values.

The loops and the pose's rates are one set of linear equations of the joint rates. Solved once in a straight line, they
give the rates per rate of the pose, those that neither pose nor inputs feel, and the accelerations. Whether the pivots
are good at a configuration is told beside: by what all rows leave, redundant ones among them, and by an estimate of
the inverse.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from assur.joint_graph.configuration import Configuration
from assur.joint_graph.programs import Outputs
from assur.machine.motion.loop_equations import TURNED, angle_changes, angles_given, equations, pose_rows
from assur.machine.motion.moving_links import (
    NOTHING,
    MovingBody,
    MovingLinks,
    Twist,
    difference,
    is_nothing,
    stretched,
    work,
)
from assur.machine.motion.pivot_checks import PivotChecks, total
from assur.model.pose import Pose, rate_names
from assur.numerics.elimination import Elimination, Pivots, nothing
from assur.numerics.vectors import Vector, add, cross, minus, plus, times

PLACES = ("mass", "x", "y", "z", "xx", "yy", "zz", "xy", "xz", "yz")
"""Numbers of a body: its mass, its centre, its inertia."""
Vectors = list[dict[int, Any]]


@dataclass(frozen=True)
class IdleMotion:
    """A column without a pivot: which columns move with it, which links, at the examples."""

    column: int
    support: tuple[int, ...]
    links: tuple[str, ...]


@dataclass(frozen=True)
class InverseDynamics:
    """The question; what is told beside a configuration is named by `same` and `given`, lengths in the file's unit.

    Attributes:
        pose: its coordinates.
        loops, held: pivots among the rows of the loops, and of the pose's rates behind these.
        idle: motions of the columns without one.
        drives: column and sign of each input.
        bodies: of links that weigh, which of the ten numbers of `PLACES` are not zero.
        rotors: columns that have one.
        units: columns whose unit is not 1.
        gravity: along which axes it acts.
        loaded, moving: whether a load acts on the platform; whether there are rates and accelerations.
        heavy: whether motions of the idle columns weigh.
    """

    pose: Pose
    loops: Pivots
    held: Pivots
    idle: tuple[IdleMotion, ...]
    drives: tuple[tuple[int, float], ...]
    bodies: tuple[tuple[str, tuple[int, ...]], ...]
    rotors: tuple[int, ...]
    units: tuple[int, ...]
    gravity: tuple[int, ...]
    loaded: bool
    moving: bool
    heavy: bool

    @property
    def same(self) -> tuple[str, ...]:
        """Names of what is the same at every configuration."""
        return (
            *(f"{link} {PLACES[k]}" for link, places in self.bodies for k in places),
            *(f"rotor {column}" for column in self.rotors),
            *(f"unit {column}" for column in self.units),
            *(f"gravity {axis}" for axis in self.gravity),
        )

    @property
    def given(self) -> tuple[str, ...]:
        """Names of what is given beside the configuration, behind these."""
        names = rate_names(self.pose)
        return (
            *((f"load {k}" for k in range(6)) if self.loaded else ()),
            *((f"{what} {name}" for what in ("rate", "change") for name in names) if self.moving else ()),
            *(TURNED if angles_given(self.pose) else ()),
        )

    def __call__(self, configuration: Configuration, *numbers: Any) -> Outputs:
        """Of all that is named below, by pose rate i, drive k, column j.

        "driven k,i": rates of the drives per rate of the pose; "needed i": the force per rate of the pose; "rate j" and
        "second j": of the joints; "kinetic", "potential"; "square l": of gaps; "size", "inverse": squared norms of the
        closure and, estimated, of its inverse; "left m" and "among m": what rows leave, of how much.
        """
        return _Solution(self, configuration, dict(zip((*self.same, *self.given), numbers, strict=True))).outputs()


@dataclass(frozen=True, eq=False)
class _Idle:
    """A motion that leaves the pose as it is: joint rates, twists of the links that it moves, what these need of it."""

    rates: dict[int, Any]
    twists: dict[str, Twist]
    wrenches: dict[str, Twist]


@dataclass(frozen=True, eq=False)
class _Moved:
    """Joint rates and accelerations, twists, wrenches on links by joint rate, and what accelerations made up for."""

    rates: dict[int, Any]
    second: dict[int, Any]
    twists: Mapping[str, Twist]
    needed: dict[int, Any]
    right: dict[int, Any]


class _Solution:
    def __init__(self, question: InverseDynamics, configuration: Configuration, given: Mapping[str, Any]) -> None:
        self.question, self.given = question, given
        self.configuration = replace(configuration, rates={})
        self.links = MovingLinks(self.configuration)
        self.first = 6 * len(configuration.graph.cut)
        self.gravity: Vector = (given.get("gravity 0", 0), given.get("gravity 1", 0), given.get("gravity 2", 0))
        self.bodies = {link: _body(link, given) for link, _ in question.bodies}
        self.units = [given.get(f"unit {k}", 1) for k in range(sum(map(len, self.links.screws.values())))]
        entries = equations(self.configuration, question.pose, given)
        self.triangle = Elimination(entries, (*question.loops, *question.held))
        self.checks = PivotChecks(self.configuration, entries, self.triangle, question.loops, self.units)
        self.still = dict.fromkeys(self.configuration.frames, NOTHING)
        self.strays: list[Twist] = []
        self.idle = [self._idle(own) for own in question.idle]

    def outputs(self) -> Outputs:
        question = self.question
        along = [self.triangle.solved({self.first + i: 1}) for i in range(len(rate_names(question.pose)))]
        own = self._moved(along)
        outputs = {
            f"driven {k},{i}": times(rates.get(column, 0), sign)
            for k, (column, sign) in enumerate(question.drives)
            for i, rates in enumerate(along)
        }
        outputs |= {f"needed {i},0": _dot(rates, own.needed) for i, rates in enumerate(along)}
        outputs |= {f"rate {column},0": number for column, number in sorted(own.rates.items())}
        outputs |= {f"second {column},0": number for column, number in sorted(own.second.items())}
        outputs |= {"kinetic": self._kinetic(own), "potential": self._potential()}
        outputs |= {f"square {k}": number for k, number in enumerate(self.checks.gaps())}
        outputs |= {"size": self.checks.size(), "inverse": self.checks.inverse()}
        looked = [self.checks.left(_mixed([*along, *(item.rates for item in self.idle)]), {})]
        if question.moving:
            looked.append(self.checks.left(own.second, own.right))
        looked += [(self.checks.square(twist), 1) for twist in self.strays]
        for place, what in enumerate(("left", "among")):
            outputs |= {f"{what} {k}": numbers[place] for k, numbers in enumerate(looked)}
        return outputs

    def _idle(self, motion: IdleMotion) -> _Idle:
        rates = self.triangle.solved({}, {motion.column: 1})
        rates = {column: rates[column] for column in motion.support}
        if not self.question.heavy:
            return _Idle(rates, {}, {})
        twists, strays = self.links.twists_of(motion.links, rates)
        self.strays += strays
        moved = {link: twist for link, twist in twists.items() if link in self.bodies}
        wrenches = {
            link: self.links.wrench(link, self.bodies[link], (NOTHING, twist), (0, 0, 0))
            for link, twist in moved.items()
        }
        return _Idle(rates, moved, wrenches)

    def _moved(self, along: Vectors) -> _Moved:
        question = self.question
        rates: dict[int, Any] = {}
        second: dict[int, Any] = {}
        right: dict[int, Any] = {}
        twists, changes = self.still, self.still
        if question.moving:
            for own, name in zip(along, rate_names(question.pose), strict=True):
                _add(rates, own, self.given[f"rate {name}"])
            if question.heavy:
                twists = self.links.twists(rates)
                powers = [total(work(twists[link], own) for link, own in item.wrenches.items()) for item in self.idle]
                self._without(rates, self._shares(powers))
            else:
                self._shortest(rates)
            twists = self.links.twists(rates)
            drifts = self.links.drifts(twists, rates)
            right = self._right(twists, self.links.accelerations(drifts, {}), drifts)
            second = self.triangle.solved(right)
            if not question.heavy:
                self._shortest(second)
            changes = self.links.accelerations(drifts, second)
            right = {row: number for row, number in right.items() if row < self.first}
        wrenches = self._wrenches(twists, changes)
        if question.heavy:
            powers = [
                total(work(own, wrenches[link]) for link, own in item.twists.items() if link in wrenches)
                for item in self.idle
            ]
            shares = self._shares(powers)
            self._without(second, shares)
            for item, share in zip(self.idle, shares, strict=True):
                for link, weight in item.wrenches.items():
                    wrenches[link] = difference(wrenches.get(link, NOTHING), stretched(weight, share))
        needed = self.links.efforts(wrenches)
        for column in question.rotors:
            effort = times(self.given[f"rotor {column}"], second.get(column, 0))
            needed[column] = plus(needed.get(column, 0), effort)
        return _Moved(rates, second, twists, needed, right)

    def _shares(self, powers: Sequence[Any]) -> list[Any]:
        """How much of each idle motion needs these powers, by inertia alone."""
        matrix = [
            [
                total(work(own, item.wrenches[link]) for link, own in other.twists.items() if link in item.wrenches)
                for item in self.idle
            ]
            for other in self.idle
        ]
        return solved_square(matrix, powers)

    def _without(self, rates: dict[int, Any], shares: Sequence[Any]) -> None:
        for item, share in zip(self.idle, shares, strict=True):
            _add(rates, item.rates, times(-1, share))

    def _shortest(self, rates: dict[int, Any]) -> None:
        """Leave out what is along idle motions that weigh nothing."""
        measured = [
            {
                column: self.checks.unknown(column, self.checks.unknown(column, number))
                for column, number in item.rates.items()
            }
            for item in self.idle
        ]
        matrix = [[_dot(item.rates, own) for own in measured] for item in self.idle]
        self._without(rates, solved_square(matrix, [_dot(own, rates) for own in measured]))

    def _wrenches(self, twists: Mapping[str, Twist], changes: Mapping[str, Twist]) -> dict[str, Twist]:
        """What must act on links beside gravity and the load."""
        wrenches = {
            link: self.links.wrench(link, body, (twists[link], changes[link]), self.gravity)
            for link, body in self.bodies.items()
        }
        if self.question.loaded:
            platform, load = self.configuration.graph.platform, [self.given[f"load {k}"] for k in range(6)]
            force, moment = (load[0], load[1], load[2]), (load[3], load[4], load[5])
            applied = force, add(moment, cross(self.configuration.platform[1], force))
            wrenches[platform] = difference(wrenches.get(platform, NOTHING), applied)
        return {link: own for link, own in wrenches.items() if not is_nothing(own)}

    def _right(
        self, twists: Mapping[str, Twist], changes: Mapping[str, Twist], drifts: Mapping[str, Twist]
    ) -> dict[int, Any]:
        """What accelerations are to make up for, by row, where links speed up without them."""
        graph = self.configuration.graph
        right: dict[int, Any] = {}
        for index, cut in enumerate(graph.cut):
            angular, velocity = self.links.gap(changes, drifts, cut)
            right |= {6 * index + row: minus(0, number) for row, number in enumerate((*angular, *velocity))}
        _, point = self.configuration.platform
        (turning, moving), (angular, change) = twists[graph.platform], changes[graph.platform]
        speed = add(moving, cross(turning, point))
        own = (*angular, *add(add(change, cross(angular, point)), cross(turning, speed)))
        pose = self.question.pose
        extra = angle_changes(turning, self.given) if angles_given(pose) else {}
        for place, (name, row) in enumerate(zip(rate_names(pose), pose_rows(pose, self.given), strict=True)):
            biased = plus(extra.get(name, 0), total(times(factor, own[k]) for k, factor in row.items()))
            right[self.first + place] = minus(self.given[f"change {name}"], biased)
        return {row: number for row, number in right.items() if not nothing(number)}

    def _kinetic(self, own: _Moved) -> Any:
        twice = total(self.links.kinetic(link, body, own.twists[link]) for link, body in self.bodies.items())
        for column in self.question.rotors:
            rate = own.rates.get(column, 0)
            twice = plus(twice, times(self.given[f"rotor {column}"], times(rate, rate)))
        return times(0.5, twice)

    def _potential(self) -> Any:
        return minus(0, total(self.links.height(link, body, self.gravity) for link, body in self.bodies.items()))


def _body(link: str, given: Mapping[str, Any]) -> MovingBody:
    mass, x, y, z, xx, yy, zz, xy, xz, yz = (given.get(f"{link} {place}", 0) for place in PLACES)
    return MovingBody(mass, (x, y, z), ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz)))


def _add(total: dict[int, Any], own: Mapping[int, Any], factor: Any) -> None:
    for k, number in own.items():
        total[k] = plus(total.get(k, 0), times(number, factor))


def _dot(first: Mapping[int, Any], second: Mapping[int, Any]) -> Any:
    return total(times(number, second[k]) for k, number in first.items() if k in second)


def _mixed(vectors: Vectors) -> dict[int, Any]:
    """A sum of all, with shares drawn once."""
    mixed: dict[int, Any] = {}
    for own, share in zip(vectors, np.random.default_rng(1).normal(size=len(vectors)).tolist(), strict=True):
        _add(mixed, own, share)
    return mixed


def solved_square(matrix: Sequence[Sequence[Any]], right: Sequence[Any]) -> list[Any]:
    """Unknowns of a positive definite matrix."""
    entries = {(i, j): number for i, row in enumerate(matrix) for j, number in enumerate(row)}
    count = range(len(right))
    solved = Elimination(entries, tuple((k, k) for k in count)).solved(dict(enumerate(right)))
    return [solved.get(k, 0) for k in count]
