"""Index maps as data, as files and as a person reads them."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from rich.console import RenderableType

from assur.cli import region_question
from assur.cli.indexed import Length, length_words
from assur.cli.numbers import assignments, whole_number
from assur.cli.options import Outcome, Shared
from assur.cli.output import heading, table
from assur.cli.paths import output_file
from assur.cli.progress import progress
from assur.errors import UnknownNameError, UsageError
from assur.kinematics.answers.at_border import angle_at_border
from assur.kinematics.answers.style import style_of
from assur.kinematics.status import Status
from assur.mechanism import Mechanism
from assur.model.pose import LENGTHS
from assur.results.answers.indices import MapsAnswer
from assur.results.files import write_whole
from assur.results.json_text import json_text
from assur.results.plain_text import short
from assur.workspace.index_maps import IndexMaps, index_maps
from assur.workspace.region import Workspace, workspace
from assur.workspace.slices import MOST, coordinates, slice_at

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PICTURES = (".png", ".pdf", ".svg")
ENDINGS = (".npz", ".csv", ".json", *PICTURES)


def over_plane(
    record: Mechanism,
    plane: str,
    at: Sequence[str],
    asked: tuple[str | None, Sequence[str], Sequence[str], str],
    nodes: str,
    output: str | None,
    length: Length,
    shared: Shared,
) -> Outcome:
    """Every index over the coordinates of `plane`; `asked` is the mode, boxes, strokes and resolution."""
    names = plane_names(record, plane)
    count = whole_number(nodes, "--nodes")
    written = maps_file(output, names)
    region = region_of_plane(record, names, at, asked, shared)
    with progress("index maps", shared):
        maps = index_maps(record, region, names, nodes=count, characteristic_length=length)
    shown = maps.in_degrees() if record.angle == "deg" else maps
    answer = shown.answer()
    if written is not None:
        write_maps(written, shown, answer, lambda: _drawn(record, region, maps))
    return Outcome(answer, lambda: _shown(record, shown, written))


def region_of_plane(
    record: Mechanism,
    names: Sequence[str],
    at: Sequence[str],
    asked: tuple[str | None, Sequence[str], Sequence[str], str],
    shared: Shared,
) -> Workspace:
    """The workspace that maps over coordinates `names` go through."""
    mode, box, stroke, resolution = asked
    question = region_question.question(
        record, mode, box, stroke, resolution, (), None, [*at, *_rest(record, names, at)]
    )
    with progress("workspace", shared) as step:
        return workspace(
            record,
            question.mode,
            question.box,
            question.strokes,
            question.resolution,
            (),
            held=question.held,
            progress=step,
        )


def maps_file(output: str | None, names: Sequence[str]) -> Path | None:
    """Where maps are written, None where they are not; pictures are of two coordinates."""
    written = None if output is None else output_file(output, ENDINGS)
    if written is not None and written.suffix.lower() in PICTURES and len(names) != 2:
        raise UsageError(f"cannot draw {len(names)} coordinates in {written}", hint="give two to --map, as --map x,z")
    return written


def plane_names(record: Mechanism, plane: str) -> tuple[str, ...]:
    """The coordinates that --map names."""
    names = tuple(name.strip() for name in plane.split(","))
    for name in names:
        if name not in coordinates(record):
            raise UnknownNameError(f"pose coordinate of {record.name}", name, coordinates(record))
    if len(set(names)) < len(names):
        raise UsageError(f"--map: {plane} names a coordinate twice", hint="give different ones, as --map x,z")
    return names


def _rest(record: Mechanism, names: Sequence[str], at: Sequence[str]) -> list[str]:
    """The coordinates of which nothing was said, held where they are at home (angles of many) or in mid-box."""
    given = assignments(at, "--at", f"{record.platform.pose[-1]}=0")
    twice = [name for name in names if name in given]
    if twice:
        raise UsageError(f"--map: {twice[0]} varies, and --at holds it", hint="leave one of the two out")
    every = coordinates(record)
    home = slice_at(record).held if len(every) > MOST else {}
    texts = []
    for name in every:
        if name in names or name in given:
            continue
        if name not in home and name not in record.box:
            raise UsageError(f"--map: nothing says where {name} is held", hint=f"add --at {name}=0")
        value = home[name] if name in home else sum(record.box[name]) / 2
        texts.append(f"{name}={float(value if name in LENGTHS else angle_at_border(record, value))!r}")
    return texts


def write_maps(path: Path, shown: IndexMaps, answer: MapsAnswer, drawn: Callable[[], Figure]) -> None:
    """Write maps as the ending of the file says."""
    ending = path.suffix.lower()
    if ending in PICTURES:
        from assur.figures.encode import encoded
        from assur.figures.style import styled

        with styled():
            figure = drawn()
        write_whole(path, encoded(figure, ending[1:]))
    elif ending == ".npz":
        import numpy as np

        stream, arrays = io.BytesIO(), cast("Mapping[str, Any]", shown.arrays())
        np.savez_compressed(stream, **arrays)
        write_whole(path, stream.getvalue())
    else:
        write_whole(path, shown.csv() if ending == ".csv" else json_text(answer) + "\n")


def _drawn(record: Mechanism, region: Workspace, maps: IndexMaps) -> Figure:
    from assur.figures.context import Context
    from assur.figures.index_maps import drawn

    return drawn(Context(record, region), maps).figure


def map_tables(record: Mechanism, maps: IndexMaps, what: str) -> Iterable[RenderableType]:
    """Which maps of `what` these are, with means and extremes and where these are."""
    style, names = style_of(record), maps.coordinates
    of_mode = f" of working mode {maps.mode}" if maps.mode else ""
    yield heading(f"{maps.mechanism}, {what} maps{of_mode}")
    axes = ", ".join(f"{name} {nodes[0]:g} .. {nodes[-1]:g}" for name, nodes in maps.axes)
    held = "".join(f", {name} = {value:g}" for name, value in maps.held.items())
    inside = int(np.sum(maps.status != Status.unreachable))
    yield f"over {axes}{held}: {inside} of {maps.status.size} nodes in the workspace"
    yield ""
    rows, places = [], []
    for name, item in maps.maps.items():
        ends = [end for end in (item.least, item.most) if end is not None]
        unit = f"{name} [{item.unit}]" if item.unit else name
        rows.append((unit, *(short(value) for value in (item.mean, *(end.value for end in ends)))) if ends else
                    (unit, "none", "none", "none"))  # fmt: skip
        if ends:
            places.append((name, *(", ".join(f"{value:.6g}" for value in end.at) for end in ends)))
    yield table((what, "mean", "least", "most"), rows, left=(what,))
    if places:
        yield ""
        where = ", ".join(map(style.coordinate_title, names))
        yield table((f"at {where}", "least", "most"), places, left=(f"at {where}",))
    yield ""


def _shown(record: Mechanism, maps: IndexMaps, written: Path | None) -> Iterable[RenderableType]:
    yield from map_tables(record, maps, "index")
    yield "means and extremes are those of the nodes; without --map they come with errors"
    if maps.reach is not None:
        beyond = int(np.sum(np.isinf(maps["distance"])))
        yield (
            "distance: from the nearest parallel singularity inside the reach, its border not counted, that rays found"
            f" within {maps.reach:g} {maps.unit} (none from {beyond} nodes)"
        )
    yield length_words(record, maps.length)
    if written is not None:
        yield f"written: {written}"
