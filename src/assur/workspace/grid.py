"""A uniform grid over a box, with one cell to spare on every side.

Everything that is meshed lives on three axes. A pose with fewer coordinates gets slack axes: one cell
thick, along which nothing changes, so that a plane region is a slab and its area is volume / thickness.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.workspace.domain import Box

FloatArray = NDArray[np.float64]
MAX_CELLS = 400
NARROWEST = 1e-90
"""The smallest side of a box, whose cube in cells is a float still."""


@dataclass(frozen=True)
class UniformGrid:
    """Nodes low + i * step with i = -1 .. cells + 1 along each of three axes; the box is i = 0 .. cells."""

    box: Box
    cells: tuple[int, ...]

    def __post_init__(self) -> None:
        if not 1 <= self.dimension <= 3:
            raise UsageError(
                f"a workspace has 1 to 3 coordinates, not {self.dimension} ({', '.join(self.box.names)})",
                hint="fix the others first",
            )
        if len(self.cells) != self.dimension or not all(2 <= count <= MAX_CELLS for count in self.cells):
            raise UsageError(f"resolution: {self.cells}; 2 to {MAX_CELLS} cells along each coordinate")
        for name, low, high in zip(self.box.names, self.box.low, self.box.high, strict=True):
            if high - low < NARROWEST:
                raise UsageError(
                    f"box: {name} = {low:g} .. {high:g} is too narrow for an estimate",
                    hint=f"{NARROWEST:g} at least; a proof may look at any box",
                )

    @property
    def dimension(self) -> int:
        """Number of pose coordinates, without slack axes."""
        return len(self.box.names)

    @cached_property
    def counts(self) -> tuple[int, ...]:
        """Cells along the three axes; one along a slack axis."""
        return (*self.cells, *(1 for _ in range(3 - self.dimension)))

    @cached_property
    def low(self) -> FloatArray:
        """Lowest corner (3,) of the box."""
        return np.array([*self.box.low, *(0.0 for _ in range(3 - self.dimension))])

    @cached_property
    def high(self) -> FloatArray:
        """Highest corner (3,) of the box."""
        return np.array([*self.box.high, *(self.slack for _ in range(3 - self.dimension))])

    @cached_property
    def slack(self) -> float:
        """Thickness of a slack axis: the smallest step of the others."""
        sizes = np.subtract(self.box.high, self.box.low)
        return float(np.min(sizes / self.cells))

    @cached_property
    def thickness(self) -> float:
        """By what a volume on three axes is divided to give that of the pose's own coordinates."""
        return self.slack ** (3 - self.dimension)

    @cached_property
    def step(self) -> FloatArray:
        """Cell size (3,)."""
        return (self.high - self.low) / self.counts

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of nodes along each axis."""
        return tuple(count + 3 for count in self.counts)

    def position(self, index: FloatArray) -> FloatArray:
        """Coordinates (..., 3) of node indices (..., 3), which may be fractions; node (0, 0, 0) is at i = -1."""
        return self.low + self.step * (index - 1.0)

    def columns(self, index: NDArray[np.intp]) -> tuple[FloatArray, ...]:
        """The coordinates, each (n,), of nodes (n, 3)."""
        return tuple(self.position(index.astype(float)).T[: self.dimension])

    def blocks(self, size: int = 2**18) -> Iterator[tuple[slice, tuple[FloatArray, ...]]]:
        """Slabs of nodes along the first axis, about `size` nodes each, as components that broadcast."""
        axes = [self.position(np.arange(count)[:, None] + np.zeros(3))[:, k] for k, count in enumerate(self.shape)]
        rows = max(1, size // int(np.prod(self.shape[1:])))
        for start in range(0, self.shape[0], rows):
            part = slice(start, start + rows)
            columns = (axes[0][part, None, None], axes[1][None, :, None], axes[2][None, None, :])
            yield part, columns[: self.dimension]


def grid_over(box: Box, resolution: int) -> UniformGrid:
    """The grid with `resolution` cells along every coordinate of a box."""
    if isinstance(resolution, bool) or not isinstance(resolution, (int, np.integer)):
        raise UsageError(f"resolution: {resolution!r} is not a whole number of cells")
    return UniformGrid(box, (int(resolution),) * len(box.names))
