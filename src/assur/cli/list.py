"""`assur list`: the built-in mechanisms and topologies."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from assur.cli.options import PLAIN, Outcome, Plain
from assur.cli.output import table

if TYPE_CHECKING:
    from rich.console import RenderableType

    from assur.results.answers.catalogue import CatalogueAnswer, ListedMechanism, ListedTopology


def list_(*, shared: Plain = PLAIN) -> Outcome:  # noqa: ARG001  # read by main
    """The built-in mechanisms, with their inputs and poses, and those known by their topology alone.

    A mechanism of your own is named by the path of its file: assur show ./my.toml

    For example:
        assur list
        assur list --json
    """
    from assur.model.registry import left_out
    from assur.results.answers.catalogue import CatalogueAnswer

    answer = CatalogueAnswer(tuple(_mechanisms()), tuple(_topologies()), left_out())
    return Outcome(answer, lambda: _shown(answer))


def _mechanisms() -> Iterator[ListedMechanism]:
    from assur.model.registry import CLOSED_FORM, names, record_alone
    from assur.results.answers.catalogue import ListedMechanism

    for record in map(record_alone, names()):
        yield ListedMechanism(
            *(record.name, record.title, record.source, record.unit, record.angle),
            inputs=tuple(each.name for each in record.inputs),
            coordinates=record.platform.pose,
            closed_form=(record.file.parent / CLOSED_FORM).is_file(),
        )


def _topologies() -> Iterator[ListedTopology]:
    from assur.model.registry import topology_names
    from assur.model.topologies import load_topology
    from assur.results.answers.catalogue import ListedTopology

    for each in map(load_topology, topology_names()):
        chains = tuple(chain.text for chain in each.chains)
        yield ListedTopology(each.name, each.title, each.source, each.limb_types, chains, each.mode)


def _shown(answer: CatalogueAnswer) -> Iterable[RenderableType]:
    yield table(
        ("name", "inputs", "pose", "what it is"),
        [
            (
                item.name,
                " ".join(item.inputs),
                " ".join(item.coordinates),
                item.title,
            )
            for item in answer.mechanisms
        ],
        left=("name", "inputs", "pose", "what it is"),
    )
    yield ""
    yield "topology alone, without dimensions:"
    yield table(
        ("name", "limbs", "what it is"),
        [(item.name, item.limbs, item.title) for item in answer.topologies],
        left=("name", "limbs", "what it is"),
    )
    for item in answer.left_out:
        yield f"Not there: {item.title}; {item.reason}."
