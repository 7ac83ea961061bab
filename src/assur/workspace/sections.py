"""Sections: the polygons and the area of a cut through a solid, across any of its axes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from manifold3d import CrossSection, Manifold
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.workspace.reach import Reach

FloatArray = NDArray[np.float64]
AROUND = (-1.0, -0.5, 0.0, 0.5, 1.0)
"""Cuts that are compared, in cells of the coarser region away from the one that is asked for."""


@dataclass(frozen=True, eq=False)
class RegionSection:
    """A cut through a region at one value of one coordinate.

    Attributes:
        coordinate, value: where it is cut.
        plane: names of the coordinates that remain.
        area: area of the cut; total length where one coordinate remains.
        area_error: estimate of its error: the largest difference to half the resolution, here and up to a cell away.
            One cut alone may agree by chance, where its surface happens to lie alike on both grids.
        polygons: each (n, 2), outer ones counter-clockwise, holes clockwise; intervals (2, 1) where one
            coordinate remains.
    """

    coordinate: str
    value: float
    plane: tuple[str, ...]
    area: float
    area_error: float
    polygons: tuple[FloatArray, ...]


def turned(solid: Manifold, axis: int) -> Manifold:
    """The solid with that axis upwards, by a cyclic change of axes, which keeps it right-handed."""
    rotation = np.zeros((3, 4))
    rotation[range(3), [(axis + 1) % 3, (axis + 2) % 3, axis]] = 1.0
    return solid.transform(rotation)


def flat_polygons(cross: CrossSection, axis: int) -> tuple[FloatArray, ...]:
    """Polygons of what lies across an axis, their two coordinates in ascending order, outer ones counter-clockwise."""
    polygons = [np.array(polygon, dtype=float) for polygon in cross.to_polygons()]
    if axis == 1:  # the remaining axes come as (2, 0); swapping them also turns the polygons round
        polygons = [polygon[::-1, ::-1] for polygon in polygons]
    return tuple(polygons)


def cut(solid: Manifold, axis: int, value: float, span: tuple[float, float]) -> tuple[float, tuple[FloatArray, ...]]:
    """Area and polygons of the cut across `axis` at `value`; `span` is the solid's domain along that axis.

    A cut at an end of the span is taken just inside it.

    >>> area, polygons = cut(Manifold.cube([1.0, 2.0, 3.0]), 0, 0.5, (0.0, 1.0))
    >>> round(area, 12), polygons[0].min(axis=0).tolist(), polygons[0].max(axis=0).tolist()
    (6.0, [0.0, 0.0], [2.0, 3.0])
    """
    margin = 1e-9 * (span[1] - span[0])
    cross = turned(solid, axis).slice(min(max(value, span[0] + margin), span[1] - margin))
    return float(cross.area()), flat_polygons(cross, axis)


def section(region: Reach, value: float, coordinate: str, coarser: Reach) -> RegionSection:
    """The cut through a region at a value of one of its coordinates, which must lie in the box.

    `coarser` is the same region at half the resolution, by which the error of the area is estimated.
    """
    box = region.grid.box
    axis = box.axis(coordinate)
    span = box.low[axis], box.high[axis]
    if not isinstance(value, (int, float, np.number)):
        raise UsageError(f"section: {value!r} is not a number")
    if not span[0] <= value <= span[1]:
        raise UsageError(f"section: {coordinate} = {value:g} is outside the box [{span[0]:g}, {span[1]:g}]")
    area, polygons = cut(region.solid, axis, float(value), span)
    plane = tuple(name for name in box.names if name != coordinate)
    if region.grid.dimension == 2:
        polygons = tuple(_interval(polygon[:, [0]]) for polygon in polygons)
    error = _area_error(region, coarser, axis, float(value))
    return RegionSection(coordinate, float(value), plane, area / region.grid.thickness, error, polygons)


def _area_error(region: Reach, coarser: Reach, axis: int, value: float) -> float:
    box = region.grid.box
    span = box.low[axis], box.high[axis]
    step = float(coarser.grid.step[axis])
    values = np.unique(np.clip([value + cells * step for cells in AROUND], *span))
    fine, coarse = (np.array([cut(item.solid, axis, at, span)[0] for at in values]) for item in (region, coarser))
    return float(np.max(np.abs(fine - coarse))) / region.grid.thickness


def _interval(along: FloatArray) -> FloatArray:
    """A rectangle that stands on a slack axis, as its interval (2, 1)."""
    return np.array([along.min(axis=0), along.max(axis=0)])
