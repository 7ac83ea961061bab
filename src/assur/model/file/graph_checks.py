"""What the joint graph must be: one piece, without dead ends, and as its parallelograms say."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from assur.errors import KeyPath
from assur.model.file.chain_checks import check_chains, is_first
from assur.model.file.faults import Faults, listed
from assur.model.file.limbs import Tables
from assur.model.mechanism import GeneralisedJoint, Joint, MechanismRecord
from assur.numerics.rotations import FloatArray

_CORNERS = {
    "P(4R)": ("revolute",) * 4,
    "P(4U)": ("universal",) * 4,
    "P(4S)": ("spherical",) * 4,
    "P(2US)": ("universal", "spherical", "spherical", "universal"),
}
"""Types of the four joints in turn, from one end of the first rod to that of the second."""
_GEOMETRY = (("parameters",), ("joints",), ("generalised",), ("unit",), ("angle",))
"""Where a fault leaves sizes and directions unknown."""
_EQUAL = 1e-9
_SMALLEST = 1e-9


def check_graph(record: MechanismRecord, tables: Tables, faults: Faults) -> None:
    """Note what is wrong with the graph of a record, as far as what it is made of is right."""
    begun = len(faults.problems)
    if not _is_known(record, tables, faults):
        return
    _check_connected(record, tables, faults)
    if faults.spares(*_GEOMETRY):
        _check_size(record, faults)
        for name, placed in tables.generalised.items():
            if is_first(placed.instance):
                _check_parallelogram(record, record.generalised[name], placed.path, faults)
    if len(faults.problems) == begun and faults.spares(("generalised",), ("chains",), ("chain",)):
        check_chains(record, tables, faults)


def _is_known(record: MechanismRecord, tables: Tables, faults: Faults) -> bool:
    """Whether every link and joint of the graph is there, so that no fault follows from one that is told already."""
    whole = len(record.joints) == len(tables.joints) and not (tables.broken.keys() & {"links", "joints"})
    apart = all(joint.parent != joint.child for joint in record.joints.values())
    named = {record.base, record.platform.link} <= record.links.keys()
    return bool(record.joints) and whole and apart and named and faults.spares(("links",), ("repeat",))


def _check_connected(record: MechanismRecord, tables: Tables, faults: Faults) -> None:
    beside: dict[str, list[str]] = {name: [] for name in record.links}
    for joint in record.joints.values():
        beside[joint.parent].append(joint.child)
        beside[joint.child].append(joint.parent)
    told = reached = _island(beside, record.base)
    for first in tables.links:
        if first not in told:
            island = _island(beside, first)
            told = told | island
            others = [name for name in tables.links if name in island and name != first]
            placed = tables.links[first]
            more = f", nor is what hangs on it ({listed(others)})" if others else ""
            hint = "a second base? All links that stand still are one link, the base" if others else ""
            found = f"'{placed.local}' is not connected to the base{more}"
            faults.add(placed.path, found, "allowed: one connected graph", hint)
    for name, placed in tables.links.items():
        if name in reached and len(beside[name]) == 1 and name not in (record.base, record.platform.link):
            hint = "a body that only rides along belongs to the link that carries it, as a point"
            faults.add(placed.path, f"'{placed.local}' dangles: it has one joint only", "allowed: two or more", hint)


def _island(beside: Mapping[str, Sequence[str]], start: str) -> set[str]:
    """A link and all that joints connect with it."""
    island, ahead = {start}, [start]
    while ahead:
        further = {name for name in beside[ahead.pop()] if name not in island}
        island |= further
        ahead += further
    return island


def _check_size(record: MechanismRecord, faults: Faults) -> None:
    """Points that all coincide are a spherical mechanism; points that nearly do are no mechanism."""
    size = max(float(np.max(np.abs([joint.at, joint.child_at]))) for joint in record.joints.values())
    if 0 < size < _SMALLEST:
        found = f"no coordinate of a joint exceeds {size:.3g} {record.unit}"
        faults.add(("joints",), found, f"allowed: links of at least {_SMALLEST:g} {record.unit}, or all of no size")


def _check_parallelogram(
    record: MechanismRecord, parallelogram: GeneralisedJoint, path: KeyPath, faults: Faults
) -> None:
    """Four joints in turn around a loop of four links, opposite sides of equal length."""
    joints = [record.joints[name] for name in parallelogram.joints]
    corners = _CORNERS[parallelogram.kind]
    wrong = [joint.name for joint, corner in zip(joints, corners, strict=True) if joint.type.name != corner]
    if wrong:
        allowed = " and ".join(dict.fromkeys(corners))
        faults.add((*path, "joints"), f"{listed(wrong)}", f"allowed in {parallelogram.kind}: {allowed} joints")
        return
    links = _common_links(joints)
    if links is None:
        hint = "give them in turn: each shares a link with the next, the last with the first"
        faults.add((*path, "joints"), "no loop of four links", "allowed: four joints around one loop", hint)
        return
    opposite = ({links[0], links[2]}, {links[1], links[3]})
    if {parallelogram.parent, parallelogram.child} not in opposite:
        pairs = " or ".join(" and ".join(sorted(pair)) for pair in opposite)
        faults.add(
            (*path, "stands_for"),
            f"{parallelogram.parent} and {parallelogram.child}",
            f"allowed: opposite links, {pairs}",
        )
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
