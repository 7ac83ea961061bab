"""Rays from poses to where a parallel factor first changes its sign: the nearest crossing, found by narrowing fans.

Along a ray the signs of the factors are compared from point to point, and once more at the border of the workspace: a
factor that holds the root of a serial radicand may change its sign in a sliver there. Round the nearest crossings
smaller and smaller fans look for nearer ones. Where the factors are smallest on the border, fans go along it towards
still smaller ones until they cross: that finds the wedges in which the borders of two limbs meet.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.closed_form.filling import Engine
from assur.kinematics.closed_form.sweep import inverse_sweep
from assur.kinematics.status import FACTOR_TOLERANCE, closed_form_of, scale
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
CHUNK = 128
"""Poses that are worked on at a time while rays go all ways."""

GOLDEN = (5**0.5 - 1) / 2

RAYS = {1: 2, 2: 120, 3: 96}
"""Directions in a line, a plane and in space."""

STEPS = 16
"""Pieces of a ray."""

SETS = ((3, 3), (1, 3), (1, 3))
"""Of each set of rays: how many of the nearest crossings, and of the rays that end in the smallest factors on the
border, are starts of fans."""

LURES = 10
"""How often fans are thrown along the border."""

ROUNDS, PIECES = 22, 4
"""How often a fan of rays in so many pieces is thrown; one that finds nothing nearer is halved."""

HALVINGS, FINE = 8, 40
"""Halvings that find the border on a piece of a ray, and those that find where a sign changes."""

ON_SURFACE = 1e-5
"""Share of its scale within which a factor is zero at the pose that is said to be singular."""


class Rays:
    """Rays in the lengths of a pose, over the parallel factors of one working mode."""

    def __init__(self, record: MechanismRecord, mode: str, columns: list[int], engine: Engine) -> None:
        factors = closed_form_of(record).factor_list
        self.record, self.mode, self.columns, self.engine = record, mode, columns, engine
        self.rows = [k for k, item in enumerate(factors) if item.kind == "parallel"]
        self.names = [factors[k].name for k in self.rows]
        self.scales = np.array([[scale(record, factors[k].scale)] for k in self.rows])  # (F, 1)
        self.bits = 2 ** np.arange(len(self.rows))

    def of(self, poses: FloatArray, reach: float) -> tuple[FloatArray, NDArray[np.int_], FloatArray]:
        """Distance (N,), row of the factor (N,), -1 for none, and the singular pose (N, m)."""
        values, there = self.sample(poses)
        away = np.where(np.any(np.abs(values) <= FACTOR_TOLERANCE * self.scales, axis=0), 0.0, np.inf)
        ways = np.zeros((len(poses), len(self.columns)))
        todo = np.flatnonzero(there & np.isinf(away))
        rng = np.random.default_rng(7)
        for starts in SETS:  # each in the ball that remains
            found, way = self.round(poses[todo], np.minimum(away[todo], reach), starts, rng)
            closer = found < away[todo]
            away[todo[closer]], ways[todo[closer]] = found[closer], way[closer]
        hit = there & np.isfinite(away)
        nearest, which = np.full(poses.shape, np.nan), np.full(len(poses), -1)
        nearest[hit] = self.moved(poses[hit], ways[hit], away[hit])
        which[hit] = np.argmin(np.abs(self.sample(nearest[hit])[0]) / self.scales, axis=0)
        return np.where(there, away, np.nan), which, nearest

    def round(
        self, poses: FloatArray, limit: FloatArray, starts: tuple[int, int], rng: np.random.Generator
    ) -> tuple[FloatArray, FloatArray]:
        """The nearest crossing (N,) within limits (N,), infinite where there is none, and the way (N, k) to it."""
        fixed, spacing = directions(len(self.columns))
        fixed = fixed @ _turn(rng, len(self.columns))
        parts = [np.s_[first : first + CHUNK] for first in range(0, max(1, len(poses)), CHUNK)]
        found = [self.crossings(poses[part], fixed[None], 0 * limit[part], limit[part], STEPS) for part in parts]
        low, high, omen = (np.concatenate(side) for side in zip(*found, strict=True))
        chosen = np.concatenate(
            [np.argsort(low, axis=1)[:, : starts[0]], np.argsort(omen, axis=1)[:, : starts[1]]], axis=1
        )
        rows, picked = np.repeat(np.arange(len(poses)), chosen.shape[1]), chosen.ravel()
        bracket, ways = (low[rows, picked], high[rows, picked]), fixed[picked]
        lured = np.flatnonzero(np.isinf(bracket[0]) & np.isfinite(omen[rows, picked]))
        ways[lured], bracket[0][lured], bracket[1][lured] = self.lured(
            poses[rows[lured]], ways[lured], limit[rows[lured]], omen[rows[lured], picked[lured]], spacing
        )
        away, ways = self.descended(poses[rows], ways, bracket, spacing)
        best = np.argmin(away.reshape(chosen.shape), axis=1) + chosen.shape[1] * np.arange(len(poses))
        return away[best], ways[best]

    def lured(
        self, poses: FloatArray, ways: FloatArray, limit: FloatArray, omen: FloatArray, spacing: float
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Ways (N, k) with brackets to which fans lead along the border, towards smaller factors; infinite for none."""
        ways, omen, spread = ways.copy(), omen.copy(), np.full(len(poses), spacing)
        low, high = np.full((2, len(poses)), np.inf)
        rng = np.random.default_rng(11)
        for _ in range(LURES if len(self.columns) > 1 else 0):
            some = np.flatnonzero(np.isinf(low))
            fan = _normed(ways[some, None] + spread[some, None, None] * _fan(rng, len(self.columns)))
            start, end, sign = self.crossings(poses[some], fan, 0 * limit[some], limit[some], STEPS)
            sign[np.isfinite(start)] = -1.0
            rows, best = np.arange(len(some)), np.argmin(sign, axis=1)
            better = sign[rows, best] < omen[some]
            ways[some[better]], omen[some[better]] = fan[rows, best][better], sign[rows, best][better]
            low[some], high[some] = start[rows, best], end[rows, best]
            spread[some[~better]] *= 0.5
        return ways, low, high

    def descended(
        self, poses: FloatArray, ways: FloatArray, bracket: tuple[FloatArray, FloatArray], spacing: float
    ) -> tuple[FloatArray, FloatArray]:
        """The crossing (N,) that narrowing fans of rays lead to from one in brackets on ways (N, k), and its way."""
        ways, away = ways.copy(), self.pinned(poses, ways, *bracket)
        spread = np.where(np.isfinite(away), spacing, 0.0)
        rng = np.random.default_rng(7)
        for _ in range(ROUNDS if len(self.columns) > 1 else 0):
            some = np.flatnonzero(np.isfinite(away))
            fan = _normed(ways[some, None] + spread[some, None, None] * _fan(rng, len(self.columns)))
            start = away[some] * np.maximum(0.0, 1.0 - 2.0 * spread[some])
            low, high, _ = self.crossings(poses[some], fan, start, away[some], PIECES)
            best = np.argmin(high, axis=1)
            rows = np.arange(len(some))
            trial = self.pinned(poses[some], fan[rows, best], low[rows, best], high[rows, best])
            closer = trial < away[some]
            away[some[closer]], ways[some[closer]] = trial[closer], fan[rows, best][closer]
            spread[some[~closer]] *= 0.5
        return away, ways

    def crossings(
        self, poses: FloatArray, ways: FloatArray, low: FloatArray, high: FloatArray, pieces: int
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Between which lengths (N, D) the signs change first on rays (N, D, k) from lengths (N,) to lengths (N,).

        And the least factor (N, D), over its scale, where a ray meets the border; all infinite where there is none.
        """
        at = low[:, None] + (high - low)[:, None] * np.linspace(0.0, 1.0, pieces + 1)  # (N, S + 1)
        ways = np.broadcast_to(ways, (len(poses), *ways.shape[1:]))
        shape = (*ways.shape[:2], pieces + 1)
        radii = np.broadcast_to(at[:, None], shape)
        signs, there = self.signs(self.moved(poses[:, None, None], ways[:, :, None], radii))
        start, end = radii[..., :-1].copy(), radii[..., 1:].copy()
        crossed = there[..., 1:] & there[..., :-1] & (signs[..., 1:] != signs[..., :-1])
        ray = np.nonzero(there[..., 1:] != there[..., :-1])
        leaves = there[..., :-1][ray]
        inner = np.where(leaves, start[ray], end[ray])
        outer = self.border(poses[ray[0]], ways[ray[:2]], inner, np.where(leaves, end[ray], start[ray]))
        values, _ = self.sample(self.moved(poses[ray[0]], ways[ray[:2]], outer))
        beyond, omen = self.bits @ np.signbit(values).astype(int), np.full(crossed.shape, np.inf)
        omen[ray] = np.min(np.abs(values) / self.scales, axis=0)
        crossed[ray] = beyond != np.where(leaves, signs[..., :-1][ray], signs[..., 1:][ray])
        start[ray], end[ray] = np.minimum(inner, outer), np.maximum(inner, outer)
        first, hit = np.argmax(crossed, axis=-1)[..., None], np.any(crossed, axis=-1)
        low, high = (np.where(hit, np.take_along_axis(side, first, -1)[..., 0], np.inf) for side in (start, end))
        return low, high, np.min(omen, axis=-1)

    def border(self, poses: FloatArray, ways: FloatArray, inner: FloatArray, outer: FloatArray) -> FloatArray:
        """Lengths (N,) a little beyond the border of the workspace, which lies between two lengths (N,)."""
        for _ in range(HALVINGS):
            middle = 0.5 * (inner + outer)
            _, there = self.signs(self.moved(poses, ways, middle))
            inner, outer = np.where(there, middle, inner), np.where(there, outer, middle)
        return outer

    def pinned(self, poses: FloatArray, ways: FloatArray, low: FloatArray, high: FloatArray) -> FloatArray:
        """Lengths (N,) at which the first sign changes between two; infinite where no factor vanishes in the mode."""
        known = np.flatnonzero(np.isfinite(high))
        answer = np.full(len(poses), np.inf)
        poses, ways, low, high = poses[known], ways[known], low[known], high[known]
        signs, _ = self.signs(self.moved(poses, ways, low))
        for _ in range(FINE):
            middle = 0.5 * (low + high)
            here, _ = self.signs(self.moved(poses, ways, middle))
            low, high = np.where(here == signs, middle, low), np.where(here == signs, high, middle)
        values, there = self.sample(self.moved(poses, ways, high))
        on = there & np.any(np.abs(values) <= ON_SURFACE * self.scales, axis=0)
        answer[known[on]] = high[on]
        return answer

    def moved(self, poses: FloatArray, ways: FloatArray, lengths: FloatArray) -> FloatArray:
        """Poses (..., m) moved by lengths (...) along ways (..., k) in the coordinates that are lengths."""
        moved = np.array(np.broadcast_to(poses, (*lengths.shape, poses.shape[-1])))
        moved[..., self.columns] += lengths[..., None] * ways
        return moved

    def signs(self, poses: FloatArray) -> tuple[NDArray[np.int_], BoolArray]:
        """Signs of all factors in one number (...) at poses (..., m), and whether the mode reaches them (...)."""
        values, there = self.sample(poses.reshape(-1, poses.shape[-1]))
        return (self.bits @ np.signbit(values).astype(int)).reshape(poses.shape[:-1]), there.reshape(poses.shape[:-1])

    def sample(self, poses: FloatArray) -> tuple[FloatArray, BoolArray]:
        """Parallel factors (F, N) at poses (N, m), and whether the mode reaches them (N,)."""
        columns = np.ascontiguousarray(poses.T)
        found = inverse_sweep(self.record, columns, self.mode, ("exists", "factors"), engine=self.engine)
        return found["factors"][self.rows], found["exists"]


def directions(size: int) -> tuple[FloatArray, float]:
    """Unit vectors (D, k) spread over a line, a plane or space, and the angle between neighbours.

    >>> ways, spacing = directions(3)
    >>> ways.shape, np.abs(ways.sum(axis=0)).max() < 0.5, round(spacing, 2)
    ((96, 3), np.True_, 0.36)
    """
    count = RAYS[size]
    turns = 2 * np.pi * np.arange(count)
    if size == 1:
        return np.array([[1.0], [-1.0]]), 0.0
    if size == 2:
        return np.stack([np.cos(turns / count), np.sin(turns / count)], axis=-1), 2 * np.pi / count
    height = 1.0 - (2.0 * np.arange(count) + 1.0) / count
    angle, radius = turns * GOLDEN, np.sqrt(1.0 - height**2)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), height], axis=-1), (4 * np.pi / count) ** 0.5


def _normed(vectors: FloatArray) -> FloatArray:
    return np.asarray(vectors / np.linalg.norm(vectors, axis=-1, keepdims=True))


def _fan(rng: np.random.Generator, size: int) -> FloatArray:
    """Unit vectors (FAN, k) in pairs of opposites, turned by chance."""
    basis = _turn(rng, size)
    return np.concatenate([basis, -basis])


def _turn(rng: np.random.Generator, size: int) -> FloatArray:
    """An orthonormal basis (k, k) by chance."""
    return np.asarray(np.linalg.qr(rng.normal(size=(size, size)))[0])
