"""Screws of joints and twists of links in SI units: what velocities and accelerations of all links are made of.

A joint rate is in m/s or rad/s; those of a ball joint are its angular velocity along the parent's axes. A twist is the
angular velocity, then the velocity of the body point at the base's origin. An acceleration is the rate of a twist seen
from the base: where a joint turns or slides along an axis that moves with twist V, its screw S changes by V x S.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.configuration import Configuration
from assur.joint_graph.frames import flat
from assur.joint_graph.programs import Outputs, program
from assur.joint_graph.tree import joint_graph
from assur.joints.steps import STILL
from assur.kinematics.validation.check import METRES
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS, Pose, rate_names

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Paths:
    """Which joint coordinates (n,) lie between the base and each link, in each loop, and before each other in a joint.

    Attributes:
        links: names, the base left out.
        of_links: (L, n) 1, -1 or 0.
        of_loops: (v, n) the same around each loop.
        of_parents: (n, n) row i: the coordinates that carry the axis of coordinate i.
    """

    links: tuple[str, ...]
    of_links: FloatArray
    of_loops: FloatArray
    of_parents: FloatArray


@lru_cache(maxsize=64)
def paths(record: MechanismRecord) -> Paths:
    """The paths of a joint graph.

    >>> from assur.model.registry import load_record
    >>> own = paths(load_record("fivebar"))
    >>> own.links, own.of_loops.astype(int).tolist()
    (('crank1', 'crank2', 'rod1', 'rod2'), [[1, -1, 1, -1, 1]])
    """
    graph, count = joint_graph(record), len(record.coordinates)

    def row(way: dict[str, int]) -> FloatArray:
        numbers = np.zeros(count)
        for name, sense in way.items():
            numbers[graph.slices[name]] = sense
        return numbers

    links = tuple(link for link in record.links if link != record.base)
    parents = np.zeros((count, count))
    for name, joint in record.joints.items():
        first = graph.slices[name].start
        for step, place in joint.type.places:
            for own in range(len(step.kinds)):
                parents[first + place + own] = row(dict(graph.paths[joint.parent]))
                parents[first + place + own, first : first + place] += 1.0
    return Paths(
        links,
        np.array([row(dict(graph.paths[link])) for link in links]),
        np.array([row({cut.name: 1, **way}) for cut, way in zip(graph.cut, graph.loops, strict=True)]).reshape(
            -1, count
        ),
        parents,
    )


def joint_screws(record: MechanismRecord, values: FloatArray) -> FloatArray:
    """Unit twists (N, 6, n) of the joint coordinates at joint values (N, n)."""
    numbers = program(record, _screws)(record, flat(record, values))
    screws = np.moveaxis(numbers.reshape(len(record.coordinates), 6, len(values)), -1, 0).swapaxes(1, 2).copy()
    metre = METRES[record.unit]
    screws[:, 3:] *= metre
    return screws / rate_units(record)


def rate_units(record: MechanismRecord) -> FloatArray:
    """What a joint rate (n,) in the mechanism's units is multiplied by to be in SI units."""
    return np.array([METRES[record.unit] if item.kind == "length" else 1.0 for item in record.coordinates])


def rate_metres(record: MechanismRecord) -> FloatArray:
    """The same for a rate (k,) of the pose."""
    return _metres(record, rate_names(record.platform.pose))


def pose_metres(record: MechanismRecord) -> FloatArray:
    """The same for a coordinate (m,) of the pose.

    >>> from assur.model.registry import load_record
    >>> pose_metres(load_record("planar_3rrr")).tolist()
    [0.001, 0.001, 1.0]
    """
    return _metres(record, record.platform.pose)


def _metres(record: MechanismRecord, names: Pose) -> FloatArray:
    return np.array([METRES[record.unit] if name in LENGTHS else 1.0 for name in names])


def crossed(first: FloatArray, second: FloatArray) -> FloatArray:
    """The rate (..., 6) of twists (..., 6) that are fixed in bodies with others: the commutator of motions."""
    turning, moving = first[..., :3], first[..., 3:]
    angular = np.cross(turning, second[..., :3])
    return np.concatenate([angular, np.cross(turning, second[..., 3:]) + np.cross(moving, second[..., :3])], axis=-1)


def screw_rates(record: MechanismRecord, screws: FloatArray, rates: FloatArray) -> FloatArray:
    """How fast screws (N, 6, n) change, times their rates: (N, n, 6), at joint rates (N, n)."""
    moved = np.swapaxes(screws, 1, 2) * rates[..., None]  # (N, n, 6)
    return crossed(np.einsum("ij,njk->nik", paths(record).of_parents, moved), moved)


def _screws(configuration: Configuration) -> Outputs:
    still = replace(configuration, rates={})
    twists = [twist for joint in configuration.graph.joints for twist in still.twists(joint, STILL)]
    return {
        f"{column} {k}": number
        for column, (angular, velocity) in enumerate(twists)
        for k, number in enumerate((*angular, *velocity))
    }
