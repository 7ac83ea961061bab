"""What `assur aspects` is asked, and how its answer reads."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from rich.console import RenderableType

from assur.cli import exit_codes, region_question
from assur.cli.interruption import pressed
from assur.cli.numbers import assignments, number, numbers
from assur.cli.options import Outcome, RegionOptions, Shared
from assur.cli.output import heading, table
from assur.cli.paths import output_file
from assur.cli.progress import progress
from assur.cli.quantities import interval_words, unit_of, value_words
from assur.errors import UsageError
from assur.kinematics.answers.at_border import box_at_border, coordinate_unit, coordinates_at_border
from assur.kinematics.limits import limits_note
from assur.kinematics.modes import all_modes
from assur.mechanism import Mechanism
from assur.results.answers.answer import ABSENT
from assur.results.answers.region import (
    AspectsAnswer,
    AspectsOfMode,
    AspectsOfModes,
    ListedAspect,
    ListedPath,
    PathCheck,
    PlacedPose,
)
from assur.results.outward import outward as bounds
from assur.workspace.aspects.aspects import Aspects, aspects
from assur.workspace.aspects.checking import check_path
from assur.workspace.aspects.path import AspectPath
from assur.workspace.aspects.places import Place

ANSWERS = {"inside": "yes", "connected": "yes", "undecided": "open"}
"""What a pose or a path says of its question; where two poses lie apart, or one is not reached, it is "no"."""

PICTURES = (".svg", ".png", ".pdf")

LISTED = 20
"""Aspects that a person sees, the largest first; --json has all."""

VERTICES = 12
"""Vertices of a path that a person sees."""


@dataclass(frozen=True)
class AspectQuestion:
    """The words, as typed."""

    mode: str | None
    where: RegionOptions
    finest: str | None
    start: str | None
    end: str | None
    output: str | None


@dataclass(frozen=True, eq=False)
class Explored:
    """The aspects of each mode, and of one mode the path or the place asked for."""

    modes: tuple[Aspects, ...]
    path: AspectPath | None = None
    check: PathCheck | None = None
    place: Place | None = None


def outcome(record: Mechanism, asked: AspectQuestion, shared: Shared) -> Outcome:
    """The aspects, as data and for a person; drawn or written where a file is named."""
    written = _target(asked)
    answer = _answer(record, asked, shared)
    data = _said(record, answer)
    if written is not None:
        _write(written, record, answer, data)
    return Outcome(data, lambda: _shown(record, answer, data, written), exit_code=_exit_code(answer))


def _target(asked: AspectQuestion) -> Path | None:
    if asked.end is not None and asked.start is None:
        raise UsageError("--to: from where?", hint="add --from")
    if asked.mode == "all" and asked.start is not None:
        raise UsageError("--from is about one working mode", hint="name it in place of all")
    if asked.output is None:
        return None
    path = output_file(asked.output, (*PICTURES, ".json"))
    if asked.mode == "all" and path.suffix.lower() in PICTURES:
        raise UsageError("a picture shows one working mode", hint="name it in place of all, or write a .json file")
    return path


def _answer(record: Mechanism, asked: AspectQuestion, shared: Shared) -> Explored:
    mode = None if asked.mode == "all" else asked.mode
    words = region_question.question(record, mode, asked.where)
    finest = None if asked.finest is None else number(asked.finest, "--finest")
    modes = all_modes(record, "inverse") if asked.mode == "all" else (words.mode,)
    found = []
    for name in modes:
        with progress(f"aspects {name}".strip(), shared) as step:
            found.append(aspects(record, name, words.box, words.strokes, words.held, finest, step))
        if pressed():
            return Explored(tuple(found))
    if asked.start is None:
        return Explored(tuple(found))
    first = found[0]
    start = pose(record, asked.start, "--from", first.box.names)
    if asked.end is None:
        return Explored(tuple(found), place=first.of(start))
    path = first.path(start, pose(record, asked.end, "--to", first.box.names))
    check = check_path(record, first, path) if path.status == "connected" else None
    return Explored(tuple(found), path, check)


def pose(record: Mechanism, text: str, option: str, names: Sequence[str]) -> list[float]:
    """The pose that is meant, in lengths and rad: values in the order of the names, or NAME=VALUE."""
    parts = text.split(",")
    if "=" in text:
        given = assignments(parts, option, ",".join(f"{name}=0" for name in names))
        wrong = set(given) ^ set(names)
        if wrong:
            raise UsageError(f"{option}: {', '.join(given)} given, {', '.join(names)} wanted")
        parts = [given[name] for name in names]
    values = numbers(parts, names, option)
    return [value * coordinate_unit(record, name) for name, value in zip(names, values, strict=True)]


def _exit_code(answer: Explored) -> int:
    if answer.place is not None:
        return exit_codes.of_answers([ANSWERS.get(answer.place.status, "no")])
    if answer.path is None:
        return 0
    if answer.check is not None and not answer.check.passed:
        return exit_codes.FAILS
    return exit_codes.of_answers([ANSWERS.get(answer.path.status, "no")])


def _said(record: Mechanism, explored: Explored) -> AspectsAnswer | AspectsOfModes:
    if len(explored.modes) > 1:
        return AspectsOfModes(record.name, tuple(_of_mode(record, item) for item in explored.modes))
    path, place = explored.path, explored.place
    return AspectsAnswer(
        **vars(_of_mode(record, explored.modes[0])),
        path=ABSENT if path is None else _listed_path(record, path, explored.check),
        place=ABSENT if place is None else PlacedPose(place.status, place.aspect, place.signs, place.why),
    )


def _of_mode(record: Mechanism, parts: Aspects) -> AspectsOfMode:
    """What is said of a mode, angles of poses in the mechanism's angle unit."""
    aspects = (
        ListedAspect(item.label, item.signs, item.volume, len(item.boxes), item.perhaps) for item in parts.aspects
    )
    return AspectsOfMode(
        mechanism=parts.mechanism,
        mode=parts.mode,
        how=parts.how,
        coordinates=parts.box.names,
        box=box_at_border(record, parts.box.names, parts.box.intervals),
        held=coordinates_at_border(record, parts.slice.held),
        unit=parts.unit,
        naming=tuple(parts.naming),
        aspects=tuple(aspects),
        told_apart=parts.told_apart,
        paved=parts.names,
        turning=tuple(parts.turning),
        finest=coordinates_at_border(record, parts.finest),
        undecided=len(parts.search.undecided),
        stopped=parts.stopped,
        note=parts.note,
    )


