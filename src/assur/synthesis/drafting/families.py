"""Families: limbs that are one limb turned about z, which a file writes once as a template."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Hashable, Sequence
from dataclasses import dataclass

import numpy as np

from assur.topology.chains import Chain, ChainJoint, Element, InnerLoop, Parallelogram, flattened
from assur.topology.directions import EXACT, Vector

APART = 5.0
"""Degrees between two limbs of a family, at least."""

FLAT = 1e-9


@dataclass(frozen=True)
class Family:
    """Limbs that are turns of one about z.

    Attributes:
        pattern: the chain that they are turns of, by its place.
        members: their places among the chains.
        angles: from the pattern to each, in degrees; 0 of a limb alone.
    """

    pattern: int
    members: tuple[int, ...]
    angles: tuple[float, ...]

    @property
    def even(self) -> bool:
        """Whether the limbs stand evenly around z, in order."""
        step = 360.0 / len(self.angles)
        return len(self.angles) > 1 and all(
            abs(angle - step * number) < FLAT for number, angle in enumerate(self.angles)
        )


def families(chains: Sequence[Chain]) -> tuple[Family, ...]:
    """The limbs sorted into families, each limb into the first that it fits, in the order of the first limbs.

    >>> from assur.topology.notation import parse_chains
    >>> [item.angles for item in families(parse_chains(["R[z] R[z] R[z]"] * 3))]
    [(0.0, 120.0, 240.0)]
    >>> [item.members for item in families(parse_chains(["P[x] R[x]", "P[y] R[y]", "P[z] R[z]"]))]
    [(0, 1), (2,)]
    """
    shared = shared_labels(chains)
    kinds = [_kind(chain, shared) for chain in chains]
    groups: list[tuple[list[int], list[float]]] = []
    for number, chain in enumerate(chains):
        alike = kinds.count(kinds[number])
        for members, angles in groups:
            if kinds[members[0]] != kinds[number]:
                continue
            angle = _turn(chains[members[0]], chain, angles, len(angles) * 360.0 / alike)
            if angle is not None:
                members.append(number)
                angles.append(angle)
                break
        else:
            groups.append(([number], [0.0]))
    return tuple(Family(members[0], tuple(members), tuple(angles)) for members, angles in groups)


def apart(family: Family, parts: int) -> tuple[Family, ...]:
    """A family taken apart: every `parts`-th limb together, turns of the same pattern.

    >>> apart(Family(0, (0, 1, 2, 3), (0.0, 90.0, 180.0, 270.0)), 2)[1]
    Family(pattern=0, members=(1, 3), angles=(90.0, 270.0))
    """
    return tuple(
        Family(family.pattern, family.members[start::parts], family.angles[start::parts]) for start in range(parts)
    )


def shared_labels(chains: Sequence[Chain]) -> frozenset[str]:
    """Labels of points that several limbs have in common.

    >>> from assur.topology.notation import parse_chains
    >>> sorted(shared_labels(parse_chains(["R[x]@O R[y]@O", "R[y]@O R[x]@O R[z]@B S@B"])))
    ['O']
    """
    counts = Counter(label for chain in chains for label in {_label(joint) for joint in chain.joints} if label)
    return frozenset(label for label, count in counts.items() if count > 1)


def _label(joint: ChainJoint | Parallelogram) -> str:
    return joint.point if isinstance(joint, ChainJoint) else ""


def _kind(chain: Chain, shared: frozenset[str]) -> Hashable:
    """What two limbs of a family have in common beside their directions."""
    private: dict[str, int] = {}

    def of(element: Element) -> Hashable:
        if isinstance(element, InnerLoop):
            return tuple(tuple(map(of, branch)) for branch in element.branches)
        if isinstance(element, Parallelogram):
            return (element.kind, element.general)
        label = element.point
        mark = label if label in shared or not label else private.setdefault(label, len(private))
        return (element.type.letter, element.general, mark)

    return tuple(map(of, chain.elements))


def _turn(first: Chain, other: Chain, taken: Sequence[float], preferred: float) -> float | None:
    """The angle (deg) about z from a limb to another, of several possible ones that nearest to the preferred one."""
    possible = turns(_axes(first), _axes(other))
    if possible is None:
        possible = ([preferred], [])
    for some in possible:
        free = [angle for angle in some if all(_gap(angle, other_angle) > APART for other_angle in taken)]
        if free:
            return min(free, key=lambda angle: _gap(angle, preferred))
    return None


def turns(first: Sequence[Vector], other: Sequence[Vector]) -> tuple[list[float], list[float]] | None:
    """Angles (deg) of the rotations about z that take each axis into the other one; None where every angle does.

    First those that keep the senses of all axes, then those that turn some of them round.

    >>> turns([(0.0, 1.0, 0.0)], [(-1.0, 0.0, 0.0)]), turns([(0.0, 0.0, 1.0)], [(0.0, 0.0, 1.0)])
    (([90.0], [270.0]), None)
    """
    level = [place for place, axis in enumerate(first) if math.hypot(axis[0], axis[1]) > EXACT]
    if not level:
        same = all(math.hypot(axis[0], axis[1]) < EXACT for axis in other)
        return None if same else ([], [])
    angles: tuple[list[float], list[float]] = ([], [])
    start, end = first[level[0]], other[level[0]]
    for sense in (1.0, -1.0):
        angle = math.atan2(sense * end[1], sense * end[0]) - math.atan2(start[1], start[0])
        fits = [_fits(_turned(axis, angle), goal) for axis, goal in zip(first, other, strict=True)]
        if all(fits):
            angles[2 - min(fits)].append(round(math.degrees(angle) % 360.0, 9) % 360.0)
    return angles


def _fits(axis: Vector, goal: Vector) -> int:
    """2 for the same direction, 1 for the opposite one, 0 for another."""
    if np.linalg.norm(np.subtract(axis, goal)) < EXACT:
        return 2
    return int(np.linalg.norm(np.add(axis, goal)) < EXACT)


def _turned(axis: Vector, angle: float) -> Vector:
    cosine, sine = math.cos(angle), math.sin(angle)
    return (cosine * axis[0] - sine * axis[1], sine * axis[0] + cosine * axis[1], axis[2])


def _gap(first: float, second: float) -> float:
    """Degrees between two directions around z."""
    return abs((first - second + 180.0) % 360.0 - 180.0)


def _axes(chain: Chain) -> list[Vector]:
    """The axes that were written."""
    axes: list[Vector] = []
    for joint in flattened(chain.elements):
        if not joint.general:
            axes += joint.axes if isinstance(joint, ChainJoint) else (joint.axis,)
    return axes
