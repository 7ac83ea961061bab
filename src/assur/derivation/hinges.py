"""What joints say of the orientations of the links that they join: fixed to each other, or turning about an axis."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.derivation.exact_vectors import ExactVectors
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.symbols import GivenSymbols
from assur.joint_graph.frames import frames
from assur.joint_graph.tree import joint_graph
from assur.joints.steps import UNTURNED, about
from assur.kinematics.home import home_values
from assur.model.mechanism import GeneralisedJoint, Joint, MechanismRecord
from assur.numerics.vectors import Matrix, Vector, apply, product, scaled, subtract, transposed

FloatArray = NDArray[np.float64]
HOME = 1e-9
"""Rotations at home are known to rounding."""


@dataclass(frozen=True)
class RigidPair:
    """R_child = R_parent after."""

    parent: str
    child: str
    after: Matrix
    joints: tuple[str, ...] = ()


@dataclass(frozen=True)
class Hinge:
    """R_child = R_parent Rot(axis, q) after."""

    parent: str
    child: str
    after: Matrix
    axis: Vector
    joints: tuple[str, ...] = ()

    @property
    def back(self) -> Hinge:
        """The same, of the parent against the child."""
        own = apply(transposed(self.after), self.axis)
        return Hinge(self.child, self.parent, transposed(self.after), scaled(own, -1), self.joints)


def hinges(symbols: GivenSymbols) -> Iterator[RigidPair | Hinge]:
    """What all joints say, locked ones as rigid pairs, and what parallelograms say that stay such.

    Errors: NotDerivedError.

    >>> from assur.derivation.witness import ModularWitness
    >>> from assur.model.registry import load_record
    >>> len([*hinges(GivenSymbols(load_record("fivebar"), "direct", ModularWitness()))])
    5
    """
    yield from _of_joints(symbols)
    yield from _of_parallelograms(symbols)


def cross_of(joint: Joint) -> str:
    """The cross of a universal joint, as a link."""
    return f"{joint.name}'s cross"


def rods_of(record: MechanismRecord, group: GeneralisedJoint) -> tuple[str, str]:
    """The two rods of a parallelogram."""
    links = {link for name in group.joints for link in (record.joints[name].parent, record.joints[name].child)}
    first, second = sorted(links - {group.parent, group.child})
    return first, second


def _near(record: MechanismRecord, group: GeneralisedJoint) -> list[str]:
    """The two joints on the parent's side."""
    return [name for name in group.joints if group.parent in (record.joints[name].parent, record.joints[name].child)]


def _of_joints(symbols: GivenSymbols) -> Iterator[RigidPair | Hinge]:
    record = symbols.record
    slices = joint_graph(record).slices
    for name, joint in record.joints.items():
        own = symbols.geometry.joints[name]
        turning = [(step, first) for step, first in joint.type.places if step.kind != "slide"]
        if not turning:
            yield RigidPair(joint.parent, joint.child, own.turn, (name,))
        links = (joint.parent, *[cross_of(joint)] * (len(turning) - 1), joint.child)
        for k, (step, first) in enumerate(turning):
            after = own.turn if links[k + 1] == joint.child else UNTURNED
            index = slices[name].start + first
            if step.kind == "screw":
                raise NotDerivedError(f"{name}: a screw, whose length and angle belong together")
            if step.kind == "turn" and index in symbols.locked:
                turned = about(own.axes[step.direction], *symbols.locked[index])
                yield RigidPair(links[k], links[k + 1], product(turned, after), (name,))
            elif step.kind == "turn":
                yield Hinge(links[k], links[k + 1], after, own.axes[step.direction], (name,))


def _of_parallelograms(symbols: GivenSymbols) -> Iterator[RigidPair | Hinge]:
    record = symbols.record
    for group in record.generalised.values():
        parent, child = group.parent, group.child
        if group.kind == "P(4R)":
            yield RigidPair(parent, child, _as_at_home(record, parent, child), (group.name,))
            first, second = rods_of(record, group)
            yield RigidPair(first, second, _as_at_home(record, first, second), (group.name,))
        elif group.kind in ("P(4S)", "P(2US)"):
            near, far = (point_on(symbols, record.joints[name], parent) for name in _near(record, group))
            axis = ExactVectors(symbols.witness).unit(subtract(far, near))
            after = _as_at_home(record, parent, child, _short_link(record, group))
            yield Hinge(parent, child, after, axis, (group.name,))
            if group.kind == "P(2US)":
                first, second = rods_of(record, group)
                yield RigidPair(first, second, _as_at_home(record, first, second), (group.name,))


def _short_link(record: MechanismRecord, group: GeneralisedJoint) -> FloatArray:
    """The direction (3,), in floats, of the line between the rods' joints on the parent."""
    joints = [record.joints[name] for name in _near(record, group)]
    near, far = (joint.at if joint.parent == group.parent else joint.child_at for joint in joints)
    return np.asarray((far - near) / np.linalg.norm(far - near))


def _as_at_home(record: MechanismRecord, first: str, second: str, axis: FloatArray | None = None) -> Matrix:
    """The orientation of one link against another at home, which must be that of frames that are parallel.

    Where the one turns against the other about an axis (3,) they must be so after some turn about it.
    """
    placed = frames(record, home_values(record))
    kept = np.eye(3) if axis is None else axis[:, None]
    if np.max(np.abs(placed[first][0].T @ placed[second][0] @ kept - kept)) > HOME:
        raise NotDerivedError(f"{first} and {second} stay parallel, but their frames are not")
    return UNTURNED


def point_on(symbols: GivenSymbols, joint: Joint, link: str) -> Vector:
    """A joint's point, fixed in one of its links."""
    own = symbols.geometry.joints[joint.name]
    return own.at if joint.parent == link else own.child_at


def slides(symbols: GivenSymbols, joint: Joint, link: str) -> Iterator[Vector]:
    """Directions in which a joint that does not turn slides, fixed in one of its links."""
    own = symbols.geometry.joints[joint.name]
    for step, _ in joint.type.places:
        if step.kind == "slide" and not joint.type.turns:
            axis = own.axes[step.direction]
            yield axis if joint.parent == link else apply(transposed(own.turn), axis)
