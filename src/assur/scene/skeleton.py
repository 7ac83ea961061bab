"""The skeleton: where the joints, bars and plates of a mechanism are, in one configuration, from the joint graph."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import Frame, frames
from assur.joint_graph.geometry import characteristic_length
from assur.model.mechanism import Joint, MechanismRecord
from assur.numerics.segments import segment_distances
from assur.scene.companion import Companion

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Rod:
    """A straight part of a link: names of its ends and their positions (2, 3) in the base frame."""

    link: str
    ends: tuple[str, str]
    points: FloatArray
    label: str = ""
    length: str = ""

    @property
    def size(self) -> float:
        """Distance of the ends."""
        return float(np.linalg.norm(self.points[1] - self.points[0]))


@dataclass(frozen=True, eq=False)
class Plate:
    """A link with three or more joints that do not lie on a line: their positions (k, 3)."""

    link: str
    points: FloatArray
    label: str = ""


@dataclass(frozen=True, eq=False)
class JointMark:
    """A joint as it is drawn.

    Attributes:
        at: (3,) its point on the child; of a sliding joint this is where the slider is.
        rail: (3,) its point on the parent.
        axes: (k, 3) unit axes in the base frame.
        grounded: it stands on the base.
        driven: it is actuated.
    """

    joint: Joint
    at: FloatArray
    rail: FloatArray
    axes: FloatArray
    grounded: bool
    driven: bool

    @property
    def slides(self) -> bool:
        """Whether the joint lets its links slide along one another, on a line."""
        return self.joint.type.slides == 1

    @property
    def flat(self) -> bool:
        """Whether they slide on a plane, whose normal is its first axis."""
        return self.joint.type.slides == 2

    @property
    def shown(self) -> FloatArray:
        """Where its symbol stands (3,): of a leg that grows longer, in the middle of it."""
        return (self.at + self.rail) / 2 if self.telescopes else self.at

    @property
    def telescopes(self) -> bool:
        """Whether it makes a leg longer that does not slide on the base."""
        return self.slides and not self.grounded


@dataclass(frozen=True, eq=False)
class Skeleton:
    """A mechanism in one configuration.

    Attributes:
        values: (n,) joint values.
        frames: link -> (orientation (3, 3), origin (3,)).
        points: lettered points and joints -> position (3,).
        size: longest side of the box about all points.
    """

    record: MechanismRecord
    values: FloatArray
    frames: Mapping[str, Frame]
    points: Mapping[str, FloatArray]
    rods: tuple[Rod, ...]
    plates: tuple[Plate, ...]
    marks: tuple[JointMark, ...]

    @property
    def cloud(self) -> FloatArray:
        """Every point of the drawing (k, 3), the rails' own points left out."""
        ends = [rod.points for rod in self.rods] + [plate.points for plate in self.plates]
        return np.concatenate([*ends, np.array([mark.at for mark in self.marks])])

    @property
    def size(self) -> float:
        """Longest side of the box about all points; of a mechanism in one point its characteristic length."""
        return float(np.max(np.ptp(self.cloud, axis=0))) or characteristic_length(self.record)

    def bars(self, but: Collection[str] = ()) -> list[tuple[str, FloatArray]]:
        """Link and ends (2, 3) of everything straight: rods, and what is drawn between any two corners of a plate.

        `but` names links that are left out.
        """
        straight = [(rod.link, rod.points) for rod in self.rods if rod.size > 0]
        straight += [(plate.link, np.array(pair)) for plate in self.plates for pair in combinations(plate.points, 2)]
        return [(link, points) for link, points in straight if link not in but]

    def room(self, start: FloatArray, end: FloatArray, but: Collection[str] = ()) -> float:
        """Least distance of a straight line from what moves, infinite where nothing does; without links of `but`."""
        moving = np.array([points for _, points in self.bars({self.record.base, *but})]).reshape(-1, 2, 3)
        return float(np.min(segment_distances(start, end, moving[:, 0], moving[:, 1]), initial=np.inf))

    @property
    def chains(self) -> tuple[str, ...]:
        """Names of the chains: those of the file, else its repeated limbs."""
        limbs = dict.fromkeys(link.partition(".")[0] for link in self.record.links if "." in link)
        return tuple(self.record.chains) or tuple(limbs)

    def chain_of(self) -> dict[str, str]:
        """Link -> the one chain that it belongs to; the base and the platform belong to none."""
        if not self.record.chains:
            return {link: link.partition(".")[0] for link in self.record.links if "." in link}
        chains: dict[str, set[str]] = {}
        for chain in self.record.chains.values():
            for name in _joints_of(self.record, (*chain.serial, *chain.loop, *chain.tail)):
                joint = self.record.joints[name]
                for link in (joint.parent, joint.child):
                    chains.setdefault(link, set()).add(chain.name)
        shared = (self.record.base, self.record.platform.link)
        return {link: next(iter(names)) for link, names in chains.items() if len(names) == 1 and link not in shared}


