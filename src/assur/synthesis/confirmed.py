"""Second route: limbs joined by their twists, at random poses of the required motion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations

import numpy as np

from assur.synthesis.designs import DeterminingSet, least
from assur.synthesis.limb_motions import CandidateLimb
from assur.topology.chains import BASE, PLATFORM
from assur.topology.counting.coupling import Decomposition, coupling
from assur.topology.counting.decoupling import Decoupling, by_jacobian
from assur.topology.counting.redundant_drives import driven_by
from assur.topology.screws.edges import Edge, closure, column_names, input_columns, null_basis, rank


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
    def determining(self) -> tuple[DeterminingSet, ...]:
        """The sets of redundant drives that determine the mechanism; none where drives are not redundant."""
        columns = input_columns(self.edges)
        if len(columns) <= self.dof:
            return ()
        rates = null_basis(closure(self.edges))[:, columns]
        sets = (some for some in combinations(range(len(columns)), self.dof) if rank(rates[:, some]) == self.dof)
        counted = ((some, self._loops(some).coupling_degree) for some in sets)
        return tuple(DeterminingSet(some, degree) for some, degree in counted if degree is not None)

    @cached_property
    def loops(self) -> Decomposition:
        """Loops in the order that attains the coupling degree; of redundant drives those count that need the least."""
        return self._loops(min(self.determining, key=least).drives) if self.determining else coupling(self.edges)

    def _loops(self, drives: Sequence[int]) -> Decomposition:
        """Loops where the inputs with these indices are the only ones."""
        names, columns = column_names(self.edges), input_columns(self.edges)
        return coupling(driven_by(self.edges, [names[columns[index]] for index in drives]))

    @cached_property
    def decoupling(self) -> Decoupling | None:
        """Which output depends on which drive; none where the drives do not fix the platform, or are redundant."""
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
    return counted_by(edges)


def counted_by(edges: Sequence[Edge]) -> Confirmed:
    """F, and what is left of it with the driven joints locked, of a mechanism at the configurations of its edges."""
    matrix = closure(edges)
    freedoms = matrix.shape[-1]
    locked = np.delete(matrix, input_columns(edges), axis=-1)
    return Confirmed(freedoms - rank(matrix), locked.shape[-1] - rank(locked), tuple(edges))


def _of_limb(edge: Edge, limb: str) -> Edge:
    """An edge with its limb's name; its ends too, if they are neither base nor platform."""
    parent, child = (link if link in (BASE, PLATFORM) else f"{limb}, {link}" for link in (edge.parent, edge.child))
    name = limb if (edge.parent, edge.child) == (BASE, PLATFORM) else f"{limb}, {edge.name}"
    return replace(edge, name=name, parent=parent, child=child)