def _listed_path(record: Mechanism, path: AspectPath, check: PathCheck | None) -> ListedPath:
    units = [coordinate_unit(record, name) for name in path.coordinates]
    ends = zip(path.boxes.low.T.tolist(), path.boxes.high.T.tolist(), strict=True)
    return ListedPath(
        path.status,
        path.why,
        (path.start.aspect, path.end.aspect),
        path.coordinates,
        tuple([value / unit for value, unit in zip(row, units, strict=True)] for row in path.points.tolist()),
        path.names,
        tuple(box_at_border(record, path.names, list(zip(low, high, strict=True))) for low, high in ends),
        check,
    )


def _write(path: Path, record: Mechanism, answer: Explored, data: AspectsAnswer | AspectsOfModes) -> None:
    from assur.results.files import write_whole
    from assur.results.json_text import json_text

    ending = path.suffix.lower()
    if ending == ".json":
        write_whole(path, json_text(data) + "\n")
        return
    from assur.figures.aspects import drawn
    from assur.figures.context import Context
    from assur.figures.encode import encoded
    from assur.figures.style import styled

    connected = answer.path if answer.path is not None and answer.path.status == "connected" else None
    with styled():
        figure = drawn(Context(record), answer.modes[0], connected).figure
    write_whole(path, encoded(figure, ending[1:]))


