"""What `assur workspace` proves: bounds of volumes and areas, boxes, and the largest shape about a point."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from rich.console import RenderableType

from assur.cli import exit_codes
from assur.cli.numbers import assignments, interval, number, whole_number
from assur.cli.options import Outcome, Shared
from assur.cli.output import heading, table
from assur.cli.progress import progress
from assur.cli.quantities import interval_words, mode_words, value_words
from assur.cli.region_question import Question
from assur.errors import UnknownNameError, UsageError
from assur.kinematics.answers.at_border import box_at_border, coordinate_unit, coordinates_at_border
from assur.kinematics.limits import NO_LIMITS, joint_limits, limits_stated
from assur.mechanism import Mechanism
from assur.numerics.intervals.functions import from_degrees
from assur.results.answers.region import (
    CertifiedBox,
    CertifiedShape,
    CertifiedVolume,
    FailingPose,
    PavedBoxes,
    ProvedParts,
    RegionProof,
    SectionBounds,
)
from assur.results.outward import outward
from assur.workspace.certified.largest import LargestShape, largest
from assur.workspace.certified.paving import MOST
from assur.workspace.certified.proving import ProvedBox, largest_of, prove_box
from assur.workspace.certified.questions import Witness
from assur.workspace.certified.region import CertifiedWorkspace, certified_workspace
from assur.workspace.certified.shapes import ShapeName
from assur.workspace.slices import coordinates, slice_at


@dataclass(frozen=True)
class ProofQuestion:
    """The words that only proofs take, as typed."""

    gap: str | None
    finest: str | None
    boxes: str | None
    prove: str | None
    largest: ShapeName | None
    around: str | None
    ratio: str | None


def outcome(record: Mechanism, question: Question, asked: ProofQuestion, shared: Shared) -> Outcome:
    """The proof that is wanted, as data and for a person."""
    _compatible(asked)
    if asked.prove is not None:
        return _box(record, question, asked.prove, _most(asked), shared)
    if asked.largest is not None:
        return _largest(record, question, asked, asked.largest, shared)
    return _volume(record, question, asked, shared)


def _compatible(asked: ProofQuestion) -> None:
    if asked.prove is not None and asked.largest is not None:
        raise UsageError("--prove and --largest are two questions", hint="ask one after the other")
    if asked.largest is not None and asked.around is None:
        raise UsageError("--largest: about which point?", hint="add --around x=0,y=0,z=400")
    for name, value in (("--around", asked.around), ("--ratio", asked.ratio)):
        if value is not None and asked.largest is None:
            raise UsageError(f"{name} belongs to --largest", hint="for example --largest cube --around x=0,y=0,z=400")
    if asked.ratio is not None and asked.largest != "cylinder":
        raise UsageError(f"--ratio is of a cylinder, not of a {asked.largest}", hint="leave it out")
    if asked.largest is not None and asked.boxes is not None:
        raise UsageError("--boxes belongs to --certify and --prove", hint="leave it out")
    other = asked.prove is not None or asked.largest is not None
    if other and (asked.gap is not None or asked.finest is not None):
        raise UsageError("--gap and --finest belong to --certify", hint="leave them out")
    if asked.gap is not None and asked.finest is not None:
        raise UsageError("--gap and --finest: give one of them", hint="--finest is in the mechanism's length unit")


def _most(asked: ProofQuestion) -> int:
    """Boxes that may be looked at."""
    most = MOST if asked.boxes is None else whole_number(asked.boxes, "--boxes")
    if most < 1:
        raise UsageError(f"--boxes: {most} is not positive", hint=f"{MOST} if it is left out")
    return most


def _volume(record: Mechanism, question: Question, asked: ProofQuestion, shared: Shared) -> Outcome:
    gap = 1e-3 if asked.gap is None else number(asked.gap, "--gap")
    finest = None if asked.finest is None else number(asked.finest, "--finest")
    if gap <= 0:
        raise UsageError(f"--gap: {gap:g} is not positive", hint="1e-3 means bounds that differ by a thousandth")
    if finest is not None and finest <= 0:
        raise UsageError(f"--finest: {finest:g} is not a positive length")
    sections, most = question.sections, _most(asked)
    with progress("certified workspace", shared) as step:
        found = certified_workspace(
            *(record, question.mode, question.box, question.strokes, question.held, gap, sections, finest, step),
            most=most,
        )
    data = _certified_volume(record, question, found)
    return Outcome(data, lambda: _shown_volume(record, found, data))


def _shown_volume(record: Mechanism, region: CertifiedWorkspace, data: CertifiedVolume) -> Iterable[RenderableType]:
    box = f"box: {interval_words(record, zip(data.coordinates, data.box, strict=True))}"
    yield from _head(record, f"certified workspace of {mode_words(record, region.mode)}", box, data)
    what = ("length", "area", "volume")[len(region.box.names) - 1]
    low, high = outward(*region.volume)
    yield f"{what}: {low} .. {high} {region.unit}"
    gap = "" if region.gap_reached is None else f", gap {region.gap_reached:.2g}"
    yield f"how: {region.how}{gap}"
    boxes = data.boxes
    along = ", ".join(boxes.coordinates)
    yield f"boxes over {along}: {boxes.inside} inside, {boxes.outside} outside, {boxes.boundary} boundary"
    if region.note:
        yield f"note: {region.note}"
    if region.sections:
        last = region.sections[0].coordinate
        yield ""
        yield table(
            (f"section at {last}", f"least [{region.sections[0].unit}]", f"most [{region.sections[0].unit}]"),
            [(f"{item.at[last]:g}", *outward(*item.area)) for item in data.sections],
        )
        for item in data.sections:
            if item.stopped:
                yield f"note: section at {item.at[last]:g}: {item.stopped}"


def _box(record: Mechanism, question: Question, text: str, most: int, shared: Shared) -> Outcome:
    example = f"{record.platform.pose[0]}=-20:20"
    box = dict(question.box)
    for name, pair in assignments([text], "--prove", example).items():
        low, high = interval(pair, f"--prove {name}", example)
        _known(record, question, "--prove", name)
        if name in question.box:
            raise UsageError(f"--prove: {name} is given by --box too", hint="--box is for coordinates left out of it")
        box[name] = (low * coordinate_unit(record, name), high * coordinate_unit(record, name))
    box = outer_box(record, box, question.held)
    with progress("proof", shared) as step:
        found = prove_box(record, box, question.mode, question.strokes, held=question.held, progress=step, most=most)
    data = _certified_box(record, question, found)
    code = exit_codes.of_answers([{"proved": "yes", "refuted": "no", "undecided": "open"}[found.status]])
    return Outcome(data, lambda: _shown_box(record, found, data), exit_code=code)


def outer_box(
    record: Mechanism, box: Mapping[str, tuple[float, float]], held: Mapping[str, float] | None = None
) -> dict[str, tuple[float, float]]:
    """A box in lengths and rad that holds the one in degrees from which its angles, or the file's, were converted.

    >>> from assur.mechanism import load
    >>> low, high = outer_box(load("planar_3rpr"), {"phi": (0.0, math.radians(180.0))})["phi"]
    >>> low, math.pi < 3.1415926535897936 <= high
    (0.0, True)
    """
    found = {**{name: record.box[name] for name in slice_at(record, held).free if name in record.box}, **box}
    for name, ends in found.items():
        if coordinate_unit(record, name) != 1.0:
            wide = from_degrees(ends)
            found[name] = (float(wide.low[0]), float(wide.high[1]))
    return found


def _shown_box(record: Mechanism, box: ProvedBox, data: CertifiedBox) -> Iterable[RenderableType]:
    words = f"box: {interval_words(record, zip(data.coordinates, data.box, strict=True))}"
    yield from _head(record, f"a box in {mode_words(record, box.mode)}", words, data)
    yield f"question: is every pose {_reached(data)}, and none singular?"
    yield f"answer: {box.status}"
    if box.status != "proved":
        yield f"proved for {_floored(100 * box.share)} % of it"
    if data.witness is not None:
        yield f"fails at: {value_words(record, data.witness.pose)}"
        yield f"because: {data.witness.why}"
    boxes = data.boxes
    if boxes.failed or boxes.doubtful:
        yield f"parts: {boxes.proved} proved, {boxes.failed} not reached at all, {boxes.doubtful} undecided"
        yield ""
        rows = [("not reached", item) for item in boxes.largest_failed[:5]]
        rows += [("undecided", item) for item in boxes.largest_doubtful[:5]]
        yield table(
            ("the largest parts", *boxes.coordinates),
            [(word, *(f"{low:.5g} .. {high:.5g}" for low, high in item)) for word, item in rows],
            left=("the largest parts",),
        )
    if box.stopped:
        yield f"note: {ENDED[box.stopped]}; what was not looked at counts as undecided"


def _largest(record: Mechanism, question: Question, asked: ProofQuestion, shape: ShapeName, shared: Shared) -> Outcome:
    example = "x=0,y=0,z=400"
    centre = {}
    for name, text in assignments([asked.around or ""], "--around", example).items():
        _known(record, question, "--around", name)
        centre[name] = number(text, f"--around {name}") * coordinate_unit(record, name)
    ratio = 1.0 if asked.ratio is None else number(asked.ratio, "--ratio")
    with progress(f"largest {shape}", shared) as step:
        found = largest(
            record, shape, centre, ratio, question.mode, question.strokes, held=question.held, progress=step
        )
    data = _certified_shape(record, question, found)
    code = exit_codes.of_answers(["yes" if found.size > 0 else "no" if found.witness is not None else "open"])
    return Outcome(data, lambda: _shown_largest(record, found, data), exit_code=code)


def _shown_largest(record: Mechanism, shape: LargestShape, data: CertifiedShape) -> Iterable[RenderableType]:
    name = shape.shape.name
    centre = f"around: {value_words(record, data.centre)}"
    yield from _head(record, f"the largest {name} in {mode_words(record, shape.mode)}", centre, data)
    yield f"inside: every pose is {_reached(data)}, and none is singular"
    side = "edge" if name == "cube" else "diameter"
    more = "" if shape.height is None else f", height {_floored(shape.height)} {record.unit}"
    yield f"proved up to: {side} {_floored(shape.size)} {record.unit}{more}"
    if data.witness is not None:
        yield f"not beyond: {side} {outward(shape.size, shape.refuted)[1]} {record.unit}"
        yield f"fails at: {value_words(record, data.witness.pose)}"
        yield f"because: {data.witness.why}"
    if shape.stopped:
        yield f"note: {NOTES[shape.stopped]}"


def _floored(size: float) -> str:
    """A proved size as text that is not above it.

    >>> _floored(73.82812500007303)
    '73.828125'
    """
    return outward(size, size * (1 + 1e-6))[0]


ENDED = {
    "interrupted": "interrupted",
    "rounding": "floats cannot halve the open parts any further",
    "too many boxes": "as many boxes were looked at as may be; --boxes raises that",
}
NOTES = {
    "interrupted": "interrupted: this is the size reached",
    "undecided": "between the two sizes nothing could be decided",
    "no limit": "nothing fails within the farthest size looked at",
}


def _known(record: Mechanism, question: Question, option: str, name: str) -> None:
    if name in (question.held or ()):
        raise UsageError(f"{option}: {name} is held", hint=f"leave {name} out of --at or of {option}")
    if name not in coordinates(record):
        raise UnknownNameError(f"pose coordinate of {record.name}", name, coordinates(record))


def _said(record: Mechanism, question: Question, proved: CertifiedWorkspace | ProvedBox | LargestShape) -> RegionProof:
    """What is said of every proof."""
    return RegionProof(
        mechanism=record.name,
        mode=proved.mode,
        held=coordinates_at_border(record, proved.held),
        stopped=proved.stopped,
        limits_stated=limits_stated(record, question.strokes),
        joint_limits=tuple(joint_limits(record)),
    )


def _certified_volume(record: Mechanism, question: Question, region: CertifiedWorkspace) -> CertifiedVolume:
    names, paving = region.box.names, region.paving
    unit = coordinate_unit(record, names[-1])
    return CertifiedVolume(
        **vars(_said(record, question, region)),
        volume=region.volume,
        unit=region.unit,
        how=region.how,
        gap=region.gap,
        gap_reached=region.gap_reached,
        coordinates=names,
        box=box_at_border(record, names, region.box.intervals),
        sections=tuple(
            SectionBounds(item.area, item.unit, item.stopped, {item.coordinate: item.value / unit})
            for item in region.sections
        ),
        boxes=PavedBoxes(paving.names, len(paving.inside), len(paving.outside), len(paving.boundary)),
        note=region.note,
    )


def _certified_box(record: Mechanism, question: Question, proved: ProvedBox) -> CertifiedBox:
    failed, doubtful = (
        tuple(box_at_border(record, proved.names, box) for box in largest_of(boxes))
        for boxes in (proved.failed, proved.doubtful)
    )

    return CertifiedBox(
        **vars(_said(record, question, proved)),
        what=proved.what,
        status=proved.status,
        coordinates=proved.box.names,
        box=box_at_border(record, proved.box.names, proved.box.intervals),
        share_proved=proved.share,
        witness=_witness(record, proved.witness),
        boxes=ProvedParts(
            *(proved.names, len(proved.proved), len(proved.failed), len(proved.doubtful)),
            largest_failed=failed,
            largest_doubtful=doubtful,
        ),
    )


def _certified_shape(record: Mechanism, question: Question, shape: LargestShape) -> CertifiedShape:
    return CertifiedShape(
        **vars(_said(record, question, shape)),
        what=shape.what,
        shape=shape.shape.name,
        centre=coordinates_at_border(record, dict(zip(shape.shape.names, shape.shape.centre, strict=True))),
        size=shape.size,
        height=shape.height,
        refuted=shape.refuted if math.isfinite(shape.refuted) else None,
        witness=_witness(record, shape.witness),
    )


def _witness(record: Mechanism, witness: Witness | None) -> FailingPose | None:
    return None if witness is None else FailingPose(coordinates_at_border(record, witness.pose), witness.why)


def _head(record: Mechanism, title: str, where: str, data: RegionProof) -> Iterable[RenderableType]:
    """What every proof begins with, and what is to be said beside a claim of reach where there are no limits."""
    yield heading(f"{record.name}, {title}")
    yield where
    if data.held:
        yield f"held: {value_words(record, data.held)}"
    if not data.limits_stated:
        yield f"limits: {NO_LIMITS}"
    if data.joint_limits:
        yield f"limits of the file: {', '.join(data.joint_limits)}"


def _reached(data: RegionProof) -> str:
    return "reached within limits" if data.limits_stated else "reached"
