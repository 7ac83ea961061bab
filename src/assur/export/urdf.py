"""URDF: the spanning tree, and beside it a file for the loops that URDF cannot hold (`assur.export.sidecar`).

The tree stands at home, where URDF counts every joint value as zero. A link's frame lies at its joint, with the axes
of our frame; the sidecar says where our frame lies in it. A joint with several freedoms is a row of single ones with
nominal links between; a ball joint turns about x, then y, then z of the link that it carries.
"""

from __future__ import annotations

from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from assur.export.bodies import CARRIER_INERTIA, CARRIER_MASS, Bodies, Body, bodies
from assur.export.names import Names, link_name
from assur.export.shapes import arms, radius
from assur.export.steps import ElementaryJoint
from assur.export.xml_text import Element, child, comment, document, number, numbers, tensor_entries
from assur.joint_graph.tree import joint_graph
from assur.model.mechanism import MechanismRecord
from assur.numerics import rotations

FloatArray = NDArray[np.float64]
NOTE = "sizes are nominal; masses in kg, lengths in m, angles in rad; it stands at home, where every joint is at zero"
EFFORT, VELOCITY = 1000.0, 10.0
"""Nominal limits, which URDF asks for: N or N m, and m/s or rad/s."""

REACH = 10.0
"""Travel, in characteristic lengths, of a slide for which the file gives none."""


def urdf(record: MechanismRecord) -> str:
    """The text of the URDF file of a mechanism: a tree without its loops.

    Raises what `assur.kinematics.home.home_values` raises: only what closes can be exported.

    >>> from assur.model.registry import load_record
    >>> text = urdf(load_record("fivebar"))
    >>> text.count("<link "), text.count("<joint ")
    (5, 4)
    """
    model = bodies(record)
    root = ElementTree.Element("robot", name=record.name)
    comment(root, f"{record.title}; {NOTE}; its loops are in the file beside it")
    for name in tree_links(record):
        body = model.bodies[name]
        if body.parent:
            _joints(root, body, model)
        element = child(root, "link", name=link_name(name))
        _solid(element, body, model)
    return document(root)


def tree_links(record: MechanismRecord) -> list[str]:
    """The links, each after the one that carries it."""
    graph = joint_graph(record)
    return [record.base, *(joint.child if forward else joint.parent for joint, forward in graph.tree)]


def anchor(body: Body) -> FloatArray:
    """Where (3,) a link's URDF frame lies in its own frame, in m: at the joint that carries it."""
    return body.steps[0].at if body.steps else np.zeros(3)


def single_steps(step: ElementaryJoint) -> list[ElementaryJoint]:
    """A hinge or slide as it is, a ball as hinges about x, y, z."""
    if step.kind != "ball":
        return [step]
    parts = zip(("rx", "ry", "rz"), np.eye(3), strict=True)
    return [replace(step, name=f"{step.name}.{name}", kind="hinge", axis=axis) for name, axis in parts]


def roll_pitch_yaw(orientation: FloatArray) -> FloatArray:
    """Angles (3,) about fixed x, y, z of a rotation (3, 3), exact also where pitch is a right angle.

    >>> roll_pitch_yaw(np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])).round(12).tolist()
    [0.0, 1.570796326795, 0.0]
    """
    yaw = np.arctan2(orientation[1, 0], orientation[0, 0])
    pitch = np.arctan2(-orientation[2, 0], np.hypot(orientation[0, 0], orientation[1, 0]))
    _, y, z = np.eye(3)
    rolled = rotations.about_axis(y, -pitch) @ rotations.about_axis(z, -yaw) @ orientation
    return np.array([np.arctan2(rolled[2, 1], rolled[1, 1]), pitch, yaw])


def _joints(root: Element, body: Body, model: Bodies) -> None:
    """The row of joints that carries a link, and the nominal links between them."""
    steps = [single for step in body.steps for single in single_steps(step)]
    taken = Names(model.bodies)
    names = [taken.new(f"{step.name}.link", "body") for step in steps[:-1]]
    position = body.position + body.orientation @ anchor(body) - anchor(model.bodies[body.parent])
    place = {"xyz": numbers(position), "rpy": numbers(roll_pitch_yaw(body.orientation))}
    for step, near, far in zip(steps, [link_name(body.parent), *names], [*names, link_name(body.name)], strict=True):
        made = child(root, "joint", name=step.name, type=_kind(step))
        child(made, "origin", **place)
        child(made, "parent", link=near)
        child(made, "child", link=far)
        child(made, "axis", xyz=numbers(step.axis))
        if _kind(step) != "continuous":
            low, high = step.limits or (-REACH * model.size, REACH * model.size)
            bounds = {"lower": number(low - step.home), "upper": number(high - step.home)}
            child(made, "limit", effort=number(EFFORT), velocity=number(VELOCITY), **bounds)
        place = {"xyz": "0 0 0", "rpy": "0 0 0"}
        if far in names:
            _mass(child(root, "link", name=far), CARRIER_MASS, np.zeros(3), CARRIER_INERTIA * model.size**2 * np.eye(3))


def _kind(step: ElementaryJoint) -> str:
    if step.kind == "slide":
        return "prismatic"
    return "continuous" if step.limits is None else "revolute"


def _solid(element: Element, body: Body, model: Bodies) -> None:
    """Mass and shapes of a link; URDF has no capsules, so the arms are cylinders between the balls."""
    shift, size = anchor(body), number(radius(model))
    _mass(element, body.mass, body.centre - shift, body.inertia)
    for centre in body.centres:
        _shape(element, np.eye(3), centre - shift, "sphere", radius=size)
    for arm in arms(body, model):
        _shape(element, arm.turn, arm.middle - shift, "cylinder", radius=size, length=number(arm.length))


def _mass(element: Element, mass: float, centre: FloatArray, inertia: FloatArray) -> None:
    inertial = child(element, "inertial")
    child(inertial, "origin", xyz=numbers(centre), rpy="0 0 0")
    child(inertial, "mass", value=number(mass))
    child(inertial, "inertia", **tensor_entries(inertia))


def _shape(element: Element, turn: FloatArray, at: FloatArray, kind: str, **sizes: str) -> None:
    visual = child(element, "visual")
    child(visual, "origin", xyz=numbers(at), rpy=numbers(roll_pitch_yaw(turn)))
    child(child(visual, "geometry"), kind, **sizes)
