"""First-order motion of any mechanism, from the null space of its closure: Jp v = Jq qdot, singularities, constraints.

The joint rates that keep every loop closed are the null space N of the closure Jacobian. Its rows of the
inputs and of the pose's rates, N_q and N_x, say all that a velocity analysis asks. Jp and Jq are the relations
between them: (Jp, -Jq) is an orthonormal basis of the left null space of (N_x; N_q), so they exist at
singularities too, and are unique up to a common orthogonal factor. Every rank is taken where lengths count in
units of the characteristic length.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.border import Named, checked_joints
from assur.kinematics.closure import CLOSED, closure_error
from assur.kinematics.pose import turning_matrix
from assur.kinematics.rates.architecture import usual_ranks
from assur.kinematics.rates.motions import (
    SINGULAR,
    InstantaneousMotion,
    IntArray,
    Ranks,
    drive_units,
    general_share,
    motions,
    pose_units,
)
from assur.model.mechanism import MechanismRecord
from assur.results.notebook import Entries, Tabulated

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Instant(Tabulated):
    """First-order motion at joint values (..., n).

    Attributes:
        jp, jq: (..., r, k) and (..., r, d) with Jp v = Jq qdot, r = k = d where the inputs fix the mechanism; with
            redundant ones r = d > k, and Jp is singular where all of them together do not fix it. v are the
            rates of the pose as `rate_names` names them, qdot those of the printed inputs; each row is a velocity.
            A row that is lacking because the closure loses rank is zero. The basis is chosen with det Jq >= 0, which
            leaves the sign of det Jp: that of det Jp det Jq, the only one that does not depend on the basis.
        measures: "output" and "input", the smallest singular value of Jp and Jq with lengths in units of the
            characteristic length and screws in turns for it (a sine: 0 where singular, at most 1), and "closure", the
            smallest singular value of the closure that counts in general: as a share of what it is around home, at
            most 1.
        ranks, general: here, and in general (see `general`).
        gap: of all ranks here, the least ratio of a singular value kept to the largest dropped.
        closed: whether the joint values close the loops; elsewhere all matrices and measures are NaN.
        no_rates: (...) where phi, theta and psi have no rates of their own, theta being a right angle: the mechanism
            need not be singular there, and measures and ranks, which count angular velocities, do not say so.
    """

    jp: FloatArray
    jq: FloatArray
    measures: Mapping[str, FloatArray]
    ranks: Ranks
    general: Ranks
    gap: FloatArray
    closed: BoolArray
    motion: InstantaneousMotion
    no_rates: BoolArray

    def _title(self) -> str:
        return "first-order motion: smallest singular values, freedoms, types of singularity"

    def _entries(self) -> Entries:
        return [
            {
                **{name: float(values[place]) for name, values in self.measures.items()},
                "freedoms": int(self.ranks.freedoms[place]),
                "singular": ", ".join(name for name, holds in self.types.items() if holds[place]) or "no",
            }
            for place in np.ndindex(self.closed.shape)
        ]

    @cached_property
    def types(self) -> Mapping[str, BoolArray]:
        """Zlatanov's six types of singularity (Zlatanov, Fenton and Benhabib 1994), each (...).

        RI, redundant input: inputs move and the pose stands. RO, redundant output: the platform moves, turns that the
        pose leaves out among it, and the inputs stand. IO, II: a rate of the pose, of the inputs is impossible. IIM:
        the mechanism has more freedoms than in general. RPM: a motion of passive joints alone. Each is judged
        against what holds in general, so that the spin of a rod is no singularity.
        """
        ranks, usual = self.ranks, self.general
        held = {
            "RI": ranks.related - ranks.pose > usual.related - usual.pose,
            "RO": ranks.moving - ranks.inputs > usual.moving - usual.inputs,
            "IO": ranks.pose < usual.pose,
            "II": ranks.inputs < usual.inputs,
            "IIM": ranks.freedoms > usual.freedoms,
            "RPM": ranks.internal > usual.internal,
        }
        return {name: np.asarray(value & self.closed) for name, value in held.items()}

    @cached_property
    def platform_gains(self) -> BoolArray:
        """Whether the platform has more freedoms (...) than in general, all inputs free.

        This is the constraint singularity of Zlatanov, Bonev and Gosselin (2002); where the closure loses rank and the
        platform gains nothing, the loss is inside a limb.
        """
        return np.asarray((self.ranks.twists > self.general.twists) & self.closed)

    @cached_property
    def singular_output(self) -> BoolArray:
        """Whether the inputs do not determine the pose's rates (...): Jp is singular."""
        return self._undetermined("output", self.jp)

    @cached_property
    def singular_input(self) -> BoolArray:
        """Whether the pose's rates do not determine the inputs' (...): Jq is singular."""
        return self._undetermined("input", self.jq)

    def _undetermined(self, name: str, matrix: FloatArray) -> BoolArray:
        lacking = matrix.shape[-2] < matrix.shape[-1]
        with np.errstate(invalid="ignore"):
            return np.asarray(self.closed & ((self.measures[name] <= SINGULAR) | lacking))


