"""The structure of a mechanism: rigid bodies, the beams between them, and the joints that let them move.

Bodies are rigid links, and the nodes of elastic ones. Joints alone hold bodies together rigidly, so a spanning forest
over the joints leaves few unknowns: six of each tree's root, none of the base, and all joint coordinates. Passive
joints need no more: nothing holds their coordinates. Loops that rigid links close stay as conditions; where links bend
there are none, however often they hold the same.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.joint_graph.tree import joint_graph
from assur.machine.elasticity.beams import Beam
from assur.machine.elasticity.skeletons import PLATFORM, BarSkeleton, elastic, skeleton
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
        paths: (B, n) 1, -1 or 0: which joint coordinates lie between the tree's root and the body.
        loops: (v, n) the same around each loop that rigid bodies close.
        beams: all of them.
        platform: the body that the platform's point is on.
        sides: joint -> the bodies of its parent and of its child.
        skeletons: of the elastic links.
        stiffness: (n,) of the actuators at their joint coordinates, N/m or N m/rad; 0 of passive ones.
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
    stiffness: FloatArray

    @property
    def unknowns(self) -> int:
        """Of the roots, then of the joints."""
        return 6 * int(self.roots.max()) + int(self.paths.shape[1])


@lru_cache(maxsize=64)
def structure(record: MechanismRecord, *, shear: bool = True, rigid: bool = False) -> ElasticStructure:
    """The structure of a mechanism; with `rigid` no link bends.

    Errors:
        UsageError: actuators without stiffness; what `skeleton` refuses.

    >>> from assur.model.registry import load_record
    >>> own = structure(load_record("zeng2019"))
    >>> len(own.bodies), len(own.beams), own.unknowns, len(own.loops)
    (23, 9, 47, 0)
    """
    stiffness = actuator_stiffness(record)
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
    roots, paths, loops = _forest(record, len(bodies), sides)
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
    return ElasticStructure(record, bodies, roots, paths, loops, beams, platform, sides, skeletons, stiffness)


def actuator_stiffness(record: MechanismRecord) -> FloatArray:
    """Stiffness (n,) at the joint coordinates, 0 where nothing drives.

    Errors:
        UsageError: an actuator of which the file says none.
    """
    numbers = np.zeros(len(record.coordinates))
    lacking = []
    for drive in record.drives:
        label = record.coordinate_label(drive.coordinate)
        actuator = record.machine.actuators.get(label)
        if actuator is None or actuator.stiffness is None:
            lacking.append((label, drive.coordinate.kind))
        else:
            numbers[drive.coordinate.index] = actuator.stiffness
    if lacking:
        label, kind = lacking[0]
        told = "1e7 }, in N/m" if kind == "length" else "1e5 }, in N m/rad"
        key = label if label.count(".") == 0 or label.split(".")[0] in record.joints else label.split(".", 1)[1]
        raise UsageError(
            f"{record.name}: no stiffness of {', '.join(name for name, _ in lacking)}",
            hint=f"say it in [actuators]: {key} = {{ stiffness = {told}",
        )
    return numbers


def _forest(
    record: MechanismRecord, count: int, sides: dict[str, tuple[int, int]]
) -> tuple[IntArray, FloatArray, FloatArray]:
    """Trees over the joints, the base's first: root of each body, paths, and the loops that are left."""
    slices, width = joint_graph(record).slices, len(record.coordinates)
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
                paths[other, slices[name]] = 1.0 if body == parent else -1.0
                reached.append(other)
    loops = []
    for name, (parent, child) in sides.items():
        if name not in used:
            around = paths[parent] - paths[child]
            around[slices[name]] = 1.0
            loops.append(around)
    return roots, paths, np.array(loops).reshape(-1, width)
