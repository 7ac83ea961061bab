"""Workspace: volume with its error, sections, projections, and the parallel singularities inside."""

from __future__ import annotations

import itertools

from assur.kinematics.answers.at_border import angle_at_border
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle
from assur.report.findings import Findings
from assur.report.numbers import extent_unit, fixed, short, shown_unit
from assur.report.sections.singularities import written
from assur.results.kinds import Result, Scalar, Section, Table
from assur.singularity.loci import Locus, parallel_factors
from assur.workspace.region import Workspace


def reach(found: Findings) -> Section:
    """The region that the default working mode reaches inside the file's box."""
    region, record = found.workspace, found.record
    strokes = [item for item in record.inputs if item.stroke]
    limits = "with the strokes of the file" if strokes else "without limits on the inputs, since none are stated"
    how = (
        "Each margin of the inverse problem bounds a solid; the workspace is their intersection with the box."
        if record.closed_form
        else f"Without a closed form the mode is {region.how} over a grid: this is the part that hangs together with "
        "where it starts, inside the box. What is thinner than a cell may be missed."
    )
    mode = f"the working mode {region.mode}" if region.mode else "the mechanism"
    said = (
        f"The poses of the box {_box(region, record)} that {mode} reaches{held_words(region, record)}, {limits}. "
        f"{how} The error is the difference to the same calculation at half the resolution."
    )
    unit = extent_unit(record, region.box.names)
    known = f"{found.resolution} cells along each coordinate"
    results: list[Result] = [Scalar(size_name(region), region.volume, unit, known, region.volume_error)]
    if region.share is not None:
        near = f"within {region.near:g} {record.unit} of a parallel-singular surface"
        results.append(Scalar("share near a singularity", round(100 * region.share, 1), "%", near))
    results += [
        *found.picture("workspace"),
        *_loci(found),
        *found.picture("projections"),
        *_projections(region, record),
        *found.picture("sections"),
        *_sections(region, record),
    ]
    return Section("Workspace", said, results)


def size_name(region: Workspace) -> str:
    """What its extent is called: length, area or volume; of lengths and angles together just extent.

    >>> from types import SimpleNamespace
    >>> size_name(SimpleNamespace(box=SimpleNamespace(names=("x", "y", "phi"))))
    'extent'
    """
    names = region.box.names
    return "extent" if any(map(is_angle, names)) else ("length", "area", "volume")[len(names) - 1]


def held_words(region: Workspace, record: MechanismRecord) -> str:
    """What is held, e.g. " with phi = 0.0° held"; nothing where all coordinates vary."""
    held = ", ".join(f"{name} = {_at(record, name, value)}" for name, value in region.slice.held.items())
    return f" with {held} held" if held else ""


def _at(record: MechanismRecord, name: str, value: float) -> str:
    """A value of a coordinate with its unit."""
    if not is_angle(name):
        return f"{short(value)} {shown_unit(record.unit)}"
    return f"{fixed(float(angle_at_border(record, value)), 1)}{'°' if record.angle == 'deg' else ' rad'}"


def _box(region: Workspace, record: MechanismRecord) -> str:
    intervals = zip(region.box.names, region.box.low, region.box.high, strict=True)
    return ", ".join(
        f"{name} from {_at(record, name, low)} to {_at(record, name, high)}" for name, low, high in intervals
    )


def _loci(found: Findings) -> list[Table]:
    region, record = found.workspace, found.record
    names = region.box.names
    mixed = any(map(is_angle, names))
    factors = {item.name: item for item in parallel_factors(record)}
    if not factors:
        return []
    unit = extent_unit(record, names[1:])
    rows = tuple(
        (
            written(factors[locus.factor]),
            locus.meaning,
            _size(locus, mixed=mixed),
        )
        for locus in region.loci
    )
    size = "inside" if mixed else f"area [{unit}]" if len(names) == 3 else f"length [{unit}]"
    title = "Parallel singularities inside the workspace"
    where = "surface" if len(names) == 3 else "curve"
    caption = "" if mixed else f"Size of the {where} on which each factor vanishes."
    return [Table(title, ("factor", "zero where", size), rows, caption)]


def _size(locus: Locus, *, mixed: bool) -> str:
    """How much of a locus is inside; lengths and angles together have no area."""
    if locus.everywhere:
        return "everywhere"
    if not locus.area:
        return "nowhere inside"
    return "on a surface" if mixed else short(locus.area, 5)


def _projections(region: Workspace, record: MechanismRecord) -> list[Table]:
    if len(region.box.names) != 3 or region.volume == 0.0:
        return []
    planes = list(itertools.combinations(region.box.names, 2))
    rows = tuple(
        (f"{first}–{second}", short(region.projection(first, second).area, 6), extent_unit(record, (first, second)))
        for first, second in planes
    )
    return [Table("Projections", ("plane", "area", "unit"), rows)]


def _sections(region: Workspace, record: MechanismRecord) -> list[Table]:
    if not region.sections:
        return []
    name = region.sections[0].coordinate
    size = extent_unit(record, [other for other in region.box.names if other != name])
    rows = tuple((_at(record, name, item.value), short(item.area, 6)) for item in region.sections)
    return [Table(f"Sections across {name}", (name, f"area [{size}]"), rows)]
