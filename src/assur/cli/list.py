"""`assur list`: the built-in mechanisms."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from assur.cli.options import PLAIN, Outcome, Plain
from assur.cli.output import table

if TYPE_CHECKING:
    from rich.console import RenderableType


def list_(*, shared: Plain = PLAIN) -> Outcome:  # noqa: ARG001  # read by main
    """The built-in mechanisms, with their inputs and poses.

    A mechanism of your own is named by the path of its file: assur show ./my.toml

    For example:
        assur list
        assur list --json
    """
    from assur.mechanism import load, names

    rows = []
    for name in names():
        record = load(name)
        rows.append(
            {
                "name": name,
                "title": record.title,
                "source": record.source,
                "unit": record.unit,
                "angle": record.angle,
                "inputs": [item.name for item in record.inputs],
                "coordinates": list(record.platform.pose),
                "closed_form": record.closed_form is not None,
            }
        )
    return Outcome({"mechanisms": rows}, lambda: _shown(rows))


def _shown(rows: list[dict[str, Any]]) -> Iterable[RenderableType]:
    yield table(
        ("name", "inputs", "pose", "what it is"),
        [
            (
                item["name"],
                " ".join(item["inputs"]),
                " ".join(item["coordinates"]),
                f"{item['title']}\n{item['source']}",
            )
            for item in rows
        ],
        left=("name", "inputs", "pose", "what it is"),
    )
