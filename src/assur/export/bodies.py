"""A mechanism as bodies: what every simulation file says, in SI units, at home, before any of them says it.

The spanning tree of the joint graph carries the bodies; every joint is taken apart into hinges, slides and balls.
At home each elementary joint of a format without reference values is at zero; `ElementaryJoint.home` says what ours is.
A cut joint gets a *carrier*: a nominal body that hangs on the parent by all of the joint but its last hinge (or
ball), which is left to a constraint between carrier and child. A revolute or spherical joint needs no such body.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from assur.export.names import Names
from assur.export.steps import ElementaryJoint, joint_steps
from assur.joint_graph.frames import Frame, child_frame, frames
from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.tree import joint_graph
from assur.kinematics.home import home_values
from assur.kinematics.validation.check import METRES
from assur.machine.masses.link_masses import masses
from assur.machine.masses.rigid_body import RigidBody
from assur.model.mechanism import Joint, MechanismRecord

FloatArray = NDArray[np.float64]

MASS = 1.0
"""Nominal mass of a link, in kg, where the file does not say what all links weigh."""

CARRIER_MASS = 1e-3
"""Nominal mass of a carrier, in kg."""

CARRIER_INERTIA = 4e-7
"""Nominal inertia of a carrier about any axis, in kg m^2 per m^2 of the characteristic length.

