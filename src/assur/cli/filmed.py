"""What `assur motion` writes, and what it says of it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from assur.cli.numbers import numbers
from assur.cli.options import Outcome, Shared
from assur.cli.output import heading
from assur.cli.progress import progress
from assur.cli.quantities import style_of

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from rich.console import RenderableType

    from assur.figures.motion import Form
    from assur.mechanism import Mechanism


def outcome(
    record: Mechanism, path: Path, to: Sequence[str], *, frames: int, seconds: float, size: int, shared: Shared
) -> Outcome:
    """The film, written."""
    from assur.figures.motion import encoded_film, film
    from assur.kinematics.answers.at_border import inputs_at_border, pose_at_border, pose_from_border
    from assur.kinematics.border import inputs_of
    from assur.results.files import write_whole
    from assur.results.json_text import plain

    names = record.platform.pose
    goal = pose_from_border(record, numbers(to, names, f"--to, pose of {record.name}")) if to else None
    form = cast("Form", path.suffix.lower()[1:])
    with progress("motion", shared) as step:
        found = film(record, frames, size, to=goal, progress=step)
        write_whole(path, encoded_film(found.pictures, form, seconds))
    data = {
        "mechanism": record.name,
        "file": str(path),
        "bytes": path.stat().st_size,
        "format": form,
        "frames": len(found.pictures),
        "seconds": seconds,
        "pixels": [side - side % (2 if form == "mp4" else 1) for side in found.pictures.shape[2:0:-1]],
        "coordinates": list(names),
        "poses": plain(pose_at_border(record, found.poses)),
        "inputs": plain(inputs_at_border(record, inputs_of(record, found.values))),
    }
    return Outcome(data, lambda: _shown(record, data, pose_at_border(record, found.poses)))


def _shown(record: Mechanism, data: dict[str, Any], poses: NDArray[Any]) -> Iterable[RenderableType]:
    style = style_of(record)
    width, height = data["pixels"]
    yield heading(f"{record.name}, motion")
    for k, name in enumerate(data["coordinates"]):
        low, high = (style.coordinate(name, float(value)) for value in (poses[:, k].min(), poses[:, k].max()))
        yield f"{name}: {low} to {high} {style.coordinate_unit(name)}".rstrip()
    yield f"{data['frames']} frames of {width} x {height} pixels, {data['seconds']:g} s a turn"
    yield f"written: {data['file']} ({data['bytes'] / 1e3:.0f} kB)"
