"""Maps of the least stiffness as data, as files and as a person reads them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import RenderableType

from assur.cli.mapped import map_tables, maps_file, plane_names, region_of_plane, write_maps
from assur.cli.numbers import whole_number
from assur.cli.options import Outcome, Shared
from assur.cli.progress import progress
from assur.machine.elasticity.stiffness_maps import stiffness_maps
from assur.machine.elasticity.structure import structure
from assur.mechanism import Mechanism
from assur.workspace.index_maps import IndexMaps
from assur.workspace.region import Workspace

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def over_plane(
    record: Mechanism,
    plane: str,
    at: Sequence[str],
    asked: tuple[str | None, Sequence[str], Sequence[str], str],
    nodes: str,
    output: str | None,
    shared: Shared,
) -> Outcome:
    """The least stiffness over the coordinates of `plane`; `asked` is the mode, boxes, strokes and resolution."""
    names, count = plane_names(record, plane), whole_number(nodes, "--nodes")
    written = maps_file(output, names)
    structure(record)  # what the file lacks is told first
    region = region_of_plane(record, names, at, asked, shared)
    with progress("maps of stiffness", shared):
        maps = stiffness_maps(record, region, names, nodes=count)
    shown = maps.in_degrees() if record.angle == "deg" else maps
    answer = shown.answer()
    if written is not None:
        write_maps(written, shown, answer, lambda: _drawn(record, region, maps))
    return Outcome(answer, lambda: _shown(record, shown, written))


def _drawn(record: Mechanism, region: Workspace, maps: IndexMaps) -> Figure:
    from assur.figures.context import Context
    from assur.figures.stiffness_maps import drawn

    return drawn(Context(record, region), maps).figure


def _shown(record: Mechanism, maps: IndexMaps, written: Path | None) -> Iterable[RenderableType]:
    yield from map_tables(record, maps, "stiffness")
    yield "means and extremes are those of the nodes; the direction is that of the least stiffness, without sense"
    if written is not None:
        yield f"written: {written}"
