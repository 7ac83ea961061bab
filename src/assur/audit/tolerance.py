"""How far a printed number may be from ours: from its digits and those it is computed from, and nothing else.

    tolerance = half a unit of its last place + sum over j of |dr/dg_j| * half a unit of the last place of g_j

for a result r at given printed numbers g_j, with dr/dg from Jp v = Jq qdot at the solution that it is compared with.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from assur.audit.printed import Printed
from assur.kinematics.answers.at_border import inputs_from_border, pose_from_border
from assur.kinematics.modes import Problem, all_modes
from assur.kinematics.rates.velocity import velocity_map
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]


def half_units(digits: Sequence[Printed]) -> FloatArray:
    """Half a unit of the last place of each number (k,), in its own unit."""
    return np.array([number.half_unit for number in digits])


def tolerances(
    record: MechanismRecord,
    problem: Problem,
    pose: FloatArray,
    mode: str,
    given: Sequence[Printed],
    results: Sequence[Printed],
) -> FloatArray:
    """Tolerance (k,) of each printed result at a solution, in the unit that it is printed in.

    The solution is its pose (m,), in lengths and rad, and its working mode; `given` are the printed numbers
    that the problem was solved for.

    Where the sensitivity does not exist (a singular solution, two merged branches) only the results' own digits count.
    """
    sensitivity = _sensitivity(record, problem, pose, mode)
    return half_units(results) + np.abs(sensitivity) @ half_units(given)


def _sensitivity(record: MechanismRecord, problem: Problem, pose: FloatArray, mode: str) -> FloatArray:
    """d(result)/d(given) (k, j), both in the units of the border; zero where it does not exist."""
    inputs_unit = inputs_from_border(record, np.ones(len(record.inputs)))
    pose_unit = pose_from_border(record, np.ones(len(pose)))
    shape = (len(pose), len(inputs_unit)) if problem == "direct" else (len(inputs_unit), len(pose))
    if mode not in all_modes(record, "inverse"):
        return np.zeros(shape)
    velocity = velocity_map(record, pose, mode)
    if problem == "direct":
        matrix = velocity.matrix * inputs_unit / pose_unit[:, None]
    else:
        columns = [velocity.input(direction) for direction in np.eye(len(pose))]
        matrix = np.stack(columns, axis=-1) * pose_unit / inputs_unit[:, None]
    return matrix if np.all(np.isfinite(matrix)) else np.zeros(shape)
