"""Workspace: volume with its error, sections, projections, and the parallel singularities inside."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace

from assur.kinematics.answers.at_border import angle_at_border
from assur.kinematics.limits import NO_LIMITS, limits_note, limits_stated
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle
from assur.report.findings import Findings
from assur.report.sections.singularities import written
from assur.report.units import extent_unit
from assur.results.kinds import FLOATING, PROVED, TWO_RESOLUTIONS, Cell, Result, Scalar, Section, Table
from assur.results.typeset_text import bounds, fixed, short, shown_unit, with_error
from assur.singularity.loci import Locus, parallel_factors
from assur.workspace.parasitic import largest_parasitic
from assur.workspace.projections import projection
from assur.workspace.region import Workspace

AGAINST = "AGAINST the proved bounds"
SHARE = "estimate: by a solid about the surface, its error not estimated"
NO_SURFACE = "not proved: no such surface was found"
NOT_REACHED = "not proved: that nothing is reached, where no node of the cells is"
UNSEEN = "not proved: that a factor is nowhere zero where it only keeps its sign at every node of the cells"
ENDINGS = {
    "": "",
    "no limit": "; nothing fails within the farthest size that is looked at",
    "undecided": "; what limits it is not decided",
    "interrupted": "; interrupted",
}
"""Why there is no larger one, where no pose that fails was found."""


def reach(findings: Findings) -> Section:
    """The region that the default working mode reaches inside the file's box."""
    region, record = findings.workspace, findings.record
    limits = "within the limits of the file" if limits_stated(record) else f"where {NO_LIMITS}"
    how = (
        "Each margin of the inverse problem bounds a solid; the workspace is their intersection with the box."
        if record.closed_form
        else f"Without a closed form the mode is {region.how} over a grid: this is the part that hangs together with "
        "where it starts, inside the box. What is thinner than a cell may be missed."
    )
    mode = f"the working mode {region.mode}" if region.mode else "the mechanism"
    said = (
        f"The poses of the box {_box(region, record)} that {mode} reaches{held_words(region, record)}, {limits}. "
        f"{how} The error is the difference to the same calculation at half the resolution.{_proof_words(findings)}"
    )
    results: list[Result] = [
        *extents(findings),
        *share(findings),
        *largest_cube(findings),
        *findings.picture("workspace"),
        *_loci(findings),
        *findings.picture("projections"),
        *_projections(findings),
        *findings.picture("sections"),
        *_sections(findings),
        *findings.picture("parasitic"),
        *_parasitic(findings),
    ]
    return Section("Workspace", said, results)


def _proof_words(findings: Findings) -> str:
    """Whether bounds are proved, and why not; whether a cube is."""
    proof, why = findings.bounds, findings.cube
    said = (
        f" No bounds are proved: {proof}."
        if isinstance(proof, str)
        else " The bounds do not come from solids: boxes are proved to lie inside or outside by interval arithmetic, "
        "for the dimensions, strokes and box exactly as they stand."
    )
    if isinstance(why, str):
        return f"{said} No region free of singularities is proved: {why}."
    if why.size == 0 and why.witness:
        return f"{said} About the configuration of this report no region is free: {why.witness.why} there."
    return said


def extents(findings: Findings) -> list[Scalar]:
    """The volume by every route, the best known first: proved bounds, then the estimate by solids."""
    region, proof = findings.workspace, findings.bounds
    name, unit = size_name(region), extent_unit(findings.record, region.box.names)
    cells = f"{findings.cells} cells along each coordinate"
    limits = limits_note(findings.record)
    noted = "; ".join(filter(None, (cells, limits)))
    estimate = Scalar(name, region.volume, unit, TWO_RESOLUTIONS, region.volume_error, note=noted)
    if isinstance(proof, str):
        return [estimate]
    low, high = proof.volume
    agrees = agreement(region.volume, region.volume_error, proof.volume)
    return [
        Scalar(name, None, unit, PROVED, low=low, high=high, note="; ".join(filter(None, (proof.note, limits)))),
        replace(estimate, name=f"{name} by solids", note=f"{cells}; {agrees}"),
    ]


def agreement(value: float, error: float, bounds: tuple[float, float]) -> str:
    """How an estimate lies to proved bounds.

    >>> agreement(1.0, 0.1, (0.9, 1.2)), agreement(1.25, 0.1, (0.9, 1.2)), agreement(2.0, 0.1, (0.9, 1.2))
    ('inside the proved bounds', 'within its error of the proved bounds', 'AGAINST the proved bounds')
    """
    low, high = bounds
    if low <= value <= high:
        return "inside the proved bounds"
    near = low - error <= value <= high + error
    return "within its error of the proved bounds" if near else AGAINST


def share(findings: Findings) -> list[Scalar]:
    """How much of the volume is near a parallel singularity, where that can be said."""
    region = findings.workspace
    if region.share is None:
        return []
    away = f"{region.near:g} {shown_unit(findings.record.unit)}"
    near = f"within {away} of a parallel-singular surface inside; the border of the workspace is not counted"
    if all(locus.factor in findings.nowhere for locus in region.loci):
        known = f"{PROVED}: there is no such surface"
    else:
        known = SHARE if any(locus.area or locus.everywhere for locus in region.loci) else NO_SURFACE
    return [Scalar("share near a singularity", round(100 * region.share, 1), "%", known, note=near)]