def instantaneous(record: MechanismRecord, joints: Named) -> Instant:
    """First-order motion at joint values (..., n), or by name, of a mechanism with or without a closed form.

    Example: the five-bar's two inputs move its platform's point in two directions, and nothing is singular at home.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> here = instantaneous(record, home_values(record))
    >>> int(here.ranks.freedoms), here.jp.shape, [name for name, holds in here.types.items() if holds]
    (2, (2, 2), [])
    """
    values = checked_joints(record, joints)
    length = characteristic_length(record)
    motion = motions(record, values)
    usual = usual_ranks(record)
    closed = closure_error(record, values) <= CLOSED * length
    count_x = motion.pose.shape[-2]
    rows = _complement(motion.related_left, motion.ranks.related, int(usual.related))  # (..., r, k + F)
    jp, jq = _oriented(rows[..., :count_x], -rows[..., count_x:])
    whole = np.asarray(motion.ranks.related == usual.related)
    share = motion.values[..., int(usual.closure) - 1] / motion.values[..., 0] / general_share(record)
    measures = {"output": _smallest(jp) * whole, "input": _smallest(jq) * whole, "closure": np.minimum(share, 1.0)}
    unknown = ~closed[..., None, None]
    turning = turning_matrix(record, values)
    return Instant(
        jp=np.where(unknown, np.nan, jp * length / pose_units(record) @ turning),
        jq=np.where(unknown, np.nan, jq * length / drive_units(record)),
        measures={name: np.where(closed, value, np.nan) for name, value in measures.items()},
        ranks=motion.ranks,
        general=usual,
        gap=motion.gap,
        closed=np.asarray(closed),
        motion=motion,
        no_rates=np.asarray(closed & (np.abs(np.linalg.det(turning)) <= SINGULAR)),
    )


def _complement(left: FloatArray, rank: IntArray, usual: int) -> FloatArray:
    """Rows (..., d - usual, d) orthogonal to the first `rank` of left vectors (..., d, d); those lacking are zero."""
    last = np.swapaxes(left, -1, -2)[..., usual:, :]
    return np.asarray(last * (np.arange(usual, left.shape[-1]) >= rank[..., None])[..., None])


def _oriented(jp: FloatArray, jq: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The same relations with det Jq >= 0: the first row of both turned round where it is not."""
    if jq.shape[-1] != jq.shape[-2]:
        return jp, jq
    sign = np.ones(jq.shape[:-1])
    sign[..., 0] = np.where(np.linalg.det(jq) < 0.0, -1.0, 1.0)
    return jp * sign[..., None], jq * sign[..., None]


def _smallest(matrix: FloatArray) -> FloatArray:
    """The smallest singular value (...) of a matrix; 0 of no rows, which hold nothing."""
    if not min(matrix.shape[-2:]):
        return np.zeros(matrix.shape[:-2])
    return np.asarray(np.linalg.svd(matrix, compute_uv=False)[..., -1])
