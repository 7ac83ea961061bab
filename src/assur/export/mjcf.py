"""MJCF, the file of MuJoCo: the spanning tree as nested bodies, the loops closed by equality constraints.

What is written is what MuJoCo, Newton, Drake and Pinocchio all read: every loop is closed by `connect` constraints of
two bodies and an anchor, which coincide at home. Of ball joints that is one point, of hinges two points of the axis,
of anything else three points of a carrier. And every body is carried by one joint, with nominal bodies between.

The model stands at home; a joint's value there is its `ref`, so that the values of hinges and slides are ours (in m
and rad), and those of actuated joints are the printed inputs times their signs. A ball joint counts from home. An
actuator is called by the name of the input, and its length is the printed input: a motor pushes along it, a servo
takes it for its control.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np

from assur.export.bodies import Bodies, Body, Closure, bodies, singly_jointed
from assur.export.names import Names, link_name
from assur.export.shapes import arms, radius
from assur.export.steps import ElementaryJoint
from assur.export.xml_text import Element, child, comment, document, number, numbers, quaternion
from assur.model.mechanism import MechanismRecord

NOTE = "sizes of bodies are nominal; masses in kg, lengths in m, angles in rad; key 'home' is the assembled home"
TIMESTEP = 5e-4
STIFF = {"solref": "0.001 1", "solimp": "0.999 0.9999 0.001 0.5 2"}
"""Constraints that give way for one millisecond, critically damped: the stiffest that the time step allows."""

QUICKNESS = 100.0
"""Natural frequency of the position servos, in rad/s, with the mass of all bodies on each."""


def mjcf(record: MechanismRecord, *, servos: bool = False) -> str:
    """The text of the MJCF file of a mechanism.

    Args:
        record: the mechanism.
        servos: position servos as actuators in place of motors. MuJoCo and Newton know both; Drake takes the range
            of a servo's control for its largest force.

    Raises what `assur.kinematics.home.home_values` raises: only what closes can be exported.

    >>> from assur.model.registry import load_record
    >>> text = mjcf(load_record("fivebar"))
    >>> text.count("<body "), text.count("<connect "), '<key name="home"' in text
    (5, 2, True)
    """
    model = singly_jointed(printed(record, bodies(record)))
    root = ElementTree.Element("mujoco", model=record.name)
    comment(root, f"{record.title}; {NOTE}")
    child(root, "compiler", angle="radian", autolimits="true")
    child(root, "option", timestep=number(TIMESTEP), integrator="implicitfast", gravity=numbers(model.gravity))
    defaults = child(root, "default")
    child(defaults, "geom", contype="0", conaffinity="0")
    child(defaults, "site", size=number(radius(model)))
    child(defaults, "equality", **STIFF)
    world = child(root, "worldbody")
    child(world, "light", pos=numbers([0.0, 0.0, 4 * model.size]))
    _tree(record, model, world)
    equality = child(root, "equality")
    for closure in model.closures:
        _closure(equality, closure)
    _screws(record, model, equality)
    _actuators(record, model, root, servos=servos)
    _home(record, model, root, servos=servos)
    return document(root)


def printed(record: MechanismRecord, model: Bodies) -> Bodies:
    """The bodies with actuated joints whose values are the printed inputs by their signs, within their strokes.

    >>> from assur.model.registry import load_record
    >>> record = load_record("planar_3rpr")
    >>> model = bodies(record)
    >>> leg = record.inputs[0]
    >>> step = printed(record, model).steps[record.coordinate_label(leg.coordinate)]
    >>> bool(step.value(model.home) == leg.sign * model.metre * (leg.sign * model.home[step.index] + leg.offset))
    True
    """
    driven = {record.coordinate_label(one.coordinate): one for one in record.drives}

    def told(step: ElementaryJoint) -> ElementaryJoint:
        one = driven.get(step.name)
        if one is None:
            return step
        offset = step.ratio * one.offset / one.sign
        bounds = [] if step.limits is None else [np.array(step.limits) + offset]
        bounds += [] if one.stroke is None else [np.sort(step.ratio * np.array(one.stroke) / one.sign)]
        limits = (float(max(low for low, _ in bounds)), float(min(high for _, high in bounds))) if bounds else None
        return replace(step, home=step.home + offset, offset=offset, limits=limits)

    told_bodies = {name: replace(body, steps=tuple(map(told, body.steps))) for name, body in model.bodies.items()}
    return replace(model, bodies=told_bodies)


def _tree(record: MechanismRecord, model: Bodies, world: Element) -> None:
    """Bodies inside each other, with their joints, shapes and sites."""
    made: dict[str, Element] = {"": world}
    rotors = {joint: actuator.inertia for joint, actuator in record.machine.actuators.items() if actuator.inertia}
    for body in model.bodies.values():
        element = child(
            made[body.parent],
            "body",
            name=link_name(body.name),
            pos=numbers(body.position),
            quat=quaternion(body.orientation),
        )
        made[body.name] = element
        inertia = numbers(body.inertia[([0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2])])
        child(element, "inertial", pos=numbers(body.centre), mass=number(body.mass), fullinertia=inertia)
        _joints(element, body, rotors)
        _shapes(element, body, model)
    _sites(record, model, made)


def _sites(record: MechanismRecord, model: Bodies, made: Mapping[str, Element]) -> None:
    """Letters, and the platform's point. Pinocchio takes a site for a body of its name, so that they differ."""
    names = Names([*map(link_name, model.bodies), *model.steps])
    for letter in record.points.values():
        site = names.new(letter.name, "point")
        child(made[letter.link], "site", name=site, pos=numbers(model.metre * letter.at))
    if "platform" not in record.points:
        site, at = names.new("platform", "point"), model.metre * record.platform.point
        child(made[record.platform.link], "site", name=site, pos=numbers(at))


