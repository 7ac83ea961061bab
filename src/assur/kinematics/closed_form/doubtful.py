"""Roots that rounding leaves in doubt, real or not, one or two: the mechanism itself decides, by closing its loops.

A double root of a polynomial is where two poses meet, and the mechanism is singular there. So of two roots that cannot
be told apart, either both lead to assemblies of the joint graph, or both to one that is singular or nearly so, or
neither does because the loops stay open. Whatever else happens is not decided, and the answer says so.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closed_form.branches import Branches
from assur.kinematics.closure import CLOSED, assemble
from assur.kinematics.configurations import distinct
from assur.kinematics.status import Status, scale, vanishes
from assur.kinematics.turns import in_one_turn
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IntArray = NDArray[np.intp]
BEYOND_DOUBT = 1e-2
"""Part of its scale by which a margin is not zero for certain: rounding moves n roots that meet by its n-th root."""


def decided(branches: Branches, count: IntArray) -> tuple[BoolArray, BoolArray]:
    """Which branches (N, K) of N direct problems are no solutions of their own, and which are not decided.

    Args:
        branches: every branch whose root may be real, with the values of all joints.
        count: (N, K) how many roots lie where each does; 1 for a simple root, 0 for one that is not real.

    Returns:
        dropped (N, K): its loops stay open, or it is the pose of another root.
        unsure (N, K): there may be another pose here. That is so where an assembly was reached that is no branch, where
        two roots lead to one pose that is not singular, where the kernel degenerates and no margin forbids the branch,
        where it may degenerate and the loops stay open (so it loses two poses that share a root), and where three or
        more roots lie together and not all of them are poses that are not singular.
    """
    degenerate, nearly, forbidden = (np.zeros(count.shape, dtype=bool) for _ in range(3))
    for margin in branches._margin_list:
        value = branches.margins[margin.name]
        if margin.zero == "degenerate":
            degenerate |= vanishes(branches.record, margin, value) | ~np.isfinite(value)
            nearly |= np.abs(value) <= BEYOND_DOUBT * scale(branches.record, margin.scale)
        else:
            forbidden |= value < -BEYOND_DOUBT * scale(branches.record, margin.scale)
    count = np.where(forbidden, 0, count)
    joints, residuals, status = branches.joints, branches.residuals, branches.formula_status
    dropped, unsure = np.zeros(count.shape, dtype=bool), (count > 1) & degenerate
    for row in range(len(count)):
        one = _Problem(branches.record, joints[row], residuals[row], status[row], count[row])
        dropped[row], more = one.decided()
        unsure[row] |= more | (one.open & nearly[row])
    return dropped, unsure


class _Problem:
    """The K branches of one problem."""

    def __init__(
        self,
        record: MechanismRecord,
        joints: FloatArray,
        residuals: FloatArray,
        status: NDArray[np.int8],
        count: IntArray,
    ) -> None:
        self.record, self.joints, self.status = record, joints, status
        self.doubtful, self.crowded = count > 1, count > 2
        with np.errstate(invalid="ignore"):
            self.closed = residuals <= CLOSED * characteristic_length(record)
        self.open = np.isfinite(residuals) & ~self.closed & self.doubtful

    def decided(self) -> tuple[BoolArray, BoolArray]:
        """Dropped (K,) and unsure (K,)."""
        listed = np.concatenate(
            [np.flatnonzero(self.closed & ~self.doubtful), np.flatnonzero(self.closed & self.doubtful)]
        )
        kept = listed[distinct(self.record, self.joints[listed])]
        copies = np.setdiff1d(listed, kept)
        dropped = self.open.copy()
        dropped[copies] = True
        unsure = self.crowded & (dropped | (self.status >= Status.parallel))
        for k in copies:
            unsure[k] |= not self._is_singular(self._same(kept, self.joints[k]))
        for k in np.flatnonzero(self.open):
            unsure[k] |= self._leads_elsewhere(kept, self.joints[k])
        return dropped, unsure

    def _same(self, kept: IntArray, joints: FloatArray) -> int | None:
        """The one of the branches `kept` that is this configuration."""
        for k in kept:
            if len(distinct(self.record, np.stack([self.joints[k], joints]))) == 1:
                return int(k)
        return None

    def _is_singular(self, branch: int | None) -> bool:
        return branch is not None and self.status[branch] not in (Status.regular, Status.serial)

    def _leads_elsewhere(self, kept: IntArray, start: FloatArray) -> bool:
        """Whether the loops close from here at a pose that is none of those `kept`, or one that is not singular."""
        found = assemble(self.record, start, held=self.record.input_indices, near=True)
        return bool(found.closed) and not self._is_singular(self._same(kept, in_one_turn(self.record, found.values)))
