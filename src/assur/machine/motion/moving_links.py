"""Twists, accelerations and wrenches of links over any number type: from link to link along the spanning tree.

A twist is the angular velocity, then the velocity of the body point at the base's origin; a wrench is the force, then
its moment about that origin. Angles are in rad, lengths in the mechanism's unit, masses in kg.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

from assur.joint_graph.configuration import Configuration
from assur.joints.steps import STILL
from assur.model.mechanism import Joint
from assur.numerics.elimination import nothing
from assur.numerics.vectors import (
    Matrix,
    Vector,
    add,
    apply,
    cross,
    dot,
    minus,
    plus,
    scaled,
    subtract,
    times,
    transposed,
)

Twist = tuple[Vector, Vector]
Rates = Mapping[int, Any]
"""Of joint coordinates by their places; those that are left out are nothing."""
NOTHING: Twist = (STILL, STILL)


class MovingBody(NamedTuple):
    """Mass, centre in the link's frame, inertia about it in the link's axes."""

    mass: Any
    centre: Vector
    inertia: Matrix


@dataclass(frozen=True, eq=False)
class MovingLinks:
    """The links of a configuration, whose joints may move."""

    configuration: Configuration

    @cached_property
    def screws(self) -> dict[str, list[Twist]]:
        """Of every joint the twists of its child against its parent, per rate of each coordinate."""
        joints = self.configuration.graph.joints
        return {joint.name: list(self.configuration.twists(joint, STILL)) for joint in joints}

    def twists(self, rates: Rates) -> dict[str, Twist]:
        """Of all links."""
        return self._along({joint.name: self.own(joint, rates) for joint in self.configuration.graph.joints})

    def twists_of(self, moved: Collection[str], rates: Rates) -> tuple[dict[str, Twist], list[Twist]]:
        """Of links that alone are known to move, and what is nothing if so: the twists of others behind them."""
        placed, others = {self.configuration.graph.base: NOTHING}, list[Twist]()
        for joint, forward in self.configuration.graph.tree:
            near, far = (joint.parent, joint.child) if forward else (joint.child, joint.parent)
            own = self.own(joint, rates)
            twist = sum_of(placed[near], own) if forward else difference(placed[near], own)
            placed[far] = twist if far in moved else NOTHING
            if far not in moved and not is_nothing(twist):
                others.append(twist)
        return {link: placed[link] for link in moved}, others

    def own(self, joint: Joint, rates: Rates) -> Twist:
        """Of a joint's child against its parent."""
        return _total(self._parts(joint, rates))

    def drifts(self, twists: Mapping[str, Twist], rates: Rates) -> dict[str, Twist]:
        """What joints add to accelerations where their rates do not change: their axes are carried along."""
        drifts = {}
        for joint in self.configuration.graph.joints:
            parts, carrier, own = self._parts(joint, rates), twists[joint.parent], []
            for step, first in joint.type.places:
                moved = _total(parts[first : first + len(step.kinds)])
                own.append(_crossed(carrier, moved))
                carrier = sum_of(carrier, moved)
            drifts[joint.name] = _total(own)
        return drifts

    def accelerations(self, drifts: Mapping[str, Twist], second: Rates) -> dict[str, Twist]:
        """Rates of the twists of all links."""
        joints = self.configuration.graph.joints
        return self._along({joint.name: sum_of(drifts[joint.name], self.own(joint, second)) for joint in joints})

    def gap(self, placed: Mapping[str, Twist], own: Mapping[str, Twist], joint: Joint) -> Twist:
        """By how much a cut joint moves its child otherwise than the tree does, at the child's joint point."""
        angular, velocity = difference(sum_of(placed[joint.parent], own[joint.name]), placed[joint.child])
        return angular, add(velocity, cross(angular, self.configuration.child_point(joint)))

    def wrench(self, link: str, body: MovingBody, moving: tuple[Twist, Twist], gravity: Vector) -> Twist:
        """What a body needs that moves by a twist and its rate, in a field of gravity."""
        rotation, origin = self.configuration.frames[link]
        (turning, velocity), (angular, speeding) = moving
        centre = add(origin, apply(rotation, body.centre))
        own = add(velocity, cross(turning, centre))
        acceleration = add(add(speeding, cross(angular, centre)), cross(turning, own))
        force = scaled(subtract(acceleration, gravity), body.mass)
        inward = transposed(rotation)
        turned, change = apply(inward, turning), apply(inward, angular)
        moment = add(apply(body.inertia, change), cross(turned, apply(body.inertia, turned)))
        return force, add(apply(rotation, moment), cross(centre, force))

    def kinetic(self, link: str, body: MovingBody, twist: Twist) -> Any:
        """Twice the energy of a body that moves by a twist."""
        rotation, origin = self.configuration.frames[link]
        velocity = add(twist[1], cross(twist[0], add(origin, apply(rotation, body.centre))))
        turned = apply(transposed(rotation), twist[0])
        return plus(times(body.mass, dot(velocity, velocity)), dot(turned, apply(body.inertia, turned)))

    def height(self, link: str, body: MovingBody, gravity: Vector) -> Any:
        """Mass times how far a body is along gravity."""
        rotation, origin = self.configuration.frames[link]
        return times(body.mass, dot(gravity, add(origin, apply(rotation, body.centre))))

    def efforts(self, wrenches: Mapping[str, Twist]) -> dict[int, Any]:
        """What the tree's joint coordinates must exert for wrenches on links."""
        graph, borne = self.configuration.graph, dict(wrenches)
        efforts = {}
        for joint, forward in reversed(graph.tree):
            near, far = (joint.parent, joint.child) if forward else (joint.child, joint.parent)
            if far not in borne:
                continue
            for column, screw in enumerate(self.screws[joint.name], graph.slices[joint.name].start):
                effort = work(screw, borne[far])
                efforts[column] = effort if forward else minus(0, effort)
            borne[near] = sum_of(borne.get(near, NOTHING), borne[far])
        return efforts

    def _parts(self, joint: Joint, rates: Rates) -> list[Twist]:
        first = self.configuration.graph.slices[joint.name].start
        screws = enumerate(self.screws[joint.name], first)
        return [stretched(screw, rates.get(column, 0)) for column, screw in screws]

    def _along(self, own: Mapping[str, Twist]) -> dict[str, Twist]:
        placed = {self.configuration.graph.base: NOTHING}
        for joint, forward in self.configuration.graph.tree:
            if forward:
                placed[joint.child] = sum_of(placed[joint.parent], own[joint.name])
            else:
                placed[joint.parent] = difference(placed[joint.child], own[joint.name])
        return placed


def stretched(twist: Twist, factor: Any) -> Twist:
    """A twist, or a wrench, times a number."""
    return scaled(twist[0], factor), scaled(twist[1], factor)


def is_nothing(twist: Twist) -> bool:
    """Whether a twist or a wrench is zero whatever the configuration."""
    return all(map(nothing, (*twist[0], *twist[1])))


def work(twist: Twist, wrench: Twist) -> Any:
    """Power of a wrench on a link that moves by a twist."""
    return plus(dot(twist[1], wrench[0]), dot(twist[0], wrench[1]))


def sum_of(a: Twist, b: Twist) -> Twist:
    """Of twists, or of wrenches."""
    return add(a[0], b[0]), add(a[1], b[1])


def difference(a: Twist, b: Twist) -> Twist:
    """Of twists, or of wrenches."""
    return subtract(a[0], b[0]), subtract(a[1], b[1])


def _total(parts: Iterable[Twist]) -> Twist:
    total = NOTHING
    for part in parts:
        total = sum_of(total, part)
    return total


def _crossed(first: Twist, second: Twist) -> Twist:
    """How fast the second changes that the first carries along."""
    (turning, moving), (angular, velocity) = first, second
    return cross(turning, angular), add(cross(turning, velocity), cross(moving, angular))
