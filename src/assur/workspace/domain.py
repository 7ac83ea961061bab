"""The domain: a box of poses, and a uniform grid that covers it with one cell to spare on every side.

Everything that is meshed lives on three axes. A pose with fewer coordinates gets slack axes: one cell
thick, along which nothing changes, so that a plane region is a slab and its area is volume / thickness.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UnknownNameError, UsageError
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
MAX_CELLS = 400


@dataclass(frozen=True)
class Box:
    """One interval low < high per pose coordinate, in the order of the pose.

    >>> Box(("x", "y"), (0.0, 1.0), (2.0, 4.0)).intervals
    [[0.0, 2.0], [1.0, 4.0]]
    """

    names: tuple[str, ...]
    low: tuple[float, ...]
    high: tuple[float, ...]

    def __post_init__(self) -> None:
        for name, low, high in zip(self.names, self.low, self.high, strict=True):
            if not (np.isfinite(low) and np.isfinite(high)):
                raise UsageError(f"box: {name} = [{low}, {high}] is not finite")
            if not low < high:
                raise UsageError(
                    f"box: {name} = [{low:g}, {high:g}] is turned round or empty", hint="give low < high"
                )

    @property
    def intervals(self) -> list[list[float]]:
        """[[low, high], ...] as JSON takes it."""
        return [[low, high] for low, high in zip(self.low, self.high, strict=True)]

    def axis(self, name: str) -> int:
        """Place of a coordinate in the pose."""
        if name not in self.names:
            raise UnknownNameError("pose coordinate", name, self.names)
        return self.names.index(name)


def box_of(record: MechanismRecord, box: Mapping[str, Sequence[float]] | ArrayLike | None) -> Box:
    """The box that a user means: pairs in the order of the pose, or some of them by name.

    What is left out comes from the mechanism's file; `UsageError` where that has none either.

    >>> from assur.model.registry import load_record
    >>> box_of(load_record("zeng2019"), {"z": (200, 300)}).intervals
    [[-110.0, 90.0], [-250.0, 250.0], [200.0, 300.0]]
    """
    names = record.platform.pose
    if box is not None and not isinstance(box, Mapping):
        box = dict(zip(names, _pairs(names, box), strict=True))
    pairs: dict[str, Any] = {**record.box, **(box or {})}
    for name in pairs:
        if name not in names:
            raise UnknownNameError(f"pose coordinate of {record.name}", name, names)
    missing = [name for name in names if name not in pairs]
    if missing:
        raise UsageError(f"box: no interval for {', '.join(missing)}", hint="the mechanism's file gives no box")
    limits = _pairs(names, [pairs[name] for name in names])
    return Box(names, tuple(limits[:, 0].tolist()), tuple(limits[:, 1].tolist()))


def _pairs(names: tuple[str, ...], box: ArrayLike) -> FloatArray:
    try:
        limits = np.asarray(box, dtype=float)
    except (TypeError, ValueError) as error:
        raise UsageError("box: not an array of numbers", hint=f"give (low, high) for {', '.join(names)}") from error
    if limits.shape != (len(names), 2):
        raise UsageError(f"box: shape {limits.shape}, ({len(names)}, 2) wanted: (low, high) for {', '.join(names)}")
    return limits


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

    def blocks(self, size: int = 2**18) -> Iterator[tuple[slice, tuple[FloatArray, ...]]]:
        """Slabs of nodes along the first axis, about `size` nodes each, as components that broadcast."""
        axes = [self.position(np.arange(count)[:, None] + np.zeros(3))[:, k] for k, count in enumerate(self.shape)]
        rows = max(1, size // int(np.prod(self.shape[1:])))
        for start in range(0, self.shape[0], rows):
            part = slice(start, start + rows)
            columns = (axes[0][part, None, None], axes[1][None, :, None], axes[2][None, None, :])
            yield part, columns[: self.dimension]

    def centres(self) -> FloatArray:
        """Centres (N, m) of all cells of the box."""
        axes = [
            low + (np.arange(count) + 0.5) * step
            for low, count, step in zip(self.box.low, self.cells, self.step, strict=False)
        ]
        return np.stack([axis.ravel() for axis in np.meshgrid(*axes, indexing="ij")], axis=-1)


def grid_over(box: Box, resolution: int) -> UniformGrid:
    """The grid with `resolution` cells along every coordinate of a box."""
    if isinstance(resolution, bool) or not isinstance(resolution, (int, np.integer)):
        raise UsageError(f"resolution: {resolution!r} is not a whole number of cells")
    return UniformGrid(box, (int(resolution),) * len(box.names))
