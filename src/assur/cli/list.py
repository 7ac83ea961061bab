"""`assur list`: the built-in mechanisms and topologies."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from assur.cli.options import PLAIN, Outcome, Plain
from assur.cli.output import table

if TYPE_CHECKING:
    from rich.console import RenderableType

Rows = list[dict[str, Any]]


def list_(*, shared: Plain = PLAIN) -> Outcome:  # noqa: ARG001  # read by main
    """The built-in mechanisms, with their inputs and poses, and those known by their topology alone.

    A mechanism of your own is named by the path of its file: assur show ./my.toml

    For example:
        assur list
        assur list --json
    """
    from assur.model.registry import left_out

    found = {
        "mechanisms": _mechanisms(),
        "topologies": _topologies(),
        "left_out": [
            {"name": item.name, "title": item.title, "source": item.source, "reason": item.reason}
            for item in left_out()
        ],
    }
    return Outcome(found, lambda: _shown(found))


def _mechanisms() -> Rows:
    from assur.model.registry import CLOSED_FORM, names, record_alone

    return [
        {
            "name": record.name,
            "title": record.title,
            "source": record.source,
            "unit": record.unit,
            "angle": record.angle,
            "inputs": [item.name for item in record.inputs],
            "coordinates": list(record.platform.pose),
            "closed_form": (record.file.parent / CLOSED_FORM).is_file(),
        }
        for record in map(record_alone, names())
    ]


def _topologies() -> Rows:
    from assur.model.registry import topology_names
    from assur.model.topologies import load_topology

    return [
        {
            "name": item.name,
            "title": item.title,
            "source": item.source,
            "limbs": item.limb_types,
            "chains": [chain.text for chain in item.chains],
            "mode": item.mode,
        }
        for item in map(load_topology, topology_names())
    ]


def _shown(found: dict[str, Rows]) -> Iterable[RenderableType]:
    yield table(
        ("name", "inputs", "pose", "what it is"),
        [
            (
                item["name"],
                " ".join(item["inputs"]),
                " ".join(item["coordinates"]),
                item["title"],
            )
            for item in found["mechanisms"]
        ],
        left=("name", "inputs", "pose", "what it is"),
    )
    yield ""
    yield "topology alone, without dimensions:"
    yield table(
        ("name", "limbs", "what it is"),
        [(item["name"], item["limbs"], item["title"]) for item in found["topologies"]],
        left=("name", "limbs", "what it is"),
    )
    for item in found["left_out"]:
        yield f"Not there: {item['title']}; {item['reason']}."
