"""The joint graph as plain data: links, joints and their steps, what closes its loops, and dimensions."""

from __future__ import annotations

from typing import Any

from assur.joint_graph.frames import placed_links
from assur.joint_graph.tree import joint_graph
from assur.kinematics.turns import counted, joint_units
from assur.model.mechanism import Joint, MechanismRecord
from assur.page.resizing import general_dimensions


def graph(record: MechanismRecord) -> dict[str, Any]:
    """What the program of a configuration is given, and what its numbers belong to: lengths and rad, to the last bit.

    Links stand in the order in which they are placed, the base first; steps in that of the joint values.

    >>> from assur.model.registry import load_record
    >>> found = graph(load_record("fivebar"))
    >>> [item["name"] for item in found["joints"]], found["cut"], found["steps"][0]
    (['A1', 'A2', 'B1', 'B2', 'P'], [4], {'kind': 'turn', 'first': 0})
    """
    found = joint_graph(record)
    place = {name: k for k, name in enumerate(record.joints)}
    return {
        "links": placed_links(record),
        "joints": [_joint(joint, found.slices[name].start) for name, joint in record.joints.items()],
        "steps": [
            {"kind": step.kind, "first": found.slices[name].start + first}
            for name, joint in record.joints.items()
            for step, first in joint.type.places
        ],
        "cut": [place[joint.name] for joint in found.cut],
        "dimensions": general_dimensions(record),
    }


def coordinates(record: MechanismRecord) -> list[dict[str, str | bool | float]]:
    """Name and kind of each joint value, whether its whole turns count, and what a change of one is of it, in order."""
    return [
        {"label": record.coordinate_label(item), "kind": item.kind, "counted": bool(turns), "size": float(size)}
        for item, turns, size in zip(record.coordinates, counted(record), joint_units(record), strict=True)
    ]


def _joint(joint: Joint, first: int) -> dict[str, Any]:
    freedoms = joint.type.freedoms
    limits = joint.limits or (None,) * freedoms
    return {
        "name": joint.name,
        "parent": joint.parent,
        "child": joint.child,
        "at": joint.at.tolist(),
        "childAt": joint.child_at.tolist(),
        "first": first,
        "freedoms": freedoms,
        "limits": [list(item) if item else None for item in limits],
        "cone": joint.cone,
        "coneAxis": None if joint.cone_axis is None else joint.cone_axis.tolist(),
    }
