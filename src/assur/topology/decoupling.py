"""Decoupling: which output of the platform depends on which input, as the zero pattern of the Jacobian.

Two routes. The twists give the Jacobian itself at some configurations. The theory locks every input but one
and asks for the POC set that is left: an output perpendicular to all of it does not depend on that input.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.topology.edges import Edge, along, at_generic, closure, column_names, input_columns, null_basis

FloatArray = NDArray[np.float64]

OUTPUTS = ("x", "y", "z", "rx", "ry", "rz")
"""The platform's coordinates: along the base's axes, then about them."""

ZERO = 1e-8
"""Entries of the Jacobian below this share of its largest are zero."""


@dataclass(frozen=True)
class Decoupling:
    """depends[i][j]: whether output i depends on input j. Outputs that never change are left out."""

    outputs: tuple[str, ...]
    inputs: tuple[str, ...]
    depends: tuple[tuple[bool, ...], ...]

    @property
    def kind(self) -> str:
        """How far inputs and outputs are decoupled.

        >>> Decoupling(("x", "y"), ("P1", "P2"), ((True, True), (False, True))).kind
        'partial'
        """
        if all(all(row) for row in self.depends):
            return "none"
        return "full" if all(sum(row) == 1 for row in self.depends) else "partial"

    def inputs_of(self, output: str) -> tuple[str, ...]:
        """The inputs that an output depends on."""
        row = self.depends[self.outputs.index(output)]
        return tuple(name for name, used in zip(self.inputs, row, strict=True) if used)


def jacobian(edges: Sequence[Edge], base: str, platform: str) -> FloatArray | None:
    """Twist (N, 6, n) of the platform per rate of each input: velocity of O' in rows 0-2, rotation in rows 3-5.

    None where the inputs do not fix the platform's motion, or hinder each other. Internal freedoms do no harm.
    """
    edges = at_generic(edges)
    actuated = input_columns(edges)
    free = null_basis(closure(edges))
    moves = along(edges, base, platform) @ free
    rates = free[:, actuated, :]
    fixed = np.linalg.matrix_rank(rates, tol=1e-7)
    both = np.linalg.matrix_rank(np.concatenate([rates, moves], axis=1), tol=1e-7)
    if np.any(fixed < len(actuated)) or np.any(both > fixed):
        return None
    twists = moves @ np.linalg.pinv(rates)
    return np.concatenate([twists[:, 3:], twists[:, :3]], axis=1)


def by_jacobian(edges: Sequence[Edge], base: str, platform: str) -> Decoupling | None:
    """The zero pattern at the configurations of the edges' twists; None where there is no Jacobian."""
    matrix = jacobian(edges, base, platform)
    if matrix is None or not matrix.size:
        return None
    columns = column_names(edges)
    names = tuple(columns[index] for index in input_columns(edges))
    used = np.any(np.abs(matrix) > ZERO * np.max(np.abs(matrix)), axis=0)
    kept = [row for row in range(len(OUTPUTS)) if used[row].any()]
    return Decoupling(
        tuple(OUTPUTS[row] for row in kept), names, tuple(tuple(bool(item) for item in used[row]) for row in kept)
    )
