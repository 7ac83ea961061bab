"""Assemblies of the joint graph proved by Krawczyk's test on its loops, for mechanisms without a closed form too.

As many independent equations of the loops are taken as joint values are unknown. Where there are no more equations than
that, or the rest are zero for every configuration (as across the plane of a planar loop), the assembly is proved. In an
overconstrained mechanism the rest hold by special dimensions, which floats only have to some digits: then a zero of the
independent equations is proved, and the answer says how well the others hold.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from assur.kinematics import position
from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.certified.given import number, turn
from assur.kinematics.certified.joint_frames import JointFrames, Placed
from assur.kinematics.certified.result import CertifiedSolutions, Doubt, ProvedSolution
from assur.kinematics.closure import characteristic_length, closing_system
from assur.kinematics.modes import Problem
from assur.kinematics.position import Method
from assur.kinematics.search import distinct, in_one_turn
from assur.model.joint_graph import joint_graph
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS, QUATERNION, is_angle
from assur.numerics.intervals.interval import Interval, as_interval
from assur.numerics.krawczyk import Equations, image, parts, proves, stacked
from assur.numerics.number_types import Intervals
from assur.numerics.sparse_vectors import add, apply, minus, plus, times
from assur.topology.joints import SPHERICAL

FloatArray = NDArray[np.float64]
RADII = (1e-9, 1e-7, 1e-5)
"""Half widths of the boxes that are tried, in rad and in characteristic lengths."""
DEPENDENT = 1e-7
"""Length of a row, the largest entry of all being 1, below which an equation counts as dependent on those before."""
TINY = 1e-300


@dataclass(frozen=True, eq=False)
class _Assemblies:
    """The loops, and the pose if it is given, near K assemblies; unknown are the joint values that are not given."""

    record: MechanismRecord
    problem: Problem
    given: FloatArray
    near: FloatArray

    @property
    def unknown(self) -> list[int]:
        """Indices of the unknown joint values."""
        held = self.record.input_indices if self.problem == "direct" else ()
        return [k for k in range(self.near.shape[-1]) if k not in held]

    def of(self, rows: NDArray[np.intp]) -> _Assemblies:
        """Some of them."""
        return _Assemblies(self.record, self.problem, self.given, self.near[rows])

    def centre(self) -> FloatArray:
        """Where the unknowns (K, n) are thought to be; those of a ball joint count from there."""
        values = self.near.copy()
        for name, joint in self.record.joints.items():
            if joint.type is SPHERICAL:
                values[:, joint_graph(self.record).slices[name]] = 0.0
        return values[:, self.unknown]

    def scale(self) -> FloatArray:
        """Size (n,) of each unknown."""
        length = characteristic_length(self.record)
        return np.array([length if self.record.coordinates[k].kind == "length" else 1.0 for k in self.unknown])

    def evaluated(self, numbers: Sequence[Any]) -> tuple[list[Any], list[Any], dict[str, Placed]]:
        """Equations, what must be positive, and the frames, at unknowns (K,) of any number type."""
        values: list[Any] = [None] * self.near.shape[-1]
        for k, value in zip(self.unknown, numbers, strict=True):
            values[k] = value
        if self.problem == "direct":
            for item, printed in zip(self.record.inputs, self.given.tolist(), strict=True):
                values[item.coordinate.index] = (Interval.of(printed) - item.offset) * item.sign
        frames = JointFrames(self.record, self.near)
        placed = frames.frames(values)
        rows, positive = frames.loops(placed, values)
        if self.problem == "inverse":
            own, more = _pose_rows(self.record, placed, self.given)
            rows, positive = rows + own, positive + more
        return rows, positive, placed

    def equations(self, chosen: list[int]) -> Equations:
        """Some of the equations alone."""

        def values(_: Any, numbers: Sequence[Any]) -> list[Any]:
            rows = self.evaluated(numbers)[0]
            return [rows[k] for k in chosen]

        return values


def certified_assemblies(
    record: MechanismRecord, problem: Problem, given: FloatArray, method: Method = "auto"
) -> CertifiedSolutions:
    """Which float answers to a problem (n,) or (m,) certainly are assemblies; that they are all is not proved.

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
    every = _Assemblies(record, problem, given, answer.joints[rows])
    solutions: dict[int, ProvedSolution] = {}
    tried: list[list[int]] = []
    for k in range(len(rows)):
        chosen = None if k in solutions else _independent(every, k)
        if chosen is None or chosen in tried:
            continue
        tried.append(chosen)
        open_ = np.array([j for j in range(len(rows)) if j not in solutions], dtype=np.intp)
        solutions |= _proved(every, open_, chosen, answer, rows)
    doubts = tuple(
        Doubt("pose", answer.poses[row], answer.poses[row], "singular, or joints that turn about themselves")
        for k, row in enumerate(rows)
        if k not in solutions
    )
    model: Literal["reduced", "joint_graph"] = "reduced" if answer.complete_for == "reduced" else "joint_graph"
    right = f"each assembly is proved on the joint graph, that there are no others only in floats ({answer.right})"
    listed = tuple(solutions[k] for k in sorted(solutions))
    return CertifiedSolutions(record, problem, given, listed, doubts, False, model, right)


