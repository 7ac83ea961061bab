"""Elementary joints: every joint of a mechanism as hinges, slides and balls, seen from the body that they carry."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.tree import joint_graph
from assur.model.mechanism import Joint, MechanismRecord
from assur.numerics import rotations

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class ElementaryJoint:
    """One elementary joint.

    Attributes:
        name: that of the joint where it has one freedom, else joint.component; of a screw's advance, joint.advance.
        kind: a "hinge" and a "slide" have one value, a "ball" a rotation.
        axis: (3,) unit vector in the frame of the carried body at home; zeros for a ball.
        at: (3,) a point of it in that frame, in m.
        joint: name of our joint.
        index: of our joint value that moves it (of a ball: the first of three).
        ratio: how much it moves, in rad or m, per unit of that value.
        home: its value at home, in rad or m; 0 for a ball.
        offset: its value where ours is zero, in rad or m.
        limits: (low, high) in rad or m, or None.
        turn: of a ball, the two rotations (3, 3) between which that of our rotation vector stands.
        backwards: of a ball, whether it moves our parent against our child.
    """

    name: str
    kind: Literal["hinge", "slide", "ball"]
    axis: FloatArray
    at: FloatArray
    joint: str
    index: int
    ratio: float
    home: float
    limits: tuple[float, float] | None = None
    turn: tuple[FloatArray, FloatArray] = (np.eye(3), np.eye(3))
    backwards: bool = False
    offset: float = 0.0

    def value(self, joint_values: FloatArray) -> FloatArray:
        """Value (...) of a hinge or slide, in rad or m, at our joint values (..., n)."""
        return np.asarray(self.ratio * joint_values[..., self.index] + self.offset)

    def rotation(self, joint_values: FloatArray) -> FloatArray:
        """Rotation (..., 3, 3) of a ball away from home, in the frame of the carried body, at our joint values."""
        turned = rotations.from_vector(joint_values[..., self.index : self.index + 3])
        turned = np.swapaxes(turned, -1, -2) if self.backwards else turned
        return np.asarray(self.turn[0] @ turned @ self.turn[1])


def joint_steps(
    record: MechanismRecord, joint: Joint, home: FloatArray, *, forward: bool, metre: float
) -> tuple[ElementaryJoint, ...]:
    """A joint taken apart; `forward`: it carries its child, else its parent.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> step, = joint_steps(record, record.joints["B1"], home_values(record), forward=True, metre=1e-3)
    >>> step.name, step.kind, step.axis.tolist()
    ('B1', 'hinge', [0.0, 0.0, 1.0])
    """
    columns = joint_graph(record).slices[joint.name]
    at = metre * (joint.child_at if forward else joint.at)
    if joint.type.ball:
        vector = rotations.from_vector(home[columns])
        turn = ((vector @ joint.turn).T, joint.turn) if forward else (vector, np.eye(3))
        return (
            ElementaryJoint(
                joint.name, "ball", np.zeros(3), at, joint.name, columns.start, 1.0, 0.0, None, turn, not forward
            ),
        )
    steps = [
        _step(record, joint, step.direction, columns.start + first, home, at, metre)
        for step, first in joint.type.places
    ]
    if joint.type.screw:
        steps.append(_advance(joint, columns.start, home, at, metre))
    if not forward:
        steps = steps[::-1]
    basis = joint.turn.T if forward else -np.eye(3)
    found: list[ElementaryJoint] = []
    later = np.eye(3)  # what the steps after this one turn at home, in the carried body's frame
    shift = np.zeros(3)  # and how far they move the body, in its frame
    for step in reversed(steps):
        axis = basis @ step.axis
        own = later.T @ axis + 0.0
        aside = shift - (shift @ own) * own  # along its axis a hinge may stand anywhere
        found.insert(0, replace(step, axis=own, at=step.at - aside))
        if step.kind == "slide":
            shift = shift + step.home * own
        if step.kind == "hinge":
            later = rotations.about_axis(axis, np.array(step.home)) @ later
    return tuple(found)


def _step(
    record: MechanismRecord, joint: Joint, direction: int, index: int, home: FloatArray, at: FloatArray, metre: float
) -> ElementaryJoint:
    """The step of one component, its axis in the parent's frame."""
    coordinate = record.coordinates[index]
    component = index - joint_graph(record).slices[joint.name].start
    ratio = metre if coordinate.kind == "length" else 1.0
    limits = joint.limits[component] if joint.limits else None
    return ElementaryJoint(
        record.coordinate_label(coordinate),
        "slide" if coordinate.kind == "length" else "hinge",
        joint.axes[direction],
        at,
        joint.name,
        index,
        ratio,
        float(ratio * home[index]),
        None if limits is None else (ratio * limits[0], ratio * limits[1]),
    )


def _advance(joint: Joint, index: int, home: FloatArray, at: FloatArray, metre: float) -> ElementaryJoint:
    """The slide of a screw, which its hinge drives."""
    ratio = metre * joint.pitch / (2 * np.pi)
    return ElementaryJoint(
        f"{joint.name}.advance", "slide", joint.axes[0], at, joint.name, index, ratio, float(ratio * home[index])
    )
