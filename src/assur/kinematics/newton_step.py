"""What a step of Newton's method asks of a configuration: the least change that closes its loops.

The derivative, by twists, is that of closed loops, exact where they close: near by, steps still shrink the gaps by
squares. Redundant equations do no harm, and a rod that spins does not spin. A ball joint that closes a loop turns as
the rest has it turn: its own three equations and unknowns take no part in the elimination.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from assur.joint_graph.configuration import Configuration
from assur.joint_graph.programs import Outputs
from assur.kinematics.pose import whole_orientation
from assur.model.mechanism import Joint
from assur.model.pose import ANGLES, LENGTHS, Pose
from assur.numerics.normal_equations import least_squares_steps
from assur.numerics.vectors import Matrix, Vector, dot, minus, plus, times

DAMPING = 1e-14
"""Share of the mean square of the columns: above the rounding of J^T J, so that what nothing moves stays."""
TARGETS = (*(f"target {k}" for k in range(9)), *LENGTHS)
"""Numbers of a pose: the rotation row by row, as far as it is told, and the point."""


@dataclass(frozen=True, eq=False)
class _Row:
    """An equation: its entries by column, what is left of it, and how fast that changes with its coordinate's error."""

    entries: Mapping[int, Any]
    residual: Any
    slope: Any = 1


Side = Callable[[_Row], Any]
"""What changes are to undo in each equation."""


@dataclass(frozen=True, eq=False)
class _CutBall:
    """A ball joint that closes a loop: its first coordinate, its parent's orientation, the equations of its turn."""

    first: int
    orientation: Matrix
    rows: Sequence[_Row]

    def changes(self, others: Mapping[int, Any], side: Side) -> dict[int, Any]:
        """Of its coordinates, after those of others."""
        turns = [_sum(times(number, others.get(k, 0)) for k, number in row.entries.items()) for row in self.rows]
        x, y, z = (plus(side(row), turn) for row, turn in zip(self.rows, turns, strict=True))
        columns = zip(*self.orientation, strict=True)
        return {k: minus(0, dot(column, (x, y, z))) for k, column in enumerate(columns, start=self.first)}


@dataclass(frozen=True)
class NewtonStep:
    """What is asked of a configuration: the step that closes its loops, some joint values held, or at a pose.

    Attributes:
        held: coordinates that do not change.
        pose: coordinates of the pose that are given; none where the platform is not held.
    """

    held: tuple[int, ...]
    pose: Pose = ()

    def __call__(self, configuration: Configuration, *target: Any) -> Outputs:
        """Changes in rad and characteristic lengths, "change k,0", and squares of what they are to undo, "square k".

        Beside these "rate k,j": how fast joint value k changes with number j of what is held, the coordinates of the
        pose, lengths first, or the joint values. Ball joints change by their angular velocity in the parent's frame.
        """
        configuration = replace(configuration, rates={})
        rows, balls, squares = self._loops(configuration)
        pose = list(_pose_rows(configuration, self.pose, target))
        squares += [times(row.residual, row.residual) for row in pose]
        rated: list[Side] = [_of_pose(own) for own in pose] or [_of_held(column) for column in self.held]
        changes, *rates = self._changes([*rows, *pose], balls, [lambda row: row.residual, *rated])
        return {
            **{f"change {column},0": number for column, number in changes.items()},
            **{f"rate {column},{j}": number for j, own in enumerate(rates) for column, number in own.items()},
            **{f"rate {column},{j}": 1 for j, column in enumerate(self.held) if not pose},
            **{f"square {k}": square for k, square in enumerate(squares)},
        }

    def _loops(self, configuration: Configuration) -> tuple[list[_Row], list[_CutBall], list[Any]]:
        """Equations of the loops, those of ball joints apart, and squares of the gaps."""
        graph, inverse = configuration.graph, 1 / configuration.geometry.length
        rows, balls, squares = list[_Row](), list[_CutBall](), list[Any]()
        for cut, loop in zip(graph.cut, graph.loops, strict=True):
            (x, y, z), turned = configuration.gap(cut)
            distance = times(x, inverse), times(y, inverse), times(z, inverse)
            squares += [dot(distance, distance), _squared_chord(turned)]
            around = [(graph.joint(name), sense) for name, sense in loop.items()]
            first = graph.slices[cut.name].start
            apart = cut.type.ball and cut.type.freedoms == 3 and first not in self.held
            entries = _entries(configuration, around if apart else [(cut, 1), *around], configuration.child_point(cut))
            own = list(map(_Row, entries, (*distance, *_skew_part(turned))))
            if apart:
                balls.append(_CutBall(first, configuration.frames[cut.parent][0], own[3:]))
            rows += own[:3] if apart else own
        return rows, balls, squares

    def _changes(self, rows: Sequence[_Row], balls: Sequence[_CutBall], sides: Sequence[Side]) -> list[dict[int, Any]]:
        """For each side the changes of all coordinates that any equation moves."""
        entries = {
            (i, k): number for i, row in enumerate(rows) for k, number in row.entries.items() if k not in self.held
        }
        known = [{i: number for i, row in enumerate(rows) if not _nothing(number := side(row))} for side in sides]
        answers = least_squares_steps(entries, known, DAMPING)
        for side, changes in zip(sides, answers, strict=True):
            for ball in balls:
                changes |= ball.changes(changes, side)
        return [dict(sorted(changes.items())) for changes in answers]

    @property
    def given(self) -> tuple[str, ...]:
        """Names of the numbers that are given beside the configuration."""
        return TARGETS if self.pose else ()


