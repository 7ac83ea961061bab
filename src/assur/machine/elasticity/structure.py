"""The structure of a mechanism: rigid bodies, the beams between them, and the joints that let them move.

Bodies are rigid links, and the nodes of elastic ones. Joints alone hold bodies together rigidly, so a spanning forest
over the joints leaves few unknowns: six of each tree's root, none of the base, and all joint coordinates. Passive
joints need no more: nothing holds their coordinates. Joints that give way have more of them, and rotors behind gears
theirs. Loops that rigid links close stay as conditions; where links bend
there are none, however often they hold the same.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.tree import joint_graph
from assur.machine.elasticity.beams import Beam
from assur.machine.elasticity.skeletons import PLATFORM, BarSkeleton, elastic, skeleton
from assur.machine.elasticity.springs import Springs, VirtualJoint, springs, virtual_joints
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class StructureBeam:
    """A beam between two bodies of a link.

    Attributes:
        link: its link.
        bodies: where its first and its second end are.
        beam: what it is like.
        first, second: (3,) its ends in the link's frame, in m.
        axes: (3, 3) its axes as columns in the link's frame.
    """

    link: str
    bodies: tuple[int, int]
    beam: Beam
    first: FloatArray
    second: FloatArray
    axes: FloatArray


@dataclass(frozen=True, eq=False)
class ElasticStructure:
    """What holds a mechanism, whatever its pose.

    Attributes:
        record: the mechanism.
        bodies: (link, node) of each; the base is the first, and rigid links have the one node 0.
        roots: (B,) the tree that each body belongs to, 0 that of the base.
        paths: (B, w) 1, -1 or 0: which coordinates lie between the tree's root and the body; those of joints, then of
            virtual joints, then of rotors behind gears, which lie nowhere.
        loops: (v, w) the same around each loop that rigid bodies close.
        beams: all of them.
        platform: the body that the platform's point is on.
        sides: joint -> the bodies of its parent and of its child.
        skeletons: of the elastic links.
        virtual: joint -> how it gives way where it should hold.
        springs: at the coordinates.
    """

    record: MechanismRecord
    bodies: tuple[tuple[str, int], ...]
    roots: IntArray
    paths: FloatArray
    loops: FloatArray
    beams: tuple[StructureBeam, ...]
    platform: int
    sides: dict[str, tuple[int, int]]
    skeletons: dict[str, BarSkeleton]
    virtual: dict[str, VirtualJoint]
    springs: Springs

    @property
    def unknowns(self) -> int:
        """Of the roots, then the coordinates."""
        return int(self.coordinates.stop)

    @property
    def coordinates(self) -> slice:
        """Where the coordinates are among the unknowns."""
        roots = 6 * int(self.roots.max())
        return slice(roots, roots + int(self.paths.shape[1]))


@lru_cache(maxsize=64)
def structure(record: MechanismRecord, *, shear: bool = True, rigid: bool = False) -> ElasticStructure:
    """The structure of a mechanism; with `rigid` neither links nor joints give way.

    Errors:
        UsageError: actuators without stiffness; what `skeleton` refuses.

    >>> from assur.model.registry import load_record
    >>> own = structure(load_record("zeng2019"))
    >>> len(own.bodies), len(own.beams), own.unknowns, len(own.loops)
    (23, 9, 47, 0)
    """
    virtual = {} if rigid else virtual_joints(record)
    own_springs = springs(record, virtual)
    bent = [] if rigid else [link for link in record.links if elastic(record, link)]
    skeletons = {link: skeleton(record, link, shear=shear) for link in bent}
    links = [record.base, *(link for link in record.links if link != record.base)]
    bodies = tuple(
        (link, node) for link in links for node in range(len(skeletons[link].nodes) if link in skeletons else 1)
    )
    number = {body: place for place, body in enumerate(bodies)}

    def at(link: str, joint: str) -> int:
        return number[link, skeletons[link].ties[joint] if link in skeletons else 0]

    sides = {name: (at(joint.parent, name), at(joint.child, name)) for name, joint in record.joints.items()}
    columns = _columns(record, virtual)
    roots, paths, loops = _forest(len(bodies), sides, (columns, len(own_springs.rotors)))
    beams = tuple(
        StructureBeam(
            link=link,
            bodies=(number[link, bar.nodes[0]], number[link, bar.nodes[1]]),
            beam=bar.beam,
            first=own.nodes[bar.nodes[0]],
            second=own.nodes[bar.nodes[1]],
            axes=bar.axes,
        )
        for link, own in skeletons.items()
        for bar in own.bars
    )
    platform = at(record.platform.link, PLATFORM)
    return ElasticStructure(
        record, bodies, roots, paths, loops, beams, platform, sides, skeletons, virtual, own_springs
    )


def yields(record: MechanismRecord) -> bool:
    """Whether anything but the actuators gives way: a link, or a joint.

    >>> from assur.model.registry import load_record
    >>> yields(load_record("zeng2019"))
    True
    """
    return bool(record.machine.compliances) or any(elastic(record, link) for link in record.links)


def _columns(record: MechanismRecord, virtual: Mapping[str, VirtualJoint]) -> dict[str, list[int]]:
    """Coordinates of each joint, its own and those of its virtual joint."""
    columns = {name: list(range(part.start, part.stop)) for name, part in joint_graph(record).slices.items()}
    first = len(record.coordinates)
    for name, joint in virtual.items():
        columns[name] += range(first, first + len(joint.stiffness))
        first += len(joint.stiffness)
    return columns


def _forest(
    count: int, sides: dict[str, tuple[int, int]], coordinates: tuple[dict[str, list[int]], int]
) -> tuple[IntArray, FloatArray, FloatArray]:
    """Trees over the joints, the base's first: root of each body, paths, and the loops that are left.

    `coordinates` are those of each joint, and how many there are.
    """
    columns, width = coordinates
    roots, paths = np.full(count, -1), np.zeros((count, width))
    used: set[str] = set()
    for start in range(count):
        if roots[start] >= 0:
            continue
        tree = int(roots.max()) + 1
        roots[start] = tree
        reached = [start]
        for body in reached:
            for name, (parent, child) in sides.items():
                if name in used or body not in (parent, child):
                    continue
                other = child if body == parent else parent
                if roots[other] >= 0:
                    continue
                used.add(name)
                roots[other] = tree
                paths[other] = paths[body]
                paths[other, columns[name]] = 1.0 if body == parent else -1.0
                reached.append(other)
    loops = []
    for name, (parent, child) in sides.items():
        if name not in used:
            around = paths[parent] - paths[child]
            around[columns[name]] = 1.0
            loops.append(around)
    return roots, paths, np.array(loops).reshape(-1, width)
