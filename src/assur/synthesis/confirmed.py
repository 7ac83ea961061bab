"""Second route: limbs joined by their twists, at random poses of the required motion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from assur.synthesis.limb_motions import CandidateLimb
from assur.topology.counting.coupling import Decomposition, coupling
from assur.topology.screws.edges import Edge, closure, input_columns, rank

BASE, PLATFORM = "base", "platform"


@dataclass(frozen=True, eq=False)
class Confirmed:
    """What the ranks say.

    Attributes:
        dof: F of Eq. (3).
        left: freedoms with the actuators locked.
        edges: the limbs, each as one edge.
    """

    dof: int
    left: int
    edges: tuple[Edge, ...]

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the limbs in the order of their positions."""
        return tuple(edge.name for edge in self.edges)

    @cached_property
    def loops(self) -> Decomposition:
        """Loops in the order that attains the coupling degree."""
        return coupling(self.edges)


def confirmed(limbs: Sequence[CandidateLimb]) -> Confirmed:
    """F, and what is left of it with the driven joints locked.

    Every limb has the required motion, so the platform has it; with F equal to its dimension it has no other, and no
    limb moves by itself.

    Args:
        limbs: in the order of their positions.
    """
    edges = tuple(
        Edge(f"limb {place + 1}", BASE, PLATFORM, limb.twists[place], (), (limb.type.driven_column,))
        for place, limb in enumerate(limbs)
    )
    matrix = closure(edges)
    freedoms = matrix.shape[-1]
    locked = np.delete(matrix, input_columns(edges), axis=-1)
    return Confirmed(freedoms - rank(matrix), locked.shape[-1] - rank(locked), edges)
