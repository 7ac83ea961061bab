"""Loci: the surfaces inside a working mode's region on which a factor of det Jp vanishes.

Serial loci are not looked for: a factor of det Jq vanishes where two working modes merge, which is the
boundary of the region. A parallel factor that vanishes only there (as u1 - u2 with u1 and u2) keeps its sign
inside and has no surface.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.status import FACTOR_TOLERANCE, scale
from assur.model.closed_form import Factor
from assur.model.mechanism import MechanismRecord
from assur.model.pose import rate_names

FloatArray = NDArray[np.float64]
Faces = NDArray[np.int64]

OUTPUT = Factor("output", "parallel", "1", "the inputs stand and the platform can move", r"\det J_p", unit=0)
"""The one parallel factor of a mechanism without closed form: with rows of Jp of length 1, so that it is at most 1."""


class FactorRegion(Protocol):
    """What this analysis needs of a region, whatever made it."""

    def factor_inside(self, name: str) -> NDArray[np.float32]:
        """A factor at nodes (k,) inside the region."""

    def zero_surface(self, name: str) -> tuple[FloatArray, Faces, float]:
        """Vertices, faces and area of the zero set of a factor inside the region."""


RIM = 0.25
"""Share of the faces at the rim of a followed surface that may be too much or too little: they end somewhere in a cell.
Of the Delta robot's, at 8 to 16 cells, a sixth was."""


@dataclass(frozen=True, eq=False)
class Locus:
    """Where one factor of det Jp vanishes.

    Attributes:
        factor, meaning: its name and what it means geometrically.
        vertices: (n, m) poses; faces: (k, 3) triangles, or (k, 2) segments in a plane.
        area: total area (length in a plane), in units of the pose coordinates.
        area_error: estimate of its error: the difference to half the resolution; in a region that was followed, whose
            border is known to a part of a cell, at least a quarter of the area of the faces at the rim. Two surfaces
            nearer to each other than a cell may be missed by both resolutions.
        everywhere: the factor vanishes in the whole region, so there is no surface: the mode has a
            singularity at each of its poses.
    """

    factor: str
    meaning: str
    vertices: FloatArray
    faces: Faces
    area: float
    area_error: float = 0.0
    everywhere: bool = False


def parallel_loci(
    record: MechanismRecord, region: FactorRegion, coarser: FactorRegion | None = None
) -> tuple[Locus, ...]:
    """The locus of every parallel factor in a region; one without faces where the factor keeps its sign.

    `coarser` is the same region at half the resolution, for the errors of areas.

    Example: in the built working mode of Zeng et al. 2019 two kinds of parallel singularity cross the
    paper's own search box (E7): links 9 and 10 along Y, and parallelogram 1 flat.

    >>> from assur.model.registry import load_record
    >>> from assur.workspace.region import workspace
    >>> [locus.factor for locus in workspace(load_record("zeng2019"), resolution=24).loci if locus.area > 0]
    ['w', 'v']
    """
    found = []
    for factor in parallel_factors(record):
        locus = _locus(record, region, factor)
        error = 0.0 if coarser is None else abs(locus.area - _locus(record, coarser, factor).area)
        if coarser is not None and record.closed_form is None:
            error = max(error, RIM * rim_area(locus.vertices, locus.faces))
        found.append(replace(locus, area_error=error))
    return tuple(found)


def rim_area(vertices: FloatArray, faces: Faces) -> float:
    """The area of the faces that have an edge of their own; of segments, the length of those with a free end.

    >>> square = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]])
    >>> rim_area(square, np.array([[0, 1, 2], [0, 2, 3]]))
    1.0
    """
    count = faces.shape[1]
    sides = np.sort(np.concatenate([np.delete(faces, k, axis=1) for k in range(count)]), axis=1)
    _, side, shared = np.unique(sides, axis=0, return_inverse=True, return_counts=True)
    at_rim = np.any((shared[side.ravel()] == 1).reshape(count, -1), axis=0)
    spans = vertices[faces[at_rim]]
    spans = spans[:, 1:] - spans[:, :1]
    gram = spans @ np.swapaxes(spans, 1, 2)
    return float(np.sum(np.sqrt(np.maximum(np.linalg.det(gram), 0.0))) / math.factorial(count - 1))


def parallel_factors(record: MechanismRecord) -> tuple[Factor, ...]:
    """The parallel factors of the closed form; without one the determinant of Jp on the joint graph.

    There is no determinant where a mechanism has more or fewer inputs than rates of its pose; redundant ones leave
    no more than curves singular in a space that they would else cut.
    """
    if record.redundant_inputs:
        return ()
    if record.closed_form is not None:
        return tuple(item for item in record.closed_form.factor_list if item.kind == "parallel")
    square = len(record.inputs) == len(rate_names(record.platform.pose))
    return (OUTPUT,) if square else ()


def _locus(record: MechanismRecord, region: FactorRegion, factor: Factor) -> Locus:
    values = region.factor_inside(factor.name)
    zero = FACTOR_TOLERANCE * scale(record, factor.scale)
    everywhere = values.size > 0 and bool(np.all(np.abs(values) <= zero))
    if np.max(values, initial=0.0) <= zero or np.min(values, initial=0.0) >= -zero:
        return Locus(factor.name, factor.meaning, *_nothing(), everywhere=everywhere)
    return Locus(factor.name, factor.meaning, *region.zero_surface(factor.name))


def _nothing() -> tuple[FloatArray, Faces, float]:
    return np.empty((0, 3)), np.empty((0, 3), dtype=np.int64), 0.0
