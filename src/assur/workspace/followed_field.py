"""A followed field: a number read off the joint values that following gives, and continued beyond the border.

It is continued as the root of a closed form would be (`continued_past`). So a singularity locus runs up to the border
and along it; two loci nearer to each other than a cell are not seen, as the sign of the one determinant is the same on
both sides of them, and where two cross the crossing is rounded off within a cell.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt

from assur.kinematics.following.followed_grid import Continuation, Followed
from assur.workspace.slices import Columns

FloatArray = NDArray[np.float64]
ROUNDS = 6
"""Steps of the false position in which a field is brought to zero on an edge, at most."""

ZERO = 1e-6
"""It counts as zero at this share of what it is at the ends."""

SHORTEST = 0.01
"""Least share of a way from which a field is continued beyond its end."""


@dataclass(frozen=True, eq=False)
class FollowedField:
    """A field over a continuation: a number (N,) of what was followed to N points."""

    over: Continuation
    of: Callable[[Followed], FloatArray]

    def __call__(self, columns: Columns) -> FloatArray:
        """The field at points whose coordinates broadcast."""
        wide = np.broadcast_arrays(*columns)
        points = np.stack([column.ravel() for column in wide], axis=1).astype(float)
        return self.values(points).reshape(wide[0].shape)

    def values(self, points: FloatArray) -> FloatArray:
        """The field (N,) at points (N, d); where the mode does not reach that at the nearest node, continued."""
        at_points = self.over.at(points)
        return np.where(at_points.reached, self.of(at_points), self._at_nodes[tuple(self.over.nodes(points).T)])

    def known(self, points: FloatArray) -> FloatArray:
        """The field (N,) at points (N, d); NaN where the mode does not reach that."""
        return np.asarray(self.of(self.over.at(points)))

    @cached_property
    def _at_nodes(self) -> FloatArray:
        """The field (nodes..), continued beyond the border; -1 everywhere where nothing is reached."""
        over, ends = self.over, self.over.ends
        values = np.full(over.reached.shape, np.nan)
        if not np.any(over.reached):
            return np.full_like(values, -1.0)
        values[over.reached] = self.of(over.at_nodes)
        rows = ends.longest
        first, last = values[tuple(ends.tails[rows].T)], self.of(over.at_ends)[rows]
        values[tuple(ends.heads[rows].T)] = continued_past(first, last, ends.share[rows])
        return filled(values)

    def crossing(self, start: FloatArray, end: FloatArray) -> FloatArray:
        """Share (N,) of the way between points (N, 3) at which the field is zero, by false position (Illinois).

        Where the mode ends on the way it is zero before the end, or beyond, where the field is continued. Where it
        does not reach the way at all the zero is interpolated.
        """
        size = len(self.over.axes)
        start, end = start[:, :size], end[:, :size]
        first, last = self.values(start), self.values(end)
        crossed = (first >= 0) != (last >= 0)
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.where(crossed, first / (first - last), np.nan)
        from_start, beyond = self.over.at(start).reached, self.over.at(end).reached
        rows = np.flatnonzero(crossed & from_start & beyond)
        share[rows] = self._zero(start[rows], end[rows], first[rows], last[rows])
        for rows, turned in ((crossed & from_start & ~beyond, False), (crossed & beyond & ~from_start, True)):
            inside, outside = (end[rows], start[rows]) if turned else (start[rows], end[rows])
            ahead, behind = (last[rows], first[rows]) if turned else (first[rows], last[rows])
            portion = self._across(inside, outside, ahead, behind)
            share[rows] = 1.0 - portion if turned else portion
        return share

    def _across(self, inside: FloatArray, outside: FloatArray, ahead: FloatArray, behind: FloatArray) -> FloatArray:
        """Share (N,) of ways out of the mode, between points (N, d), at which the field, known at both, is zero."""
        ends, joints = self.over.border(inside, outside)
        value = self.of(Followed(self.over.record, joints))
        before = (value >= 0) != (ahead >= 0)
        with np.errstate(divide="ignore", invalid="ignore"):
            share = ends + (1.0 - ends) * (value / (value - behind)) ** 2
        stop = inside + ends[:, None] * (outside - inside)
        rows = np.flatnonzero(before)
        share[rows] = ends[rows] * self._zero(inside[rows], stop[rows], ahead[rows], value[rows], bent=True)
        return share

    def _zero(
        self, start: FloatArray, end: FloatArray, first: FloatArray, last: FloatArray, bent: bool = False
    ) -> FloatArray:
        """Share (N,) of the way between points (N, d) with fields (N,) of different signs at which it vanishes.

        With `bent` the ways end at the border, where fields run as the square root of what is left of the way.
        """
        low, high, share = np.zeros(len(start)), np.ones(len(start)), np.full(len(start), 0.5)
        size = np.maximum(np.abs(first), np.abs(last))
        first, last, before = first.copy(), last.copy(), np.zeros(len(start), dtype=np.int8)
        rows = np.arange(len(start))
        for _ in range(ROUNDS):
            share[rows] = low[rows] + (high[rows] - low[rows]) * first[rows] / (first[rows] - last[rows])
            part = _straight(share[rows], bent)
            value = self.values(start[rows] + part[:, None] * (end[rows] - start[rows]))
            same = (value >= 0) == (first[rows] >= 0)
            front, back = rows[same], rows[~same]
            # the end that stays for a second time counts half
            last[front[before[front] == 1]] *= 0.5
            first[back[before[back] == -1]] *= 0.5
            low[front], first[front], before[front] = share[front], value[same], 1
            high[back], last[back], before[back] = share[back], value[~same], -1
            rows = rows[np.abs(value) > ZERO * size[rows]]
        return _straight(share, bent)


def _straight(share: FloatArray, bent: bool) -> FloatArray:
    return 1.0 - (1.0 - share) ** 2 if bent else share


def continued_past(first: FloatArray, last: FloatArray, share: FloatArray) -> FloatArray:
    """A field (N,) at the far end of ways at whose `share` the mode ends, from what it is at the start and there.

    It ends where it turns back into another branch, and fields run as a + b sqrt(d) at the distance d from there.
    Beyond, the smooth function a - b sqrt(d) goes on with them.

    >>> continued_past(np.array([3.0]), np.array([1.0]), np.array([0.2]))
    array([-3.])
    """
    share = np.maximum(share, SHORTEST)
    return np.asarray(last + (last - first) * np.sqrt((1.0 - share) / share))


def filled(values: FloatArray) -> FloatArray:
    """A field (nodes..) with no NaN: beside known nodes as a plane through three of them, else the nearest value."""
    for _ in range(values.ndim - 1):
        values = np.where(np.isnan(values), _planes(values), values)
    nearest = distance_transform_edt(np.isnan(values), return_distances=False, return_indices=True)
    return np.asarray(values[tuple(nearest)])


def _planes(values: FloatArray) -> FloatArray:
    """At each node the mean over the squares of the grid that it closes of what makes them plane; NaN without one."""
    total, count = np.zeros(values.shape), np.zeros(values.shape)
    padded = np.pad(values, 1, constant_values=np.nan)

    def moved(steps: dict[int, int]) -> FloatArray:
        return padded[
            tuple(slice(1 + steps.get(k, 0), size + 1 + steps.get(k, 0)) for k, size in enumerate(values.shape))
        ]

    for i, j in itertools.combinations(range(values.ndim), 2):
        for a, b in itertools.product((-1, 1), repeat=2):
            plane = moved({i: a}) + moved({j: b}) - moved({i: a, j: b})
            known = np.isfinite(plane)
            total[known] += plane[known]
            count += known
    with np.errstate(invalid="ignore"):
        return np.asarray(total / count)
