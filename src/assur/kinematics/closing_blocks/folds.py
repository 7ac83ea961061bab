"""Folds: pairs of solutions of one problem that merge where a sign is zero, next to each other on its two sides.

One problem seldom shows every branch: of two roots each may be real at places of its own. Where a root is zero, both of
its solutions are real; so each is met next to its fold, wherever that is.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.border import held_inputs, inputs_of
from assur.kinematics.closing_blocks.columns import ScrewColumns
from assur.kinematics.closing_blocks.signs import ChangingSign, factor_signs
from assur.kinematics.closing_blocks.strokes import with_zero
from assur.kinematics.closure import RANK_GAP, assemble
from assur.kinematics.configurations import SAME, places
from assur.kinematics.modes import Problem
from assur.kinematics.pose import pose_of
from assur.kinematics.rates.motions import motions
from assur.kinematics.still import otherwise
from assur.kinematics.turns import joint_units, periodic
from assur.model.mechanism import MechanismRecord
from assur.numerics.modulo_two import independent

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int_]
SignArray = NDArray[np.int8]
STEP = 1e-6
"""Of a difference quotient, in rad or characteristic lengths."""

UNMOVED = 1e-6
"""What is added to the squares of the rates of inputs or pose: a motion that moves none of them costs a little."""

HALVINGS = 6
"""Of the way between two assemblies, towards where a sign is zero."""

MOST_STEPS = 20
"""Of one halving: what closes no sooner halves its way once more. With 80 all names of 43 mechanisms are the same."""

MOST_ENDS = 256
"""Assemblies whose pairs are looked at: as many more or less evenly among those that are given."""

MOST_PAIRS = 24
"""Pairs of assemblies between which a fold is sought."""

CLOSE = 0.5
"""Distance of two solutions, in rad and characteristic lengths, up to which nothing else vanishes between them."""

ASIDE = 0.25
"""Share of the way across within which the other solution is where it is looked for: else it is another one."""


def differing_at_folds(
    problem: Problem, known: Sequence[ChangingSign], screws: ScrewColumns, telling: Sequence[int] = ()
) -> NDArray[np.bool_]:
    """Which signs (P, s) differ between two solutions of the problem that merge, at folds between assemblies.

    No fold is sought where each sign is a product of those with the places `telling`, in every one of the assemblies:
    then it differs as these do. Signs that the inputs decide may be among them.
    """
    if not known:
        return np.zeros((0, 0), dtype=bool)
    record, signs = screws.record, factor_signs(known, screws)
    regular = np.all(signs != 0, axis=1)
    chosen = np.flatnonzero(regular)[:: 1 + int(np.sum(regular)) // MOST_ENDS]
    near, signs = screws.values[chosen], signs[chosen]
    own = np.sort(np.unique(signs, axis=1, return_index=True)[1])
    if max(independent((signs[:, [*telling, *own]] != signs[:1, [*telling, *own]]).T), default=0) < len(telling):
        return np.zeros((0, len(known)), dtype=bool)
    first, second, column = _pairs_across(record, near, signs[:, own])
    if not len(column):
        return np.zeros((0, len(known)), dtype=bool)
    pairs = _Folds(record, problem, [known[k] for k in own]).between(near[first], near[second], column)
    before, after = (factor_signs(known, ScrewColumns(record, values)) for values in pairs)
    sound = np.all((before != 0) & (after != 0), axis=1)
    return np.unique((before != after)[sound], axis=0)


@dataclass(frozen=True, eq=False)
class _Folds:
    """The way to folds of a problem.

    Attributes:
        record: the mechanism.
        problem: "direct" holds the inputs, "inverse" the pose.
        known: the signs that change there.
    """

    record: MechanismRecord
    problem: Problem
    known: Sequence[ChangingSign]

    def between(self, first: FloatArray, second: FloatArray, column: IntArray) -> tuple[FloatArray, FloatArray]:
        """Pairs (P, n), (P, n) of assemblies with the same inputs, or the same pose, on two sides of a fold.

        Args:
            first: assemblies (N, n).
            second: others (N, n).
            column: (N,) which sign differs between them: it is zero somewhere on the way.
        """
        near = self._approached(first, second, column)
        ways = self._ways(near, column)
        close = self._size(2.0 * ways) < CLOSE  # NaN is not
        near, ways = near[close], ways[close]
        if not len(near):
            return near, near
        starts = near + 2.0 * ways
        if self.problem == "direct":
            starts = held_inputs(self.record, starts, inputs_of(self.record, near))
            closed = assemble(self.record, starts, held=self.record.input_indices)
        else:
            closed = assemble(self.record, starts, poses=pose_of(self.record, near))
        aside = self._size(closed.values - starts) <= ASIDE * self._size(2.0 * ways)
        gaps = np.abs(places(self.record, near) - places(self.record, closed.values))
        apart = np.max(gaps, axis=1, initial=0.0) > SAME
        alike = np.array([not other for other in otherwise(self.record, closed.values)], dtype=bool)
        own = closed.closed & aside & apart & alike
        return near[own], closed.values[own]

    def _approached(self, first: FloatArray, second: FloatArray, column: IntArray) -> FloatArray:
        """Assemblies (N, n) near which the sign is zero: by halving the way, whose ends close all the time."""
        first = first.copy()
        sign = with_zero(self._shares(first, column))
        way = second - first
        turning = periodic(self.record)
        way[:, turning] = np.remainder(way[:, turning] + np.pi, 2.0 * np.pi) - np.pi
        for _ in range(HALVINGS):
            way = way / 2.0
            closed = assemble(self.record, first + way, near=True, max_steps=MOST_STEPS)
            onward = closed.closed & (with_zero(self._shares(closed.values, column)) == sign)
            way[onward] += first[onward] + way[onward] - closed.values[onward]
            first[onward] = closed.values[onward]
        return first

    def _shares(self, values: FloatArray, column: IntArray) -> FloatArray:
        """What the sign of a column (N,) is, as a share, at an assembly (N, n) each."""
        shares = np.empty(len(values))
        for k in np.unique(column):
            own = column == k
            shares[own] = self.known[k].shares(ScrewColumns(self.record, values[own]))
        return shares

    def _ways(self, values: FloatArray, column: IntArray) -> FloatArray:
        """Changes (N, n) of joint values (N, n) that take the sign of a column (N,) to zero; inputs or pose move least.

        Near a fold it is that of the motion which is lost, and the other solution is as far beyond it.
        """
        at = motions(self.record, values, RANK_GAP)
        moving = np.flatnonzero(np.any(at.null != 0.0, axis=(0, 1)))
        steps = np.swapaxes(at.null[:, :, moving], -1, -2) * at.scale
        rates = (at.inputs if self.problem == "direct" else at.twists)[:, :, moving]
        resistance = np.swapaxes(rates, -1, -2) @ rates + UNMOVED * np.eye(len(moving))
        beside = (values[:, None] + STEP * steps).reshape(-1, values.shape[1])
        shares = self._shares(values, column)
        moved = self._shares(beside, np.repeat(column, len(moving))).reshape(len(values), len(moving))
        slopes = (moved - shares[:, None]) / STEP
        across = np.linalg.solve(resistance, slopes[:, :, None])[:, :, 0]
        with np.errstate(invalid="ignore", divide="ignore"):
            rates = -shares[:, None] * across / np.sum(slopes * across, axis=-1, keepdims=True)
        return np.asarray(np.einsum("nf,nfi->ni", rates, steps))

    def _size(self, changes: FloatArray) -> FloatArray:
        return np.asarray(np.linalg.norm(changes / joint_units(self.record), axis=-1))


def _pairs_across(record: MechanismRecord, values: FloatArray, signs: SignArray) -> tuple[IntArray, IntArray, IntArray]:
    """Rows, rows and columns (P,): near assemblies (N, n) between which a sign (N, s) differs; alone before others."""
    where = places(record, values)
    first, second = np.triu_indices(len(values), 1)
    order = np.argsort(np.linalg.norm(where[first] - where[second], axis=1), kind="stable")
    first, second = first[order], second[order]
    kinds, nearest = _unequal_rows(signs[first] != signs[second])
    pair, column = np.nonzero(kinds)
    ranked = np.lexsort((nearest[pair], np.sum(kinds, axis=1)[pair]))[:MOST_PAIRS]
    rows = nearest[pair[ranked]]
    return first[rows], second[rows], column[ranked]


def _unequal_rows(rows: NDArray[np.bool_]) -> tuple[NDArray[np.bool_], IntArray]:
    """The rows (M, s) that differ among rows (N, s), in order, and where (M,) each stands first.

    As bytes they are sorted many times sooner than as rows of an array.
    """
    packed = np.ascontiguousarray(np.packbits(rows, axis=1))
    _, places = np.unique(packed.view(f"V{packed.shape[1]}")[:, 0], return_index=True)
    return rows[places], places
