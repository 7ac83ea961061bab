"""Workspace: volume with its error, sections, projections, and the parallel singularities inside."""

from __future__ import annotations

import itertools

from assur.kinematics.answers import power
from assur.model.mechanism import MechanismRecord
from assur.report.findings import Findings
from assur.report.numbers import fixed, short, shown_unit
from assur.report.sections.singularities import written
from assur.results.kinds import Result, Scalar, Section, Table
from assur.workspace.region import Workspace


def reach(found: Findings) -> Section:
    """The region that the default working mode reaches inside the file's box."""
    region, record = found.workspace, found.record
    plane = len(region.box.names) < 3
    strokes = [item for item in record.inputs if item.stroke]
    limits = "with the strokes of the file" if strokes else "without limits on the inputs, since none are stated"
    said = (
        f"The poses of the box {_box(region, record)} that the working mode {region.mode} reaches, {limits}. Each "
        "margin of the inverse problem bounds a solid; the workspace is their intersection with the box. The error is "
        "the difference to the same calculation at half the resolution."
    )
    near = f"within {region.near:g} {record.unit} of a parallel-singular surface"
    share = None if region.share is None else round(100 * region.share, 1)
    known = f"{found.resolution} cells along each coordinate"
    results: list[Result] = [
        Scalar("area" if plane else "volume", region.volume, shown_unit(region.unit), known, region.volume_error),
        Scalar("share near a singularity", share, "%", near),
        *found.picture("workspace"),
        _loci(found),
        *found.picture("projections"),
        *_projections(region, record),
        *found.picture("sections"),
        *_sections(region, record),
    ]
    return Section("Workspace", said, results)


def _box(region: Workspace, record: MechanismRecord) -> str:
    unit = shown_unit(record.unit)
    intervals = zip(region.box.names, region.box.low, region.box.high, strict=True)
    return ", ".join(f"{name} = {fixed(low, 0)} to {fixed(high, 0)} {unit}" for name, low, high in intervals)


def _loci(found: Findings) -> Table:
    region, record = found.workspace, found.record
    dimension = len(region.box.names)
    factors = {item.name: item for item in found.form.factor_list}
    unit = shown_unit(power(record.unit, dimension - 1))
    rows = tuple(
        (
            written(factors[locus.factor]),
            locus.meaning,
            "everywhere" if locus.everywhere else short(locus.area, 5) if locus.area else "nowhere inside",
        )
        for locus in region.loci
    )
    size = f"area [{unit}]" if dimension == 3 else f"length [{unit}]"
    title = "Parallel singularities inside the workspace"
    return Table(title, ("factor", "zero where", size), rows, "Size of the surface on which each factor vanishes.")


def _projections(region: Workspace, record: MechanismRecord) -> list[Table]:
    if len(region.box.names) != 3 or region.volume == 0.0:
        return []
    planes = list(itertools.combinations(region.box.names, 2))
    rows = tuple((f"{first}–{second}", short(region.projection(first, second).area, 6)) for first, second in planes)
    return [Table("Projections", ("plane", f"area [{shown_unit(power(record.unit, 2))}]"), rows)]


def _sections(region: Workspace, record: MechanismRecord) -> list[Table]:
    if not region.sections:
        return []
    name, unit = region.sections[0].coordinate, shown_unit(record.unit)
    size = shown_unit(power(record.unit, len(region.box.names) - 1))
    rows = tuple((short(item.value), short(item.area, 6)) for item in region.sections)
    return [Table(f"Sections across {name}", (f"{name} [{unit}]", f"area [{size}]"), rows)]
