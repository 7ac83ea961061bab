"""Limbs of a mechanism: a series of joints each, or series that meet at one link, as those of a hybrid limb."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from assur.joint_graph.frames import Frame
from assur.kinematics.limbs.serial import NotSerialError, SerialLimb, composed, inverted, serial_limb
from assur.model.mechanism import MechanismRecord


@dataclass(frozen=True, eq=False)
class BranchedLimb:
    """Series of joints that meet at one link.

    Attributes:
        near: from the base to that link, two at least or one.
        far: from that link to the platform.
    """

    near: tuple[SerialLimb, ...]
    far: tuple[SerialLimb, ...]

    @property
    def joints(self) -> tuple[str, ...]:
        """Names, series by series."""
        return tuple(name for part in (*self.near, *self.far) for name in part.joints)

    def each(self, change: Callable[[SerialLimb], SerialLimb]) -> BranchedLimb:
        """With every series changed."""
        return replace(self, near=tuple(map(change, self.near)), far=tuple(map(change, self.far)))


Limb = SerialLimb | BranchedLimb


def from_platform(series: SerialLimb, platform: Frame) -> SerialLimb:
    """A series to the platform as one from the base to where it begins, the platform held at a frame."""
    displaced = composed(platform, inverted(series.zero))
    back = tuple(motion.moved(*displaced).back for motion in reversed(series.motions))
    return SerialLimb(series.joints, back, displaced)


def limbs_of_middle(limbs: Sequence[Limb]) -> tuple[Limb, ...] | None:
    """The same mechanism, the link where the series of its one branched limb meet taken as the platform; else None.

    >>> from assur.model.registry import load_record
    >>> limbs_of_middle(limbs_of(load_record("planar_3rrr")))
    """
    branched = [limb for limb in limbs if isinstance(limb, BranchedLimb)]
    others = tuple(limb for limb in limbs if isinstance(limb, SerialLimb))
    if len(branched) != 1 or not others:
        return None
    origin = np.eye(3), np.zeros(3)
    return *branched[0].near, BranchedLimb(others, tuple(from_platform(own, origin) for own in branched[0].far))


@lru_cache(maxsize=64)
def limbs_of(record: MechanismRecord) -> tuple[Limb, ...]:
    """The limbs of a mechanism, in the order of their first joints.

    Errors:
        NotSerialError: a limb whose series meet at several links, a screw, or links that hang on others.

    >>> from assur.model.registry import load_record
    >>> [limb.joints for limb in limbs_of(load_record("planar_3rrr"))][0]
    ('leg1.A', 'leg1.B', 'leg1.C')
    """
    ends = {record.base, record.platform.link}
    limbs: list[Limb] = [
        serial_limb(record, (name,), record.base, record.platform.link)
        for name, joint in record.joints.items()
        if {joint.parent, joint.child} == ends
    ]
    limbs += [_limb(record, part) for part in _parts(record, ends)]
    order = [*record.joints]
    return tuple(sorted(limbs, key=lambda limb: min(map(order.index, limb.joints))))


def _limb(record: MechanismRecord, links: set[str]) -> Limb:
    names = _joints_of(record, links)
    if len(names) == len(links) + 1:
        return serial_limb(record, names, record.base, record.platform.link)
    middles = [link for link in links if len(_joints_of(record, {link})) > 2]
    if len(middles) != 1:
        raise NotSerialError(f"{', '.join(sorted(links))} form no series of joints")
    (middle,) = middles
    ends = {record.base, record.platform.link, middle}
    series = [_joints_of(record, part) for part in _parts(record, ends) if part <= links]
    series += [(name,) for name in names if {record.joints[name].parent, record.joints[name].child} <= ends]
    near, far = [], []
    for own in series:
        touched = {link for name in own for link in (record.joints[name].parent, record.joints[name].child)} & ends
        if touched == {record.base, middle}:
            near.append(serial_limb(record, own, record.base, middle))
        elif touched == {middle, record.platform.link}:
            far.append(serial_limb(record, own, middle, record.platform.link))
        else:
            raise NotSerialError(f"{', '.join(own)} are no series from {middle} to the base or the platform")
    return BranchedLimb(tuple(near), tuple(far))


def _joints_of(record: MechanismRecord, links: set[str]) -> tuple[str, ...]:
    return tuple(name for name, joint in record.joints.items() if {joint.parent, joint.child} & links)


def _parts(record: MechanismRecord, ends: set[str]) -> Iterator[set[str]]:
    """Links that hang together, those at the ends left out."""
    left = [link for link in record.links if link not in ends]
    while left:
        part = [left[0]]
        for link in part:
            near = (joint for joint in record.joints.values() if link in (joint.parent, joint.child))
            part += {joint.child if joint.parent == link else joint.parent for joint in near} - ends - {*part}
        yield {*part}
        left = [link for link in left if link not in part]
