"""Projections: the outline of a solid seen along one of its axes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from manifold3d import CrossSection, FillRule, Manifold
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.workspace.reach import Reach
from assur.workspace.sections import flat_polygons, turned

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Projection:
    """What a region covers on a plane: area and polygons (n, 2), outer ones counter-clockwise, holes clockwise."""

    plane: tuple[str, ...]
    area: float
    polygons: tuple[FloatArray, ...]


def shadow(solid: Manifold, axis: int) -> tuple[float, tuple[FloatArray, ...]]:
    """Area and polygons of the projection along an axis, what lies behind itself counted once.

    >>> two = Manifold.cube([1.0, 1.0, 1.0]) + Manifold.cube([1.0, 1.0, 1.0]).translate([0.5, 0.0, 5.0])
    >>> round(shadow(two, 2)[0], 12)
    1.5
    """
    outline = turned(solid, axis).project()
    flat = CrossSection(outline.to_polygons(), FillRule.Positive)
    return float(flat.area()), flat_polygons(flat, axis)


def projection(region: Reach, plane: tuple[str, ...]) -> Projection:
    """The outline of a region on the plane of two of its coordinates."""
    box = region.grid.box
    axes = sorted({box.axis(name) for name in plane})
    if len(axes) != 2:
        raise UsageError(f"projection: two different coordinates wanted, not {', '.join(plane)}")
    area, polygons = shadow(region.solid, 3 - sum(axes))
    return Projection(tuple(box.names[k] for k in axes), area, polygons)
