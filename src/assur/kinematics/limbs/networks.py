"""Limbs of a mechanism as networks: a series of joints, or parts one after another, of which some lie side by side.

A hybrid limb has series that meet at one link; a leg with a ball screw has the screw beside the guide of its nut.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence, Set
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import Frame, frames
from assur.kinematics.home import home_values
from assur.kinematics.limbs.serial import NotSerialError, SerialLimb, serial_limb
from assur.kinematics.loops.parallelograms import crossed_parallelograms, parallelograms
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class ParallelParts:
    """Limbs between the same two links, each in the frame of the first of these.

    Attributes:
        parts: the limbs, two at least.
        turned: (3, 3) the orientation of the second link that they keep, as hinges of a parallelogram do.
    """

    parts: tuple[Limb, ...]
    turned: FloatArray | None = None

    @property
    def joints(self) -> tuple[str, ...]:
        """Names, part by part."""
        return tuple(name for part in self.parts for name in part.joints)


@dataclass(frozen=True, eq=False)
class SeriesParts:
    """Limbs one after another, each in the frame of the link where it begins.

    Attributes:
        parts: the limbs, two at least.
    """

    parts: tuple[Limb, ...]

    @property
    def joints(self) -> tuple[str, ...]:
        """Names, part by part."""
        return tuple(name for part in self.parts for name in part.joints)

    def halves(self, place: int) -> tuple[Limb, Limb]:
        """Its first parts, and the others."""
        return in_series(self.parts[:place]), in_series(self.parts[place:])


Limb = SerialLimb | ParallelParts | SeriesParts


def in_series(parts: Sequence[Limb]) -> Limb:
    """Limbs one after another; of one alone this one."""
    return parts[0] if len(parts) == 1 else SeriesParts(tuple(parts))


def side_by_side(parts: Sequence[Limb]) -> Limb:
    """Limbs between the same two links; of one alone this one."""
    return parts[0] if len(parts) == 1 else ParallelParts(tuple(parts))


def series_changed(limb: Limb, change: Callable[[SerialLimb], SerialLimb]) -> Limb:
    """A limb with every series of joints changed."""
    if isinstance(limb, SerialLimb):
        return change(limb)
    return replace(limb, parts=tuple(series_changed(part, change) for part in limb.parts))


def from_platform(limb: Limb, platform: Frame) -> Limb:
    """A limb to the platform as one from the base to where it begins, the platform held at a frame."""
    if isinstance(limb, ParallelParts):
        turned = None if limb.turned is None else platform[0] @ limb.turned.T
        return ParallelParts(tuple(from_platform(part, platform) for part in limb.parts), turned)
    if isinstance(limb, SeriesParts):
        last, *others = reversed(limb.parts)
        origin = np.eye(3), np.zeros(3)
        return SeriesParts((from_platform(last, platform), *(from_platform(part, origin) for part in others)))
    return limb.from_platform(platform)


def limbs_of_middle(limbs: Sequence[Limb]) -> tuple[Limb, ...] | None:
    """The same mechanism, the link where the parts of its one branched limb meet taken as the platform; else None.

    >>> from assur.model.registry import load_record
    >>> limbs_of_middle(limbs_of(load_record("planar_3rrr")))
    """
    branched = [limb for limb in limbs if isinstance(limb, SeriesParts)]
    others = [limb for limb in limbs if not isinstance(limb, SeriesParts)]
    if len(branched) != 1 or not others:
        return None
    first = next(k for k, part in enumerate(branched[0].parts) if isinstance(part, ParallelParts))
    near, far = branched[0].halves(first + 1 if first + 1 < len(branched[0].parts) else first)
    around = SeriesParts((side_by_side(others), from_platform(far, (np.eye(3), np.zeros(3)))))
    return (*near.parts, around) if isinstance(near, ParallelParts) else (near, around)


def parallelograms_of_hinges(record: MechanismRecord) -> dict[frozenset[str], str]:
    """Joints of each P(4R) that is a parallelogram at home -> its name; none where one is crossed there.

    >>> from assur.model.registry import load_record
    >>> sorted(parallelograms_of_hinges(load_record("zeng2019")).values())
    ['Pa1', 'Pa2']
    """
    if crossed_parallelograms(record, home_values(record)):
        return {}
    groups = parallelograms(record).values()
    return {frozenset(group.joints): group.name for group in groups if group.kind == "P(4R)"}


@lru_cache(maxsize=64)
def limbs_of(record: MechanismRecord, *, crossed: bool = False) -> tuple[Limb, ...]:
    """The limbs of a mechanism, in the order of their first joints.

    Args:
        record: the mechanism.
        crossed: whether hinges that form a parallelogram at home may also cross.

    Errors:
        NotSerialError: a limb that is no network of parts in series and side by side, or links that hang on others.

    >>> from assur.model.registry import load_record
    >>> [limb.joints for limb in limbs_of(load_record("planar_3rrr"))][0]
    ('leg1.A', 'leg1.B', 'leg1.C')
    """
    ends = record.base, record.platform.link
    whole = _network(record, set(record.links) - {*ends}, *ends)
    if not crossed:
        whole = _uncrossed(record, whole, record.base)
    limbs = whole.parts if isinstance(whole, ParallelParts) else (whole,)
    order = [*record.joints]
    return tuple(sorted(limbs, key=lambda limb: min(map(order.index, limb.joints))))


def _uncrossed(record: MechanismRecord, limb: Limb, near: str) -> Limb:
    """A limb that begins at a link; the orientation that each parallelogram of hinges keeps is that of home."""
    if isinstance(limb, SerialLimb):
        return limb
    parts, start = [], near
    for part in limb.parts:
        parts.append(_uncrossed(record, part, start))
        start = _end(record, part, start) if isinstance(limb, SeriesParts) else near
    if isinstance(limb, ParallelParts) and frozenset(limb.joints) in parallelograms_of_hinges(record):
        placed = frames(record, home_values(record))
        far = _end(record, limb, near)
        return ParallelParts(tuple(parts), placed[near][0].T @ placed[far][0])
    return replace(limb, parts=tuple(parts))


def _end(record: MechanismRecord, limb: Limb, start: str) -> str:
    """The link where a limb ends."""
    if not isinstance(limb, SerialLimb):
        for part in limb.parts[:1] if isinstance(limb, ParallelParts) else limb.parts:
            start = _end(record, part, start)
        return start
    for name in limb.joints:
        joint = record.joints[name]
        start = joint.child if joint.parent == start else joint.parent
    return start


def _network(record: MechanismRecord, links: Set[str], near: str, far: str) -> Limb:
    """All that joins two links by way of others."""
    parts = [_series(record, part, near, far) for part in _connected(record, links)]
    parts += [serial_limb(record, (name,), near, far) for name in _direct(record, near, far)]
    if not parts:
        raise NotSerialError(f"nothing joins {near} and {far}")
    return side_by_side(parts)


def _series(record: MechanismRecord, links: Set[str], near: str, far: str) -> Limb:
    """Links that hang together, between two others, cut at each one through which every way leads."""
    reached = {link: _reached(record, near, links - {link}) for link in links}
    cuts = sorted((link for link in links if far not in reached[link]), key=lambda link: len(reached[link]))
    inner = [*_connected(record, links - {*cuts})]
    if not cuts or far not in _reached(record, near, links):
        raise NotSerialError(f"{', '.join(sorted(links))} are no limb in series from {near} to {far}")
    parts: list[Limb] = []
    run: list[str] = []
    begun = near
    for start, end in pairwise([near, *cuts, far]):
        own = [part for part in inner if _beside(record, part) == {start, end}]
        inner = [part for part in inner if part not in own]
        direct = _direct(record, start, end)
        if not own and len(direct) == 1:
            run += direct
            continue
        if run:
            parts.append(serial_limb(record, run, begun, start))
        parts.append(_network(record, set().union(*own), start, end))
        run, begun = [], end
    if inner:
        raise NotSerialError(f"{', '.join(sorted(inner[0]))} hang on others")
    if run:
        parts.append(serial_limb(record, run, begun, far))
    return in_series(parts)


def _direct(record: MechanismRecord, near: str, far: str) -> list[str]:
    """Names of the joints of two links."""
    return [name for name, joint in record.joints.items() if {joint.parent, joint.child} == {near, far}]


def _beside(record: MechanismRecord, links: Set[str]) -> set[str]:
    """Links that are joined to some of these, and none of them."""
    ends = [{joint.parent, joint.child} for joint in record.joints.values()]
    return {link for pair in ends if pair & links for link in pair - links}


def _reached(record: MechanismRecord, start: str, links: Set[str]) -> set[str]:
    """The links to which ways by way of these lead, and their ends."""
    met = {start}
    more = _beside(record, met) & links
    while more:
        met |= more
        more = _beside(record, met & links) - met
    return met


def _connected(record: MechanismRecord, links: Set[str]) -> Iterator[set[str]]:
    """Links that hang together by way of these, in their order in the file."""
    left = [link for link in record.links if link in links]
    while left:
        part = _reached(record, left[0], links) & links
        yield part
        left = [link for link in left if link not in part]
