"""The joint graph as plain data: links, joints with their axes, the spanning tree, and what closes its loops."""

from __future__ import annotations

from typing import Any

from assur.joint_graph.tree import joint_graph
from assur.kinematics.turns import counted, joint_units
from assur.model.mechanism import Joint, MechanismRecord


def graph(record: MechanismRecord) -> dict[str, Any]:
    """Everything that closes the loops of a mechanism somewhere else, in lengths and rad, every number to its last bit.

    >>> from assur.model.registry import load_record
    >>> found = graph(load_record("fivebar"))
    >>> [item["name"] for item in found["joints"]], found["cut"], len(found["tree"])
    (['A1', 'A2', 'B1', 'B2', 'P'], [4], 4)
    """
    found = joint_graph(record)
    place = {name: k for k, name in enumerate(record.joints)}
    return {
        "base": record.base,
        "links": list(record.links),
        "joints": [_joint(joint, found.slices[name].start) for name, joint in record.joints.items()],
        "tree": [{"joint": place[joint.name], "forward": forward} for joint, forward in found.tree],
        "cut": [place[joint.name] for joint in found.cut],
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
        "type": joint.type.letter,
        "parent": joint.parent,
        "child": joint.child,
        "at": joint.at.tolist(),
        "childAt": joint.child_at.tolist(),
        "axes": joint.axes.tolist(),
        "turn": joint.turn.tolist(),
        "pitch": joint.pitch,
        "first": first,
        "freedoms": freedoms,
        "limits": [list(item) if item else None for item in limits],
        "cone": joint.cone,
        "coneAxis": None if joint.cone_axis is None else joint.cone_axis.tolist(),
    }
