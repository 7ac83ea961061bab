"""Newton's method on the joint graph as one recorded step, for many starts that are near an assembly.

One step is a straight-line program: frames, gaps, their derivative by twists, and the least change that closes them, by
normal equations without pivots. The derivative is that of closed loops, exact where they close: near by, steps still
shrink the gaps by squares. Redundant equations do no harm, and a rod that spins does not spin. What does not close goes
to damped least squares.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.configuration import Configuration
from assur.joint_graph.geometry import joint_scales
from assur.joint_graph.programs import GraphProgram, Outputs, program
from assur.joint_graph.tree import joint_graph
from assur.model.mechanism import MechanismRecord
from assur.model.pose import ANGLES, LENGTHS, QUATERNION, Pose, has_quaternion
from assur.numerics import rotations
from assur.numerics.newton import NewtonResult, iterated
from assur.numerics.normal_equations import least_squares_step
from assur.numerics.vectors import dot, minus, plus, times

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.intp]

TOLERANCE = 1e-13
"""Steps end where all gaps are at most this times the characteristic length."""
ENOUGH = 1e-12
"""Gaps of a start that counts as closed, where rounding keeps it from the tolerance."""
DAMPING = 1e-14
"""Share of the mean square of the columns: above the rounding of J^T J, so that what nothing moves stays."""
TARGETS = (*(f"target {k}" for k in range(9)), *LENGTHS)
"""Numbers of a pose: the rotation row by row, as far as it is told, and the point."""


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
        """Changes in rad and characteristic lengths, "change k", and squares of what they are to undo, "square k"."""
        configuration = replace(configuration, rates={})
        inverse = 1 / configuration.geometry.length
        entries, residuals, squares = dict[tuple[int, int], Any](), dict[int, Any](), list[Any]()
        for row, entry, residual in self._rows(configuration, inverse, target):
            entries |= {(row, column): number for column, number in entry.items() if column not in self.held}
            residuals[row] = residual
        for joint in configuration.graph.cut:
            distance, turned = configuration.gap(joint)
            scaled = [times(part, inverse) for part in distance]
            chord = [minus(turned[i][j], int(i == j)) for i in range(3) for j in range(3)]
            squares += [_squared(scaled), times(0.5, _squared(chord))]
        squares += [
            times(residuals[row], residuals[row]) for row in residuals if row >= 6 * len(configuration.graph.cut)
        ]
        known = {row: number for row, number in residuals.items() if not _nothing(number)}
        changes = least_squares_step(entries, known, DAMPING)
        return {
            **{f"change {column}": number for column, number in sorted(changes.items())},
            **{f"square {k}": square for k, square in enumerate(squares)},
        }

    def _rows(
        self, configuration: Configuration, inverse: Any, target: Sequence[Any]
    ) -> Iterator[tuple[int, dict[int, Any], Any]]:
        """Number, entries and residual of each equation."""
        graph = configuration.graph
        for index, (cut, loop) in enumerate(zip(graph.cut, graph.loops, strict=True)):
            distance, turned = configuration.gap(cut)
            point = configuration.child_point(cut)
            around = [(graph.joint(name), sense) for name, sense in ((cut.name, 1), *loop.items())]
            entries = _entries(configuration, around, point, inverse)
            residuals = [*(times(part, inverse) for part in distance), *_skew_part(turned)]
            yield from ((6 * index + row, entries[row], residuals[row]) for row in range(6))
        if self.pose:
            yield from self._pose_rows(configuration, inverse, target)

    def _pose_rows(
        self, configuration: Configuration, inverse: Any, target: Sequence[Any]
    ) -> Iterator[tuple[int, dict[int, Any], Any]]:
        graph = configuration.graph
        rotation, point = configuration.platform
        first = 6 * len(graph.cut)
        way = [(graph.joint(name), sense) for name, sense in graph.paths[graph.platform].items()]
        entries = _entries(configuration, way, point, inverse)
        for k, name in enumerate(LENGTHS):
            if name in self.pose:
                yield first + k, entries[k], times(minus(point[k], target[9 + k]), inverse)
        a, b, c = ((target[k], target[k + 1], target[k + 2]) for k in (0, 3, 6))
        if has_quaternion(self.pose) or all(name in self.pose for name in ANGLES):
            turned = [[dot(row, own) for own in (a, b, c)] for row in rotation]
            yield from ((first + 3 + k, entries[3 + k], part) for k, part in enumerate(_skew_part(turned)))
            return
        angular = [entries[3], entries[4], entries[5]]
        for k, name in enumerate(ANGLES):
            if name in self.pose:
                yield first + 3 + k, *_angle_row(name, rotation, angular, (a, b, c))

    @property
    def given(self) -> tuple[str, ...]:
        """Names of the numbers that are given beside the configuration."""
        return TARGETS if self.pose else ()


def _entries(configuration: Configuration, joints: Any, point: Any, inverse: Any) -> list[dict[int, Any]]:
    """Of each row, lengths first, the entries: per rad, or per characteristic length."""
    rows: list[dict[int, Any]] = [{} for _ in range(6)]
    for joint, sense in joints:
        kinds, first = joint.type.kinds, configuration.graph.slices[joint.name].start
        for row, column, number in configuration.entries(joint, sense, point):
            length = kinds[column - first] == "length"
            rows[(row + 3) % 6][column] = number if row < 3 or length else times(number, inverse)
    return rows


def _angle_row(name: str, rotation: Any, angular: Any, target: Any) -> tuple[dict[int, Any], Any]:
    """Entries and residual of one of three angles: the sine of its error, up to a cosine of theta.

    `target` has cos(phi) and sin(phi), -sin(theta), and sin(psi) and cos(psi) in the rotation's places of these.
    """
    (r00, _, _), (r10, _, _), (r20, r21, r22) = rotation
    columns = {column for entries in angular for column in entries}

    def turned(column: int, vector: Any) -> Any:
        w = [entries.get(column, 0) for entries in angular]
        return [minus(times(w[i - 2], vector[i - 1]), times(w[i - 1], vector[i - 2])) for i in range(3)]

    x_axis, y_axis, z_axis = zip(*rotation, strict=True)
    if name == "theta":
        return {column: turned(column, x_axis)[2] for column in columns}, minus(r20, target[2][0])
    if name == "phi":
        cosine, sine = target[0][0], target[1][0]
        rates = {column: turned(column, x_axis) for column in columns}
        entries = {column: minus(times(rate[1], cosine), times(rate[0], sine)) for column, rate in rates.items()}
        return entries, minus(times(r10, cosine), times(r00, sine))
    cosine, sine = target[2][2], target[2][1]
    entries = {
        column: minus(times(turned(column, y_axis)[2], cosine), times(turned(column, z_axis)[2], sine))
        for column in columns
    }
    return entries, minus(times(r21, cosine), times(r22, sine))


def _skew_part(turned: Any) -> list[Any]:
    return [times(0.5, minus(turned[k - 1][k - 2], turned[k - 2][k - 1])) for k in range(3)]


def _squared(numbers: Sequence[Any]) -> Any:
    total: Any = 0
    for number in numbers:
        total = plus(total, times(number, number))
    return total


def _nothing(number: Any) -> bool:
    return type(number) is int and number == 0


@dataclass(frozen=True, eq=False)
class Newton:
    """Newton's method for a mechanism; call it with starts (N, n) that are near assemblies.

    Attributes:
        record: the mechanism.
        step: what is held.
    """

    record: MechanismRecord
    step: NewtonStep

    def __call__(self, start: FloatArray, poses: FloatArray | None = None) -> NewtonResult:
        """Joint values (N, n) with gaps in characteristic lengths or rad, at poses (N, m) where the step holds those.

        Where the gaps are larger than `ENOUGH` no assembly is near.
        """
        given = None if poses is None else targets(self.record, poses)
        columns = [int(name.split()[1]) for name in self.program.names if name.startswith("change")]

        def step(values: FloatArray, rows: IntArray) -> tuple[FloatArray, FloatArray]:
            numbers = self.program(self.record, values, None if given is None else given[:, rows])
            gaps = np.sqrt(np.max(numbers[len(columns) :], axis=0, initial=0.0))
            return gaps, moved(self.record, values, columns, numbers[: len(columns)])

        return iterated(step, start, TOLERANCE)

    @cached_property
    def program(self) -> GraphProgram:
        """The step's program."""
        return program(self.record, self.step, self.step.given)


