"""Rays from poses to where a parallel factor first changes its sign, and fans that make the nearest crossing nearer.

Let f be the parallel factors of det Jp along one working mode, p a pose, and d a unit direction of its coordinates that
are lengths. On the ray p + r d, the orientation held, let r(d) be the least length at which a factor changes its sign.
The distance from the nearest singularity is the least r(d) over all d; r is neither smooth nor finite everywhere, so it
is searched by comparing signs alone.

1. Directions are spread over all ways. Each ray is cut into pieces; the first piece with different signs at its ends
   brackets r(d). A ray that leaves the workspace is followed to its border, where a serial radicand m vanishes: a
   factor g - sqrt(m) falls there with an infinite slope, and may change its sign in a sliver that no piece shows.
2. Rays that end in small factors on the border without a crossing are led along it: fans of rays round them go on with
   that one which ends in the least factor, until one crosses. That finds wedges in which the borders of two limbs meet.
3. Each start is pinned by bisection, then made nearer: of a fan of rays that are a little shorter, the nearest crossing
   is the next start. A fan without a nearer one is halved. Near a smooth surface, where r(d) = r0 (1 + c a^2) at an
   angle a from the least, an angle of 2^-n costs a share of 4^-n.

An answer is the length of a ray at whose end a factor was seen to vanish, so an upper bound; a surface that is thinner
than the pieces, or narrower than the directions are apart, may be missed.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.status import FACTOR_TOLERANCE
from assur.singularity.directions import basis, directions, fans
from assur.singularity.parallel_factors import BoolArray, FloatArray, ParallelFactors, packed

IndexArray = NDArray[np.int_]

CHUNK = 128
"""Poses from which rays go all ways at a time: with 96 directions and 17 lengths 200,000 poses, some tens of MB."""

PIECES = 16
"""Pieces of a ray that goes as far as is looked; a factor with two zeros within one piece shows none."""

STARTS = ((3, 3), (1, 3), (1, 3))
"""Of each set of rays, turned by chance: how many of the nearest crossings, and of the rays that end in the smallest
factors on the border, are starts. Three of the first, as the nearest of a few directions need not lead to the least."""

LEADS = 10
"""Fans along the border: halved each time that none is better, they end within a thousandth of the spacing."""

ROUNDS = 22
"""Fans towards a nearer crossing; with as many halvings 4^-n would be below what a crossing is pinned to."""

FAN_PIECES = 4
"""Pieces of a ray of a fan, which begins a little before the crossing that is known."""

BORDER_HALVINGS = 8
"""Halvings of a piece on which a ray leaves the workspace: what is left out of it is 1/4096 of the ray."""

HALVINGS = 40
"""Halvings of a bracket: its 2^-40 is a share of 1e-12, beside the 1e-9 to which loops count as closed."""

ON_SURFACE = 1e-5
"""Share of its scale within which a factor counts as zero at a pinned change of sign: 25 times `FACTOR_TOLERANCE`, to
which one with the root of a radicand is known on the border. Where a factor jumps, as at a pole, it is larger."""


@dataclass(frozen=True, eq=False)
class Brackets:
    """First changes of sign on rays (...).

    Attributes:
        low, high: (...) lengths between which each lies, infinite where there is none.
        at_border: (...) the least factor where the ray meets the border of the workspace, infinite where it does not.
    """

    low: FloatArray
    high: FloatArray
    at_border: FloatArray

    def of(self, rows: IndexArray, rays: IndexArray) -> Brackets:
        """Those of some rays (M,)."""
        return Brackets(self.low[rows, rays], self.high[rows, rays], self.at_border[rows, rays])


@dataclass(frozen=True)
class Rays:
    """Rays over the parallel factors of one working mode."""

    factors: ParallelFactors

    def nearest(self, poses: FloatArray, reach: float) -> tuple[FloatArray, IndexArray, FloatArray]:
        """The nearest crossing from poses (N, m) within a reach.

        Returns:
            Lengths (N,), infinite where there is none and NaN where the mode does not reach the pose; the row of the
            factor that vanishes there (N,), -1 for none; the singular poses (N, m), NaN for none.
        """
        values, reached = self.factors.at(poses)
        if not len(values):  # no factor, so no crossing
            return np.where(reached, np.inf, np.nan), np.full(len(poses), -1), np.full(poses.shape, np.nan)
        lengths = np.where(np.any(np.abs(values) <= FACTOR_TOLERANCE, axis=0), 0.0, np.inf)
        ways = np.zeros((len(poses), self._size))
        regular = np.flatnonzero(reached & np.isinf(lengths))
        rng = np.random.default_rng(7)
        for starts in STARTS:  # each set within the ball that remains
            trial, trial_ways = self._nearest_of_set(poses[regular], np.minimum(lengths[regular], reach), starts, rng)
            nearer = trial < lengths[regular]
            lengths[regular[nearer]], ways[regular[nearer]] = trial[nearer], trial_ways[nearer]
        hit = reached & np.isfinite(lengths)
        singular, rows = np.full(poses.shape, np.nan), np.full(len(poses), -1)
        singular[hit] = self.factors.moved(poses[hit], ways[hit], lengths[hit])
        rows[hit] = np.argmin(np.abs(self.factors.at(singular[hit])[0]), axis=0)
        return np.where(reached, lengths, np.nan), rows, singular

    def _nearest_of_set(
        self, poses: FloatArray, limit: FloatArray, starts: tuple[int, int], rng: np.random.Generator
    ) -> tuple[FloatArray, FloatArray]:
        """The nearest crossing (N,) within limits (N,) by one set of rays, infinite for none, its direction (N, k)."""
        spread, spacing = directions(self._size)
        spread = spread @ basis(rng, self._size)
        first = self._first_brackets(poses, spread, limit)
        by_length, by_factor = np.argsort(first.low, axis=1), np.argsort(first.at_border, axis=1)
        chosen = np.concatenate([by_length[:, : starts[0]], by_factor[:, : starts[1]]], axis=1)  # (N, starts)
        rows, rays = np.repeat(np.arange(len(poses)), chosen.shape[1]), chosen.ravel()
        ways, bracket = spread[rays], first.of(rows, rays)
        led = np.flatnonzero(np.isinf(bracket.low) & np.isfinite(bracket.at_border))
        ways[led], bracket.low[led], bracket.high[led] = self._led_along_border(
            poses[rows[led]], ways[led], limit[rows[led]], bracket.at_border[led], spacing
        )
        lengths, ways = self._narrowed(poses[rows], ways, self.pinned(poses[rows], ways, bracket), spacing)
        best = np.argmin(lengths.reshape(chosen.shape), axis=1) + chosen.shape[1] * np.arange(len(poses))
        return lengths[best], ways[best]

    def _first_brackets(self, poses: FloatArray, spread: FloatArray, limit: FloatArray) -> Brackets:
        """Brackets (N, D) on rays all ways."""
        parts = [np.s_[first : first + CHUNK] for first in range(0, max(1, len(poses)), CHUNK)]
        brackets = [self.brackets(poses[part], spread[None], 0 * limit[part], limit[part], PIECES) for part in parts]
        return Brackets(*(np.concatenate([getattr(part, name) for part in brackets]) for name in vars(brackets[0])))

    def _led_along_border(
        self, poses: FloatArray, ways: FloatArray, limit: FloatArray, least: FloatArray, spacing: float
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Directions (N, k) to which fans lead along the border, and brackets on them (N,), infinite for none.

        They begin at rays within a limit (N,) that meet the border, with the least factor (N,) there.
        """
        ways, least, spread = ways.copy(), least.copy(), np.full(len(poses), spacing)
        low, high = np.full((2, len(poses)), np.inf)
        rng = np.random.default_rng(11)
        for _ in range(LEADS if self._size > 1 else 0):
            open_ = np.flatnonzero(np.isinf(low))
            fan = fans(ways[open_], spread[open_], rng)
            trial = self.brackets(poses[open_], fan, 0 * limit[open_], limit[open_], PIECES)
            rank = np.where(np.isfinite(trial.low), -1.0, trial.at_border)  # a crossing comes before every factor
            rows, best = np.arange(len(open_)), np.argmin(rank, axis=1)
            better = rank[rows, best] < least[open_]
            ways[open_[better]], least[open_[better]] = fan[rows, best][better], rank[rows, best][better]
            low[open_], high[open_] = trial.low[rows, best], trial.high[rows, best]
            spread[open_[~better]] *= 0.5
        return ways, low, high

    def _narrowed(
        self, poses: FloatArray, ways: FloatArray, lengths: FloatArray, spacing: float
    ) -> tuple[FloatArray, FloatArray]:
        """Crossings (N,) to which narrowing fans lead from known ones, infinite for none; their directions (N, k)."""
        ways, lengths = ways.copy(), lengths.copy()
        spread = np.where(np.isfinite(lengths), spacing, 0.0)
        rng = np.random.default_rng(7)
        for _ in range(ROUNDS if self._size > 1 else 0):
            known = np.flatnonzero(np.isfinite(lengths))
            fan = fans(ways[known], spread[known], rng)
            # At an angle a off, a plane with the slant b is 1 - a tan(b) as far: 1 - 2 a allows for slants of 63 deg.
            start = lengths[known] * np.maximum(0.0, 1.0 - 2.0 * spread[known])
            trial = self.brackets(poses[known], fan, start, lengths[known], FAN_PIECES)
            rows, best = np.arange(len(known)), np.argmin(trial.high, axis=1)
            pinned = self.pinned(poses[known], fan[rows, best], trial.of(rows, best))
            nearer = pinned < lengths[known]
            lengths[known[nearer]], ways[known[nearer]] = pinned[nearer], fan[rows, best][nearer]
            spread[known[~nearer]] *= 0.5
        return lengths, ways

    def brackets(self, poses: FloatArray, ways: FloatArray, low: FloatArray, high: FloatArray, pieces: int) -> Brackets:
        """First changes of sign (N, D) on rays from poses (N, m) in directions (N, D, k) or (1, D, k).

        They are looked for in so many pieces between lengths (N,).
        """
        cuts = low[:, None] + (high - low)[:, None] * np.linspace(0.0, 1.0, pieces + 1)  # (N, S + 1)
        ways = np.broadcast_to(ways, (len(poses), *ways.shape[1:]))
        lengths = np.broadcast_to(cuts[:, None], (*ways.shape[:2], pieces + 1))  # (N, D, S + 1)
        signs, reached = self.factors.signs(self.factors.moved(poses[:, None, None], ways[:, :, None], lengths))
        start, end = lengths[..., :-1].copy(), lengths[..., 1:].copy()  # of each piece (N, D, S)
        crossed = reached[..., 1:] & reached[..., :-1] & (signs[..., 1:] != signs[..., :-1])
        at_border = np.full(crossed.shape, np.inf)
        split = np.nonzero(reached[..., 1:] != reached[..., :-1])  # pieces that the border splits (B,)
        leaves = reached[..., :-1][split]
        inner, outer = np.where(leaves, start[split], end[split]), np.where(leaves, end[split], start[split])
        outer = self.border(poses[split[0]], ways[split[:2]], inner, outer)
        values, _ = self.factors.at(self.factors.moved(poses[split[0]], ways[split[:2]], outer))
        at_border[split] = np.min(np.abs(values), axis=0)
        crossed[split] = packed(values) != np.where(leaves, signs[..., :-1][split], signs[..., 1:][split])
        start[split], end[split] = np.minimum(inner, outer), np.maximum(inner, outer)
        return Brackets(*_first(crossed, start, end), np.min(at_border, axis=-1))

    def border(self, poses: FloatArray, ways: FloatArray, inner: FloatArray, outer: FloatArray) -> FloatArray:
        """Lengths (N,) a little beyond the border of the workspace, which lies between two lengths (N,).

        Beyond it, where a radicand counts as zero, factors have the values of the border itself.
        """
        for _ in range(BORDER_HALVINGS):
            middle = 0.5 * (inner + outer)
            _, reached = self.factors.signs(self.factors.moved(poses, ways, middle))
            inner, outer = np.where(reached, middle, inner), np.where(reached, outer, middle)
        return outer

    def pinned(self, poses: FloatArray, ways: FloatArray, bracket: Brackets) -> FloatArray:
        """Lengths (N,) at which signs first change in brackets (N,); infinite where no factor vanishes in the mode."""
        known = np.flatnonzero(np.isfinite(bracket.high))
        poses, ways, low, high = poses[known], ways[known], bracket.low[known], bracket.high[known]
        signs, _ = self.factors.signs(self.factors.moved(poses, ways, low))
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            same = self.factors.signs(self.factors.moved(poses, ways, middle))[0] == signs
            low, high = np.where(same, middle, low), np.where(same, high, middle)
        values, reached = self.factors.at(self.factors.moved(poses, ways, high))
        zero = reached & np.any(np.abs(values) <= ON_SURFACE, axis=0)
        lengths = np.full(len(bracket.high), np.inf)
        lengths[known[zero]] = high[zero]
        return lengths

    @property
    def _size(self) -> int:
        return len(self.factors.columns)


def _first(crossed: BoolArray, start: FloatArray, end: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Start and end (N, D) of the first piece of each ray that is crossed (N, D, S), infinite where none is."""
    first, hit = np.argmax(crossed, axis=-1)[..., None], np.any(crossed, axis=-1)
    low, high = (np.where(hit, np.take_along_axis(side, first, -1)[..., 0], np.inf) for side in (start, end))
    return low, high
