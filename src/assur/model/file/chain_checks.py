"""Chains are walks through the joint graph from base to platform, and together they are the whole of it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from assur.errors import KeyPath
from assur.model.file.faults import Faults, listed
from assur.model.file.limbs import Instance, Tables
from assur.model.mechanism import LimbRecord, MechanismRecord

_ONCE = "allowed: each joint in one chain, once"


def check_chains(record: MechanismRecord, tables: Tables, faults: Faults) -> None:
    """Note what is wrong with the chains of a record whose graph is right."""
    begun = len(faults.problems)
    for name, place in tables.chains.items():
        if is_first(place.instance):
            _check_chain(record, record.chains[name], place.path, faults)
    if record.chains and len(faults.problems) == begun:
        _check_shares(record, tables, faults)


def is_first(instance: Instance | None) -> bool:
    """The other limbs of a template are turned copies of the first."""
    return instance is None or instance.number == 1


def _check_shares(record: MechanismRecord, tables: Tables, faults: Faults) -> None:
    """Every joint is part of one chain, once."""
    owners: dict[str, str] = {}
    for name, chain in record.chains.items():
        for joint in _joints(record, chain):
            if joint in owners:
                where = "twice" if owners[joint] == name else f"in the chain '{owners[joint]}' as well"
                first = f"; {faults.first(tables.chains[owners[joint]].path)}" if owners[joint] != name else ""
                faults.add(tables.chains[name].path, f"'{joint}' stands here {where}{first}", _ONCE)
            owners.setdefault(joint, name)
    left = [name for name in record.joints if name not in owners]
    if left:
        hint = "the chains together are the whole mechanism; without any they are found from the joints"
        faults.add(("chains",), f"no chain has {listed(left)}", _ONCE, hint)


def _joints(record: MechanismRecord, chain: LimbRecord) -> list[str]:
    elements = (*chain.serial, *chain.loop, *chain.tail)
    return [
        joint
        for element in elements
        for joint in (record.generalised[element].joints if element in record.generalised else (element,))
    ]


def _check_chain(record: MechanismRecord, chain: LimbRecord, path: KeyPath, faults: Faults) -> None:
    platform = record.platform.link
    if bool(chain.serial) == bool(chain.loop or chain.output or chain.tail):
        faults.add(path, "neither serial nor a loop", "allowed: serial, or loop, output and tail")
        return
    if chain.serial:
        _check_walk(record, chain.serial, (record.base, platform), (*path, "serial"), faults)
        return
    visited = _loop(record, chain.loop)
    if visited is None or record.base not in visited:
        faults.add((*path, "loop"), "no closed loop through the base", "allowed: joints in turn around one")
    elif chain.output not in visited:
        faults.add((*path, "output"), f"'{chain.output}' is not on the loop", f"allowed: {listed(visited)}")
    else:
        _check_walk(record, chain.tail, (chain.output, platform), (*path, "tail"), faults)


def _ends(record: MechanismRecord, name: str) -> tuple[str, str]:
    item = record.generalised[name] if name in record.generalised else record.joints[name]
    return item.parent, item.child


def _check_walk(
    record: MechanismRecord, names: Sequence[str], ends: tuple[str, str], path: KeyPath, faults: Faults
) -> None:
    """Each joint starts where the one before it ends."""
    link = ends[0]
    for place, name in enumerate(names):
        pair = _ends(record, name)
        if link not in pair:
            faults.add((*path, place), f"'{name}' does not meet '{link}'", "allowed: a joint of that link")
            return
        link = pair[1] if link == pair[0] else pair[0]
    if link != ends[1]:
        faults.add(path, f"ends at '{link}'", f"allowed: from '{ends[0]}' to '{ends[1]}'")


def _loop(record: MechanismRecord, names: Sequence[str]) -> set[str] | None:
    """Links of a closed loop; None where the joints do not form one, in turn."""
    if len(names) < 2:
        return None
    for start in _ends(record, names[0]):
        link, visited = start, Counter[str]()
        for name in names:
            pair = _ends(record, name)
            visited[link] += 1
            if link not in pair:
                break
            link = pair[1] if link == pair[0] else pair[0]
        else:
            if link == start and max(visited.values()) == 1:
                return set(visited)
    return None
