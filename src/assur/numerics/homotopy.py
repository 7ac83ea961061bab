"""All solutions of polynomial systems from those of another one, along a path of parameters (homotopy continuation).

The path begins at t = 1, with the solutions that are known, and ends at t = 0, where the coefficients are exact. The
unknowns are homogeneous. Where solutions meet at the end, or at infinity, an end game goes round the end in circles.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from assur.numerics.expanded import ExpandedSystem
from assur.numerics.path_tracking import along, polished

ComplexArray = NDArray[np.complex128]
FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IndexArray = NDArray[np.intp]

CLOSE = 1e-4
"""Largest correction of a predicted point of length 1; where a larger one is needed the step was too long."""
RADII = tuple(2 * 10.0**-k for k in range(2, 14))
"""The t at which the end game begins, and at which it is played again until it says the same: where parameters are
nearly special, as legs nearly equal, paths branch once more close by, at the square of what they differ by."""
SETTLED = 1e-8
CORNERS = 8
MOST_CIRCLES = 8
REGULAR = 1e-9
"""Smallest `rank_gap` of a regular end."""
SAME = 1e-6
"""Points of length 1 whose distance is smaller are one solution."""
PROBED = 4
"""Ends that are not regular whose limits are looked for first where all should be: one that settles is enough."""
ARC = 0.5
"""First step on an arc of the end game, as a share of it: half of an arc at a root of t errs by less than `CLOSE`."""


class PathEnd(IntEnum):
    """How a path ended: at a regular solution, at one where solutions meet, or nowhere that is known."""

    regular = 0
    singular = 1
    lost = 2


@dataclass(frozen=True, eq=False)
class PathEnds:
    """Ends of paths.

    Attributes:
        x: (N, n), of length 1; of lost paths where they were last in the end game, or at its first radius.
        end: (N,), what they are, `PathEnd`.
        near: (N,), whether x is at the end or on a circle round it, smaller than the largest.
        steps: of the slowest path.
    """

    x: ComplexArray
    end: NDArray[np.int8]
    near: BoolArray
    steps: int


def solve(
    system: ExpandedSystem,
    starts: ComplexArray,
    useless: Callable[[ComplexArray], BoolArray] | None = None,
    *,
    all_regular: bool = False,
) -> PathEnds:
    """Follow every start (K, n), a solution at t = 1, to t = 0 in each of P problems: ends (P K), problem by problem.

    Paths that were lost, or came together at a regular end, where two cannot, are followed again with smaller steps;
    not so those that were lost at points (N, n) which are `useless`: they have ended there. With `all_regular` one end
    that is singular is enough, and what the others are that are not regular is not asked: they are lost.

    Example: the square roots of -4 and of 9, from those of 1.

    >>> from assur.numerics.expanded import expand, unknowns
    >>> x, y, t = unknowns(3)
    >>> system = expand([x * x - (np.array([-4.0, 9.0]) * (1 - t) + (1 - 3j * (1 - t)) * t) * y * y])
    >>> ends = solve(system, np.array([[1, 1], [-1, 1]], dtype=complex))
    >>> np.abs((ends.x[:, 0] / ends.x[:, 1]) ** 2 - [-4, -4, 9, 9]).max() < 1e-12
    np.True_
    """
    count = len(system.coefficients)
    problem = np.repeat(np.arange(count), len(starts))
    first = np.tile(starts, (count, 1))
    ends = follow(system, first, problem, all_regular=all_regular)
    if all_regular and np.any(ends.end == PathEnd.singular):
        return ends
    if useless is not None:
        near = np.flatnonzero((ends.end == PathEnd.lost) & ends.near)
        ends.end[near[useless(ends.x[near])]] = PathEnd.singular
    again = np.flatnonzero((ends.end == PathEnd.lost) | _together(ends, count))
    if len(again):
        better = follow(system, first[again], problem[again], close=CLOSE / 100)
        ends.x[again], ends.end[again], ends.near[again] = better.x, better.end, better.near
        ends.end[_together(ends, count)] = PathEnd.lost
    return ends


def follow(
    system: ExpandedSystem, x: ComplexArray, problem: IndexArray, *, close: float = CLOSE, all_regular: bool = False
) -> PathEnds:
    """Follow solutions x (N, n) of problems (N,) from t = 1 to t = 0.

    An end is regular where the Jacobian has full rank, singular where the end game finds a limit, else lost. With
    `all_regular` it is played no more once a limit is known.
    """
    count = len(x)
    edge = np.full(count, RADII[0])
    before, arrived, steps = along(system, x, problem, np.ones(count), edge, close)
    last, reached, more = along(system, before, problem, edge, np.zeros(count), close)
    last, converged = polished(system, last, np.zeros(count), problem)
    regular = arrived & reached & converged & (rank_gap(system, last, problem) > REGULAR)
    end = np.where(regular, PathEnd.regular, PathEnd.lost).astype(np.int8)
    last[~regular], near = before[~regular], regular.copy()
    rest = np.flatnonzero(arrived & ~regular)
    for rows in (rest[:PROBED], rest[PROBED:]) if all_regular else (rest,):
        if len(rows) and not (all_regular and np.any(end == PathEnd.singular)):
            last[rows], settled, near[rows] = _end_game(system, before[rows], problem[rows], close)
            end[rows[settled]] = PathEnd.singular
    return PathEnds(last, end, near, steps + more)


def rank_gap(system: ExpandedSystem, x: ComplexArray, problem: IndexArray) -> FloatArray:
    """Smallest singular value (N,) of the Jacobian at points x (N, n) of length 1 and t = 0.

    Each equation is divided by its largest coefficient.
    """
    _, slope, _ = system.evaluate(x, np.zeros(len(x)), problem)
    size = np.max(np.abs(system.coefficients[problem, 0]), axis=-1)
    return np.asarray(np.linalg.svd(slope / size[..., None], compute_uv=False)[:, -1])


def distinct(x: ComplexArray) -> IndexArray:
    """Indices of the first of each group of points (N, n) of length 1 that are one line through the origin.

    >>> distinct(np.array([[1, 0], [0, 1], [-1j, 0]]))
    array([0, 1])
    """
    overlap = np.abs(x.conj() @ x.T)
    return np.flatnonzero(~np.any(np.tril(1 - overlap**2 < SAME**2 + 1e-12, -1), axis=1))


def _together(ends: PathEnds, count: int) -> BoolArray:
    """Which regular ends (P K) are not the only one of their problem at their place."""
    x = ends.x.reshape(count, -1, ends.x.shape[-1])
    regular = (ends.end == PathEnd.regular).reshape(count, -1)
    overlap = np.abs(x.conj() @ np.swapaxes(x, 1, 2)) ** 2
    near = (1 - overlap < SAME**2 + 1e-12) & regular[:, :, None] & regular[:, None, :]
    return np.asarray((np.sum(near, axis=2) > 1).ravel())


def _end_game(
    system: ExpandedSystem, x: ComplexArray, problem: IndexArray, close: float
) -> tuple[ComplexArray, BoolArray, BoolArray]:
    """Limits (N, n) at t = 0 of paths that are at x (N, n) at the first radius, and whether they have settled (N,).

    Of those that have not, where they were last, and whether (N,) that is nearer than the first radius.
    """
    points = x.copy()
    limit, closed = _limits(system, x, problem, RADII[0], close)
    settled, near = np.zeros(len(x), dtype=bool), np.zeros(len(x), dtype=bool)
    rows = np.arange(len(x))
    for first, last in itertools.pairwise(RADII):
        ways = np.full(len(rows), first), np.full(len(rows), last)
        nearer, arrived, _ = along(system, points[rows], problem[rows], *ways, close)
        points[rows[arrived]], rows = nearer[arrived], rows[arrived]
        near[rows] = True
        before = closed[rows]
        again, now = _limits(system, points[rows], problem[rows], last, close)
        same = before & now & (_distance(again, limit[rows]) < SETTLED)
        limit[rows], closed[rows] = again, now
        settled[rows[same]] = True
        rows = rows[~same]
    return np.where(settled[:, None], limit, points), settled, near


def _limits(
    system: ExpandedSystem, x: ComplexArray, problem: IndexArray, radius: float, close: float
) -> tuple[ComplexArray, BoolArray]:
    """Limits (N, n) at t = 0 of paths that are at x (N, n) at t = radius, and whether they come back (N,).

    A path that is a power series of the w-th root of t comes back after w circles round t = 0; its mean over them is
    its value at the centre (Cauchy's integral; Morgan, Sommese, Wampler 1991).
    """
    corners = radius * np.exp(2j * np.pi * np.arange(CORNERS + 1) / CORNERS)
    reference = x.conj()
    points, total, limit = x.copy(), np.zeros_like(x), np.ones_like(x)
    closed = np.zeros(len(x), dtype=bool)
    rows = np.arange(len(x))
    for circle in range(1, MOST_CIRCLES + 1):
        for first, last in itertools.pairwise(corners):
            total[rows] += points[rows] / np.sum(reference[rows] * points[rows], axis=1, keepdims=True)
            ways = np.full(len(rows), first), np.full(len(rows), last)
            points[rows], arrived, _ = along(system, points[rows], problem[rows], *ways, close, ARC)
            rows = rows[arrived]
        back = _distance(points[rows], x[rows]) < SAME
        limit[rows[back]] = total[rows[back]] / (CORNERS * circle)
        closed[rows[back]] = True
        rows = rows[~back]
    return limit / np.linalg.norm(limit, axis=1, keepdims=True), closed


def _distance(first: ComplexArray, second: ComplexArray) -> FloatArray:
    """Distances (N,) between lines through the origin, given by points (N, n) of length 1."""
    overlap = np.sum(first.conj() * second, axis=1, keepdims=True)
    return np.asarray(np.linalg.norm(second - first * overlap, axis=1))
