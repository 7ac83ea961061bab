"""Where a field is zero on the edges of a grid: every vertex of a mesh is put on the true surface.

Marching cubes places a vertex by linear interpolation, which is poor where a field runs like a square
root. With the vertices on the surface the error of a volume is that of inscribed facets, of order step^2.
The nodes beside an edge tell where to look first, so that a smooth field is read once or twice per vertex.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.workspace.grid import UniformGrid

FloatArray = NDArray[np.float64]
CLOSE = 2.0**-21
"""Share of an edge within which a vertex is placed: the facets beside it are wrong by some 1e-4 of a cell at best."""

READINGS = 100
"""Readings of one vertex at most; every fourth one halves what is left, and 2^-21 takes 21 halvings."""

CURVED = 8.0
"""Change of slope per edge, as a share of it, that is always reckoned with: a change seen at one place may be 0 by
chance. On the grids of workspaces slopes change by less than 1 per edge, but where a field is not smooth."""

BENT = 0.5
"""Change of slope between nodes, as a share of it, up to which a field may be taken for a smooth one. A kink that
changes it by as much is seen at one of the two nodes by half of that at least."""

WILD = 0.5
"""Change of slope from one secant to the next from which every second reading halves the bracket."""

ASTRAY = 0.02
"""Share of an edge by which the cubic through the nodes of a smooth field is wrong at most."""

POLISH = 6
"""Newton steps on the cubic through four nodes: from a chord within a cell they are beyond single precision."""


@dataclass(frozen=True, eq=False)
class GridEdges:
    """GridEdges of a grid on which a field changes its sign.

    Attributes:
        start, end: points (n, 3) at both nodes.
        around: the field (n, 4) at the node before the edge, at its two nodes, and at the node after it.
    """

    start: FloatArray
    end: FloatArray
    around: FloatArray


Crossing = Callable[[GridEdges], FloatArray]
"""Share (n,) of the way along edges at which a field changes its sign; NaN where it does not."""


def on_surface(
    index: FloatArray, values: NDArray[np.float32], crossing: Crossing, grid: UniformGrid, cells: NDArray[np.bool_]
) -> FloatArray:
    """Vertices (n, 3), as fractional node indices on edges of the grid, moved along their edges to the crossing.

    Vertices that are not inside one edge of the grid stay: those at a node, in the padding, or in a cell. So do those
    of which no cell beside them is among `cells`.
    """
    base = np.floor(index)
    inside = np.all((index >= 0) & (index <= np.array(grid.shape) - 1), axis=1)
    rows = np.flatnonzero(inside & (np.sum(index > base, axis=1) == 1))
    node = base[rows].astype(np.intp)
    axis = np.argmax(index[rows] > base[rows], axis=1)
    kept = _beside(cells, node, axis)
    rows, node, axis = rows[kept], node[kept], axis[kept]
    along = np.eye(3, dtype=np.intp)[axis]  # (k, 3)
    edges = GridEdges(
        grid.position(node.astype(float)), grid.position((node + along).astype(float)), _around(values, node, along)
    )
    share = crossing(edges)
    crossed = np.isfinite(share)
    result = index.copy()
    result[rows[crossed]] = (node + share[:, None] * along)[crossed]
    return result


def _beside(cells: NDArray[np.bool_], node: NDArray[np.intp], axis: NDArray[np.intp]) -> NDArray[np.bool_]:
    """Whether any of the four cells round an edge, from a node (n, 3) up along an axis (n,), is one of those."""
    padded = np.pad(cells, 1)  # cell c stands at c + 1
    known = np.zeros(len(node), dtype=bool)
    for first in (0, 1):
        for second in (0, 1):
            place = node + 1
            place[np.arange(len(node)), (axis + 1) % 3] -= first
            place[np.arange(len(node)), (axis + 2) % 3] -= second
            known |= padded[tuple(place.T)]
    return known


def _around(values: NDArray[np.float32], node: NDArray[np.intp], along: NDArray[np.intp]) -> FloatArray:
    """The field (n, 4) at nodes -1, 0, 1, 2 of edges; beyond the grid as the parabola through the other three."""
    around = np.empty((len(node), 4))
    for k in range(4):
        place = np.clip(node + (k - 1) * along, 0, np.array(values.shape) - 1)
        around[:, k] = values[tuple(place.T)]
    size = np.sum(np.array(values.shape) * along, axis=1)
    first = np.sum(node * along, axis=1)
    low, high = first == 0, first == size - 2
    around[low, 0] = 3 * around[low, 1] - 3 * around[low, 2] + around[low, 3]
    around[high, 3] = 3 * around[high, 2] - 3 * around[high, 1] + around[high, 0]
    return around


def root_of(at: Callable[[FloatArray], FloatArray]) -> Crossing:
    """The crossing of a field (n,) at points (n, 3).

    The cubic through the four nodes of an edge gives the first place, the quartic through these and that place the
    slope there; then secants follow, in a bracket that is halved every second time while slopes change wildly. Where
    nodes and first reading say that the field is smooth, a share is good when the last step, times the share by which
    its slope is in doubt, is within `CLOSE`: what it has just changed by, and at least what a field as curved as
    `CURVED` would have made of it. Elsewhere it is good when the bracket is that narrow: a reading a little aside
    closes it. A node at which the field is zero is the crossing.

    >>> edges = GridEdges(np.zeros((1, 3)), np.eye(1, 3), np.array([[-1.3, -0.3, 0.7, 1.7]]))
    >>> root_of(lambda points: points[:, 0] - 0.3)(edges).round(6)
    array([0.3])
    """

    def crossing(edges: GridEdges) -> FloatArray:
        first, last = edges.around[:, 1], edges.around[:, 2]
        crossed = (first >= 0) != (last >= 0)
        share, slope, bend, smooth = _first_guess(edges.around)
        share[first == 0], share[last == 0] = 0.0, 1.0
        way, rising = edges.end - edges.start, first < 0
        low, high = np.zeros(len(way)), np.ones(len(way))
        rows = np.flatnonzero(crossed & (first != 0) & (last != 0))
        slope, bend, before, value_before = slope[rows], bend[rows], np.empty(0), np.empty(0)
        for turn in range(READINGS):
            if not len(rows):
                break
            here = share[rows]
            value = at(edges.start[rows] + here[:, None] * way[rows])
            value = np.where(np.isfinite(value), value, -1.0)  # where the field does not exist a pose is not allowed
            ahead = (value < 0) == rising[rows]
            low[rows], high[rows] = np.where(ahead, here, low[rows]), np.where(ahead, high[rows], here)
            with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
                steeper = slope + value * bend if turn == 0 else (value - value_before) / (here - before)
                known = np.isfinite(steeper) & (steeper != 0)
                steeper = np.where(known, steeper, slope)
                far = np.abs(value / slope if turn == 0 else here - before)
                change = np.where(known, np.minimum(np.abs(1 - slope / steeper), 1.0), 1.0)
                better = here - value / steeper
            if turn == 0:
                smooth[rows] &= far <= ASTRAY
            good = (better >= low[rows]) & (better <= high[rows])
            near = good & (np.abs(better - here) * np.maximum(change, CURVED * far) <= CLOSE)
            done = (near & smooth[rows]) | (high[rows] - low[rows] <= CLOSE)
            aside = np.where(high[rows] - better > better - low[rows], CLOSE / 2, -CLOSE / 2)
            better = np.where(near & ~done, np.clip(better + aside, low[rows], high[rows]), better)
            halved = ((change > WILD) & (turn % 2 == 1)) | (turn % 4 == 3)
            middle = 0.5 * (low[rows] + high[rows])
            share[rows] = np.where(good & (done | ~halved), better, middle)
            left = ~done
            rows, slope, before, value_before = rows[left], steeper[left], here[left], value[left]
        return np.where(crossed, share, np.nan)

    return crossing


def _first_guess(around: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, NDArray[np.bool_]]:
    """Where the cubic through nodes -1, 0, 1, 2 is zero on its way from 0 to 1, its slope, and whether it bends little.

    And by what the field there is multiplied to give the change of the slope on the quartic that takes it in: w'/w of
    w = (s + 1) s (s - 1) (s - 2), which the cubic's error is a multiple of.
    """
    before, first, last, after = around.T
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        third = (after - 3 * last + 3 * first - before) / 6
        second = (before - 2 * first + last) / 2
        linear = (last - before) / 2 - third
        share = np.clip(first / (first - last), 0.0, 1.0)
        for _ in range(POLISH):
            value = ((third * share + second) * share + linear) * share + first
            share = np.clip(share - value / ((3 * third * share + 2 * second) * share + linear), 0.0, 1.0)
        share = np.where(np.isfinite(share), share, 0.5)
        slope = (3 * third * share + 2 * second) * share + linear
        bend = sum(1 / (share - node) for node in (-1, 0, 1, 2))
        turns = np.maximum(np.abs(before - 2 * first + last), np.abs(first - 2 * last + after))
    return share, slope, np.asarray(bend), turns <= BENT * np.abs(slope)
