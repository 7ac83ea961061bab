"""`assur collisions`: which links come how near to one another, over poses of the workspace or along a motion."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Parameter

from assur.cli.options import DRAWN_DEFAULTS, Drawn, MechanismName, Outcome, WorkingMode
from assur.results.answers.answer import ABSENT

if TYPE_CHECKING:
    from pathlib import Path

    from rich.console import RenderableType

    from assur.mechanism import Mechanism
    from assur.results.answers.region import CollisionsAnswer, NearestLinks
    from assur.scene.collisions import Collisions, Nearest

MEET = 1
ENDINGS = (".png", ".pdf", ".svg")
SHOWN = 10
"""Pairs that a person sees; --json has all."""

WHERE = {
    "box": "poses of the workspace",
    "home": "assemblies near home",
    "motion": "poses along a closed motion from home",
}
"""What the configurations are, by what they were drawn from."""


def collisions(
    mechanism: MechanismName,
    /,
    *,
    over: Annotated[
        Literal["workspace", "motion"],
        Parameter(
            help="Poses drawn from the workspace (if left out; without a closed form, assemblies near home), or the "
            "closed motion that --format glb shows."
        ),
    ] = "workspace",
    samples: Annotated[str, Parameter(metavar="COUNT", help="How many poses; 200 if left out.")] = "200",
    seed: Annotated[str, Parameter(metavar="NUMBER", help="Of the random poses; 0 if left out.")] = "0",
    mode: WorkingMode = None,
    output: Annotated[
        str | None,
        Parameter(name=("-o", "--output"), metavar="FILE", help="Draw the closest pair there: .png, .pdf or .svg."),
    ] = None,
    shared: Drawn = DRAWN_DEFAULTS,
) -> Outcome:
    """How near links come to one another, and which of them meet.

    Asked are all pairs of links that share no joint, drawn as assur draws them:
    thicknesses are those of `assur export --format step`, not of a design, and
    --thickness says others. It is known at the poses asked, not between them.
    Exit code 1: links meet somewhere.

    For example:
        assur collisions zeng2019 -o closest.png
        assur collisions delta_4s --thickness 0.005
        assur collisions fivebar --over motion --json
    """
    record = shared.mechanism(mechanism)
    from assur.cli.numbers import whole_number
    from assur.cli.paths import output_file
    from assur.cli.progress import progress
    from assur.errors import UsageError
    from assur.scene.collisions import collisions
    from assur.scene.motion import closed_motion
    from assur.scene.sampled import sampled

    count, start = whole_number(samples, "--samples"), whole_number(seed, "--seed")
    if start < 0:
        raise UsageError(f"--seed {start}: a seed is not negative")
    if over == "motion" and mode is not None:
        raise UsageError("--mode names a mode of the workspace; a motion begins at home", hint="leave one of them out")
    path = None if output is None else output_file(output, ENDINGS)
    with progress("collisions", shared) as step:
        joints = sampled(record, count, mode, start) if over == "workspace" else closed_motion(record, count)[:-1]
        found = collisions(record, joints, step)
    data = _answer(record, found, over, mode or record.modes.default_working or None)
    if path is not None:
        data = replace(data, file=str(_written(record, found, path)))
    return Outcome(data, lambda: _shown(record, found, data), MEET if found.meeting else 0)


def _written(record: Mechanism, collisions: Collisions, path: Path) -> Path:
    """The picture of the closest pair."""
    from assur.errors import UsageError
    from assur.figures.clearance import drawn
    from assur.figures.encode import encoded
    from assur.figures.style import styled
    from assur.results.files import write_whole

    if not collisions.pairs:
        raise UsageError(f"{record.name}: every two links share a joint, so there is no pair to draw in {path}")
    with styled():
        figure = drawn(record, collisions.pairs[0]).figure
    return write_whole(path, encoded(figure, path.suffix.lower()[1:]))


def _answer(record: Mechanism, collisions: Collisions, over: str, mode: str | None) -> CollisionsAnswer:
    from assur.results.answers.region import CollisionsAnswer
    from assur.scene.companion import companion
    from assur.scene.sampled import from_box
    from assur.scene.sizes import thickness

    reasons = {frozenset(item.links): item.because for item in companion(record).meets}
    drawn = over if over == "motion" else "box" if from_box(record) else "home"
    return CollisionsAnswer(
        mechanism=record.name,
        unit=record.unit,
        over=over,
        drawn_from=drawn,
        mode=mode if drawn == "box" else None,
        poses=collisions.poses,
        known="sampled",
        thickness=thickness(record),
        coordinates=record.platform.pose,
        pairs=tuple(_pair(record, item, reasons.get(frozenset(item.links))) for item in collisions.pairs),
    )


def _pair(record: Mechanism, pair: Nearest, because: str | None) -> NearestLinks:
    from assur.kinematics.answers.at_border import pose_at_border
    from assur.kinematics.pose import pose_of
    from assur.results.answers.region import NearestLinks

    pose = pose_at_border(record, pose_of(record, pair.joints[None])[0]).tolist()
    reason = because if pair.meeting else None
    return NearestLinks(pair.links, pair.clearance, pair.parts, pair.meeting, reason, pose)


def _shown(record: Mechanism, collisions: Collisions, data: CollisionsAnswer) -> Iterable[RenderableType]:
    from assur.cli.output import heading, table
    from assur.kinematics.answers.style import style_of
    from assur.results.plain_text import count

    style, names = style_of(record), data.coordinates
    said = f"{count(len(collisions.meeting), 'pair')} of links meet" if collisions.meeting else "no links meet"
    yield heading(f"{record.name}, collisions: {said}")
    mode = f", mode {data.mode}" if data.mode else ""
    yield f"known at {collisions.poses} {WHERE[data.drawn_from]}{mode}; between them links may come nearer"
    yield f"flat bars are drawn {data.thickness:.3g} {record.unit} thick; --thickness says otherwise"
    if not data.pairs:
        yield "every two links share a joint: nothing to ask"
        return
    rows = [
        (
            " - ".join(item.links),
            f"meet at {item.meeting} of {collisions.poses}" if item.meeting else f"{item.clearance:.4g}",
            " - ".join(item.parts),
            style.point(names, item.pose),
        )
        for item in data.pairs[:SHOWN]
    ]
    yield ""
    columns = ("links", f"clearance ({record.unit})", "nearest parts", f"there, {style.point_title(names)}")
    styles = ["bold red" if item.meeting else "" for item in data.pairs[:SHOWN]]
    yield table(columns, rows, left=("links", "nearest parts"), wrap=("links", "nearest parts"), styles=styles)
    if len(data.pairs) > SHOWN:
        yield f"{len(data.pairs) - SHOWN} more pairs are farther apart: --json"
    for item in data.pairs:
        if item.because:
            yield f"{' - '.join(item.links)}: {item.because}"
    if data.file is not ABSENT:
        yield f"written: {data.file}"
