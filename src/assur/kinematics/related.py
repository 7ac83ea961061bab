"""Assemblies in which all linear relations between joint values hold that hold about home: what is parallel stays so.

A linear function of the joint values that stands still about home does so on every regular path from it. Loops that
close anyhow mostly break such relations, if there are many: parallelograms cross over, and platforms turn.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.tree import joint_graph
from assur.kinematics.closure import FAR_DAMPING, FAR_LEAST, Assembly, assemble, closing_system
from assur.kinematics.home import home_values
from assur.kinematics.still import assemblies_about_home
from assur.kinematics.turns import joint_units
from assur.model.mechanism import MechanismRecord
from assur.numerics.elimination import independent_columns
from assur.numerics.least_squares import minimise

FloatArray = NDArray[np.float64]
RELATED = 1e-6
"""Share of the largest change about home up to which a direction is none of those of changes: squares are larger."""

EXACT, MOST_STEPS = 1e-15, 8
"""To which loops are closed at last: relations hold to as many digits, also where loops are nearly singular. So many
steps are enough from where they close to `RELATED`."""


@lru_cache(maxsize=64)
def related(record: MechanismRecord) -> tuple[tuple[int, ...], FloatArray] | None:
    """Joint values that determine all others linearly, by their places, and how all (n, k) change with them.

    None where no relation holds, or where rotation vectors of ball joints are among the values: they are not linear.

    >>> from assur.model.registry import load_record
    >>> free, changes = related(load_record("fivebar"))
    >>> changes[-1].round(6)
    array([-1.,  1., -1.,  1.])
    """
    home, units = home_values(record), joint_units(record)
    if joint_graph(record).turns:
        return None
    moved = (assemblies_about_home(record, 2 * len(home)) - home) / units
    _, sizes, right = np.linalg.svd(moved, full_matrices=False)
    own = right[: int(np.sum(sizes > RELATED * np.max(sizes, initial=0.0)))]
    if not 0 < len(own) < len(home):
        return None
    free = independent_columns(own)
    return tuple(free.tolist()), units[:, None] * np.linalg.solve(own[:, free], own).T / units[free]


def closed_as_related(record: MechanismRecord, starts: FloatArray) -> Assembly:
    """Assemblies (N, n) in which home's relations hold, of starts (S, n) that lead to one; none without relations.

    Of a start those joint values count that determine the others.
    """
    if (relations := related(record)) is None:
        return assemble(record, starts[:0])
    free, changes = relations
    length, home = characteristic_length(record), home_values(record)
    rates = changes * joint_units(record)[[*free]]
    begun = home + (starts - home)[:, free] @ changes.T

    def system(unknowns: FloatArray, rows: NDArray[np.intp]) -> tuple[FloatArray, FloatArray]:
        gaps, derivative = closing_system(record, begun[rows] + unknowns @ rates.T, None)
        return gaps / length, derivative @ rates / length

    start = np.zeros((len(starts), len(free)))
    nearest = minimise(system, start, tolerance=RELATED, damping=FAR_DAMPING, least=FAR_LEAST)
    values = (begun + nearest.x @ rates.T)[nearest.converged]
    return assemble(record, values, near=True, tolerance=EXACT, max_steps=MOST_STEPS)
