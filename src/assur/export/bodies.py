"""A mechanism as bodies: what every simulation file says, in SI units, at home, before any of them says it.

The spanning tree of the joint graph carries the bodies; every joint is taken apart into hinges, slides and balls.
At home every elementary joint of a format without a reference value is at zero; `Step.home` says what ours is there.
A cut joint gets a *carrier*: a nominal body that hangs on the parent by all of the joint but its last hinge (or
ball), which is left to a constraint between carrier and child. A revolute or spherical joint needs no such body.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from assur.export.steps import Step, joint_steps
from assur.kinematics.closure import characteristic_length
from assur.kinematics.home import home_values
from assur.kinematics.soundness.check import METRES
from assur.model.joint_graph import Frame, child_frame, frames, joint_graph
from assur.model.mechanism import Joint, MechanismRecord

FloatArray = NDArray[np.float64]

MASS = 1.0
"""Nominal mass of a link, in kg."""

CARRIER_MASS = 1e-3
"""Nominal mass of a carrier, in kg."""

CARRIER_INERTIA = 4e-7
"""Nominal inertia of a carrier about any axis, in kg m^2 per m^2 of the characteristic length."""

THICKNESS = 0.02
"""Radius of the drawn capsules, as a share of the characteristic length."""


@dataclass(frozen=True, eq=False)
class Body:
    """A link, or the carrier of a cut joint, in the spanning tree.

    Attributes:
        name: of the link; of a carrier, the joint's with ".carrier".
        parent: name of the body that carries it; empty for the base.
        orientation, position: (3, 3) and (3,) of its frame in that of the parent at home, in m.
        steps: the elementary joints that carry it, the one nearest to the parent first.
        centres: (k, 3) joint centres and, of the platform, its point, in its frame, in m.
        mass: in kg, nominal.
        centre: (3,) the mean of the centres, taken for the centre of mass.
        inertia: about any axis through it, in kg m^2: that of a ball as wide as the centres are apart.
    """

    name: str
    parent: str
    orientation: FloatArray
    position: FloatArray
    steps: tuple[Step, ...]
    centres: FloatArray
    mass: float
    centre: FloatArray
    inertia: float


@dataclass(frozen=True, eq=False)
class Closure:
    """What closes a loop: points of two bodies that coincide, or two frames that do.

    Attributes:
        joint: the cut joint.
        kind: "point" (a ball joint), "line" (two points on the axis of a hinge) or "frame" (nothing moves).
        first, second: names of the bodies, carrier (or parent) and child.
        first_points, second_points: (k, 3) in their frames, in m.
    """

    joint: str
    kind: Literal["point", "line", "frame"]
    first: str
    second: str
    first_points: FloatArray
    second_points: FloatArray


@dataclass(frozen=True, eq=False)
class Bodies:
    """A mechanism as bodies.

    Attributes:
        bodies: every body by name, each after the one that carries it; the base is the first.
        closures: one for each cut joint.
        home: (n,) our joint values at home, in the mechanism's unit and rad.
        metre: the mechanism's length unit in m.
        size: the characteristic length in m.
        steps: every elementary joint by name.
    """

    bodies: Mapping[str, Body]
    closures: tuple[Closure, ...]
    home: FloatArray
    metre: float
    size: float

    @property
    def steps(self) -> dict[str, Step]:
        """Every elementary joint by name."""
        return {step.name: step for body in self.bodies.values() for step in body.steps}


def bodies(record: MechanismRecord) -> Bodies:
    """The bodies of a mechanism.

    >>> from assur.model.registry import load_record
    >>> found = bodies(load_record("fivebar"))
    >>> list(found.bodies), [(item.joint, item.kind) for item in found.closures]
    (['base', 'crank1', 'crank2', 'rod1', 'rod2'], [('P', 'line')])
    """
    home = home_values(record)
    placed = frames(record, home)
    graph = joint_graph(record)
    metre = METRES[record.unit]
    size = metre * characteristic_length(record)
    made = {record.base: _body(record, record.base, "", placed[record.base], placed[record.base], (), size)}
    for joint, forward in graph.tree:
        near, far = (joint.parent, joint.child) if forward else (joint.child, joint.parent)
        steps = joint_steps(record, joint, home, forward=forward, metre=metre)
        made[far] = _body(record, far, near, placed[near], placed[far], steps, size)
    closures = []
    for joint in graph.cut:
        carrier, closure = _cut(record, joint, home, placed, metre, size)
        if carrier is not None:
            made[carrier.name] = carrier
        closures.append(closure)
    return Bodies(made, tuple(closures), home, metre, size)


def _cut(
    record: MechanismRecord, joint: Joint, home: FloatArray, placed: Mapping[str, Frame], metre: float, size: float
) -> tuple[Body | None, Closure]:
    """The carrier of a cut joint, where it needs one, and what closes the loop.

    An actuated joint is carried whole, so that it can be driven; so is one that does not end in a hinge or a ball.
    """
    steps = joint_steps(record, joint, home, forward=True, metre=metre)
    last = steps[-1]
    driven = any(item.coordinate.joint == joint.name for item in record.inputs)
    kind: Literal["point", "line", "frame"] = "point" if last.kind == "ball" else "line"
    if driven or last.kind == "slide" or joint.pitch:
        kind = "frame"
    kept = steps if kind == "frame" else steps[:-1]
    parent = placed[joint.parent]
    here = child_frame(joint, parent, home[joint_graph(record).slices[joint.name]])
    offsets = np.array([[-0.5], [0.5]]) * size * last.axis if kind == "line" else np.zeros((1, 3))
    points = last.at + offsets
    if kept:
        name = f"{joint.name}.carrier"
        orientation, position = _relative(parent, here)
        inertia = CARRIER_INERTIA * size**2
        place = metre * position
        carrier = Body(name, joint.parent, orientation, place, kept, last.at[None], CARRIER_MASS, last.at, inertia)
        return carrier, Closure(joint.name, kind, name, joint.child, points, points)
    orientation, position = _relative(parent, here)
    there = points @ orientation.T + metre * position
    return None, Closure(joint.name, kind, joint.parent, joint.child, there, points)


def _body(
    record: MechanismRecord, name: str, parent: str, near: Frame, far: Frame, steps: tuple[Step, ...], size: float
) -> Body:
    metre = METRES[record.unit]
    orientation, position = _relative(near, far)
    centres = metre * _centres(record, name)
    centre = np.mean(centres, axis=0)
    reach = max(float(np.max(np.linalg.norm(centres - centre, axis=-1))), THICKNESS * size)
    return Body(name, parent, orientation, metre * position, steps, centres, MASS, centre, 0.4 * MASS * reach**2)


def _relative(near: Frame, far: Frame) -> Frame:
    """Frame `far` in frame `near`."""
    return near[0].T @ far[0], near[0].T @ (far[1] - near[1])


def _centres(record: MechanismRecord, link: str) -> FloatArray:
    """Joint centres (k, 3) of a link in its frame, each once; of the platform also its point."""
    found = [joint.at for joint in record.joints.values() if joint.parent == link]
    found += [joint.child_at for joint in record.joints.values() if joint.child == link]
    if link == record.platform.link:
        found.append(record.platform.point)
    return np.unique(np.array(found).round(12) + 0.0, axis=0)
