"""The equations that assemble a linkage: loops that close, and what is held in them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from assur.topology.screws.linkage import Linkage
from assur.topology.screws.parallelograms import held_parallelograms, short_side
from assur.topology.screws.screws import PlacedLinks, ScrewTree, screw_tree

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.intp]
Hold = Literal["orientation", "parallelograms"]
Equations = Callable[[FloatArray, IndexArray], tuple[FloatArray, FloatArray]]


CLOSED = 1e-11
"""Rotation (rad) and gap (lengths) below which a loop is closed."""

EXACTLY = 5e-15
"""Rotation (rad) and gap (lengths) that rounding leaves of a loop."""

NULL = 1e-7
"""Singular values of the closure below this share of the largest count as zero."""

STILL = 1e-6
"""Rates below this share of a random one are rounding errors of zero."""


def loop_equations(linkage: Linkage, hold: Hold | None = None) -> Equations:
    """Residuals (N, rows) and derivatives (N, rows, n) at joint values (N, n), rad and lengths of the linkage."""
    return AssemblyEquations.of(linkage, screw_tree(linkage), hold).at


def projected(jacobian: FloatArray, target: FloatArray, null: float = NULL) -> FloatArray:
    """The part of targets (N, n) in the null space of jacobians (N, r, n), of singular values below a share."""
    _, singular, turned = np.linalg.svd(jacobian, full_matrices=False)
    used = turned * (singular > null * np.maximum(singular[:, :1], NULL))[..., None]
    rest: FloatArray = target - np.einsum("nki,nk->ni", used, np.einsum("nki,ni->nk", used, target))
    return rest


@dataclass(frozen=True, eq=False)
class AssemblyEquations:
    """The equations: closed loops, and what is held.

    Attributes:
        loops: pairs (v, 2) of frames that coincide.
        steady: frame of a link that keeps its orientation, or -1.
        held: frames (p, 2) of the links next to each parallelogram that is held.
        sides: (p, 3) directions of their short links at home.
    """

    tree: ScrewTree
    loops: IndexArray
    steady: int
    held: IndexArray
    sides: FloatArray

    @classmethod
    def of(cls, linkage: Linkage, tree: ScrewTree, hold: Hold | None) -> AssemblyEquations:
        """Of a linkage, `hold` as in `configurations`."""
        groups = held_parallelograms(linkage, hold is not None)
        frames = [(tree.frames[group.child], tree.frames[group.parent]) for group in groups]
        sides = np.array([short_side(linkage, group) for group in groups]).reshape(-1, 3)
        steady = tree.frames[linkage.platform] if hold == "orientation" else -1
        return cls(tree, tree.loops, steady, np.array(frames, dtype=np.intp).reshape(-1, 2), sides)

    @property
    def rows(self) -> int:
        """How many equations there are."""
        return 6 * len(self.loops) + 3 * len(self.held) + 3 * (self.steady >= 0)

    def at(self, values: FloatArray, _: IndexArray) -> tuple[FloatArray, FloatArray]:
        """Residuals (k, rows) and Jacobians (k, rows, n) at values (k, n) in rad and lengths of the linkage."""
        placed = self.tree.at(values)
        parts = [self.tree.misfit(placed, self.loops[:, 0], self.loops[:, 1])]
        if self.steady >= 0:
            residual, jacobian = self.tree.misfit(placed, np.array([self.steady]), np.array([0]))
            parts.append((residual[..., :3], jacobian[..., :3, :]))
        if len(self.held):
            parts.append(self._skewed(placed))
        count, columns = values.shape
        residuals = [residual.reshape(count, -1) for residual, _ in parts]
        jacobians = [jacobian.reshape(count, -1, columns) for _, jacobian in parts]
        return np.concatenate(residuals, axis=1), np.concatenate(jacobians, axis=1)

    def _skewed(self, placed: PlacedLinks) -> tuple[FloatArray, FloatArray]:
        """By how much short links of parallelograms differ in direction, (k, p, 3), and the Jacobian (k, p, 3, n)."""
        far, near = (
            np.einsum("kpij,pj->kpi", placed.frames[:, self.held[:, end], :3, :3], self.sides) for end in (0, 1)
        )
        omega = placed.twists[:, None, :3]
        far_spin, near_spin = (omega * self.tree.paths[self.held[:, end]][:, None] for end in (0, 1))
        jacobian = np.cross(far_spin, far[..., None], axis=-2) - np.cross(near_spin, near[..., None], axis=-2)
        return far - near, jacobian
