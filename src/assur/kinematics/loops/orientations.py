"""Which links turn about one fixed direction, each on its own circle, and which do not turn at all.

Joints that cannot turn join links to bodies. A body that hangs on another by axes of one direction u has, against it,
the orientation Rot(u, psi) C. If it hangs on it by axes of u and, by other joints, by axes of v as well, it cannot
turn: Rot(u, a) C1 = Rot(v, b) C2 has one solution at most (the rule r1(u) ∩ r1(v) = r0 of the theory). The two are
one body then, and the argument goes round again. Three bodies, each of which turns against each other about one
direction, are a spherical triangle and do not turn either, but can stand in two ways. A body all of whose joints are on
one that turns about u, with axes of one direction v across u, is a rod on a hinge: Rot(u, psi) Rot(v, phi) C, as the
rods of a parallelogram that a limb turns.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from math import hypot

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.loops.hinges import (
    HingeTurn,
    NoAssemblyError,
    NotCirclesError,
    Stiff,
    rods_between_balls,
    triangles_of_balls,
    turns_of_joints,
    turns_of_parallelograms,
)
from assur.model.mechanism import MechanismRecord
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
EXACT = 1e-9


@dataclass(frozen=True, eq=False)
class Turning:
    """Orientation of a link: Rot(axis, psi) rotation, psi the angle of circle number `circle`; fixed where it is None.

    A rod on a hinge has Rot(axis, psi) Rot(hinge, phi) rotation, and a number of its own, `rod`. A rod between ball
    joints has the number `ball`, which two rods that stay parallel share, and in its frame the direction `line`. A link
    on ball joints alone has the number `triangle`, and in its frame three of their centres, `corners` (3, 3).
    """

    rotation: FloatArray
    circle: int | None = None
    axis: FloatArray | None = None
    hinge: FloatArray | None = None
    rod: int | None = None
    line: FloatArray | None = None
    ball: int | None = None
    corners: FloatArray | None = None
    triangle: int | None = None

    @property
    def still(self) -> bool:
        """Whether the link stands in one orientation."""
        return self.circle is None and self.line is None and self.corners is None


def turnings(
    record: MechanismRecord,
    locked: Mapping[int, float],
    platform: Stiff | HingeTurn | None,
    *,
    parallel: Collection[str],
    alike: Sequence[Stiff] = (),
) -> list[dict[str, Turning]]:
    """Orientations of all links, and of the crosses of universal joints, in each way in which they can stand.

    Args:
        record: the mechanism.
        locked: index in the joint values -> value.
        platform: its orientation in the base where that is held, or may turn about one direction.
        parallel: parallelograms that stay such; others are no more than their four joints.
        alike: links that are known not to turn against each other.

    Errors:
        NotCirclesError: a link that turns otherwise. NoAssemblyError: orientations that contradict each other.

    >>> from assur.model.registry import load_record
    >>> (found,) = turnings(load_record("zeng2019"), {}, None, parallel=("Pa1", "Pa2"))
    >>> [link for link, group in found.items() if group.circle is not None]
    ['link9', 'link10', 'link12', 'link4a', 'link4b', 'link7a', 'link7b']
    """
    joints = [*turns_of_joints(record, locked), *turns_of_parallelograms(record, parallel), *alike]
    if platform is not None:
        joints.append(platform)
    return [_turnings(record, parallel, way) for way in _stiffened(record.base, joints)]


def _stiffened(base: str, joints: Sequence[Stiff | HingeTurn]) -> list[list[Stiff | HingeTurn]]:
    """The joints, and what follows from them about bodies that do not turn, in each way in which these can stand."""
    known = list(joints)
    while more := _held_together(_free(known, _bodies(base, known))):
        known.append(more)
    ways = _triangle(_free(known, _bodies(base, known)))
    return [known] if ways is None else [way for more in ways for way in _stiffened(base, [*known, *more])]


def _turnings(
    record: MechanismRecord, parallel: Collection[str], joints: Sequence[Stiff | HingeTurn]
) -> dict[str, Turning]:
    bodies = _bodies(record.base, joints)
    free = _free(joints, bodies)
    root, inside_root = bodies[record.base]
    circling = {body: ways[0] for body, ways in _ways(free, root, inside_root.T).items()}
    numbers = {body: number for number, body in enumerate(circling)}
    hinged = _hinged(free, circling)
    rods = {body: number for number, body in enumerate(hinged)}
    _refuse([turn for turn in free if not hinged.keys() & {turn.parent, turn.child}], circling)
    found = {
        link: Turning(np.eye(3), line=line, ball=number)
        for link, (line, number) in rods_between_balls(record, parallel).items()
    }
    hanging = {link: group for link, group in triangles_of_balls(record).items() if link not in bodies}
    found |= {
        link: Turning(np.eye(3), corners=corners, triangle=number)
        for number, (link, corners) in enumerate(hanging.items())
    }
    for link in record.links.keys() - bodies.keys() - found.keys():
        raise NotCirclesError(f"{link} hangs on ball joints")
    for link, (body, inside) in bodies.items():
        if body == root:
            found[link] = Turning(inside_root.T @ inside)
        elif body in circling:
            axis, rotation = circling[body]
            found[link] = Turning(rotation @ inside, numbers[body], axis)
        elif body in hinged:
            carrier, hinge, rotation = hinged[body]
            found[link] = Turning(rotation @ inside, numbers[carrier], circling[carrier][0], hinge, rods[body])
        else:
            raise NotCirclesError(f"{link} turns about more than one direction, or hangs on ball joints")
    return found


Bodies = dict[str, tuple[str, FloatArray]]
"""Link -> its body, called by its first link, and the link's orientation in it."""