def moved(record: MechanismRecord, values: FloatArray, columns: Sequence[int], changes: FloatArray) -> FloatArray:
    """Joint values (N, n) after changes (k, N) of some, lengths in characteristic ones, balls' by angular velocities.

    >>> from assur.model.registry import load_record
    >>> moved(load_record("fivebar"), np.zeros((1, 5)), [1], np.array([[0.5]]))
    array([[0. , 0.5, 0. , 0. , 0. ]])
    """
    scales, whole = joint_scales(record), np.zeros_like(values)
    for column, change in zip(columns, changes, strict=True):
        whole[:, column] = change * scales[column]
    slices = joint_graph(record).slices
    for name, joint in record.joints.items():
        for step, first in joint.type.places:
            if step.kind == "ball":
                own = slice(slices[name].start + first, slices[name].start + first + 3)
                whole[:, own] = rotations.vector_rates(values[:, own], whole[:, own])
    return values + whole


def targets(record: MechanismRecord, poses: FloatArray) -> FloatArray:
    """The numbers (12, N) of poses (N, m), in the order of `TARGETS`; what a pose leaves out is zero."""
    named = dict(zip(record.platform.pose, poses.T, strict=True))
    nothing = np.zeros(len(poses))
    if has_quaternion(record.platform.pose):
        rotation = rotations.from_quaternion(np.stack([named[name] for name in QUATERNION], axis=-1))
    elif all(name in named for name in ANGLES):
        rotation = rotations.from_angles(*(named[name] for name in ANGLES))
    else:
        phi, theta, psi = (named.get(name, nothing) for name in ANGLES)
        rotation = np.zeros((len(poses), 3, 3))
        rotation[:, 0, 0], rotation[:, 1, 0], rotation[:, 2, 0] = np.cos(phi), np.sin(phi), -np.sin(theta)
        rotation[:, 2, 1], rotation[:, 2, 2] = np.sin(psi), np.cos(psi)
    point = np.array([named.get(name, nothing) for name in LENGTHS])
    return np.concatenate([rotation.reshape(len(poses), 9).T, point])
