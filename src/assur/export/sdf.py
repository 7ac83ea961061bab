"""SDF 1.9: every joint of the joint graph as it stands, loops and all.

The model stands at home, where SDF counts every joint value as zero; a note at each joint gives ours. A cylindrical
joint, which SDF does not have, is a slide and a hinge with a nominal link between. Letters are frames. libsdformat 12
(Gazebo Fortress, Debian 12) reads no newer version, and newer libraries read this one.
"""

from __future__ import annotations

from collections.abc import Iterable
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from assur.export.bodies import CARRIER_INERTIA, CARRIER_MASS, Bodies, Body, bodies
from assur.export.names import Names
from assur.export.shapes import arms, radius
from assur.export.steps import ElementaryJoint, joint_steps
from assur.export.xml_text import Element, child, comment, document, number, numbers, tensor_entries
from assur.joint_graph.frames import frames
from assur.model.mechanism import Joint, MechanismRecord
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
VERSION = "1.9"
NOTE = "sizes are nominal; masses in kg, lengths in m, angles in rad; it stands at home, where every joint is at zero"


def sdf(record: MechanismRecord) -> str:
    """The text of the SDF file of a mechanism.

    Raises what `assur.kinematics.home.home_values` raises: only what closes can be exported.

    >>> from assur.model.registry import load_record
    >>> text = sdf(load_record("fivebar"))
    >>> text.count("<link "), text.count('type="revolute"')
    (5, 5)
    """
    model = bodies(record)
    names = Names()
    root = ElementTree.Element("sdf", version=VERSION)
    top = child(root, "model", name=record.name)
    comment(top, f"{record.title}; {NOTE}")
    inputs = ", ".join(f"{item.name} = joint {record.coordinate_label(item.coordinate)}" for item in record.drives)
    comment(top, f"inputs: {inputs}")
    placed = {link: (rotation, model.metre * origin) for link, (rotation, origin) in frames(record, model.home).items()}
    links = {link: names.new(link, "link") for link in record.links}
    for link, name in links.items():
        element = child(top, "link", name=name)
        child(element, "pose", pose(*placed[link]), rotation_format="quat_xyzw")
        _solid(element, model.bodies[link], model)
    base = child(top, "joint", name=names.new("fixed", "joint"), type="fixed")
    child(base, "parent", "world")
    child(base, "child", links[record.base])
    for joint in record.joints.values():
        _joint(top, record, joint, model, links, placed, names)
    for letter in record.points.values():
        frame = child(top, "frame", name=names.new(letter.name, "point"), attached_to=links[letter.link])
        child(frame, "pose", pose(np.eye(3), model.metre * letter.at), rotation_format="quat_xyzw")
    return document(root)


def pose(orientation: FloatArray, position: FloatArray) -> str:
    """Position, then the quaternion x y z w."""
    w, x, y, z = rotations.to_quaternion(orientation)
    return numbers([*position, x, y, z, w])


def _solid(element: Element, body: Body, model: Bodies) -> None:
    """Mass and shapes of a link."""
    _mass(element, body.mass, body.centre, body.inertia)
    size = number(radius(model))
    for k, centre in enumerate(body.centres, 1):
        _shape(element, f"centre{k}", np.eye(3), centre, "sphere", radius=size)
    for k, arm in enumerate(arms(body, model), 1):
        _shape(element, f"arm{k}", arm.turn, arm.middle, "capsule", radius=size, length=number(arm.length))


def _mass(element: Element, mass: float, centre: FloatArray, inertia: FloatArray) -> None:
    inertial = child(element, "inertial")
    child(inertial, "pose", pose(np.eye(3), centre), rotation_format="quat_xyzw")
    child(inertial, "mass", number(mass))
    matrix = child(inertial, "inertia")
    for name, entry in tensor_entries(inertia).items():
        child(matrix, name, entry)


def _shape(element: Element, name: str, turn: FloatArray, at: FloatArray, kind: str, **sizes: str) -> None:
    visual = child(element, "visual", name=name)
    child(visual, "pose", pose(turn, at), rotation_format="quat_xyzw")
    shape = child(child(visual, "geometry"), kind)
    for size, text in sizes.items():
        child(shape, size, text)


def _joint(
    top: Element,
    record: MechanismRecord,
    joint: Joint,
    model: Bodies,
    links: dict[str, str],
    placed: dict[str, tuple[FloatArray, FloatArray]],
    names: Names,
) -> None:
    steps = joint_steps(record, joint, model.home, forward=True, metre=model.metre)
    parent, own = links[joint.parent], links[joint.child]
    if joint.type.slides and len(steps) > 1:
        between = [names.new(f"{joint.name}.carrier", "link") for _ in steps[1:]]
        for name, step in zip(between, steps, strict=False):
            link = child(top, "link", name=name)
            child(link, "pose", pose(*placed[joint.child]), rotation_format="quat_xyzw")
            _mass(link, CARRIER_MASS, step.at, CARRIER_INERTIA * model.size**2 * np.eye(3))
        for step, near, far in zip(steps, [parent, *between], [*between, own], strict=True):
            kind = "prismatic" if step.kind == "slide" else "revolute"
            _element(top, names.new(step.name, "joint"), kind, near, far, [step])
        return
    name = names.new(joint.name, "joint")
    if joint.type.ball:
        _element(top, name, "ball", parent, own, steps)
    elif joint.type.turns == 2:
        _element(top, name, "universal", parent, own, steps)
    elif joint.type.screw:
        hinge = next(step for step in steps if step.kind == "hinge")
        made = _element(top, name, "screw", parent, own, [hinge])
        # rad per m, of a right-handed thread below zero; SDF 1.10 has the advance per turn in its place
        child(made, "thread_pitch", number(-2 * np.pi / (model.metre * joint.pitch)))
    else:
        kind = "prismatic" if steps[0].kind == "slide" else "revolute"
        _element(top, name, kind, parent, own, steps)


def _element(top: Element, name: str, kind: str, parent: str, own: str, steps: Iterable[ElementaryJoint]) -> Element:
    """A joint, its frame at the joint's point with the axes of the child."""
    made = child(top, "joint", name=name, type=kind)
    steps = list(steps)
    child(made, "parent", parent)
    child(made, "child", own)
    child(made, "pose", pose(np.eye(3), steps[0].at), rotation_format="quat_xyzw")
    for step, tag in zip((item for item in steps if item.kind != "ball"), ("axis", "axis2"), strict=False):
        comment(made, f"{step.name} is {number(step.home)} here")
        axis = child(made, tag)
        child(axis, "xyz", numbers(step.axis))
        limit = child(axis, "limit")
        if step.limits is not None:
            child(limit, "lower", number(step.limits[0] - step.home))
            child(limit, "upper", number(step.limits[1] - step.home))
    return made