Added to that of links as well: points and slender bars have none about some axis, which engines refuse."""

THICKNESS = 0.02
"""Radius of the drawn capsules, as a share of the characteristic length."""

PAIR = np.array([[-0.5], [0.5]])
"""Two points of an axis, in characteristic lengths along it: what keeps them together keeps the axis."""

TRIANGLE = 0.5 * (np.eye(3) - 1 / 3)
"""Three points (3, 3) about their mean, in characteristic lengths: what keeps them together keeps a frame."""


@dataclass(frozen=True, eq=False)
class Body:
    """A link, or the carrier of a cut joint, in the spanning tree.

    Attributes:
        name: of the link; of a carrier, the joint's with ".carrier".
        parent: name of the body that carries it; empty for the base.
        orientation, position: (3, 3) and (3,) of its frame in that of the parent at home, in m.
        steps: the elementary joints that carry it, the one nearest to the parent first.
        centres: (k, 3) joint centres and, of the platform, its point, in its frame, in m.
        mass: in kg, of the platform with its payload; nominal where the file does not say what all links weigh.
        centre: (3,) of mass; nominal is the mean of the centres.
        inertia: (3, 3) tensor about it, in kg m^2; nominal is that of a ball as wide as the centres are apart.
    """

    name: str
    parent: str
    orientation: FloatArray
    position: FloatArray
    steps: tuple[ElementaryJoint, ...]
    centres: FloatArray
    mass: float
    centre: FloatArray
    inertia: FloatArray


@dataclass(frozen=True, eq=False)
class Closure:
    """What closes a loop: points of two bodies that coincide at home, and stay together.

    Attributes:
        joint: the cut joint.
        first, second: names of the bodies.
        points: (k, 3) in the frame of the first, in m: one for a ball joint, two on the axis of a hinge, three that
            are not in line where nothing moves.
    """

    joint: str
    first: str
    second: str
    points: FloatArray


@dataclass(frozen=True, eq=False)
class Bodies:
    """A mechanism as bodies.

    Attributes:
        bodies: every body by name, each after the one that carries it; the base is the first.
        closures: one for each cut joint.
        home: (n,) our joint values at home, in the mechanism's unit and rad.
        metre: the mechanism's length unit in m.
        size: the characteristic length in m.
        gravity: (3,) in m/s^2.
        nominal: whether masses are.
        steps: every elementary joint by name.
    """

    bodies: Mapping[str, Body]
    closures: tuple[Closure, ...]
    home: FloatArray
    metre: float
    size: float
    gravity: FloatArray
    nominal: bool

    @property
    def steps(self) -> dict[str, ElementaryJoint]:
        """Every elementary joint by name."""
        return {step.name: step for body in self.bodies.values() for step in body.steps}


def bodies(record: MechanismRecord) -> Bodies:
    """The bodies of a mechanism.

    >>> from assur.model.registry import load_record
    >>> found = bodies(load_record("fivebar"))
    >>> list(found.bodies), [(item.joint, item.points.shape) for item in found.closures]
    (['base', 'crank1', 'crank2', 'rod1', 'rod2'], [('P', (2, 3))])
    """
    home = home_values(record)
    placed = frames(record, home)
    graph = joint_graph(record)
    metre = METRES[record.unit]
    size = metre * characteristic_length(record)
    known = masses(record)
    made = {record.base: _body(record, record.base, "", placed[record.base], placed[record.base], (), size)}
    for joint, forward in graph.tree:
        near, far = (joint.parent, joint.child) if forward else (joint.child, joint.parent)
        steps = joint_steps(record, joint, home, forward=forward, metre=metre)
        made[far] = _body(record, far, near, placed[near], placed[far], steps, size)
    if not known.lacking:
        heavy = known.carried(record.platform.link)
        made = {name: _weighed(body, heavy[name], size) if name in heavy else body for name, body in made.items()}
    tree = Bodies(made, (), home, metre, size, known.gravity, bool(known.lacking))
    cut = [_cut(record, joint, tree, placed) for joint in graph.cut]
    carriers = {body.name: body for body, _ in cut if body is not None}
    return replace(tree, bodies=made | carriers, closures=tuple(closure for _, closure in cut))


def singly_jointed(model: Bodies) -> Bodies:
    """The same with a nominal body between every two elementary joints, so that each body is carried by one.

    Several joints of one body are read in different ways: Drake takes the axes of all but the last in the frame of
    the parent, MuJoCo in that of the body.

    >>> from assur.model.registry import load_record
    >>> model = bodies(load_record("three_upu"))
    >>> len(model.bodies), len(singly_jointed(model).bodies)
    (10, 14)
    """
    made: dict[str, Body] = {}
    names = Names(model.bodies)
    for body in model.bodies.values():
        place = (body.parent, body.orientation, body.position)
        for step in body.steps[:-1]:
            name = names.new(f"{step.name}.link", "body")
            made[name] = carrier(name, place, (step,), step.at, model.size)
            place = (name, np.eye(3), np.zeros(3))
        parent, orientation, position = place
        made[body.name] = replace(
            body, parent=parent, orientation=orientation, position=position, steps=body.steps[-1:]
        )
    return replace(model, bodies=made)


def carrier(
    name: str,
    place: tuple[str, FloatArray, FloatArray],
    steps: tuple[ElementaryJoint, ...],
    at: FloatArray,
    size: float,
) -> Body:
    """A nominal body with its mass at one point (3,), in m; `place`: its parent, orientation and position there."""
    return Body(name, *place, steps, at[None], CARRIER_MASS, at, CARRIER_INERTIA * size**2 * np.eye(3))


def _cut(
    record: MechanismRecord, joint: Joint, model: Bodies, placed: Mapping[str, Frame]
) -> tuple[Body | None, Closure]:
    """The carrier of a cut joint, where it needs one, and what closes the loop.

    An actuated joint is carried whole, so that it can be driven; so is one that does not end in a hinge or a ball.
    The points are those of a body whose own joint is at its origin, for Pinocchio counts them from that joint: a
    carrier, the parent or the child. Where neither of these two is such a body, the joint is carried whole too.
    """
    steps = joint_steps(record, joint, model.home, forward=True, metre=model.metre)
    last = steps[-1]
    driven = any(item.coordinate.joint == joint.name for item in record.drives)
    parent, child = (_at_its_joint(model.bodies[name]) for name in (joint.parent, joint.child))
    whole = driven or last.kind == "slide" or bool(joint.pitch) or (len(steps) == 1 and not parent and not child)
    kept = steps if whole else steps[:-1]
    offsets = model.size * (TRIANGLE if whole else np.zeros((1, 3)) if last.kind == "ball" else PAIR * last.axis)
    near = placed[joint.parent]
    here = child_frame(joint, near, model.home[joint_graph(record).slices[joint.name]])
    orientation, position = _relative(near, here)
    origin = model.metre * position + orientation @ last.at
    if kept:
        steps = tuple(replace(step, at=np.zeros(3)) for step in kept)
        name = Names(record.links).new(f"{joint.name}.carrier", "body")
        body = carrier(name, (joint.parent, orientation, origin), steps, np.zeros(3), model.size)
        return body, Closure(joint.name, name, joint.child, offsets)
    if parent:
        return None, Closure(joint.name, joint.parent, joint.child, origin + offsets @ orientation.T)
    return None, Closure(joint.name, joint.child, joint.parent, last.at + offsets)


def _at_its_joint(body: Body) -> bool:
    """Whether the body's origin is at the joint that carries it; the base has none."""
    return not body.steps or not np.any(body.steps[-1].at)


def _body(
    record: MechanismRecord,
    name: str,
    parent: str,
    near: Frame,
    far: Frame,
    steps: tuple[ElementaryJoint, ...],
    size: float,
) -> Body:
    metre = METRES[record.unit]
    orientation, position = _relative(near, far)
    centres = metre * _centres(record, name)
    centre = np.mean(centres, axis=0)
    reach = max(float(np.max(np.linalg.norm(centres - centre, axis=-1))), THICKNESS * size)
    return Body(
        name, parent, orientation, metre * position, steps, centres, MASS, centre, 0.4 * MASS * reach**2 * np.eye(3)
    )


def _weighed(body: Body, own: RigidBody, size: float) -> Body:
    """A body with the mass that the file says."""
    tensor = own.inertia + CARRIER_INERTIA * size**2 * np.eye(3)
    return replace(body, mass=own.mass, centre=own.centre, inertia=tensor)


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
