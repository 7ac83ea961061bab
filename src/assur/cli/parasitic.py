"""How the coordinates that the pose leaves out are printed: at one pose, and where they are largest."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from rich.console import RenderableType

from assur.cli.output import heading, table
from assur.kinematics.answers.at_border import coordinate_unit, coordinates_at_border
from assur.mechanism import Mechanism
from assur.model.pose import is_angle
from assur.results.answers.position import InputsSolution, PoseSolution
from assur.results.answers.region import LargestCoordinate
from assur.results.plain_text import short
from assur.workspace.parasitic import largest_parasitic
from assur.workspace.region import Workspace


def largest(record: Mechanism, region: Workspace) -> dict[str, LargestCoordinate]:
    """Coordinate -> its largest value in size over a workspace and where; angles in the mechanism's angle unit."""
    return {
        name: LargestCoordinate(item.value / coordinate_unit(record, name), coordinates_at_border(record, item.at))
        for name, item in largest_parasitic(record, region).items()
    }


def shown_largest(record: Mechanism, data: Mapping[str, LargestCoordinate]) -> Iterable[RenderableType]:
    """The same for a person."""
    yield heading("largest parasitic motion, of the coordinates that the pose leaves out")
    rows = [
        (
            name,
            f"{short(item.value)} {_unit(record, name)}",
            ", ".join(f"{key} = {value:.5g} {_unit(record, key)}" for key, value in item.at.items()),
        )
        for name, item in data.items()
    ]
    yield table(("coordinate", "value", "at"), rows, left=("coordinate", "at"))


def shown_solutions(record: Mechanism, solutions: Iterable[PoseSolution | InputsSolution]) -> Iterable[RenderableType]:
    """Of every solution the platform's coordinates that the pose leaves out; nothing where none of them moves."""
    listed = [item for item in solutions if item.parasitic]
    if not listed:
        return
    names = tuple(listed[0].parasitic)
    yield "the platform's coordinates that the pose leaves out:"
    yield table(
        ("mode", *(f"{name} [{_unit(record, name)}]" for name in names)),
        [(item.mode, *(short(item.parasitic[name]) for name in names)) for item in listed],
    )


def _unit(record: Mechanism, name: str) -> str:
    return record.angle if is_angle(name) else record.unit
