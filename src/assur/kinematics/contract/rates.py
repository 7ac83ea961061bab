"""The second law: Jp v = Jq qdot holds for every motion of the joint graph, and for no others."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.contract.mismatch import Mismatch, place_text
from assur.kinematics.contract.solutions import Solutions
from assur.kinematics.rates.motions import InstantaneousMotion, input_units, pose_units

FloatArray = NDArray[np.float64]

RELATION = 1e-8
"""Share of the larger side of Jp v = Jq qdot by which the two may differ: a null space has lost some digits."""
CLEAR = 1e-3
"""Near a singularity of the closure, closer than this share, its null space is not clear enough to judge by."""


def wrong_rates(solutions: Solutions, motion: InstantaneousMotion) -> list[Mismatch]:
    """Rows of the velocity equation that a motion of the joint graph, at the same joint values, does not obey."""
    if not len(solutions):
        return []
    record = solutions.record
    judged = _clear(motion)
    jp, jq = solutions.jp * pose_units(record), solutions.jq * _joint_rates(solutions)
    left, right = jp @ motion.pose, jq @ motion.inputs
    size = np.max(np.abs(jp), axis=-1) + np.max(np.abs(jq), axis=-1)  # (S, r)
    miss = np.max(np.abs(left - right), axis=-1)
    lost = RELATION + 1e-12 / np.maximum(solutions.near, 1e-12)
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.where(judged[:, None] & (size > 0), miss / (size * lost[:, None]), 0.0)
    share = np.nan_to_num(share, nan=np.inf)
    row, line = np.unravel_index(int(np.argmax(share)), share.shape)
    if share[row, line] <= 1:
        return []
    text = (
        f"row {line + 1} of Jp v = Jq qdot is wrong by {miss[row, line] / size[row, line]:.2g} of its size for a "
        f"motion of the joint graph, in mode {solutions.labels[row]} of the {solutions.problem} problem "
        f"at {place_text(record, solutions.problem, solutions.given[row])}"
    )
    allowed = "every motion of the joint graph must obey it"
    return [Mismatch("Jp and Jq", f"row {line + 1}", solutions.problem, text, allowed)]


def _clear(motion: InstantaneousMotion) -> NDArray[np.bool_]:
    """Where the rank of the closure is beyond doubt, and the usual one."""
    rank = motion.ranks.closure
    least = np.take_along_axis(motion.values, rank[:, None] - 1, axis=-1)[:, 0] / motion.values[:, 0]
    return np.asarray((rank == np.max(rank)) & (least > CLEAR * np.median(least)))


def _joint_rates(solutions: Solutions) -> FloatArray:
    """What turns columns of Jq, per joint value, into those per scaled printed input."""
    return np.array([item.sign for item in solutions.record.inputs]) * input_units(solutions.record)