def _bodies(base: str, joints: Sequence[Stiff | HingeTurn]) -> Bodies:
    links = dict.fromkeys((base, *(link for joint in joints for link in (joint.parent, joint.child))))
    stiff = [joint for joint in joints if isinstance(joint, Stiff)]
    found: Bodies = {}
    for link in links:
        if link in found:
            continue
        found[link] = (link, np.eye(3))
        waiting = [link]
        for here in waiting:
            for near, far, after in (
                *((joint.parent, joint.child, joint.after) for joint in stiff),
                *((joint.child, joint.parent, joint.after.T) for joint in stiff),
            ):
                if near != here:
                    continue
                inside = found[here][1] @ after
                if far not in found:
                    found[far] = (link, inside)
                    waiting.append(far)
                elif np.max(np.abs(found[far][1] - inside)) > EXACT:
                    raise NoAssemblyError(f"the orientation of {far} is given twice, in two ways")
    return found


def _free(joints: Sequence[Stiff | HingeTurn], bodies: Bodies) -> list[HingeTurn]:
    """Joints that turn, between bodies: R_b = R_a Rot(axis, q) after."""
    found = []
    for joint in joints:
        if isinstance(joint, HingeTurn):
            (first, inside), (second, other) = bodies[joint.parent], bodies[joint.child]
            turn = HingeTurn(first, second, inside @ joint.after @ other.T, inside @ joint.axis)
            if first != second:
                found.append(turn)
            elif np.max(np.abs(turn.after @ turn.axis - turn.axis)) > EXACT:
                raise NoAssemblyError(f"{joint.child} cannot have the orientation that its joints ask for")
    return found


Way = tuple[FloatArray, FloatArray]
"""A direction u and C: the orientation is Rot(u, psi) C."""


def _ways(free: list[HingeTurn], root: str, rotation: FloatArray) -> dict[str, list[Way]]:
    """For each body, the directions by whose axes alone it hangs on the root, whose orientation is given."""
    both = [*free, *(turn.back for turn in free)]
    directions: list[FloatArray] = []
    for axis in (_upright(rotation @ turn.axis) for turn in both if turn.parent == root):
        if not any(_along(axis, other) for other in directions):
            directions.append(axis)
    found: dict[str, list[Way]] = {}
    for axis in directions:
        reached = {root: rotation}
        waiting = [root]
        for here in waiting:
            for turn in both:
                if turn.parent == here and turn.child not in reached and _along(reached[here] @ turn.axis, axis):
                    reached[turn.child] = reached[here] @ turn.after
                    waiting.append(turn.child)
        for body in waiting[1:]:
            found.setdefault(body, []).append((axis, reached[body]))
    return found


def _held_together(free: list[HingeTurn]) -> Stiff | None:
    """Two bodies that turn against each other about two directions, so not at all."""
    for root in dict.fromkeys(body for turn in free for body in (turn.parent, turn.child)):
        for body, ways in _ways(free, root, np.eye(3)).items():
            if len(ways) > 1:
                (u, first), (v, second) = ways[:2]
                between = first @ second.T @ v
                if abs(u @ between - u @ v) > EXACT:
                    raise NoAssemblyError(f"{body} cannot have the orientation that its joints ask for")
                return Stiff(root, body, rotations.about_axis(u, _angle(u, between, v)) @ first)
    return None