def _joints(element: Element, body: Body, rotors: Mapping[str, float]) -> None:
    for step in body.steps:
        at = numbers(step.at)
        if step.kind == "ball":
            child(element, "joint", name=step.name, type="ball", pos=at)
            continue
        options = {} if step.limits is None else {"range": numbers(step.limits)}
        if step.name in rotors:
            options["armature"] = number(rotors[step.name])
        axis, ref = numbers(step.axis), number(step.home)
        child(element, "joint", name=step.name, type=step.kind, pos=at, axis=axis, ref=ref, **options)


def _shapes(element: Element, body: Body, model: Bodies) -> None:
    size = number(radius(model))
    for centre in body.centres:
        child(element, "geom", type="sphere", size=size, pos=numbers(centre))
    for arm in arms(body, model):
        child(element, "geom", type="capsule", size=size, fromto=numbers([*arm.start, *arm.end]))


def _closure(equality: Element, closure: Closure) -> None:
    ends = {"body1": link_name(closure.first), "body2": link_name(closure.second)}
    for k, point in enumerate(closure.points, 1):
        child(equality, "connect", name=f"{closure.joint}.{k}", **ends, anchor=numbers(point))


def _screws(record: MechanismRecord, model: Bodies, equality: Element) -> None:
    """The advance of each screw, tied to its rotation."""
    for joint in record.joints.values():
        if joint.type.screw:
            slide = f"{joint.name}.advance"
            lead = number(model.steps[slide].ratio)
            child(equality, "joint", name=slide, joint1=slide, joint2=joint.name, polycoef=f"0 {lead} 0 0 0")


def _actuators(record: MechanismRecord, model: Bodies, root: Element, *, servos: bool) -> None:
    """Motors or position servos, called by the inputs."""
    actuator = child(root, "actuator")
    mass = sum(body.mass for body in model.bodies.values())
    for one in record.drives:
        step = model.steps[record.coordinate_label(one.coordinate)]
        arm = 1.0 if step.kind == "slide" else model.size
        gains = {"kp": number(mass * (QUICKNESS * arm) ** 2), "kv": number(2 * mass * QUICKNESS * arm**2)}
        if one.stroke is not None:
            gains["ctrlrange"] = numbers(step.ratio * np.array(one.stroke))
        common = {"name": one.name, "joint": step.name, "gear": number(one.sign)}
        child(actuator, "position" if servos else "motor", **common, **(gains if servos else {}))


def _home(record: MechanismRecord, model: Bodies, root: Element, *, servos: bool) -> None:
    """The key of that name: every joint, then every control: of a servo the printed input, of a motor no force."""
    places = [[1.0, 0.0, 0.0, 0.0] if step.kind == "ball" else [step.home] for step in _ordered(model)]
    lengths = [one.sign * model.steps[record.coordinate_label(one.coordinate)].home for one in record.drives]
    controls = np.array(lengths) if servos else np.zeros(len(lengths))
    child(child(root, "keyframe"), "key", name="home", qpos=numbers(np.concatenate(places)), ctrl=numbers(controls))


def _ordered(model: Bodies) -> list[ElementaryJoint]:
    """Elementary joints in the order of MuJoCo's qpos: that of the bodies, depth first."""
    below: dict[str, list[Body]] = {}
    for body in model.bodies.values():
        below.setdefault(body.parent, []).append(body)
    found: list[ElementaryJoint] = []
    waiting = list(below[""])
    while waiting:
        body = waiting.pop(0)
        found += body.steps
        waiting = below.get(body.name, []) + waiting
    return found
