"""What the joint graph must be: one piece, without dead ends, and as its chains and parallelograms say."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import networkx as nx
import numpy as np

from assur.model.file.faults import Faults, listed
from assur.model.file.limbs import Instance, Tables
from assur.model.file.toml_source import KeyPath
from assur.model.mechanism import Chain, GeneralisedJoint, Joint, MechanismRecord
from assur.numerics.rotations import FloatArray

_CORNERS = {
    "P(4R)": ("revolute",) * 4,
    "P(4U)": ("universal",) * 4,
    "P(4S)": ("spherical",) * 4,
    "P(2US)": ("universal", "spherical", "spherical", "universal"),
}
"""Types of the four joints in turn, from one end of the first rod to that of the second."""
_EQUAL = 1e-9


def check_graph(record: MechanismRecord, tables: Tables, faults: Faults) -> None:
    """Note what is wrong with the graph of a record whose names and numbers are right."""
    _check_connected(record, tables, faults)
    for name, placed in tables.generalised.items():
        if _is_first(placed.instance):
            _check_parallelogram(record, record.generalised[name], placed.path, faults)
    if faults.problems:
        return
    for name, place in tables.chains.items():
        if _is_first(place.instance):
            _check_chain(record, record.chains[name], place.path, faults)


def _is_first(instance: Instance | None) -> bool:
    """The other limbs of a template are turned copies of the first."""
    return instance is None or instance.number == 1


def _check_connected(record: MechanismRecord, tables: Tables, faults: Faults) -> None:
    graph: nx.MultiGraph[str] = nx.MultiGraph()
    graph.add_nodes_from(record.links)
    graph.add_edges_from((joint.parent, joint.child) for joint in record.joints.values())
    reached = nx.node_connected_component(graph, record.base)
    for name, placed in tables.links.items():
        joints = graph.degree(name)
        if name not in reached:
            faults.add(placed.path, f"'{placed.local}' is not connected to the base", "allowed: one connected graph")
        elif joints == 1 and name not in (record.base, record.platform.link):
            hint = "a body that only rides along belongs to the link that carries it, as a point"
            faults.add(placed.path, f"'{placed.local}' dangles: it has one joint only", "allowed: two or more", hint)


def _check_parallelogram(record: MechanismRecord, item: GeneralisedJoint, path: KeyPath, faults: Faults) -> None:
    """Four joints in turn around a loop of four links, opposite sides of equal length."""
    joints = [record.joints[name] for name in item.joints]
    corners = _CORNERS[item.kind]
    wrong = [joint.name for joint, corner in zip(joints, corners, strict=True) if joint.type.name != corner]
    if wrong:
        allowed = " and ".join(dict.fromkeys(corners))
        faults.add((*path, "joints"), f"{listed(wrong)}", f"allowed in {item.kind}: {allowed} joints")
        return
    links = _common_links(joints)
    if links is None:
        hint = "give them in turn: each shares a link with the next, the last with the first"
        faults.add((*path, "joints"), "no loop of four links", "allowed: four joints around one loop", hint)
        return
    opposite = ({links[0], links[2]}, {links[1], links[3]})
    if {item.parent, item.child} not in opposite:
        pairs = " or ".join(" and ".join(sorted(pair)) for pair in opposite)
        faults.add((*path, "stands_for"), f"{item.parent} and {item.child}", f"allowed: opposite links, {pairs}")
    sides = [_side(joints[place], joints[(place + 1) % 4], links[place], faults, path) for place in range(4)]
    scale = max(sides)
    for first, second in ((0, 2), (1, 3)):
        if abs(sides[first] - sides[second]) > _EQUAL * scale:
            found = f"sides {sides[first]:g} on {links[first]} and {sides[second]:g} on {links[second]}"
            faults.add(path, f"no parallelogram: {found}", "allowed: opposite sides of equal length")
    if min(sides) <= _EQUAL * scale:
        faults.add(path, "a side of length zero", "allowed: four sides")


def _common_links(joints: Sequence[Joint]) -> list[str] | None:
    """The link between each joint and the next around the loop; None where there is no loop of four."""
    links = []
    for joint, following in zip(joints, [*joints[1:], joints[0]], strict=True):
        common = {joint.parent, joint.child} & {following.parent, following.child}
        if len(common) != 1:
            return None
        links.append(common.pop())
    return links if len(set(links)) == 4 else None


def _side(first: Joint, second: Joint, link: str, faults: Faults, path: KeyPath) -> float:
    """Distance of two joints of a link, between parallel axes where they have one."""
    start, end = _in_link(first, link), _in_link(second, link)
    span = end[0] - start[0]
    if first.type.axes == 1:
        if float(np.linalg.norm(np.cross(start[1], end[1]))) > _EQUAL:
            faults.add(path, f"the axes of {first.name} and {second.name} are not parallel", "allowed: parallel axes")
        span = np.cross(start[1], span)
    return float(np.linalg.norm(span))


def _in_link(joint: Joint, link: str) -> tuple[FloatArray, FloatArray]:
    """Point and first axis of a joint in the frame of one of its links."""
    axis = joint.axes[0] if len(joint.axes) else np.zeros(3)
    return (joint.at, axis) if link == joint.parent else (joint.child_at, joint.turn.T @ axis)


def _check_chain(record: MechanismRecord, chain: Chain, path: KeyPath, faults: Faults) -> None:
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
