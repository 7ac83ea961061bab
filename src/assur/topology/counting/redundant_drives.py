"""Redundant drives: more than it takes, of which some determine the mechanism and the others follow.

Each determining subset is a choice of drives of its own, with its own coupling degree; all drives together have none,
for their constraint degrees add up to less than zero.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from assur.topology.counting.actuation import Actuation
from assur.topology.counting.coupling import coupling
from assur.topology.screws.edges import Edge, column_names

FloatArray = NDArray[np.float64]

SUBSETS = 64
"""Determining subsets that are looked at; seven drives for three freedoms have 35."""


@dataclass(frozen=True)
class DeterminingDrives:
    """Drives that determine the mechanism without redundancy, those that follow them, and the coupling degree."""

    drives: tuple[str, ...]
    following: tuple[str, ...]
    coupling_degree: int | None

    def __str__(self) -> str:
        return f"{', '.join(self.drives)}: κ = {self.coupling_degree}"


def driven_by(edges: Sequence[Edge], drives: Sequence[str]) -> list[Edge]:
    """The edges with these drives only, named as `column_names` has them.

    >>> slide = Edge("P1", "base", "cart", np.zeros((1, 6, 1)), ("P1",), (0,))
    >>> [edge.inputs for edge in driven_by([slide], [])]
    [()]
    """
    names = iter(column_names(edges))
    own = [[next(names) for _ in range(edge.freedoms)] for edge in edges]
    return [
        replace(edge, inputs=tuple(k for k in edge.inputs if named[k] in drives))
        for edge, named in zip(edges, own, strict=True)
    ]


def determining_drives(
    edges: Sequence[Edge], actuation: Actuation, internal: FloatArray
) -> tuple[DeterminingDrives, ...]:
    """Every determining subset of redundant drives, of the first ones; none where the drives are not redundant.

    Args:
        edges: as for `assur.topology.counting.coupling.coupling`, with all drives.
        actuation: what `assur.topology.counting.actuation.actuation` says of them.
        internal: basis (N, c, i) of the internal motions.
    """
    if actuation.verdict != "redundant":
        return ()
    return tuple(
        DeterminingDrives(
            drives,
            tuple(name for name in actuation.inputs if name not in drives),
            coupling(driven_by(edges, drives), internal).coupling_degree,
        )
        for drives in actuation.determining[:SUBSETS]
    )
