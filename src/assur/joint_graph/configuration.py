"""The joint graph at a configuration, over any number type: frames of its links, gaps of its loops, twists.

This is the one place where frames follow from joints and loops from frames. A closed loop says that the child of a cut
joint is reached twice at the same place: through the joint from its parent, and along the spanning tree.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from assur.joint_graph.geometry import Geometry
from assur.joint_graph.tree import JointGraph
from assur.joints.steps import STILL, UNTURNED
from assur.model.mechanism import Joint
from assur.numerics.vectors import Matrix, Vector, add, apply, cross, product, subtract, times, transposed

State = Mapping[str, Sequence[Any]]
"""The numbers of each joint, those of its steps one after the other (`assur.joint_graph.state`)."""
Placed = tuple[Matrix, Vector]
"""A frame in the base frame: rows of its orientation, and its origin."""


@dataclass(frozen=True, eq=False)
class Configuration:
    """A joint graph whose joints stand somewhere; its loops need not close.

    Attributes:
        graph: spanning tree and cut joints.
        geometry: dimensions of the joints.
        state: where each joint stands.
        rates: for ball joints whose coordinates are no angular velocities along the parent's axes, what they are of
            these, as columns.
    """

    graph: JointGraph
    geometry: Geometry
    state: State
    rates: Mapping[str, Matrix] = field(default_factory=dict)

    @cached_property
    def frames(self) -> dict[str, Placed]:
        """Frame of every link in the base frame, along the spanning tree."""
        placed: dict[str, Placed] = {self.graph.base: (UNTURNED, STILL)}
        for joint, forward in self.graph.tree:
            if forward:
                placed[joint.child] = self._child(joint, placed[joint.parent])
            else:
                placed[joint.parent] = self._parent(joint, placed[joint.child])
        return placed

    @property
    def platform(self) -> Placed:
        """The platform's orientation and its point O', in the base frame."""
        rotation, origin = self.frames[self.graph.platform]
        return rotation, add(origin, apply(rotation, self.geometry.platform))

    def point(self, joint: Joint) -> Vector:
        """The joint's point on its parent, in the base frame."""
        rotation, origin = self.frames[joint.parent]
        return add(origin, apply(rotation, self.geometry.joints[joint.name].at))

    def child_point(self, joint: Joint) -> Vector:
        """The joint's point on its child, as the spanning tree places it, in the base frame."""
        rotation, origin = self.frames[joint.child]
        return add(origin, apply(rotation, self.geometry.joints[joint.name].child_at))

    def gap(self, joint: Joint) -> tuple[Vector, Matrix]:
        """How far a cut joint is from closing its loop: a distance, and a turn in the base frame; (0, 0, 0) and 1.

        From where the spanning tree places the child's joint frame to where the joint has it.
        """
        turned, shift = self._motions[joint.name]
        rotation, _ = self.frames[joint.parent]
        reached = add(self.point(joint), apply(rotation, shift))
        return subtract(reached, self.child_point(joint)), product(
            product(rotation, turned), transposed(self.frames[joint.child][0])
        )

    def twists(self, joint: Joint, point: Vector) -> Iterator[tuple[Vector, Vector]]:
        """Angular velocity, and velocity of a point of the child, per rate of each coordinate, in the base frame."""
        own = self.geometry.joints[joint.name]
        rotation, _ = self.frames[joint.parent]
        rates = self.rates.get(joint.name, UNTURNED)
        for shift, (angular, velocity) in joint.type.twists(own.axes, own.advance, self.state[joint.name], rates):
            turning = apply(rotation, angular)
            arm = subtract(point, add(self.point(joint), apply(rotation, shift)))
            yield turning, add(apply(rotation, velocity), cross(turning, arm))

    def entries(self, joint: Joint, sense: int, point: Vector) -> Iterator[tuple[int, int, Any]]:
        """Row, coordinate and value of a joint's twists at a point, times 1 or -1; what is always zero is left out."""
        first = self.graph.slices[joint.name].start
        for column, (angular, velocity) in enumerate(self.twists(joint, point), start=first):
            for row, number in enumerate((*angular, *velocity)):
                if not (type(number) is int and number == 0):
                    yield row, column, times(sense, number)

    @cached_property
    def _motions(self) -> dict[str, Placed]:
        """Of every joint the orientation of the child's frame in the parent's, and the shift of the joint's point."""
        return {joint.name: self._motion(joint) for joint in self.graph.joints}

    def _motion(self, joint: Joint) -> Placed:
        own = self.geometry.joints[joint.name]
        turned, shift = joint.type.motion(own.axes, own.advance, self.state[joint.name])
        return product(turned, own.turn), shift

    def _child(self, joint: Joint, parent: Placed) -> Placed:
        turned, shift = self._motions[joint.name]
        own = self.geometry.joints[joint.name]
        orientation = product(parent[0], turned)
        origin = add(parent[1], apply(parent[0], add(own.at, shift)))
        return orientation, subtract(origin, apply(orientation, own.child_at))

    def _parent(self, joint: Joint, child: Placed) -> Placed:
        turned, shift = self._motions[joint.name]
        own = self.geometry.joints[joint.name]
        orientation = product(child[0], transposed(turned))
        origin = add(child[1], apply(child[0], own.child_at))
        return orientation, subtract(origin, apply(orientation, add(own.at, shift)))
