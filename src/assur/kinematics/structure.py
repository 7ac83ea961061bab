"""A mechanism with dimensions as topology sees it: a linkage, closed at home."""

from __future__ import annotations

import numpy as np

from assur.joint_graph.frames import Frame, frames, screws
from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.tree import joint_graph
from assur.kinematics.home import home_values
from assur.model.mechanism import Joint, MechanismRecord
from assur.numerics.rotations import about_axis, cross, from_vector, to_vector
from assur.topology.screws.linkage import FloatArray, Group, Linkage, LinkageJoint


def linkage(record: MechanismRecord) -> Linkage:
    """The joint graph in its closed home, lengths in the mechanism's unit; a joint with an alias is called by it.

    >>> from assur.model.registry import load_record
    >>> len(linkage(load_record("zeng2019")).joints)
    17
    """
    values = home_values(record)
    placed = frames(record, values)
    twists = screws(record, values)
    slices = joint_graph(record).slices
    called = {name: item.alias or name for name, item in record.joints.items()}
    joints = {}
    for name, item in record.joints.items():
        point = _point(item, placed)
        rows = _about(point) if item.type.ball else twists[:, slices[name]].T
        if item.type.turning:  # where what slid has carried it
            point = point + _slid(item, values[slices[name]], placed)
        joints[called[name]] = LinkageJoint(called[name], item.type, item.parent, item.child, rows, point)
    groups = {
        name: Group(name, item.kind, tuple(called[inner] for inner in item.joints), item.parent, item.child)
        for name, item in record.generalised.items()
    }
    rotation, origin = placed[record.platform.link]
    return Linkage(
        joints=joints,
        base=record.base,
        platform=record.platform.link,
        point=rotation @ record.platform.point + origin,
        groups=groups,
        inputs=tuple(
            (called[name], index - slices[name].start)
            for name, index in ((item.coordinate.joint, item.coordinate.index) for item in record.drives)
        ),
        length=characteristic_length(record),
    )


def values_from_home(record: MechanismRecord, moved: FloatArray) -> FloatArray:
    """Joint values (n,) of a mechanism from those of its linkage (n,), which are counted from home.

    A ball joint turns in the linkage about the base's three axes as they stand at home, one after the other.

    >>> from assur.model.registry import load_record
    >>> record = load_record("three_rps")
    >>> bool(np.allclose(values_from_home(record, np.zeros(15)), home_values(record)))
    True
    """
    values = home_values(record) + moved
    placed = frames(record, home_values(record))
    for name, item in record.joints.items():
        if item.type.ball:
            place, parent = joint_graph(record).slices[name], placed[item.parent][0]
            turned = np.linalg.multi_dot([about_axis(*pair) for pair in zip(np.eye(3), moved[place], strict=True)])
            before = from_vector(home_values(record)[place])
            values[place] = to_vector(parent.T @ turned @ parent @ before)
    return np.asarray(values)


def _point(joint: Joint, placed: dict[str, Frame]) -> FloatArray:
    rotation, origin = placed[joint.parent]
    point: FloatArray = rotation @ joint.at + origin
    return point


def _slid(joint: Joint, values: FloatArray, placed: dict[str, Frame]) -> FloatArray:
    shift = np.zeros(3)
    for step, first in joint.type.places:
        if step.kind == "slide":
            shift = shift + values[first] * joint.axes[step.direction]
    return np.asarray(placed[joint.parent][0] @ shift)


def _about(point: FloatArray) -> FloatArray:
    """Unit screws (3, 6) about the base's axes through a point: an S joint's rates at home are not of unit length."""
    return np.hstack([np.eye(3), cross(point, np.eye(3))])