def _proved(
    every: _Assemblies, open_: NDArray[np.intp], chosen: list[int], answer: SolutionSet, rows: NDArray[np.intp]
) -> dict[int, ProvedSolution]:
    """Those of some assemblies that are proved by the chosen equations."""
    found: dict[int, ProvedSolution] = {}
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
        values, positive, placed = near.evaluated(parts(narrow))
        sure = np.ones(len(proved), dtype=bool)
        for value in positive:
            sure &= as_interval(value).positive
        how = _how(near.record, values, chosen)
        bounds = _bounds(near, narrow, placed)
        for j in np.flatnonzero(sure):
            row = rows[proved[j]]
            mode, other = str(answer.labels[row]), str(answer.other_labels[row])
            names = (mode, other, mode) if near.problem == "direct" else (mode, mode, other)
            given, own = Interval.of(near.given), bounds[j]
            pair = (own, given) if near.problem == "direct" else (given, own)
            found[int(proved[j])] = ProvedSolution(*pair, *names, how)
    return found


def _how(record: MechanismRecord, values: Sequence[Any], chosen: list[int]) -> str:
    """By what assemblies are proved, and how well the equations hold that are not needed for it."""
    how = f"Krawczyk on {len(chosen)} independent equations of the loops"
    rest = [value for k, value in enumerate(values) if k not in chosen and type(value) is not int]
    if rest:
        worst = max(float(np.max(as_interval(value).magnitude)) for value in rest)
        how += f"; {len(rest)} dependent ones hold to {worst:.1e} ({record.unit} or rad)"
    return how


def _independent(every: _Assemblies, k: int) -> list[int] | None:
    """As many independent equations as unknowns, by elimination in floats; None where there are not so many."""
    poses = every.given[None] if every.problem == "inverse" else None
    slopes = closing_system(every.record, every.near[[k]], poses)[1][0][:, every.unknown] * every.scale()
    left = slopes / np.max(np.abs(slopes), initial=TINY)
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


def _bounds(near: _Assemblies, narrow: Interval, placed: dict[str, Placed]) -> Interval:
    """What was asked for, (K, m) or (K, n): the poses, or the printed inputs."""
    if near.problem == "direct":
        return stacked([number(value) for value in _pose(near.record, placed)], len(near.near))
    columns = [narrow[:, near.unknown.index(item.coordinate.index)] for item in near.record.inputs]
    printed = [value * item.sign + item.offset for value, item in zip(columns, near.record.inputs, strict=True)]
    return stacked(printed, len(near.near))


