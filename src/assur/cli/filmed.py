"""What `assur motion` writes, and what it says of it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import cast

from rich.console import RenderableType

from assur.cli.numbers import numbers
from assur.cli.options import Outcome, Shared
from assur.cli.output import heading
from assur.cli.progress import progress
from assur.figures.motion import Form
from assur.kinematics.answers.style import style_of
from assur.mechanism import Mechanism
from assur.results.answers.files import WrittenMotion


def outcome(
    record: Mechanism, path: Path, to: Sequence[str], *, frames: int, seconds: float, size: int, shared: Shared
) -> Outcome:
    """The film, written."""
    from assur.figures.motion import encoded_film, film
    from assur.kinematics.answers.at_border import inputs_at_border, pose_at_border, pose_from_border
    from assur.kinematics.border import inputs_of
    from assur.results.answers.files import WrittenMotion
    from assur.results.files import write_whole

    names = record.platform.pose
    goal = pose_from_border(record, numbers(to, names, f"--to, pose of {record.name}")) if to else None
    form = cast("Form", path.suffix.lower()[1:])
    with progress("motion", shared) as step:
        found = film(record, frames, size, to=goal, progress=step)
        write_whole(path, encoded_film(found.pictures, form, seconds))
    width, height = (side - side % (2 if form == "mp4" else 1) for side in found.pictures.shape[2:0:-1])
    answer = WrittenMotion(
        mechanism=record.name,
        file=str(path),
        bytes=path.stat().st_size,
        format=form,
        frames=len(found.pictures),
        seconds=seconds,
        pixels=(width, height),
        coordinates=names,
        poses=pose_at_border(record, found.poses).tolist(),
        inputs=inputs_at_border(record, inputs_of(record, found.values)).tolist(),
    )
    return Outcome(answer, lambda: _shown(record, answer))


def _shown(record: Mechanism, data: WrittenMotion) -> Iterable[RenderableType]:
    style = style_of(record)
    width, height = data.pixels
    yield heading(f"{record.name}, motion")
    for name, values in zip(data.coordinates, zip(*data.poses, strict=True), strict=True):
        low, high = (style.coordinate(name, end) for end in (min(values), max(values)))
        yield f"{name}: {low} to {high} {style.coordinate_unit(name)}".rstrip()
    yield f"{data.frames} frames of {width} x {height} pixels, {data.seconds:g} s a turn"
    yield f"written: {data.file} ({data.bytes / 1e3:.0f} kB)"