def _of_pose(own: _Row) -> Side:
    """What a coordinate of the pose leaves that changes by one."""
    return lambda row: minus(0, row.slope) if row is own else 0


def _of_held(column: int) -> Side:
    return lambda row: row.entries.get(column, 0)


def _pose_rows(configuration: Configuration, pose: Pose, target: Sequence[Any]) -> Iterator[_Row]:
    """Equations of the coordinates of a pose, lengths first."""
    if not pose:
        return
    graph, (rotation, point) = configuration.graph, configuration.platform
    way = [(graph.joint(name), sense) for name, sense in graph.paths[graph.platform].items()]
    entries = _entries(configuration, way, point)
    for name in (name for name in pose if name in LENGTHS):
        k = LENGTHS.index(name)
        yield _Row(entries[k], times(minus(point[k], target[9 + k]), 1 / configuration.geometry.length))
    a, b, c = ((target[k], target[k + 1], target[k + 2]) for k in (0, 3, 6))
    if whole_orientation(pose):
        turned = [[dot(row, own) for own in (a, b, c)] for row in rotation]
        yield from map(_Row, entries[3:], _skew_part(turned))
    else:
        yield from (_angle_row(name, rotation, entries[3:], (a, b, c)) for name in pose if name in ANGLES)


def _entries(configuration: Configuration, joints: Iterable[tuple[Joint, int]], point: Vector) -> list[dict[int, Any]]:
    """Of each row, lengths first, the entries: per rad, or per characteristic length."""
    rows: list[dict[int, Any]] = [{} for _ in range(6)]
    for joint, sense in joints:
        kinds, first = joint.type.kinds, configuration.graph.slices[joint.name].start
        for row, column, number in configuration.entries(joint, sense, point):
            length = kinds[column - first] == "length"
            rows[(row + 3) % 6][column] = (
                number if row < 3 or length else times(number, 1 / configuration.geometry.length)
            )
    return rows


def _angle_row(name: str, rotation: Any, angular: Any, target: Any) -> _Row:
    """The equation of one of three angles: the sine of its error, up to a cosine of theta.

    `target` has cos(phi) and sin(phi), -sin(theta), and sin(psi) and cos(psi) in the rotation's places of these, and
    cos(theta) beside cos(phi).
    """
    (r00, _, _), (r10, _, _), (r20, r21, r22) = rotation
    columns = {column for entries in angular for column in entries}

    def turned(column: int, vector: Any) -> Any:
        w = [entries.get(column, 0) for entries in angular]
        return [minus(times(w[i - 2], vector[i - 1]), times(w[i - 1], vector[i - 2])) for i in range(3)]

    x_axis, y_axis, z_axis = zip(*rotation, strict=True)
    if name == "theta":
        return _Row(
            {column: turned(column, x_axis)[2] for column in columns}, minus(r20, target[2][0]), minus(0, target[0][1])
        )
    if name == "phi":
        cosine, sine = target[0][0], target[1][0]
        rates = {column: turned(column, x_axis) for column in columns}
        entries = {column: minus(times(rate[1], cosine), times(rate[0], sine)) for column, rate in rates.items()}
        return _Row(entries, minus(times(r10, cosine), times(r00, sine)), plus(times(r00, cosine), times(r10, sine)))
    cosine, sine = target[2][2], target[2][1]
    entries = {
        column: minus(times(turned(column, y_axis)[2], cosine), times(turned(column, z_axis)[2], sine))
        for column in columns
    }
    return _Row(entries, minus(times(r21, cosine), times(r22, sine)), plus(times(r22, cosine), times(r21, sine)))


def _skew_part(turned: Any) -> list[Any]:
    return [times(0.5, minus(turned[k - 1][k - 2], turned[k - 2][k - 1])) for k in range(3)]


def _squared_chord(turned: Any) -> Any:
    """Half the square of how far a rotation is from none."""
    chord = [minus(turned[i][j], int(i == j)) for i in range(3) for j in range(3)]
    return times(0.5, _sum(times(number, number) for number in chord))


def _sum(numbers: Iterable[Any]) -> Any:
    total: Any = 0
    for number in numbers:
        total = plus(total, number)
    return total


def _nothing(number: Any) -> bool:
    return type(number) is int and number == 0
