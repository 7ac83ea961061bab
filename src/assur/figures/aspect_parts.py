"""Parts of a plane or a cut in which no factor changes its sign, traced, and the aspect that is proved in each."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from manifold3d import CrossSection, FillRule
from matplotlib.path import Path
from numpy.typing import NDArray

from assur.figures.context import Context
from assur.figures.plots import outline
from assur.workspace.aspects.aspects import Aspects
from assur.workspace.certified.boxes import Boxes
from assur.workspace.domain import Box
from assur.workspace.fields import closed_form_fields
from assur.workspace.grid import grid_over
from assur.workspace.projections import shadow
from assur.workspace.reach import reach
from assur.workspace.slices import Slice

FloatArray = NDArray[np.float64]
Polygons = tuple[FloatArray, ...]

TRACED = 96
"""Cells along each coordinate over which borders are traced, beside what is proved."""

SEEN = 1e-3
"""What covers less than this share of a panel is rounding of a border."""


@dataclass(frozen=True, eq=False)
class TracedPart:
    """A part of the workspace in a plane that hangs together and in which no factor changes its sign.

    Attributes:
        polygons: (n, 2) each, the outer one first, then holes.
        area: in the units of both coordinates.
        aspects: places in `Aspects.aspects` of those that have boxes in it, that of the largest area first.
    """

    polygons: Polygons
    area: float
    aspects: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class TracedPlane:
    """A plane or a cut: the border (n, 2) of the workspace in it, its area, and the parts that have an aspect."""

    border: Polygons
    area: float
    parts: tuple[TracedPart, ...]

    @property
    def open(self) -> bool:
        """Whether something of it is in no part."""
        return self.area - sum(part.area for part in self.parts) > SEEN * self.area


def traced(context: Context, aspects: Aspects, value: float | None) -> TracedPlane:
    """The plane of the first two coordinates of aspects, where the third, if there is one, has a value.

    >>> from assur.model.registry import load_record
    >>> from assur.workspace.aspects.aspects import aspects
    >>> record = load_record("fivebar")
    >>> found = traced(Context(record), aspects(record, "-+", {"x": (-300, 300), "y": (-300, 300)}, finest=9.0), None)
    >>> [part.aspects for part in found.parts], found.open
    ([(0,), (1,)], True)
    """
    plane, box = aspects.names[:2], aspects.box
    held = {name: sum(box.intervals[box.axis(name)]) / 2 for name in aspects.slice.free if name not in plane}
    if value is not None:
        held[aspects.names[2]] = value
    poses = Slice(aspects.slice.pose, plane, {**aspects.slice.held, **held})
    kinds = ("parallel", "serial")
    margins, factors = closed_form_fields(context.record, aspects.mode, aspects.strokes, poses, kinds)
    low, high = (tuple(ends[box.axis(name)] for name in plane) for ends in (box.low, box.high))
    grid = grid_over(Box(plane, low, high), TRACED)
    whole = reach(margins, {name: factors[name] for name in aspects.naming}, grid)
    area, border = shadow(whole.solid, 2)
    sides = {name: whole.positive(name) for name in aspects.naming}
    parts: list[TracedPart] = []
    for signs in sorted({tuple(item.signs[name] for name in aspects.naming) for item in aspects.aspects}):
        solid = whole.solid
        for side, sign in zip(sides.values(), signs, strict=True):
            solid = solid ^ side if sign > 0 else solid - side
        parts += _pieces(aspects, value, signs, shadow(solid, 2)[1])
    parts.sort(key=lambda part: part.aspects)
    return TracedPlane(border, area, tuple(part for part in parts if part.area > SEEN * area))


def _pieces(aspects: Aspects, value: float | None, signs: tuple[int, ...], polygons: Polygons) -> list[TracedPart]:
    """Those of polygons, in which the factors have such signs, that hang together and have boxes of an aspect."""
    own = [
        (k, rectangles(item.boxes, value))
        for k, item in enumerate(aspects.aspects)
        if tuple(item.signs[name] for name in aspects.naming) == signs
    ]
    found = []
    for piece in CrossSection(list(polygons), FillRule.Positive).decompose():
        rings = tuple(np.asarray(ring) for ring in piece.to_polygons())
        proved = {k: _area_in(outline(rings), corners) for k, corners in own}
        ordered = sorted((k for k, size in proved.items() if size > 0), key=lambda k: -proved[k])
        if ordered:
            found.append(TracedPart(rings, float(piece.area()), tuple(ordered)))
    return found


def _area_in(path: Path | None, corners: FloatArray) -> float:
    """Area of the rectangles (n, 4, 2) whose middles lie in a path."""
    inside = path.contains_points(corners.mean(axis=1)) if path and len(corners) else np.zeros(len(corners), bool)
    return float(np.sum(np.prod(corners[inside, 2] - corners[inside, 0], axis=-1)))


def rectangles(boxes: Boxes, value: float | None) -> FloatArray:
    """Corners (n, 4, 2) of the boxes in the plane, of boxes in space of those that the cut meets."""
    if value is not None:
        boxes = boxes[(boxes.low[2] <= value) & (value < boxes.high[2])]
    (left, low), (right, high) = boxes.low[:2], boxes.high[:2]
    return np.stack([np.stack(pair, axis=-1) for pair in ((left, low), (right, low), (right, high), (left, high))], 1)


def united(corners: FloatArray) -> list[FloatArray]:
    """Polygons (k, 2) round rectangles (n, 4, 2) that touch: boxes of a proof are in the data alone."""
    return [np.asarray(polygon) for polygon in CrossSection(list(corners), FillRule.NonZero).to_polygons()]


def listed(planes: Sequence[TracedPlane]) -> list[int]:
    """Places of the aspects that are seen in some of the planes, in their order."""
    return sorted({k for plane in planes for part in plane.parts for k in part.aspects})
