"""Where operation modes meet: singular places on random paths through one mode, from which another one is entered.

Along a path the least singular value of the closure that counts dips to zero where it crosses a singularity. There the
closure has one freedom more. Short steps along it that close again, the shorter the nearer, are in the modes that meet.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.numerics.least_squares import minimise
from assur.topology.screws.assembly_equations import CLOSED, EXACTLY, Equations, Hold, loop_equations
from assur.topology.screws.linkage import Linkage
from assur.topology.screws.mode_kinds import ModeKind, kind_around, numbers_at
from assur.topology.screws.parallelograms import crossed
from assur.topology.screws.screws import screw_tree

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.intp]

PATHS, STEPS, STEP = 8, 40, 0.1
"""Random paths through a mode, their steps, and the largest displacement of a joint (rad, lengths) in each."""

GOLDEN = (5**0.5 - 1) / 2
NARROWED = 26
"""Steps of golden section: 0.618^26 of a step is 4e-6 of it."""

SINGULAR = 1e-5
"""Share of the largest singular value below which a dip is a singularity: loops near one close to the root of 1e-14."""

PLACES = 4
"""Singular places that are looked at."""

LEAPS = (0.06, 0.015)
"""Steps (rad, lengths) off a singular place: where both lead to another mode, it is no stretch away."""

FAR = 1e3
"""So far from where it was aimed is what no loops close at."""

WAYS = 6
"""Directions of these steps."""


def meetings_met(
    linkage: Linkage, value: FloatArray, hold: Hold | None = None
) -> Iterator[tuple[ModeKind, FloatArray]]:
    """Kinds of other modes that are entered from that of an assembly (n,), with a place (n,) where that is.

    Args:
        linkage: assembled at home.
        value: an assembly inside one mode.
        hold: as in `assur.topology.screws.configurations.configurations`.
    """
    scales = screw_tree(linkage).scales
    mode = _Mode.around(loop_equations(linkage, hold), value / scales)
    known = {_numbers(linkage, value)}
    for place in mode.singular_places(value / scales):
        for ends in mode.leaps(place):
            far, near = ({_numbers(linkage, end * scales)} for end in ends)
            if far == near and None not in far and not far <= known:
                kind = kind_around(linkage, ends[1] * scales, hold=hold)
                if kind is not None:
                    known |= far
                    yield kind[0], place * scales


def _numbers(linkage: Linkage, value: FloatArray) -> tuple[object, ...] | None:
    """What tells kinds apart at one assembly (n,), None where ranks are not clear."""
    numbers = numbers_at(linkage, value[None])
    return None if numbers is None else (*numbers, crossed(linkage, value))


@dataclass(frozen=True, eq=False)
class _Mode:
    """The closed loops of a linkage, and how many of their equations are independent in one mode."""

    equations: Equations
    rank: int

    @classmethod
    def around(cls, equations: Equations, start: FloatArray) -> _Mode:
        return cls(equations, int(np.sum(_singular_values(equations, start[None])[0] > SINGULAR)))

    def singular_places(self, start: FloatArray) -> FloatArray:
        """Assemblies (M, n) on random paths from one (n,) where the closure loses rank, one from each dip."""
        path = self._path(np.repeat(start[None], PATHS, axis=0))
        dips = self._least(path.reshape(-1, path.shape[-1])).reshape(path.shape[:2])
        step, number = np.nonzero((dips[1:-1] < dips[:-2]) & (dips[1:-1] < dips[2:]))
        deepest = np.argsort(dips[step + 1, number])[: 2 * PLACES]
        step, number = step[deepest], number[deepest]
        if not len(step):
            return np.zeros((0, len(start)))
        places = self._narrowed(*(path[step + k, number] for k in (0, 1, 2)))
        return places[self._least(places) < SINGULAR][:PLACES]

    def leaps(self, place: FloatArray) -> Iterator[FloatArray]:
        """Assemblies (2, n), far and near, off a singular one (n,) in directions with its freedom more."""
        turned = np.linalg.svd(self.equations(place[None], np.arange(1))[1][0])[2]
        more, free = turned[self.rank - 1], turned[self.rank :]
        rng = np.random.default_rng(0)
        for number in range(WAYS):
            way = (-1) ** number * more + rng.normal(size=len(free)) / max(len(free), 1) ** 0.5 @ free
            aim = place + np.array(LEAPS)[:, None] * way / np.max(np.abs(way))
            ends = self._polished(self._closed(aim))
            if np.all(np.max(np.abs(ends - aim), axis=1) < np.array(LEAPS) / 2):
                yield ends

    def _path(self, values: FloatArray) -> FloatArray:
        """Assemblies (S, N, n) along a path from each of (N, n), which goes on as it went where loops do not close."""
        rng = np.random.default_rng(0)
        heading = rng.normal(size=values.shape)
        path = [values]
        for _ in range(STEPS):
            free = np.linalg.svd(self.equations(values, np.arange(len(values)))[1])[2][:, self.rank :]
            way = np.einsum("nki,nk->ni", free, np.einsum("nki,ni->nk", free, heading))
            ends = self._closed(values + STEP * way / np.maximum(np.max(np.abs(way), axis=1, keepdims=True), STEP))
            gone = np.max(np.abs(ends - values), axis=1)
            went = (gone < 2 * STEP)[:, None]
            heading = np.where(went, (ends - values) / STEP, rng.normal(size=values.shape))
            values = np.where(went, ends, values)
            path.append(values)
        return np.stack(path)

    def _narrowed(self, before: FloatArray, middle: FloatArray, after: FloatArray) -> FloatArray:
        """Assemblies (N, n) with the least singular value between others, by golden section along two chords."""

        def at(share: FloatArray) -> FloatArray:
            first, second = np.minimum(share, 0.0)[:, None], np.maximum(share, 0.0)[:, None]
            return self._closed(middle + first * (middle - before) + second * (after - middle))

        low, high = -np.ones(len(before)), np.ones(len(before))
        left, right = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
        at_left, at_right = self._least(at(left)), self._least(at(right))
        for _ in range(NARROWED):
            less = at_left < at_right
            low, high = np.where(less, low, left), np.where(less, right, high)
            new = np.where(less, high - GOLDEN * (high - low), low + GOLDEN * (high - low))
            at_new = self._least(at(new))
            left, right = np.where(less, new, right), np.where(less, left, new)
            at_left, at_right = np.where(less, at_new, at_right), np.where(less, at_left, at_new)
        return self._polished(at((low + high) / 2))

    def _least(self, values: FloatArray) -> FloatArray:
        """The least singular value of the closure that counts (N,), as a share of the largest."""
        return _singular_values(self.equations, values)[:, self.rank - 1]

    def _closed(self, aim: FloatArray) -> FloatArray:
        """Assemblies (N, n) near others; far away where there are none."""
        closed = minimise(self.equations, aim, tolerance=CLOSED, max_steps=40)
        return np.where(closed.converged[:, None], closed.x, aim + FAR)

    def _polished(self, values: FloatArray) -> FloatArray:
        """Assemblies (N, n) with loops closed to rounding."""
        return minimise(self.equations, values, tolerance=EXACTLY, max_steps=8).x


def _singular_values(equations: Equations, values: FloatArray) -> FloatArray:
    """Those of the closure (N, k), as shares of the largest."""
    singular = np.linalg.svd(equations(values, np.arange(len(values)))[1], compute_uv=False)
    return np.asarray(singular / singular[:, :1])
