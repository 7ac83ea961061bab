"""How the answer of `assur workspace` reads, as data, as a file and for a person."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Literal

from rich.console import RenderableType

from assur.cli.options import Outcome, Shared
from assur.cli.output import heading, table
from assur.cli.paths import output_file
from assur.cli.progress import progress
from assur.cli.quantities import interval_words, mode_words, unit_of, value_words
from assur.cli.region_question import Question
from assur.kinematics.answers.at_border import (
    box_at_border,
    coordinate_unit,
    coordinates_at_border,
    input_unit,
    power,
)
from assur.kinematics.limits import NO_LIMITS, joint_limits, limits_stated
from assur.mechanism import Mechanism
from assur.model.pose import is_angle
from assur.results.answers.answer import entries
from assur.results.answers.region import LargestCoordinate, SectionArea, WorkspaceAnswer
from assur.results.files import write_whole
from assur.results.json_text import json_text
from assur.results.plain_text import short, with_error
from assur.workspace.aspects.nowhere import nothing_reached, nowhere_zero
from assur.workspace.parasitic import largest_parasitic
from assur.workspace.region import Workspace, default_resolution, workspace

ENDINGS = (".json", ".obj")
SAME = 1e-9
"""A region is its box where it lacks no more than this share of it."""


def target(text: str) -> Path:
    """The file that is to be written, if it can be."""
    return output_file(text, ENDINGS)


def outcome(record: Mechanism, asked: Question, written: Path | None, shared: Shared) -> Outcome:
    """The workspace as data and for a person; written to a file where one is named."""
    with progress("workspace", shared) as step:
        found = workspace(
            record,
            asked.mode,
            asked.box,
            asked.strokes,
            asked.resolution,
            asked.sections,
            asked.near,
            asked.held,
            step,
        )
    data = _answer(record, asked, found)
    if written is not None:
        write_whole(written, _content(written, found, data))
    return Outcome(data, lambda: _shown(record, data, written))


def _answer(record: Mechanism, asked: Question, region: Workspace) -> WorkspaceAnswer:
    """The answer, with angles in the mechanism's angle unit."""
    names, last = region.box.names, region.box.names[-1]
    limits = {item.name: item.stroke for item in record.inputs if item.stroke is not None} | asked.strokes
    units = {item.name: input_unit(record, item) for item in record.inputs}
    return WorkspaceAnswer(
        mechanism=record.name,
        volume=region.volume,
        volume_error=region.volume_error,
        unit=region.unit,
        mode=region.mode,
        how=region.how,
        coordinates=names,
        box=box_at_border(record, names, region.box.intervals),
        held=coordinates_at_border(record, region.slice.held),
        parallel_singular=region.parallel_singular,
        sections=tuple(
            SectionArea(item.area, item.area_error, {last: item.value / coordinate_unit(record, last)})
            for item in region.sections
        ),
        resolution=asked.resolution or default_resolution(record, region.slice),
        strokes={name: (low / units[name], high / units[name]) for name, (low, high) in limits.items()},
        limits_stated=limits_stated(record, asked.strokes),
        joint_limits=tuple(joint_limits(record)),
        parasitic=_parasitic(record, region),
        nowhere=_nowhere(record, asked, region),
        empty=_empty(record, asked, region),
    )


def _nowhere(record: Mechanism, asked: Question, region: Workspace) -> tuple[str, ...]:
    """Of the parallel factors without a locus inside those that are proved to have none."""
    unseen = [item.factor for item in region.loci if not item.area and not item.everywhere]
    if record.closed_form is None or not unseen or region.volume == 0:
        return ()
    return tuple(sorted(nowhere_zero(record, unseen, asked.mode, asked.box, asked.strokes, asked.held)))


def _empty(record: Mechanism, asked: Question, region: Workspace) -> Literal["proved", "sampled"] | None:
    """How it is known that nothing is reached, where nothing is."""
    if region.volume > 0:
        return None
    proved = record.closed_form is not None and nothing_reached(
        record, asked.mode, asked.box, asked.strokes, asked.held
    )
    return "proved" if proved else "sampled"


def _content(path: Path, region: Workspace, data: WorkspaceAnswer) -> str:
    if path.suffix.lower() == ".obj":
        points = [f"v {' '.join(f'{value:.9g}' for value in vertex)}" for vertex in region.vertices.tolist()]
        faces = [f"f {' '.join(str(index + 1) for index in face)}" for face in region.faces.tolist()]
        return "\n".join([f"# {region.mechanism}, working mode {region.mode}", *points, *faces, ""])
    polygons = [[polygon.tolist() for polygon in section.polygons] for section in region.sections]
    return json_text({**entries(data), "section_polygons": polygons}) + "\n"


