"""Maps of what actuators hold and of stiffness, as data, as files and as a person reads them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import RenderableType

from assur.cli.mapped import map_tables, maps_file, plane_names, region_of_plane, write_maps
from assur.cli.numbers import whole_number
from assur.cli.options import Outcome, Shared
from assur.cli.progress import Step, progress
from assur.machine.elasticity.stiffness_maps import stiffness_maps
from assur.machine.elasticity.structure import structure
from assur.machine.forces.capacity import force_limits
from assur.machine.forces.capacity_maps import capacity_maps, tops
from assur.machine.masses.link_masses import all_masses
from assur.mechanism import Mechanism
from assur.workspace.index_maps import IndexMaps
from assur.workspace.region import Workspace

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True)
class MachineMap:
    """What is mapped.

    Attributes:
        what: in a word.
        needed: what the file must say, told before anything is solved.
        maps: of a workspace, over coordinates, by nodes along each, with progress.
        drawn: their figure.
        words: what is said of them.
    """

    what: str
    needed: Callable[[Mechanism], object]
    maps: Callable[[Mechanism, Workspace, Sequence[str], int, Step], IndexMaps]
    drawn: Callable[[Mechanism, Workspace, IndexMaps], Figure]
    words: Callable[[IndexMaps], Sequence[str]]


def over_plane(
    mapped: MachineMap,
    record: Mechanism,
    plane: str,
    at: Sequence[str],
    asked: tuple[str | None, Sequence[str], Sequence[str], str],
    nodes: str,
    output: str | None,
    shared: Shared,
) -> Outcome:
    """A map over the coordinates of `plane`; `asked` is the mode, boxes, strokes and resolution."""
    names, count = plane_names(record, plane), whole_number(nodes, "--nodes")
    written = maps_file(output, names)
    mapped.needed(record)
    region = region_of_plane(record, names, at, asked, shared)
    with progress(f"maps of {mapped.what}", shared) as step:
        maps = mapped.maps(record, region, names, count, step)
    shown = maps.in_degrees() if record.angle == "deg" else maps
    answer = shown.answer()
    if written is not None:
        write_maps(written, shown, answer, lambda: mapped.drawn(record, region, maps))
    return Outcome(answer, lambda: _shown(mapped, record, shown, written))


def _shown(mapped: MachineMap, record: Mechanism, maps: IndexMaps, written: Path | None) -> Iterable[RenderableType]:
    yield from map_tables(record, maps, mapped.what)
    yield from mapped.words(maps)
    if written is not None:
        yield f"written: {written}"


def _forces_drawn(record: Mechanism, region: Workspace, maps: IndexMaps) -> Figure:
    from assur.figures.context import Context
    from assur.figures.index_maps import drawn

    return drawn(Context(record, region), maps, tops(maps)).figure


def _stiffness_drawn(record: Mechanism, region: Workspace, maps: IndexMaps) -> Figure:
    from assur.figures.context import Context
    from assur.figures.stiffness_maps import drawn

    return drawn(Context(record, region), maps).figure


FORCES = MachineMap(
    "force",
    lambda record: (force_limits(record), all_masses(record)),
    lambda record, region, names, count, step: capacity_maps(record, region, names, nodes=count, progress=step),
    _forces_drawn,
    lambda maps: (
        "at rest under gravity, within the limits of the file; means and extremes are those of the nodes",
        "; ".join(f"{name}: {item.meaning}" for name, item in maps.maps.items() if " " not in name),
    ),
)
STIFFNESS = MachineMap(
    "stiffness",
    structure,
    lambda record, region, names, count, step: stiffness_maps(record, region, names, nodes=count, progress=step),
    _stiffness_drawn,
    lambda _: (
        "means and extremes are those of the nodes; the direction is that of the least stiffness, without sense",
    ),
)