def largest_cube(findings: Findings) -> list[Scalar]:
    """The largest cube about the configuration of this report that is proved free of singularities."""
    cube, record = findings.cube, findings.record
    if isinstance(cube, str) or (cube.size == 0 and cube.witness):
        return []
    names = cube.shape.names
    shape = ("interval", "square", "cube")[len(names) - 1]
    at = ", ".join(f"{name} = {_at(record, name, value)}" for name, value in zip(names, cube.shape.centre, strict=True))
    held = ", ".join(f"{name} = {_at(record, name, value)}" for name, value in cube.held.items())
    mode = f", mode {cube.mode}" if cube.mode else ""
    about = f"about {at}{f' with {held} held' if held else ''}{mode}: every pose is reached and none is singular"
    if not limits_stated(record):
        about += f" ({NO_LIMITS})"
    ends = f"; the next larger ones hold a pose where {cube.witness.why}" if cube.witness else ENDINGS[cube.stopped]
    known = math.isfinite(cube.refuted)
    return [
        Scalar(
            f"edge of the largest {shape} free of singularities",
            None if known else cube.size,
            shown_unit(record.unit),
            PROVED,
            low=cube.size,
            high=cube.refuted if known else None,
            note=about + ends,
        )
    ]


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


def _loci(findings: Findings) -> list[Table]:
    region, record = findings.workspace, findings.record
    names = region.box.names
    mixed = any(map(is_angle, names))
    factors = {factor.name: factor for factor in parallel_factors(record)}
    if not factors:
        return []
    unit = extent_unit(record, names[1:])
    rows = tuple(
        (
            written(factors[locus.factor]),
            locus.meaning,
            _size(findings, locus, mixed=mixed),
        )
        for locus in region.loci
    )
    size = "inside" if mixed else f"area [{unit}]" if len(names) == 3 else f"length [{unit}]"
    title = "Parallel singularities inside the workspace"
    where = "surface" if len(names) == 3 else "curve"
    caption = "" if mixed else f"Size of the {where} on which each factor vanishes."
    return [Table(title, ("factor", "zero where", size), rows, caption, known_by=_right_of_loci(findings))]


def _right_of_loci(findings: Findings) -> str:
    """By what right the sizes of loci are known, and that there is none."""
    if findings.workspace.volume == 0:
        return f"{PROVED}: nothing is reached" if findings.unreached else NOT_REACHED
    loci = [locus for locus in findings.workspace.loci if not locus.everywhere]
    absent = {locus.factor for locus in loci if not locus.area}
    parts = [TWO_RESOLUTIONS] if len(absent) < len(loci) else []
    parts += [f"{PROVED}: nowhere zero"] if absent & findings.nowhere else []
    parts += [UNSEEN] if absent - findings.nowhere else []
    return "; ".join(parts or [FLOATING])


def _size(findings: Findings, locus: Locus, *, mixed: bool) -> str:
    """How much of a locus is inside, or by what right there is none; lengths and angles together have no area."""
    if locus.everywhere:
        return "everywhere"
    if locus.area:
        return "on a surface" if mixed else with_error(locus.area, locus.area_error)
    if findings.workspace.volume == 0:
        return "nothing is reached"
    if locus.factor in findings.nowhere:
        return "nowhere: proved"
    return f"none found on {findings.cells} cells along each coordinate"


def _projections(findings: Findings) -> list[Table]:
    region, record = findings.workspace, findings.record
    if len(region.box.names) != 3 or region.volume == 0.0:
        return []
    rows = []
    for plane in itertools.combinations(region.box.names, 2):
        area = region.projection(*plane).area
        error = abs(area - projection(region.coarser, plane).area)
        rows.append(("–".join(plane), with_error(area, error), extent_unit(record, plane)))
    return [Table("Projections", ("plane", "area", "unit"), tuple(rows), known_by=TWO_RESOLUTIONS)]


def _sections(findings: Findings) -> list[Table]:
    """Areas of the cuts: proved bounds and the estimate beside each other, where both are known."""
    region, record = findings.workspace, findings.record
    if not region.sections:
        return []
    name = region.sections[0].coordinate
    size = extent_unit(record, [other for other in region.box.names if other != name])
    proof = findings.bounds
    proved = {} if isinstance(proof, str) else {section.value: section.area for section in proof.sections}
    rows: list[tuple[Cell, ...]] = []
    for section in region.sections:
        error = section.area_error
        row = (_at(record, name, section.value), with_error(section.area, error))
        both = proved.get(section.value)
        rows.append((*row, bounds(*both), agreement(section.area, error, both)) if both else (*row, "", ""))
    columns = (name, f"area by solids [{size}]", f"area, proved bounds [{size}]", "the estimate is")
    known = f"{PROVED}; by solids {TWO_RESOLUTIONS}" if proved else TWO_RESOLUTIONS
    return [Table(f"Sections across {name}", columns, tuple(rows), known_by=known)]


def _parasitic(findings: Findings) -> list[Table]:
    """Of the coordinates that the pose leaves out and that move along: the largest values over the region."""
    record = findings.record
    rows = tuple(
        (
            name,
            _at(record, name, motion.value),
            ", ".join(f"{key} = {_at(record, key, value)}" for key, value in motion.at.items()),
        )
        for name, motion in largest_parasitic(record, findings.workspace).items()
    )
    caption = "Coordinates that the pose leaves out and that move along with it: the largest sizes that were seen."
    known = "estimate: largest over the border's vertices and points inside; the true one may be larger"
    return [Table("Parasitic motion", ("coordinate", "largest", "at"), rows, caption, known_by=known)] if rows else []