def _shown(record: Mechanism, data: WorkspaceAnswer, written: Path | None) -> Iterable[RenderableType]:
    dimension = len(data.coordinates)
    yield heading(f"{data.mechanism}, workspace of {mode_words(record, data.mode)}")
    yield f"how: {data.how}"
    yield f"box: {interval_words(record, zip(data.coordinates, data.box, strict=True))}"
    if data.held:
        yield f"held: {value_words(record, data.held)}"
    if data.strokes:
        yield f"strokes: {interval_words(record, data.strokes.items())}"
    if not data.limits_stated:
        yield f"limits: {NO_LIMITS}"
    if data.joint_limits:
        yield f"limits of the file: {', '.join(data.joint_limits)}"
    what = ("length", "area", "volume")[dimension - 1]
    size = f"{with_error(data.volume, data.volume_error)} {data.unit}"
    if data.empty == "proved":
        yield f"{what}: 0 {data.unit}: nothing is reached, proved"
    elif data.empty:
        yield f"{what}: 0 {data.unit}: nothing is reached on {data.resolution} cells along each coordinate"
    elif _whole(record, data):
        yield f"{what}: {data.volume:.10g} {data.unit}, all of the box: {_unlimited(data)}"
    else:
        yield f"{what}: {size} (error: difference to half the resolution)"
    yield ""
    yield from _sections(record, data)
    yield from _singular(record, data)
    if data.parasitic:
        yield ""
        yield from _shown_parasitic(record, data.parasitic)
    if written is not None:
        yield f"written: {written}"


def _whole(record: Mechanism, data: WorkspaceAnswer) -> bool:
    """Whether the region is the box, as far as its grid can tell."""
    units = [coordinate_unit(record, name) for name in data.coordinates]
    box = math.prod((high - low) * unit for (low, high), unit in zip(data.box, units, strict=True))
    return bool(data.volume_error <= SAME * box and abs(data.volume - box) <= SAME * box)


def _unlimited(data: WorkspaceAnswer) -> str:
    """What limits a region that fills its box."""
    if not data.limits_stated:
        return "no stroke limits it; --stroke LOW:HIGH does"
    return "no limit was seen in it; a larger --box may show one"


def area_title(record: Mechanism, names: Sequence[str]) -> str:
    """What stands over areas of surfaces in the space of some coordinates, with its unit.

    Where lengths and angles mix, a surface has no one unit: its area is that with a length and a radian drawn alike.

    >>> from assur.model.registry import load_record
    >>> record = load_record("three_rps")
    >>> area_title(record, ("x", "y", "z")), area_title(record, ("z", "theta", "psi"))
    ('area [mm^2]', 'area [1 mm as 1 rad]')
    """
    lengths, dimension = [not is_angle(name) for name in names], len(names) - 1
    if any(lengths) and not all(lengths):
        return f"area [1 {record.unit} as 1 rad]"
    unit = power(record.unit if all(lengths) else "rad", dimension)
    return f"area [{unit}]" if unit else "area"


def _sections(record: Mechanism, data: WorkspaceAnswer) -> Iterable[RenderableType]:
    if not data.sections:
        return
    *others, last = data.coordinates
    angles = sum(map(is_angle, others))
    powers = ((record.unit, len(others) - angles), ("rad", angles))
    unit = " ".join(power(name, exponent) for name, exponent in powers if exponent)
    yield table(
        (f"section at {last}", f"area [{unit}]" if unit else "area"),
        [(f"{item.at[last]:g}", with_error(item.area, item.area_error)) for item in data.sections],
    )
    yield ""


def _singular(record: Mechanism, data: WorkspaceAnswer) -> Iterable[RenderableType]:
    singular = data.parallel_singular
    unseen = "nothing is reached" if data.empty else "none found"
    none = {name: "none, proved" if name in data.nowhere else unseen for name in singular.factors}
    rows = [
        (
            name,
            "the whole mode" if item.everywhere else short(item.area) if item.faces else none[name],
            item.meaning,
        )
        for name, item in singular.factors.items()
    ]
    yield heading("parallel singularities inside")
    yield table(("factor", area_title(record, data.coordinates), "zero where"), rows, left=("factor", "zero where"))
    if "none found" in {row[1] for row in rows}:
        yield f"none found: on {data.resolution} cells along each coordinate, which is no proof"
    share, near = singular.share, f"{singular.near:g} {record.unit}"
    if any(map(is_angle, data.coordinates)):
        return  # no distance where angles vary
    if share is None:
        yield f"share within {near} of one: not known"
    else:
        yield f"share within {near} of one: {100 * share:.2f} %; the border of the workspace is not counted"


def _parasitic(record: Mechanism, region: Workspace) -> dict[str, LargestCoordinate]:
    """Coordinate -> its largest value in size over a workspace and where; angles in the mechanism's angle unit."""
    return {
        name: LargestCoordinate(item.value / coordinate_unit(record, name), coordinates_at_border(record, item.at))
        for name, item in largest_parasitic(record, region).items()
    }


def _shown_parasitic(record: Mechanism, data: Mapping[str, LargestCoordinate]) -> Iterable[RenderableType]:
    """The same for a person."""
    yield heading("largest parasitic motion, of the coordinates that the pose leaves out")
    rows = [
        (
            name,
            f"{short(item.value)} {unit_of(record, name)}",
            value_words(record, item.at, digits=5),
        )
        for name, item in data.items()
    ]
    yield table(("coordinate", "value", "at"), rows, left=("coordinate", "at"))
