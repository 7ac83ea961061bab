"""Regular grids over a box of poses, made part by part and never held."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from assur.errors import UnknownNameError, UsageError
from assur.kinematics.closed_form.blocks import FloatArray
from assur.model.mechanism import MechanismRecord
from assur.model.pose import has_quaternion
from assur.numerics.regular_places import regular_places

Box = Mapping[str, tuple[float, float]]


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


def grid_over(record: MechanismRecord, counts: Sequence[int], box: Box | None = None) -> Grid:
    """The grid of a mechanism over a box of its pose, the file's where none is given.

    Errors:
        UsageError: a count below 1, not one count per coordinate, a box that is empty, reversed or not finite, or an
            orientation by a quaternion, over which there is no such grid.
        UnknownNameError: a box with a coordinate that the pose lacks.

    Example:
        >>> from assur.model.registry import load_record
        >>> grid_over(load_record("zeng2019"), (200, 200, 200)).size
        8000000
    """
    names = record.platform.pose
    if has_quaternion(names):
        raise UsageError(f"{record.name}: no grid over quaternions", hint="sweep poses of your own with inverse_sweep")
    if len(counts) != len(names) or any(count != int(count) or count < 1 for count in counts):
        raise UsageError(f"counts {list(counts)}", hint=f"whole numbers from 1 on for {', '.join(names)}")
    limits: dict[str, tuple[float, float]] = {name: (record.box[name][0], record.box[name][1]) for name in names}
    for name, (low, high) in (box or {}).items():
        if name not in names:
            raise UnknownNameError("coordinate of a box", name, names)
        if not (np.isfinite(low) and np.isfinite(high)) or low > high:
            raise UsageError(f"box: {name} from {low:g} to {high:g}", hint="finite limits, the lower one first")
        limits[name] = (float(low), float(high))
    lows, highs = ([limits[name][k] for name in names] for k in (0, 1))
    return Grid(names, tuple(lows), tuple(highs), tuple(int(count) for count in counts))
