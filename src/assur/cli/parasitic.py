"""How the coordinates that the pose leaves out are printed: at one pose, and where they are largest."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from assur.cli.output import heading, table
from assur.cli.quantities import is_length, short

if TYPE_CHECKING:
    from rich.console import RenderableType

    from assur.mechanism import Mechanism
    from assur.results.answers.position import InputsSolution, PoseSolution
    from assur.workspace.region import Workspace


def largest(record: Mechanism, found: Workspace) -> dict[str, Any]:
    """Coordinate -> its largest value in size over a workspace and where; angles in the mechanism's angle unit."""
    from assur.workspace.parasitic import largest_parasitic

    return {
        name: {
            "value": _outside(record, name, item.value),
            "at": {key: _outside(record, key, value) for key, value in item.at.items()},
        }
        for name, item in largest_parasitic(record, found).items()
    }


def shown_largest(record: Mechanism, data: Mapping[str, Any]) -> Iterable[RenderableType]:
    """The same for a person."""
    yield heading("largest parasitic motion, of the coordinates that the pose leaves out")
    rows = [
        (
            name,
            f"{short(item['value'])} {_unit(record, name)}",
            ", ".join(_at(record, *pair) for pair in item["at"].items()),
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


def _outside(record: Mechanism, name: str, value: float) -> float:
    from assur.kinematics.answers.at_border import angle_at_border

    return value if is_length(name) else float(angle_at_border(record, value))


def _unit(record: Mechanism, name: str) -> str:
    return record.unit if is_length(name) else record.angle


def _at(record: Mechanism, name: str, value: float) -> str:
    return f"{name} = {value:.5g} {_unit(record, name)}"
