"""Which rows and columns solve for joint rates: chosen once for a mechanism, at assemblies around home."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.programs import program
from assur.joint_graph.tree import joint_graph
from assur.kinematics.pose import platform_frame
from assur.kinematics.rates.motions import around_home, general
from assur.kinematics.turns import joint_units
from assur.kinematics.validation.check import METRES
from assur.machine.masses.link_masses import Masses
from assur.machine.motion.inertia import link_inertia
from assur.machine.motion.joint_motion import closed_motion, joint_scales_si
from assur.machine.motion.loop_equations import Equations, angle_numbers
from assur.machine.motion.recorded_dynamics import IdleMotion
from assur.machine.motion.screws import joint_screws, paths
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS, rate_names
from assur.numerics.elimination import ZERO, Pivots, chosen_pivots

FloatArray = NDArray[np.float64]

STILL = 1e-9
"""Rates that are smaller at all examples are none."""


@dataclass(frozen=True)
class GraphPivots:
    """Pivots among the rows of the loops and of the pose's rates, and the motions of columns without one."""

    loops: Pivots
    held: Pivots
    idle: tuple[IdleMotion, ...]


@lru_cache(maxsize=64)
def graph_pivots(record: MechanismRecord) -> GraphPivots | None:
    """Pivots that are good around home; None where the pose's rates are not free there, or drives are too few.

    >>> from assur.model.registry import load_record
    >>> own = graph_pivots(load_record("delta_4s"))
    >>> len(own.loops), len(own.held), [motion.links for motion in own.idle][:2]
    (30, 3, [('leg1.rod1',), ('leg1.rod2',)])
    """
    usual, names, loops = general(record), rate_names(record.platform.pose), 6 * len(joint_graph(record).cut)
    if not int(usual.pose) == int(usual.inputs) == int(usual.related) == len(names):
        return None
    values = around_home(record)
    matrices = _equations(record, values)
    ranks = np.linalg.matrix_rank(matrices[:, :loops], tol=ZERO)
    fit = ranks == int(usual.closure)
    first, held = chosen_pivots(matrices[fit], (range(loops), range(loops, loops + len(names))))
    if len(first) != int(usual.closure) or len(held) != len(names):
        return None
    return GraphPivots(first, held, _idle_motions(record, (*first, *held), matrices[fit], values[fit]))


def weighs(record: MechanismRecord, known: Masses) -> bool | None:
    """Whether motions that leave the pose as it is all weigh (True), or none; None where some do."""
    own = graph_pivots(record)
    if own is None or not own.idle:
        return False
    values = around_home(record)[-1:]
    kept = int(closed_motion(link_inertia(record, values, known), values).weighing[0])
    return None if 0 < kept < len(own.idle) else kept > 0


def _equations(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """Entries (N, r, n) as numbers."""
    names, loops, length = rate_names(record.platform.pose), len(joint_graph(record).cut), characteristic_length(record)
    asked = Equations(record.platform.pose)
    own = program(record, asked, asked.given)
    given = angle_numbers(platform_frame(record, values)[0]) if asked.given else None
    shape = 6 * loops + len(names), len(record.coordinates)
    matrices = own.matrix("entry", own(record, values, given), shape) * joint_units(record)
    lengths = [False] * 3 + [True] * 3
    matrices[:, [*lengths * loops, *(name in LENGTHS for name in names)]] /= length
    return np.asarray(matrices)


def _idle_motions(
    record: MechanismRecord, pivots: Pivots, matrices: FloatArray, values: FloatArray
) -> tuple[IdleMotion, ...]:
    rows, columns = ([pivot[k] for pivot in pivots] for k in (0, 1))
    signs, length = paths(record).of_links, METRES[record.unit] * characteristic_length(record)
    motions = []
    for column in sorted(set(range(matrices.shape[2])) - set(columns)):
        rates = np.zeros((len(values), matrices.shape[2]))
        rates[:, columns] = -np.linalg.solve(matrices[:, rows][:, :, columns], matrices[:, rows, column, None])[..., 0]
        rates[:, column] = 1.0
        twists = np.einsum("lj,skj,sj->lks", signs, joint_screws(record, values), rates * joint_scales_si(record))
        moved = np.abs(twists) > STILL * np.repeat([1.0, length], 3)[:, None]
        links = [link for link, own in zip(paths(record).links, moved, strict=True) if np.any(own)]
        support = np.flatnonzero(np.max(np.abs(rates), axis=0) > STILL)
        motions.append(IdleMotion(column, tuple(support.tolist()), tuple(links)))
    return tuple(motions)
