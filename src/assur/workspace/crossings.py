"""Where a field is zero on the edges of a grid: bisection puts every vertex of a mesh on the true surface.

Marching cubes places a vertex by linear interpolation, which is poor where a field runs like a square
root. With the vertices on the surface the error of a volume is that of inscribed facets, of order step^2.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from assur.workspace.grid import UniformGrid

FloatArray = NDArray[np.float64]
STEPS = 26
"""Halvings: 2^-26 of a cell."""


Crossing = Callable[[FloatArray, FloatArray], FloatArray]
"""Share (n,) of the way between points (n, 3) and others at which a field changes its sign; NaN where it does not."""


def on_surface(index: FloatArray, crossing: Crossing, grid: UniformGrid) -> FloatArray:
    """Vertices (n, 3), as fractional node indices on edges of the grid, moved along their edges to the crossing.

    Vertices that are not inside one edge of the grid stay: those at a node, in the padding, or in a cell.
    """
    base = np.floor(index)
    inside = np.all((index >= 0) & (index <= np.array(grid.shape) - 1), axis=1)
    rows = np.flatnonzero(inside & (np.sum(index > base, axis=1) == 1))
    start = base[rows]
    along = np.eye(3)[np.argmax(index[rows] > start, axis=1)]  # (k, 3)
    share = crossing(grid.position(start), grid.position(start + along))
    crossed = np.isfinite(share)
    result = index.copy()
    result[rows[crossed]] = (start + share[:, None] * along)[crossed]
    return result


def halving(at: Callable[[FloatArray], FloatArray]) -> Crossing:
    """The crossing of a field (n,) at points (n, 3), found by halving the way.

    >>> share = halving(lambda points: points[:, 0] - 0.3)(np.zeros((1, 3)), np.eye(1, 3))
    >>> share.round(6)
    array([0.3])
    """

    def crossing(start: FloatArray, end: FloatArray) -> FloatArray:
        def positive(share: FloatArray) -> NDArray[np.bool_]:
            result: NDArray[np.bool_] = at(start + share[:, None] * (end - start)) >= 0.0
            return result

        low, high = np.zeros(len(start)), np.ones(len(start))
        first = positive(low)
        crossed = first != positive(high)
        for _ in range(STEPS):
            middle = 0.5 * (low + high)
            same = positive(middle) == first
            low, high = np.where(same, middle, low), np.where(same, high, middle)
        return np.where(crossed, 0.5 * (low + high), np.nan)

    return crossing
