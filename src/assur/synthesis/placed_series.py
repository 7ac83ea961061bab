"""Series of revolute and prismatic joints placed in space, many at a time: poses, twists, and how they are closed.

All are written as at home, with axes that may run through one point, the origin. A pose is a rotation (3, 3) and where
the point that is in the origin at home goes (3,).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.numerics.least_squares import IndexArray, minimise
from assur.numerics.rotations import from_vector, to_vector
from assur.topology.chains import Chain, ChainJoint, Parallelogram

FloatArray = NDArray[np.float64]
Mask = NDArray[np.bool_]

CLOSED = 1e-11
"""Rotation (rad) and gap (lengths of about one) below which a series has reached a pose."""

SIZE = 2.0
"""Half the side of the box in which joints stand: large enough that short displacements are within reach."""

DRAWS = 12
"""So often the joints of a series are drawn, and the best drawing is taken."""

PARTS = (0.5, 1.0)
"""Shares of a displacement by which a pose is approached from home."""


@dataclass(frozen=True, eq=False)
class PlacedSeries:
    """M series of f joints each at home.

    Attributes:
        axes: (M, f, 3) unit vectors.
        points: (M, f, 3) a point on each axis; of a P it does not matter.
        turning: (M, f) whether a joint turns.
    """

    axes: FloatArray
    points: FloatArray
    turning: Mask

    def __getitem__(self, rows: IndexArray | Mask) -> PlacedSeries:
        return PlacedSeries(self.axes[rows], self.points[rows], self.turning[rows])

    def at(self, values: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Rotations (M, 3, 3), places (M, 3) and twists (M, 6, f), (omega, v at the origin), at joint values (M, f)."""
        count, joints = values.shape
        rotation: FloatArray = np.broadcast_to(np.eye(3), (count, 3, 3))
        place, columns = np.zeros((count, 3)), []
        for joint in range(joints):
            turning, axis, value = self.turning[:, joint, None], self.axes[:, joint], values[:, joint, None]
            line = np.einsum("mij,mj->mi", rotation, axis)
            point = np.einsum("mij,mj->mi", rotation, self.points[:, joint]) + place
            omega = np.where(turning, line, 0.0)
            columns.append(np.concatenate([omega, np.where(turning, np.cross(point, line), line)], axis=1))
            place = place + np.where(turning, 0.0, value * line)
            turned = from_vector(np.where(turning, value * line, 0.0))
            rotation = turned @ rotation
            place = np.where(turning, np.einsum("mij,mj->mi", turned, place - point) + point, place)
        return rotation, place, np.stack(columns, axis=-1)

    def turned(self, turn: FloatArray) -> PlacedSeries:
        """All of them turned about the origin by (3, 3)."""
        return PlacedSeries(self.axes @ turn.T, self.points @ turn.T, self.turning)

    def repeated(self, count: int) -> PlacedSeries:
        """Each series so many times, one after the other."""
        return self[np.repeat(np.arange(len(self.axes)), count)]


def best_of(draws: Sequence[PlacedSeries]) -> PlacedSeries:
    """Of each series, drawn several times, the one that is farthest from losing a freedom at home.

    Joints that stand nearly on one line could hardly follow anything.
    """
    smallest = [np.linalg.svd(one.at(np.zeros(one.turning.shape))[2], compute_uv=False)[:, -1] for one in draws]
    best, rows = np.argmax(smallest, axis=0), np.arange(len(draws[0].axes))
    axes, points, turning = (np.stack(parts)[best, rows] for parts in zip(*map(_parts, draws), strict=True))
    return PlacedSeries(axes, points, turning)


def _parts(series: PlacedSeries) -> tuple[FloatArray, FloatArray, Mask]:
    return series.axes, series.points, series.turning


def series_of(chains: Sequence[Chain], generator: np.random.Generator) -> PlacedSeries:
    """Chains of R, P, C, U and S with as many freedoms each, the labelled point in the origin, other joints at random.

    >>> from assur.topology.notation import parse_chain
    >>> one = series_of([parse_chain("R[x]@O U[x,y@O]")], np.random.default_rng(0))
    >>> off = np.cross(one.points, one.axes)[0]  # how far the axes pass the origin
    >>> [bool(np.any(row)) for row in off.round(12)]
    [False, True, False]
    """
    return best_of([_drawn(chains, generator) for _ in range(DRAWS)])


def _drawn(chains: Sequence[Chain], generator: np.random.Generator) -> PlacedSeries:
    every = [[step for joint in chain.joints for step in _steps(joint, generator)] for chain in chains]
    axes, points = (np.array([[step[part] for step in steps] for steps in every]) for part in (0, 1))
    return PlacedSeries(axes, points, np.array([[turning for _, _, turning in steps] for steps in every]))


def _steps(
    joint: ChainJoint | Parallelogram, generator: np.random.Generator
) -> Iterator[tuple[FloatArray, FloatArray, bool]]:
    """Axis, point and whether it turns, of each freedom of a joint."""
    if isinstance(joint, Parallelogram):
        raise UsageError("a parallelogram has no place in a series of revolute and prismatic joints")
    axes = np.array(joint.axes) if joint.axes else np.eye(3)
    on_axis = next((axis for axis, labels in enumerate(joint.through) if labels), None)
    point = generator.uniform(-SIZE, SIZE, 3)
    if joint.point:
        point = np.zeros(3)
    elif on_axis is not None:
        point = generator.uniform(0.3, 1.0) * SIZE * axes[on_axis]
    if joint.type.letter in ("P", "C"):
        yield axes[0], point, False
    if joint.type.letter != "P":
        for axis in axes:
            yield axis, point, True


def at_point(twists: FloatArray, point: FloatArray) -> FloatArray:
    """Twists (N, 6, f) with v at a point (3,) instead of the origin."""
    there = twists[:, 3:] + np.cross(twists[:, :3], point[None, :, None], axis=1)
    return np.concatenate([twists[:, :3], there], axis=1)


def following(series: PlacedSeries, leader: PlacedSeries, values: FloatArray) -> tuple[Mask, FloatArray]:
    """Whether series M can take all poses of another one, and their joint values (M, N, f) there.

    Args:
        series: M of them.
        leader: one series.
        values: (N, g) of its joints.
    """
    count, poses = len(series.axes), len(values)
    every = series.repeated(poses)
    at = np.zeros((count * poses, series.axes.shape[1]))
    reached = np.ones(len(at), dtype=bool)
    for part in PARTS:
        rotation, place, _ = leader.repeated(poses).at(part * values)
        target = np.tile(rotation, (count, 1, 1)), np.tile(place, (count, 1))

        def gap(
            q: FloatArray, rows: IndexArray, target: tuple[FloatArray, FloatArray] = target
        ) -> tuple[FloatArray, FloatArray]:
            turned, moved, twists = every[rows].at(q)
            error = to_vector(turned @ np.swapaxes(target[0][rows], -1, -2))
            rates = twists[:, 3:] + np.cross(twists[:, :3], moved[:, :, None], axis=1)
            return np.concatenate([error, moved - target[1][rows]], axis=1), np.concatenate(
                [twists[:, :3], rates], axis=1
            )

        closed = minimise(gap, at, tolerance=CLOSED, max_steps=30)
        at, reached = closed.x, reached & closed.converged
    return np.all(reached.reshape(count, poses), axis=1), at.reshape(count, poses, -1)
