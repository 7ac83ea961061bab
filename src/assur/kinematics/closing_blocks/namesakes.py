"""Namesakes: two solutions of one problem between which none of some signs differs, but another does.

Solutions need not merge anywhere: a crank that cannot come to lie across the others keeps its side. Nor need home's
problem have both of them. So assemblies on two sides of a sign, wherever they are, are led to the same problem.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.border import held_inputs, inputs_of
from assur.kinematics.closing_blocks.columns import ScrewColumns
from assur.kinematics.closing_blocks.signs import ChangingSign, factor_signs
from assur.kinematics.closure import assemble
from assur.kinematics.configurations import SAME, places
from assur.kinematics.modes import Problem
from assur.kinematics.pose import pose_of
from assur.kinematics.still import otherwise
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.intp]
SignArray = NDArray[np.int8]
MOST_PAIRS = 6
"""Pairs that are led to one problem, for each sign; the nearest."""


def namesakes(
    problem: Problem, known: Sequence[ChangingSign], screws: ScrewColumns, telling: Sequence[int]
) -> NDArray[np.bool_]:
    """Which signs (P, s) differ between two solutions of one problem, which those with the places `telling` do not.

    Args:
        problem: "direct" holds the inputs, "inverse" the pose.
        known: the signs.
        screws: of assemblies (N, n), some of which are led to the problems of others.
        telling: places of signs that have names, or that the inputs decide.
    """
    record, signs = screws.record, factor_signs(known, screws)
    regular = np.all(signs != 0, axis=1)
    near, signs = screws.values[regular], signs[regular]
    first, second = _pairs(signs, _given(record, problem, near), telling)
    if not len(first):
        return np.zeros((0, len(known)), dtype=bool)
    starts, others = near[[*first, *second]], near[[*second, *first]]
    if problem == "direct":
        begun = held_inputs(record, starts, inputs_of(record, others))
        closed = assemble(record, begun, held=record.input_indices)
    else:
        closed = assemble(record, starts, poses=pose_of(record, others))
    gaps = np.abs(places(record, closed.values) - places(record, others))
    apart = closed.closed & (np.max(gaps, axis=1, initial=0.0) > SAME)
    apart[apart] = [not other for other in otherwise(record, closed.values[apart])]
    own = factor_signs(known, ScrewColumns(record, closed.values))
    unlike = np.asarray(own != signs[[*second, *first]])[apart & np.all(own != 0, axis=1)]
    return np.asarray(unlike[~np.any(unlike[:, [*telling]], axis=1)])


def _given(record: MechanismRecord, problem: Problem, values: FloatArray) -> FloatArray:
    """Inputs or poses (N, m), in rad and characteristic lengths."""
    length = characteristic_length(record)
    if problem == "inverse":
        units = np.array([length if name in LENGTHS else 1.0 for name in record.platform.pose])
        return np.asarray(pose_of(record, values) / units)
    units = np.array([length if driven.coordinate.kind == "length" else 1.0 for driven in record.inputs])
    return np.asarray(inputs_of(record, values) / units)


def _pairs(signs: SignArray, given: FloatArray, telling: Sequence[int]) -> tuple[IntArray, IntArray]:
    """Rows and rows of signs (N, s) between which no sign that tells differs, but another does; near problems first."""
    named = np.unique(signs[:, [*telling]], axis=0, return_inverse=True)[1].reshape(-1)
    first, second = np.nonzero(np.triu(named[:, None] == named, 1))
    order = np.argsort(np.linalg.norm(given[first] - given[second], axis=1), kind="stable")
    unlike = signs[first[order]] != signs[second[order]]
    kept = np.unique([order[row] for column in unlike.T for row in np.flatnonzero(column)[:MOST_PAIRS]]).astype(int)
    return first[kept], second[kept]
