"""The workspace of a mechanism in one working mode: one call, one frozen result.

The region is the set of poses of a box that the mode reaches with every input inside its stroke and every joint
inside its limits, where there are any. With a closed form the mode reaches a pose where every margin of its inverse
problem is at least zero. Without one it is followed over the box from home
(`kinematics/following/continuation.py`), and the region is the part of the mode that hangs together with home inside
the box.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle
from assur.results.answers.region import ParallelSingular, SingularSurface
from assur.results.json_text import plain
from assur.results.notebook import Entries, Tabulated
from assur.singularity.loci import Locus, parallel_loci
from assur.work import Progress
from assur.workspace.bounds import Stroke
from assur.workspace.certified.region import unit
from assur.workspace.domain import Box, box_of
from assur.workspace.fields import Field, inside_at
from assur.workspace.followed_field import FollowedField
from assur.workspace.grid import grid_over
from assur.workspace.mode_fields import CLOSED_FORM, mode_fields
from assur.workspace.nearness import near_volume, triangles_of
from assur.workspace.projections import Projection, projection
from assur.workspace.reach import Reach
from assur.workspace.sections import RegionSection, section
from assur.workspace.slices import MOST, Slice, slice_at
from assur.workspace.volume import at_two_resolutions

FloatArray = NDArray[np.float64]
RESOLUTION = 64
FOLLOWED = 20
"""Cells along each coordinate by default; fewer in space where the mechanism has no closed form and is followed."""

NEAR = 0.035
"""How near to a parallel singularity is near, as a share of the characteristic length, rounded to one digit."""


@dataclass(frozen=True, eq=False)
class Workspace(Tabulated):
    """The workspace of one working mode.

    Attributes:
        record, mode, box: what it is the workspace of.
        slice: which coordinates vary and at what the others are held.
        unit: of `volume`: "mm^3", or "mm^2 rad" where one of three coordinates is an angle.
        volume: volume (area in a plane) of the region inside the box.
        volume_error: estimate of its error: the difference to half the resolution.
        sections: cuts across the last pose coordinate.
        loci: where each parallel factor vanishes inside.
        near, share: `share` of the volume lies within the distance `near` of one of these surfaces; None
            where there is no volume, where a pose coordinate is an angle, or where `near` is too small to resolve.
        vertices, faces: (n, 3) and (k, 3), the surface of the region, or the triangulated region in a plane.
        margins, region, coarser: the fields and the solid behind it all, and that at half the resolution.
        strokes: those that were asked for in place of the file's.
        how: "closed form", or from where the mode was followed: "followed from home".
    """

    record: MechanismRecord = field(repr=False)
    mode: str
    box: Box
    slice: Slice
    unit: str
    volume: float
    volume_error: float
    sections: tuple[RegionSection, ...] = field(repr=False)
    loci: tuple[Locus, ...] = field(repr=False)
    near: float
    share: float | None
    vertices: FloatArray = field(repr=False)
    faces: NDArray[np.int64] = field(repr=False)
    margins: Mapping[str, Field] = field(repr=False)
    region: Reach = field(repr=False)
    coarser: Reach = field(repr=False)
    strokes: Mapping[str, Stroke | None] | None = None
    how: str = CLOSED_FORM

    @property
    def mechanism(self) -> str:
        """The mechanism's name."""
        return self.record.name

    def _picture(self) -> Any:
        """Its figure, of two or three coordinates."""
        if len(self.box.names) == 1:
            return None
        context = import_module("assur.figures.context").Context(self.record, self)
        return import_module("assur.figures.catalogue").draw(self.record, "workspace", context)

    def _title(self) -> str:
        return f"workspace of {self.mechanism}, mode {self.mode}, by {self.how}"

    def _entries(self) -> Entries:
        bounds = zip(self.box.names, self.box.low, self.box.high, strict=True)
        rows: list[tuple[str, object, object, str]] = [("size", self.volume, self.volume_error, self.unit)]
        rows += [(f"{name} of the box", f"{low:g} to {high:g}", "", "") for name, low, high in bounds]
        rows += [(f"cut at {cut.coordinate} = {cut.value:g}", cut.area, cut.area_error, "") for cut in self.sections]
        return [dict(zip(("what", "value", "error", "unit"), row, strict=True)) for row in rows]

    @property
    def parallel_singular(self) -> ParallelSingular:
        """Per parallel factor its surface inside the workspace, and how much of the volume is near one."""
        surfaces = {
            locus.factor: SingularSurface(
                locus.meaning,
                None if locus.everywhere else locus.area,
                None if locus.everywhere else locus.area_error,
                len(locus.faces),
                locus.everywhere,
            )
            for locus in self.loci
        }
        return ParallelSingular(surfaces, self.near, self.share)

    def section(self, value: float, coordinate: str | None = None) -> RegionSection:
        """The cut at a value of a pose coordinate, the last one where none is named.

        >>> import assur
        >>> region = assur.load("fivebar").workspace(resolution=16)
        >>> cut = region.section(200.0)
        >>> (low,), (high,) = cut.polygons[0]
        >>> cut.coordinate, round(float(cut.area - (high - low)), 9)
        ('y', 0.0)
        """
        return section(self.region, value, coordinate or self.box.names[-1], self.coarser)

    def projection(self, *plane: str) -> Projection:
        """What the region covers on the plane of two pose coordinates, e.g. `projection("x", "z")` for XOZ.

        >>> import assur
        >>> region = assur.load("fivebar").workspace(resolution=16)
        >>> abs(region.projection("x", "y").area - region.volume) < region.volume_error
        True
        """
        return projection(self.region, plane)

    def interior(self, count: int, rng: np.random.Generator) -> FloatArray:
        """Poses (N, m) of equal weight inside the region: what it holds of `count` points spread over the box.

        >>> import assur
        >>> region = assur.load("fivebar").workspace(resolution=16)
        >>> poses = region.interior(100, np.random.default_rng(0))
        >>> bool(assur.load("fivebar").inverse(poses, region.mode).exists.all())
        True
        """
        return self.inside(count, rng)[0]

    def inside(self, count: int, rng: np.random.Generator) -> tuple[FloatArray, FloatArray | None]:
        """Poses (N, m) as `interior`, and of a mode that was followed its joint values (N, n) there.

        >>> import assur
        >>> region = assur.load("fivebar").workspace(resolution=16)
        >>> poses, joints = region.inside(100, np.random.default_rng(0))
        >>> poses.shape[1], joints is None  # it has a closed form, which gives them
        (2, True)
        """
        points = self.box.spread(count, rng)
        inside = inside_at(self.margins, points)
        joints = None if self.how == CLOSED_FORM else self.joints(points)[inside]
        return self.slice.poses(points[inside]), joints

    def joints(self, points: FloatArray) -> FloatArray:
        """Joint values (N, n) of the mode at points (N, free coordinates); NaN where it was not followed to.

        Only of a mode that was followed; where there is a closed form, the inverse problem gives them.

        >>> import assur
        >>> region = assur.load("fivebar").workspace(resolution=16)
        >>> region.joints(region.interior(10, np.random.default_rng(0)))
        Traceback (most recent call last):
        ...
        assur.errors.UsageError: fivebar has a closed form
        hint: take the joint values of .inverse(poses, mode)
        """
        followed = next((item for item in self.margins.values() if isinstance(item, FollowedField)), None)
        if followed is None:
            raise UsageError(
                f"{self.mechanism} has a closed form", hint="take the joint values of .inverse(poses, mode)"
            )
        found = followed.over.at(np.asarray(points, dtype=float))
        return np.where(found.reached[:, None], found.joints, np.nan)

    def to_json(self) -> dict[str, Any]:
        """The result as plain numbers, lists and None.

        >>> import assur
        >>> region = assur.load("fivebar").workspace(resolution=16)
        >>> region.to_json()["volume"] == region.volume
        True
        """
        key = self.box.names[-1]
        return {
            "volume": self.volume,
            "volume_error": self.volume_error,
            "unit": self.unit,
            "mode": self.mode,
            "how": self.how,
            "coordinates": list(self.box.names),
            "box": self.box.intervals,
            "held": dict(self.slice.held),
            "parallel_singular": plain(self.parallel_singular),
            "sections": [{key: item.value, "area": item.area, "area_error": item.area_error} for item in self.sections],
        }


