"""A screw and another joint along its axis, on a link that carries nothing else: together a cylindrical joint.

So a nut that turns in a bearing, a screw on a slide, and two screws of different leads. Of the two values that such a
pair has, the slide and the turn are linear functions, so that a mechanism with cylindrical joints in the pairs' places
has the same assemblies, and the loops of that one are solved where a screw among their unknowns has no equation.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.tree import joint_graph
from assur.joints.cylindrical import CYLINDRICAL
from assur.kinematics.home import home_values
from assur.kinematics.modes import Problem
from assur.model.mechanism import Coordinate, Input, Joint, MechanismRecord
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
STRAIGHT = 1e-9
"""Sine, and share of the characteristic length, below which two axes are one line: both are written."""
ALIKE = 1e-9
"""Share by which leads must differ for two screws to be a slide and a turn."""


@dataclass(frozen=True, eq=False)
class MergedPair:
    """A mechanism with a cylindrical joint in the place of a pair.

    Attributes:
        record: that mechanism.
        whole: the one with the pair.
        rates: (2, 2) slide and turn by the joint values of the pair; they are the last two values of the record.
        pair: indices of the pair in the whole's joint values.
        driven: number of the input that is the slide, -1 where none is.
    """

    record: MechanismRecord
    whole: MechanismRecord
    rates: FloatArray
    pair: tuple[int, int]
    driven: int

    def given(self, inputs: FloatArray) -> FloatArray:
        """Printed inputs (n,) of the merged mechanism for those of the whole."""
        if self.driven < 0:
            return inputs
        own = self.whole.inputs[self.driven]
        lead = self.rates[0, self.pair.index(own.coordinate.index)]
        answer = inputs.copy()
        answer[self.driven] = lead * own.joint_value(inputs[self.driven])
        return answer

    def expanded(self, joints: FloatArray) -> FloatArray:
        """Joint values (K, n) of the whole; a turn is within half a turn of home's."""
        home = home_values(self.whole)
        own = joints[:, -2:] - self.rates @ home[list(self.pair)]
        own[:, 1] = rotations.nearest_turn(own[:, 1])
        answer = np.broadcast_to(home, (len(joints), len(home))).copy()
        answer[:, list(self.pair)] += np.linalg.solve(self.rates, own.T).T
        others = np.setdiff1d(np.arange(len(home)), self.pair)
        answer[:, others] = joints[:, :-2]
        return answer


@lru_cache(maxsize=64)
def merged_pair(record: MechanismRecord, problem: Problem) -> MergedPair | None:
    """The first pair as a cylindrical joint, or None; in the direct problem a driven screw is a driven slide.

    >>> from assur.model.registry import load_record
    >>> merged_pair(load_record("fivebar"), "direct") is None
    True
    """
    for link in record.links:
        joints = [joint for joint in record.joints.values() if link in (joint.parent, joint.child)]
        if link == record.base or len(joints) != 2 or not any(joint.type.screw for joint in joints):
            continue
        if link == record.platform.link and problem == "inverse":
            continue  # where the pose holds it
        pair = _along_one_axis(link, joints[0], joints[1], characteristic_length(record))
        if pair is not None and (merged := _merged(record, problem, link, *pair)) is not None:
            return merged
    return None


@dataclass(frozen=True, eq=False)
class _Crossed:
    """A joint seen from one of its links, the near one: points, axis and turn, and which sense its value has."""

    joint: Joint
    near: str
    far: str
    at: FloatArray
    far_at: FloatArray
    axis: FloatArray
    turn: FloatArray
    sense: float

    @classmethod
    def of(cls, joint: Joint, near: str) -> _Crossed:
        if joint.parent == near:
            return cls(joint, near, joint.child, joint.at, joint.child_at, joint.axes[0], joint.turn, 1.0)
        turn = joint.turn.T
        return cls(joint, near, joint.parent, joint.child_at, joint.at, turn @ joint.axes[0], turn, -1.0)

    @property
    def rates(self) -> FloatArray:
        """Slide and turn (2,) of its far link along and about the axis, per unit of its value."""
        if self.joint.type.screw:
            return self.sense * np.array([self.joint.pitch / (2 * np.pi), 1.0])
        return self.sense * np.array([0.0, 1.0] if self.joint.type.turning else [1.0, 0.0])


def _along_one_axis(link: str, first: Joint, second: Joint, size: float) -> tuple[Joint, FloatArray] | None:
    """The cylindrical joint, and slide and turn (2, 2) by the values of the two; None where it is none."""
    if not all(joint.type.axial and len(joint.type.components) == 1 for joint in (first, second)):
        return None
    near = _Crossed.of(first, first.parent if first.child == link else first.child)
    far = _Crossed.of(second, link)
    along = near.turn.T @ near.axis  # in the link
    between = far.at - near.far_at
    turning = first.type.turning and second.type.turning  # else a slide, which has no place
    beside = np.linalg.norm(rotations.cross(along, between)) / size if turning else 0.0
    if max(np.linalg.norm(rotations.cross(along, far.axis)), beside) > STRAIGHT:
        return None
    rates = np.column_stack([near.rates, np.sign(along @ far.axis) * far.rates])
    if abs(np.linalg.det(rates)) < ALIKE * size:
        return None
    at, child_at = near.at + near.turn @ between, far.far_at
    if not second.type.turning:
        at, child_at = near.at, far.far_at - far.turn.T @ between
    name, limits = f"{first.name} and {second.name}", (None,) * len(CYLINDRICAL.components)
    axes, turn = near.axis[None], near.turn @ far.turn
    return Joint(name, CYLINDRICAL, near.near, far.far, at, child_at, axes, turn, limits=limits), rates


def _merged(record: MechanismRecord, problem: Problem, link: str, joint: Joint, rates: FloatArray) -> MergedPair | None:
    """None where what is driven leaves neither slide nor turn as it was."""
    names = [name for name, own in record.joints.items() if link in (own.parent, own.child)]
    first, second = (joint_graph(record).slices[name].start for name in names)
    driven = [k for k, item in enumerate(record.inputs) if item.coordinate.index in (first, second)]
    others = [item for item in record.coordinates if item.joint not in names]
    if problem == "direct" and driven:
        passive = int(record.inputs[driven[0]].coordinate.index == first)
        if len(driven) > 1 or rates[0, passive]:
            return None  # a value of both, not a slide
    place = len(others)
    moved = {item.index: replace(item, index=k) for k, item in enumerate(others)}
    slide = Coordinate(joint.name, CYLINDRICAL.components[0], place, "length")
    turn = Coordinate(joint.name, CYLINDRICAL.components[1], place + 1, "angle")
    home = home_values(record)
    platform = record.platform
    if platform.link == link:
        platform = replace(platform, link=joint.child, point=np.zeros(3), written=None)
    inputs = [
        Input(slide, item.name, item.latex) if k in driven else replace(item, coordinate=moved[item.coordinate.index])
        for k, item in enumerate(record.inputs)
    ]
    merged = replace(
        record,
        links={name: item for name, item in record.links.items() if name != link},
        joints={name: item for name, item in record.joints.items() if name not in names} | {joint.name: joint},
        platform=platform,
        inputs=tuple(inputs),
        coordinates=(*moved.values(), slide, turn),
        home=np.concatenate([np.delete(home, [first, second]), rates @ home[[first, second]]]),
        chains={},
        angles={},
        points={},
        overrides={},  # home is that of the changed dimensions
    )
    return MergedPair(merged, record, rates, (first, second), driven[0] if driven else -1)
