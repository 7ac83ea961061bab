"""Regular grids over a box of poses, made part by part and never held."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from assur.kinematics.closed_form.blocks import FloatArray
from assur.numerics.regular_places import regular_places


@dataclass(frozen=True)
class Grid:
    """A regular grid over a box, its poses in the order of their indices, the last coordinate running fastest.

    Attributes:
        names: coordinates of the pose.
        low, high: the box; both ends belong to the grid, a coordinate with one place has its middle.
        counts: places along each coordinate.
        scales: from the units of the box to those of the poses, one per coordinate; the same units where empty.

    Example:
        >>> Grid(("x", "y"), (0.0, 5.0), (2.0, 7.0), (3, 1)).poses(slice(1, 3))
        array([[1., 2.],
               [6., 6.]])
    """

    names: tuple[str, ...]
    low: tuple[float, ...]
    high: tuple[float, ...]
    counts: tuple[int, ...]
    scales: tuple[float, ...] = ()

    @property
    def size(self) -> int:
        """Number of poses."""
        return math.prod(self.counts)

    @cached_property
    def axes(self) -> tuple[FloatArray, ...]:
        """Places along each coordinate, in the units of the poses."""
        places = tuple(map(regular_places, self.low, self.high, self.counts))
        return tuple(map(np.multiply, places, self.scales)) if self.scales else places

    def poses(self, part: slice) -> FloatArray:
        """Components (m, b) of the poses from part.start to part.stop; the same bits whatever the part."""
        last = self.counts[-1]
        first, rows = part.start // last, -(-part.stop // last) - part.start // last
        within = slice(part.start - first * last, part.stop - first * last)
        places = np.unravel_index(np.arange(first, first + rows), self.counts[:-1]) if self.counts[:-1] else ()
        columns = [np.repeat(self.axes[k][place], last)[within] for k, place in enumerate(places)]
        return np.stack([*columns, np.tile(self.axes[-1], rows)[within]])
