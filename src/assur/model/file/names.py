"""No two things with one name."""

from __future__ import annotations

from collections.abc import Iterator

from assur.errors import KeyPath
from assur.model.file import schema
from assur.model.file.faults import Faults
from assur.model.file.limbs import Tables

Use = tuple[str, str, KeyPath]
"""A name, what it names, and where."""


def check_names(file: schema.FileEntry, tables: Tables, faults: Faults) -> None:
    """Note every name that two links, joints, aliases, points, generalised joints or limbs share.

    Joints, points, parameters and angles all stand in formulas, so they share their names. Printed names of
    inputs and names of chains are groups of their own.
    """
    _check_group([*_elements(tables), *_links(tables)], faults)
    _check_group([*_elements(tables), *_letters(file)], faults)
    _check_group([(item.entry.name, "input", (*item.path, "name")) for item in tables.inputs.values()], faults)


def _check_group(uses: list[Use], faults: Faults) -> None:
    first: dict[str, tuple[str, KeyPath]] = {}
    told: set[KeyPath] = set()
    for name, kind, path in sorted(uses, key=lambda use: faults.source.line(use[2])):
        if name in first and path not in told:
            told.add(path)
            other, place = first[name]
            found = f"{_a(other)} has the name '{name}' already; {faults.first(place)}"
            faults.add(path, found, "allowed: another name")
        first.setdefault(name, (kind, path))


def _a(kind: str) -> str:
    return f"an {kind}" if kind[0] in "ai" else f"a {kind}"


def _elements(tables: Tables) -> Iterator[Use]:
    for table, kind in (("joints", "joint"), ("points", "point"), ("generalised", "generalised joint")):
        for name, placed in getattr(tables, table).items():
            yield name, kind, placed.path
    for placed in tables.joints.values():
        if placed.entry.alias:
            own = f"{placed.instance.prefix}." if placed.instance else ""
            yield own + placed.entry.alias, "joint", (*placed.path, "alias")
    yield from _limbs(tables)


def _limbs(tables: Tables) -> Iterator[Use]:
    for instance in tables.instances:
        yield instance.prefix, "limb", ("limbs", instance.limb)


def _links(tables: Tables) -> Iterator[Use]:
    for name, placed in tables.links.items():
        yield name, "link", placed.path


def _letters(file: schema.FileEntry) -> Iterator[Use]:
    for name in file.parameters:
        yield name, "parameter", ("parameters", name)
    for name in file.angles:
        yield name, "angle", ("angles", name)