def _shown(
    record: Mechanism, answer: Explored, data: AspectsAnswer | AspectsOfModes, written: Path | None
) -> Iterable[RenderableType]:
    if isinstance(data, AspectsAnswer):
        yield from _mode(record, answer.modes[0], data)
        if data.place is not ABSENT:
            place = data.place
            yield ""
            yield f"the pose lies in aspect {place.aspect}" if place.status == "inside" else f"the pose: {place.why}"
        if data.path is not ABSENT:
            yield ""
            yield from _way(record, data.path)
    else:
        yield from _modes(record, answer.modes)
    if written is not None:
        yield f"written: {written}"


def _modes(record: Mechanism, modes: Sequence[Aspects]) -> Iterable[RenderableType]:
    yield heading(f"{record.name}, aspects of every working mode")
    rows = []
    for item in modes:
        labels = ", ".join(part.label for part in item.aspects[:8]) + (", .." if len(item) > 8 else "")
        rows.append(
            (item.mode or "-", str(len(item)), labels or ("none so far" if item.stopped else "none"), item.note)
        )
    yield table(("mode", "aspects", "labels", "note"), rows, left=("labels", "note"))
    yield f"labels: signs of {', '.join(modes[0].naming)}"


def _mode(record: Mechanism, aspects: Aspects, data: AspectsAnswer) -> Iterable[RenderableType]:
    of_mode = f" of working mode {aspects.mode}" if aspects.mode else ""
    yield heading(f"{record.name}, aspects{of_mode}: {len(aspects)}")
    yield f"box: {interval_words(record, zip(data.coordinates, data.box, strict=True))}"
    if data.held:
        yield f"held: {value_words(record, data.held)}"
    if limits := limits_note(record, aspects.strokes):
        yield f"limits: {limits}"
    if not len(aspects):
        yield _none(aspects)
    else:
        rows = [
            (item.label, *bounds(*item.volume), str(len(item.boxes)), ", ".join(item.perhaps) or "-")
            for item in aspects.aspects[:LISTED]
        ]
        titles = ("aspect", f"least [{aspects.unit}]", f"most [{aspects.unit}]", "boxes", "not told apart from")
        yield table(titles, rows, left=("aspect", "not told apart from"))
        if len(aspects) > LISTED:
            yield f"and {len(aspects) - LISTED} smaller ones"
        yield f"aspect: signs of {', '.join(aspects.naming)}"
    yield f"how: {aspects.how}, over {', '.join(aspects.names)}; {data.undecided} boxes are undecided"
    if aspects.note:
        yield f"note: {aspects.note}"


def _none(aspects: Aspects) -> str:
    """What is said where there is no aspect; a search that was stopped has not looked everywhere."""
    if aspects.stopped:
        return "none so far: the box was not looked at to the end"
    return "none: no box of this size is proved to be reached and free of singularities"


def _way(record: Mechanism, path: ListedPath) -> Iterable[RenderableType]:
    word = {"connected": "one aspect", "separated": "two aspects", "undecided": "undecided", "outside": "no"}
    label = f", {path.aspects[0]}" if path.status == "connected" else ""
    yield heading(f"from one pose to the other: {word[path.status]}{label}")
    if path.why:
        yield path.why
    if path.status != "connected":
        return
    points = path.points
    step = max(1, -(-(len(points) - 1) // (VERTICES - 1)))
    shown = [*range(0, len(points) - 1, step), len(points) - 1]
    titles = [f"{name} [{unit_of(record, name)}]" for name in path.coordinates]
    yield table(("vertex", *titles), [(str(k + 1), *(f"{value:.7g}" for value in points[k])) for k in shown])
    yield f"certificate: each of the {len(path.boxes)} pieces lies in a box that is proved"
    if (check := path.check) is not None:
        moved = {True: "; followed on the joint graph", False: f"; not followed: {check.stopped}", None: ""}
        holds = "reached, with the same signs, " if check.reached and check.kept else "NOT so "
        yield f"check: {holds}at {check.samples} poses by the closed form{moved[check.followed]}"