def default_resolution(record: MechanismRecord, poses: Slice | None = None) -> int:
    """Cells along each coordinate where nobody says how many.

    >>> from assur.model.registry import load_record
    >>> default_resolution(load_record("zeng2019"))
    64
    """
    free = (poses or slice_at(record)).free
    return RESOLUTION if record.closed_form or len(free) < MOST else FOLLOWED


def workspace(
    record: MechanismRecord,
    mode: str | None = None,
    box: Mapping[str, Sequence[float]] | ArrayLike | None = None,
    strokes: Mapping[str, Stroke | None] | None = None,
    resolution: int | None = None,
    sections: Sequence[float] | None = None,
    near: float | None = None,
    held: Mapping[str, float] | None = None,
    progress: Progress | None = None,
) -> Workspace:
    """The workspace of a working mode inside a box, by solids (see `assur.workspace.solids`).

    Args:
        record: the mechanism. Without a closed form it is followed, which takes ten seconds where the other takes
            one: a third of the resolution will often do.
        mode: signs of the working mode; the file's default where none is given.
        box: (low, high) per coordinate that varies, in order or by name, in length units and rad; the file's box
            for what is left out.
        strokes: input name -> (low, high) as printed, in length units and rad, or None for no limit; the
            file's for what is left out.
        resolution: cells along each coordinate, 4 to 400; by default 64, or 20 in space where there is no closed
            form. What is thinner than a cell may be missed.
        sections: values of the last pose coordinate; by default those of the file that lie in the box.
        near: distance from a parallel-singular surface, in length units; by default 3.5 % of the characteristic
            length, rounded to one digit.
        held: pose coordinates that stand still, in lengths and rad; of a pose with more than three coordinates the
            angles by default, as they are at home. At most three may vary.
        progress: called with (steps done, steps in all).

    Returns:
        The frozen result; an empty region has the volume 0 and no share.

    Errors:
        UsageError: a box or a stroke turned round or not finite, a section outside the box, an unknown name
        or mode, a resolution that is none.

    Example: the paper's search box, Table 2 row 4. The volume is 500 mm times an area that quadrature of
    the two circles gives as 45629.17 mm^2, so 22 814 586 mm^3.

    >>> from assur.model.registry import load_record
    >>> found = workspace(load_record("zeng2019"), resolution=32)
    >>> abs(found.volume - 22_814_586.4) < found.volume_error < 0.001 * found.volume
    True
    """
    mode = mode or record.modes.default_working
    poses = slice_at(record, held)
    domain = box_of(record, box, poses.free)
    resolution = default_resolution(record, poses) if resolution is None else resolution
    if near is None:
        near = float(f"{NEAR * characteristic_length(record):.1g}")
    if not (isinstance(near, (int, float, np.number)) and np.isfinite(near) and near > 0):
        raise UsageError(f"near: {near!r} is not a positive distance")
    fields = mode_fields(record, mode, strokes, poses, grid_over(domain, resolution), progress)
    region, coarser = at_two_resolutions(fields.margins, fields.factors, domain, resolution, fields.tick)
    loci = parallel_loci(record, region, coarser)
    fields.tick()
    share = _share(region, loci, near)
    fields.tick()
    values = _default_sections(record, domain) if sections is None else sections
    vertices, faces = region.mesh()
    found = Workspace(
        record=record,
        mode=mode,
        box=domain,
        slice=poses,
        unit=unit(record, domain.names),
        volume=region.volume,
        volume_error=abs(region.volume - coarser.volume),
        sections=tuple(section(region, value, domain.names[-1], coarser) for value in values),
        loci=loci,
        near=float(near),
        share=share,
        vertices=vertices,
        faces=faces,
        margins=fields.margins,
        region=region,
        coarser=coarser,
        strokes=strokes,
        how=fields.how,
    )
    fields.tick()
    return found


def _default_sections(record: MechanismRecord, box: Box) -> tuple[float, ...]:
    """The file's sections, which are values of the last coordinate of the pose, where that one varies."""
    if box.names[-1] != record.platform.pose[-1]:
        return ()
    return tuple(value for value in record.sections if box.low[-1] <= value <= box.high[-1])


def _share(region: Reach, loci: Sequence[Locus], near: float) -> float | None:
    volume = region.volume
    if volume == 0.0:
        return None
    if any(locus.everywhere for locus in loci):
        return 1.0
    if any(map(is_angle, region.grid.box.names)):
        return None
    surfaces = [triangles_of(locus.vertices, locus.faces) for locus in loci if len(locus.faces)]
    close = near_volume(region, surfaces, near) if surfaces else 0.0
    return None if close is None else close / volume