def skeleton(record: MechanismRecord, companion: Companion, values: FloatArray) -> Skeleton:
    """The skeleton at joint values (n,).

    >>> from assur.model.registry import load_record
    >>> from assur.scene.companion import Companion
    >>> from assur.kinematics.home import home_values
    >>> record = load_record("fivebar")
    >>> [rod.link for rod in skeleton(record, Companion(), home_values(record)).rods]
    ['crank1', 'crank2', 'rod1', 'rod2']
    """
    placed = frames(record, values)
    points = {
        name: placed[lettered.link][0] @ lettered.at + placed[lettered.link][1]
        for name, lettered in record.points.items()
    }
    points |= {name: _on_parent(placed, joint) for name, joint in record.joints.items()}
    rods, plates = _bodies(record, companion, placed)
    return Skeleton(record, values, placed, points, rods, plates, tuple(_marks(record, placed)))


def _bodies(
    record: MechanismRecord, companion: Companion, placed: Mapping[str, Frame]
) -> tuple[tuple[Rod, ...], tuple[Plate, ...]]:
    rods, plates = [], []
    for bar in companion.bars:
        ends = np.array([link_point(record, placed, bar.link, name) for name in bar.ends])
        rods.append(Rod(bar.link, (bar.ends[0], bar.ends[1]), ends, bar.label, bar.length))
    drawn = {bar.link for bar in companion.bars}
    for link in record.links:
        if link in drawn or link == record.base:
            continue
        names = _distinct(record, placed, link)
        corners = np.array([link_point(record, placed, link, name) for name in names])
        label = companion.links.get(link, "")
        if len(names) < 2:
            continue
        if len(names) == 2 or _collinear(corners):
            first, last = _extremes(corners)
            rods.append(Rod(link, (names[first], names[last]), corners[[first, last]], label))
        else:
            plates.append(Plate(link, corners, label))
    return tuple(rods), tuple(plates)


def _distinct(record: MechanismRecord, placed: Mapping[str, Frame], link: str) -> list[str]:
    """Joints of a link, one for each place; of a link with one joint its lettered points too."""
    joints = [name for name, joint in record.joints.items() if link in (joint.parent, joint.child)]
    letters = [name for name, point in record.points.items() if point.link == link]
    names: list[str] = []
    for name in joints if len(joints) > 1 else (*joints, *letters):
        place = link_point(record, placed, link, name)
        if all(np.linalg.norm(place - link_point(record, placed, link, other)) > 1e-9 for other in names):
            names.append(name)
    return names


def link_point(record: MechanismRecord, placed: Mapping[str, Frame], link: str, name: str) -> FloatArray:
    """Position (3,) of a joint, on the side of that link, or of a lettered point."""
    if name in record.points:
        lettered = record.points[name]
        rotation, origin = placed[lettered.link]
        return np.asarray(rotation @ lettered.at + origin)
    joint = record.joint(name)
    rotation, origin = placed[link]
    return np.asarray(rotation @ (joint.at if link == joint.parent else joint.child_at) + origin)


def _on_parent(placed: Mapping[str, Frame], joint: Joint) -> FloatArray:
    rotation, origin = placed[joint.parent]
    return np.asarray(rotation @ joint.at + origin)


def _marks(record: MechanismRecord, placed: Mapping[str, Frame]) -> list[JointMark]:
    driven = {actuated.coordinate.joint for actuated in record.drives}
    marks = []
    for name, joint in record.joints.items():
        axes = np.array([placed[joint.parent][0] @ axis for axis in joint.axes]).reshape(-1, 3)
        if joint.type.turns == 2:  # its second axis is given in the child's frame
            axes[1] = placed[joint.child][0] @ joint.axes[1]
        at = link_point(record, placed, joint.child, name)
        grounded = record.base in (joint.parent, joint.child)
        marks.append(JointMark(joint, at, _on_parent(placed, joint), axes, grounded, name in driven))
    return marks


def _joints_of(record: MechanismRecord, names: tuple[str, ...]) -> list[str]:
    """Joints by name, a generalised joint as those that it is made of."""
    joints: list[str] = []
    for name in names:
        joints += record.generalised[name].joints if name in record.generalised else [name]
    return joints


def _collinear(points: FloatArray) -> bool:
    spread = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    return bool(spread[1] <= 1e-9 * max(spread[0], 1e-300))


def _extremes(points: FloatArray) -> tuple[int, int]:
    gaps = np.linalg.norm(points[:, None] - points[None], axis=2)
    first, last = np.unravel_index(np.argmax(gaps), gaps.shape)
    return int(first), int(last)
