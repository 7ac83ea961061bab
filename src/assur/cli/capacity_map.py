"""Maps of what actuators hold as data, as files and as a person reads them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import RenderableType

from assur.cli.mapped import map_tables, maps_file, plane_names, region_of_plane, write_maps
from assur.cli.numbers import whole_number
from assur.cli.options import Outcome, Shared
from assur.cli.progress import progress
from assur.machine.forces.capacity import force_limits
from assur.machine.forces.capacity_maps import capacity_maps, tops
from assur.machine.masses.link_masses import all_masses
from assur.mechanism import Mechanism
from assur.workspace.index_maps import IndexMaps
from assur.workspace.region import Workspace

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def over_plane(
    record: Mechanism, plane: str, at: Sequence[str], mode: str, nodes: str, output: str | None, shared: Shared
) -> Outcome:
    """What is held over the coordinates of `plane`."""
    names, count = plane_names(record, plane), whole_number(nodes, "--nodes")
    written = maps_file(output, names)
    force_limits(record), all_masses(record)  # what the file lacks is told first
    region = region_of_plane(record, names, at, (mode, (), (), "32"), shared)
    with progress("maps of forces", shared):
        maps = capacity_maps(record, region, names, nodes=count)
    shown = maps.in_degrees() if record.angle == "deg" else maps
    answer = shown.answer()
    if written is not None:
        write_maps(written, shown, answer, lambda: _drawn(record, region, maps))
    return Outcome(answer, lambda: _shown(record, shown, written))


def _drawn(record: Mechanism, region: Workspace, maps: IndexMaps) -> Figure:
    from assur.figures.context import Context
    from assur.figures.index_maps import drawn

    return drawn(Context(record, region), maps, tops(maps)).figure


def _shown(record: Mechanism, maps: IndexMaps, written: Path | None) -> Iterable[RenderableType]:
    yield from map_tables(record, maps, "force")
    yield "at rest under gravity, within the limits of the file; means and extremes are those of the nodes"
    yield "; ".join(f"{name}: {item.meaning}" for name, item in maps.maps.items() if " " not in name)
    if written is not None:
        yield f"written: {written}"
