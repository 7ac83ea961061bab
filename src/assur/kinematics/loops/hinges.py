"""What joints, and parallelograms that stay such, say about the orientations of the links that they join.

Opposite links of a P(4R) do not turn against each other. The short links of a P(4S) that stays a parallelogram turn
against each other about their common direction, as if by a revolute joint. Ball joints say nothing; a rod between two
of them has a direction only, and a link on three or more is no more than the triangle of their centres.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import frames
from assur.joint_graph.tree import joint_graph
from assur.joints.steps import Step
from assur.kinematics.home import home_values
from assur.kinematics.loops.parallelograms import PARALLEL, parallelograms
from assur.model.mechanism import GeneralisedJoint, Joint, MechanismRecord
from assur.numerics import rotations

FloatArray = NDArray[np.float64]


class NotCirclesError(Exception):
    """Some link turns otherwise; the message says which."""


class NoAssemblyError(Exception):
    """Orientations that what is locked asks for contradict each other."""


@dataclass(frozen=True, eq=False)
class Stiff:
    """R_child = R_parent after."""

    parent: str
    child: str
    after: FloatArray


@dataclass(frozen=True, eq=False)
class HingeTurn:
    """R_child = R_parent Rot(axis, q) after, q free."""

    parent: str
    child: str
    after: FloatArray
    axis: FloatArray

    @property
    def back(self) -> HingeTurn:
        """The same, seen from the child."""
        return HingeTurn(self.child, self.parent, self.after.T, -self.after.T @ self.axis)


def middle(joint: Joint) -> str:
    """The cross of a universal joint, as a link."""
    return f"{joint.name}'s cross"


def turns_of_joints(record: MechanismRecord, locked: Mapping[int, float]) -> Iterable[Stiff | HingeTurn]:
    """What each joint allows, joint values `locked` (index -> value) given; a universal joint by way of its cross."""
    slices = joint_graph(record).slices
    for name, joint in record.joints.items():
        turning = [(step, first) for step, first in joint.type.places if step.kind != "slide"]
        if not turning:
            yield Stiff(joint.parent, joint.child, joint.turn)
        links = (joint.parent, *[middle(joint)] * (len(turning) - 1), joint.child)
        for k, (step, first) in enumerate(turning):
            after = joint.turn if links[k + 1] == joint.child else np.eye(3)
            start = slices[name].start + first
            values = np.array([locked.get(start + index, np.nan) for index in range(len(step.kinds))])
            if np.all(np.isfinite(values)):
                yield Stiff(links[k], links[k + 1], _turned(joint, step, values) @ after)
            elif step.kind != "ball":
                yield HingeTurn(links[k], links[k + 1], after, joint.axes[step.direction])


def _turned(joint: Joint, step: Step, values: FloatArray) -> FloatArray:
    """What a step turns by (3, 3) at given values."""
    if step.kind == "ball":
        return rotations.from_vector(values)
    return rotations.about_axis(joint.axes[step.direction], values[0])


def turns_of_parallelograms(record: MechanismRecord, parallel: Collection[str]) -> Iterable[Stiff | HingeTurn]:
    """How opposite links of parallelograms can turn against each other: not at all in a P(4R).

    Nor do the rods of a P(2US), if its universal joints are parallel; one may have rolled over, half a turn.
    """
    groups = parallelograms(record)
    placed = frames(record, home_values(record)) if groups else {}
    for group in groups.values():
        if group.name not in parallel:
            continue
        between = placed[group.parent][0].T @ placed[group.child][0]
        if group.kind == "P(4R)":
            yield Stiff(group.parent, group.child, between)
            first, second = _rods(record, group)
            yield Stiff(first, second, placed[first][0].T @ placed[second][0])
        if group.kind == "P(2US)":
            yield from _rods_alike(record, group, placed)
        if group.kind in ("P(4S)", "P(2US)"):
            near, far = (_point_on(record.joints[name], group.parent) for name in _near(record, group))
            yield HingeTurn(group.parent, group.child, between, (far - near) / np.linalg.norm(far - near))


def _rods_alike(
    record: MechanismRecord, group: GeneralisedJoint, placed: Mapping[str, tuple[FloatArray, FloatArray]]
) -> Iterable[Stiff]:
    """Equal directions of the rods of a P(2US) are equal angles of universal joints whose axes are parallel."""
    crosses, axes = [], []
    values, slices = home_values(record), joint_graph(record).slices
    for joint in (record.joints[name] for name in group.joints):
        if joint.type.turns == 2:
            near, _ = placed[joint.parent]
            cross = near @ rotations.about_axis(joint.axes[0], values[slices[joint.name]][0])
            crosses.append((middle(joint), cross))
            axes.append(np.stack([near @ joint.axes[0], cross @ joint.axes[1]]))
    if np.max(np.linalg.norm(rotations.cross(axes[0], axes[1]), axis=1)) < PARALLEL:
        rods = [(link, placed[link][0]) for link in _rods(record, group)]
        for (first, here), (second, there) in (crosses, rods):
            yield Stiff(first, second, here.T @ there)


def rods_between_balls(record: MechanismRecord, parallel: Collection[str]) -> dict[str, tuple[FloatArray, int]]:
    """Rods between two ball joints: direction in their frame, and a number that the rods of a kept P(4S) share.

    These two have one direction, from the parallelogram's parent on.
    """
    together: dict[str, str] = {}
    begins: dict[str, str] = {}
    for group in parallelograms(record).values():
        if group.kind == "P(4S)" and group.name in parallel:
            first, second = _rods(record, group)
            together[second] = first
            begins |= {first: group.parent, second: group.parent}
    lines: dict[str, FloatArray] = {}
    for link, joints in _joints_of(record).items():
        if len(joints) == 2 and all(joint.type.ball for joint in joints):
            near, far = (_point_on(joint, link) for joint in joints)
            if link in begins and begins[link] in (joints[1].parent, joints[1].child):
                near, far = far, near
            lines[link] = (far - near) / np.linalg.norm(far - near)
    numbers = {link: number for number, link in enumerate(link for link in lines if link not in together)}
    return {link: (line, numbers[together.get(link, link)]) for link, line in lines.items()}


def triangles_of_balls(record: MechanismRecord) -> dict[str, FloatArray]:
    """Links that hang on nothing but three ball joints or more: three of the centres (3, 3) in the link's frame.

    >>> from assur.model.registry import load_record
    >>> triangles_of_balls(load_record("three_rps"))["platform"].round(1).tolist()
    [[120.0, 0.0, 0.0], [-60.0, -103.9, 0.0], [-60.0, 103.9, 0.0]]
    """
    found = {}
    for link, joints in _joints_of(record).items():
        if len(joints) >= 3 and all(joint.type.ball for joint in joints):
            centres = np.array([_point_on(joint, link) for joint in joints])
            sides = centres - centres[0]
            second = int(np.argmax(np.linalg.norm(sides, axis=1)))
            third = int(np.argmax(np.linalg.norm(rotations.cross(sides, sides[second]), axis=1)))
            found[link] = centres[[0, second, third]]
    return found


def _joints_of(record: MechanismRecord) -> dict[str, list[Joint]]:
    """Link -> its joints."""
    found: dict[str, list[Joint]] = {link: [] for link in record.links}
    for joint in record.joints.values():
        found[joint.parent].append(joint)
        found[joint.child].append(joint)
    return found


def _rods(record: MechanismRecord, group: GeneralisedJoint) -> tuple[str, str]:
    links = {link for name in group.joints for link in (record.joints[name].parent, record.joints[name].child)}
    first, second = sorted(links - {group.parent, group.child})
    return first, second


def _near(record: MechanismRecord, group: GeneralisedJoint) -> list[str]:
    """The two joints on the parent's side."""
    return [name for name in group.joints if group.parent in (record.joints[name].parent, record.joints[name].child)]


def _point_on(joint: Joint, link: str) -> FloatArray:
    return joint.at if joint.parent == link else joint.child_at