def _triangle(free: list[HingeTurn]) -> list[list[Stiff]] | None:
    """Three bodies that turn against each other about one direction each, u, v and w: a spherical triangle.

    Two of its angles are given, so that w stands in one of two ways against the first body, mirrored at the plane of u
    and v, and none of the three turns: as the bars of an articulated platform, each held against turning about all but
    one direction.
    """
    for root in dict.fromkeys(body for turn in free for body in (turn.parent, turn.child)):
        ways = _ways(free, root, np.eye(3))
        for first in ways:
            between = _ways(free, first, np.eye(3))
            for second in sorted(between.keys() & ways.keys()):
                (u, first_stands), (v, second_stands), (w, after) = ways[first][0], ways[second][0], between[second][0]
                own, other = first_stands @ w, second_stands @ after.T @ w  # w at psi = 0, carried by either body
                if second > first and not (_along(u, v) or _along(u, own) or _along(v, other)):
                    return _stands(root, (first, u, first_stands, own), (second, v, second_stands, other))
    return None


Carried = tuple[str, FloatArray, FloatArray, FloatArray]


def _stands(root: str, first: Carried, second: Carried) -> list[list[Stiff]]:
    """How two bodies can stand in the root, each Rot(u, psi) C with w as it carries it at psi = 0; w is one of both."""
    (near, u, here, own), (far, v, there, other) = first, second
    across = rotations.cross(u, v)
    along = np.linalg.solve(np.array([[1.0, u @ v], [u @ v, 1.0]]), [u @ own, v @ other])
    rest = float(1.0 - along @ [u @ own, v @ other])
    if rest < -EXACT:
        raise NoAssemblyError(f"{near} and {far} cannot have the orientations that their joints ask for")
    side = np.sqrt(max(rest, 0.0)) / np.linalg.norm(across)
    senses = (1.0, -1.0) if rest > EXACT else (0.0,)
    found = []
    for sense in senses:
        axis = along[0] * u + along[1] * v + sense * side * across
        found.append(
            [
                Stiff(root, body, rotations.about_axis(about, _angle(about, start, axis)) @ turned)
                for body, about, start, turned in ((near, u, own, here), (far, v, other, there))
            ]
        )
    return found


def _angle(axis: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    """The angle of the turn about an axis that takes one direction to another."""
    return np.asarray(np.arctan2(axis @ rotations.cross(start, end), start @ end - (axis @ start) * (axis @ end)))


def _hinged(free: list[HingeTurn], circling: Mapping[str, Way]) -> dict[str, tuple[str, FloatArray, FloatArray]]:
    """Rods on hinges: the body that carries them, the hinge's direction and C, both where that body's psi is zero."""
    found: dict[str, tuple[str, FloatArray, FloatArray]] = {}
    both = [*free, *(turn.back for turn in free)]
    for turn in both:
        if turn.parent not in circling or turn.child in circling or turn.child in found:
            continue
        axis, rotation = circling[turn.parent]
        hinge = rotation @ turn.axis
        others = [other for other in both if other.child == turn.child]
        alike = all(t.parent == turn.parent and _along(rotation @ t.axis, hinge) for t in others)
        if alike and abs(hinge @ axis) < EXACT:
            found[turn.child] = (turn.parent, hinge, rotation @ turn.after)
    return found


def _refuse(free: list[HingeTurn], circling: Mapping[str, Way]) -> None:
    """Every axis must be along the direction of what turns about it."""
    for turn in free:
        for body, axis in ((turn.parent, turn.axis), (turn.child, turn.after.T @ turn.axis)):
            if body in circling and not _along(circling[body][1] @ axis, circling[body][0]):
                raise NotCirclesError(f"{body} turns about more than one direction")


def _upright(axis: FloatArray) -> FloatArray:
    """The same line, its sense by the largest component."""
    return np.asarray(axis * np.sign(axis[np.argmax(np.abs(axis.round(6)))]))


def _along(axis: FloatArray, other: FloatArray) -> bool:
    (a, b, c), (d, e, f) = axis.tolist(), other.tolist()  # asked thousands of times: floats are ten times as fast
    return hypot(b * f - c * e, c * d - a * f, a * e - b * d) < EXACT