def _pose(record: MechanismRecord, placed: dict[str, Placed]) -> list[Any]:
    """The pose's coordinates, an angle as (cosine, sine) up to a positive factor; theta is between -90 and 90 deg."""
    rotation, origin = placed[record.platform.link]
    point = add(origin, apply(rotation, _exact(record.platform.point)))
    level = plus(times(rotation[0][0], rotation[0][0]), times(rotation[1][0], rotation[1][0]))
    scalar = Intervals().sqrt(plus(plus(plus(1, rotation[0][0]), rotation[1][1]), rotation[2][2])) / 2
    found: dict[str, Any] = {
        **dict(zip(LENGTHS, point, strict=True)),
        "phi": (as_interval(rotation[0][0]), as_interval(rotation[1][0])),
        "theta": (Intervals().sqrt(level), as_interval(minus(0, rotation[2][0]))),
        "psi": (as_interval(rotation[2][2]), as_interval(rotation[2][1])),
        "qw": scalar,
    }
    for name, (i, j) in zip(QUATERNION[1:], ((2, 1), (0, 2), (1, 0)), strict=True):
        found[name] = as_interval(minus(rotation[i][j], rotation[j][i])) / (scalar * 4)
    return [found[name] for name in record.platform.pose]


def _pose_rows(record: MechanismRecord, placed: dict[str, Placed], pose: FloatArray) -> tuple[list[Any], list[Any]]:
    """What is zero, and what is positive, where the platform is at a pose (m,)."""
    rotation, origin = placed[record.platform.link]
    point = add(origin, apply(rotation, _exact(record.platform.point)))
    wanted = dict(zip(record.platform.pose, pose.tolist(), strict=True))
    rows: list[Any] = [
        minus(point[LENGTHS.index(name)], Interval.of(wanted[name])) for name in LENGTHS if name in wanted
    ]
    positive: list[Any] = []
    pairs = {"phi": (rotation[0][0], rotation[1][0]), "psi": (rotation[2][2], rotation[2][1])}
    for name in (name for name in wanted if is_angle(name)):
        cosine, sine = turn(Interval.of(wanted[name]))
        if name == "theta":
            rows.append(plus(rotation[2][0], sine))
            continue
        rows.append(minus(times(pairs[name][1], cosine), times(pairs[name][0], sine)))
        positive.append(plus(times(pairs[name][0], cosine), times(pairs[name][1], sine)))
    if QUATERNION[0] in wanted:
        own, more = _turned_to(rotation, [Interval.of(wanted[name]) for name in QUATERNION])
        rows, positive = rows + own, positive + more
    return rows, positive


def _turned_to(rotation: Any, quaternion: list[Interval]) -> tuple[list[Any], list[Any]]:
    """Skew part and trace of the turn from a quaternion of any length to a rotation."""
    w, x, y, z = quaternion
    twice = 2 / (w * w + x * x + y * y + z * z)
    wanted = (
        (1 - twice * (y * y + z * z), twice * (x * y - w * z), twice * (x * z + w * y)),
        (twice * (x * y + w * z), 1 - twice * (x * x + z * z), twice * (y * z - w * x)),
        (twice * (x * z - w * y), twice * (y * z + w * x), 1 - twice * (x * x + y * y)),
    )
    gap = [[_dot([row[i] for row in wanted], [row[j] for row in rotation]) for j in range(3)] for i in range(3)]
    skew = [minus(gap[2][1], gap[1][2]), minus(gap[0][2], gap[2][0]), minus(gap[1][0], gap[0][1])]
    return skew, [plus(plus(gap[0][0], gap[1][1]), gap[2][2])]


def _dot(a: Sequence[Any], b: Sequence[Any]) -> Any:
    return plus(plus(times(a[0], b[0]), times(a[1], b[1])), times(a[2], b[2]))


def _exact(point: FloatArray) -> Any:
    return tuple(0 if value == 0 else Interval.of(value) for value in point.tolist())
