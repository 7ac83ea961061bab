"""Second route: limbs joined by their twists, at random poses of the required motion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from assur.synthesis.limb_motions import CandidateLimb
from assur.topology.chains import BASE, PLATFORM
from assur.topology.counting.coupling import Decomposition, coupling
from assur.topology.counting.decoupling import Decoupling, by_jacobian
from assur.topology.screws.edges import Edge, closure, input_columns, rank


@dataclass(frozen=True, eq=False)
class Confirmed:
    """What the ranks say.

    Attributes:
        dof: F of Eq. (3).
        left: freedoms with the actuators locked.
        edges: the limbs, each as one edge, or as those of its inner loop and the rest.
    """

    dof: int
    left: int
    edges: tuple[Edge, ...]

    @cached_property
    def loops(self) -> Decomposition:
        """Loops in the order that attains the coupling degree."""
        return coupling(self.edges)

    @cached_property
    def decoupling(self) -> Decoupling | None:
        """Which output depends on which drive; none where the drives do not fix the platform."""
        return by_jacobian(self.edges, BASE, PLATFORM)


def confirmed(limbs: Sequence[CandidateLimb], places: Sequence[int]) -> Confirmed:
    """F, and what is left of it with the driven joints locked.

    Every limb has the required motion, so the platform has it; with F equal to its dimension it has no other, and no
    limb moves by itself.

    Args:
        limbs: one beside the other.
        places: the position of each.
    """
    edges = tuple(
        _of_limb(edge, f"limb {number}")
        for number, (limb, place) in enumerate(zip(limbs, places, strict=True), 1)
        for edge in limb.edges[place]
    )
    matrix = closure(edges)
    freedoms = matrix.shape[-1]
    locked = np.delete(matrix, input_columns(edges), axis=-1)
    return Confirmed(freedoms - rank(matrix), locked.shape[-1] - rank(locked), edges)


def _of_limb(edge: Edge, limb: str) -> Edge:
    """An edge with its limb's name; its ends too, if they are neither base nor platform."""
    parent, child = (link if link in (BASE, PLATFORM) else f"{limb}, {link}" for link in (edge.parent, edge.child))
    name = limb if (edge.parent, edge.child) == (BASE, PLATFORM) else f"{limb}, {edge.name}"
    return replace(edge, name=name, parent=parent, child=child)
