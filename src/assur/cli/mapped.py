"""Maps over coordinates of a workspace as data, as files and as a person reads them."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from rich.console import RenderableType

from assur.cli import region_question
from assur.cli.numbers import assignments, whole_number
from assur.cli.options import MapOptions, Outcome, Shared
from assur.cli.output import heading, table
from assur.cli.paths import output_file
from assur.cli.progress import Step, progress
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
from assur.workspace.index_maps import IndexMaps
from assur.workspace.region import Workspace, workspace
from assur.workspace.slices import MOST, coordinates, slice_at

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from assur.figures.context import Context
    from assur.figures.spec import Drawing

PICTURES = (".png", ".pdf", ".svg")
ENDINGS = (".npz", ".csv", ".json", *PICTURES)
CELLS = "32"
"""Of a workspace that is mapped, along each coordinate, where nothing else is said."""


@dataclass(frozen=True)
class PlaneMap:
    """What is mapped.

    Attributes:
        what: in a word.
        nodes: along each coordinate, where nothing else is said.
        needed: what the file must say, told before anything is solved.
        maps: of a workspace, over coordinates, by nodes along each, with progress.
        drawn: their figure.
        words: what is said of them.
    """

    what: str
    nodes: int
    needed: Callable[[Mechanism], object]
    maps: Callable[[Mechanism, Workspace, Sequence[str], int, Step], IndexMaps]
    drawn: Callable[[Context, IndexMaps], Drawing]
    words: Callable[[Mechanism, IndexMaps], Iterable[str]]


def over_plane(asked: PlaneMap, record: Mechanism, mode: str, over: MapOptions, shared: Shared) -> Outcome:
    """A map over the coordinates of --map in a working mode."""
    names = plane_names(record, over.map_ or "")
    count = asked.nodes if over.nodes is None else whole_number(over.nodes, "--nodes")
    written = maps_file(over.output, names)
    asked.needed(record)
    region = region_of_plane(record, names, mode, over, shared)
    with progress(f"{asked.what} maps", shared) as step:
        maps = asked.maps(record, region, names, count, step)
    shown = maps.in_degrees() if record.angle == "deg" else maps
    answer = shown.answer()
    if written is not None:
        write_maps(written, shown, answer, lambda: _figure(asked, record, region, maps))
    return Outcome(answer, lambda: _shown(asked, record, shown, written))


def region_of_plane(record: Mechanism, names: Sequence[str], mode: str, over: MapOptions, shared: Shared) -> Workspace:
    """The workspace that maps over coordinates `names` go through."""
    where = replace(over, at=(*over.at, *_rest(record, names, over.at)))
    question = region_question.question(record, mode, where, over.resolution or CELLS)
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


def _figure(asked: PlaneMap, record: Mechanism, region: Workspace, maps: IndexMaps) -> Figure:
    from assur.figures.context import Context

    return asked.drawn(Context(record, region), maps).figure


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


def _shown(asked: PlaneMap, record: Mechanism, maps: IndexMaps, written: Path | None) -> Iterable[RenderableType]:
    yield from map_tables(record, maps, asked.what)
    yield from asked.words(record, maps)
    if written is not None:
        yield f"written: {written}"
