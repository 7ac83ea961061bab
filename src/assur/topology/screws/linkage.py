"""A linkage: links and joints placed in space, in one assembled configuration, by the screws of its joints.

The second route of topology stands on it. Screws are (omega, v at the base's origin), in the base frame at
the home configuration; a joint with several freedoms is a row of screws in the order in which they move.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from assur.errors import UnknownNameError
from assur.joints.joint_type import JointType

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class LinkageJoint:
    """A joint between two links.

    Attributes:
        screws: (f, 6) unit screws at home, moving the child against the parent: a rotation (u, p x u), a
            translation (0, u), a helix (u, p x u + h u) with h the advance per rad. The screw k stands as
            it is when the screws before it are at rest (child side last).
        point: (3,) a point of the joint at home.
    """

    name: str
    type: JointType
    parent: str
    child: str
    screws: FloatArray
    point: FloatArray


@dataclass(frozen=True)
class Group:
    """Joints between two links that count as one generalised joint: a parallelogram."""

    name: str
    kind: str
    joints: tuple[str, ...]
    parent: str
    child: str


@dataclass(frozen=True, eq=False)
class Linkage:
    """Links and joints of a mechanism, of a limb or of a part of either, closed at home.

    Attributes:
        joints: by name; links are the names that occur in them.
        point: (3,) the platform's base point O' at home.
        groups: generalised joints by name.
        inputs: actuated components, (joint, index of the component) each, in order.
        length: a length of the size of the linkage, to measure translations with.
        parted: parallelograms that are no generalised joint, because other joints stand on a bar of theirs.

    Errors:
        UnknownNameError: an input or a joint of a group that is not among the joints.
    """

    joints: Mapping[str, LinkageJoint]
    base: str
    platform: str
    point: FloatArray
    groups: Mapping[str, Group] = field(default_factory=dict)
    inputs: tuple[tuple[str, int], ...] = ()
    length: float = 1.0
    parted: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        inside = [name for group in self.groups.values() for name in group.joints]
        for name in (*inside, *(joint for joint, _ in self.inputs)):
            if name not in self.joints:
                raise UnknownNameError("joint", name, self.joints)

    @property
    def links(self) -> tuple[str, ...]:
        """Names of the links, in the order in which joints name them."""
        return tuple(dict.fromkeys(link for joint in self.joints.values() for link in (joint.parent, joint.child)))

    @property
    def slices(self) -> dict[str, slice]:
        """Joint -> its place in the vector of joint values."""
        places, start = {}, 0
        for name, joint in self.joints.items():
            places[name] = slice(start, start + len(joint.screws))
            start += len(joint.screws)
        return places


def part(linkage: Linkage, names: Collection[str], platform: str, point: FloatArray | None = None) -> Linkage:
    """Some joints and parallelograms of a linkage by themselves, such as a limb that is displaced freely on its own.

    Args:
        linkage: the whole.
        names: of joints, or of groups for all their joints.
        platform: the link that is looked at.
        point: (3,) O' of that link at home, by default where the platform's is.

    Errors:
        UnknownNameError: a name that is neither a joint nor a group.
    """
    for name in names:
        if name not in linkage.joints and name not in linkage.groups:
            raise UnknownNameError("joint", name, [*linkage.joints, *linkage.groups])
    inside = {name for group in names if group in linkage.groups for name in linkage.groups[group].joints}
    joints = {name: joint for name, joint in linkage.joints.items() if name in names or name in inside}
    return dataclasses.replace(
        linkage,
        joints=joints,
        platform=platform,
        point=linkage.point if point is None else point,
        groups={name: group for name, group in linkage.groups.items() if set(group.joints) <= set(joints)},
        inputs=tuple(actuated for actuated in linkage.inputs if actuated[0] in joints),
    )
