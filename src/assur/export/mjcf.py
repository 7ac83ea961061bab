"""MJCF, the file of MuJoCo: the spanning tree as nested bodies, the loops closed by equality constraints.

The model stands at home; a joint's value there is its `ref`, so that the values of hinges and slides are ours (in m
and rad). A ball joint counts from home. An actuator is called by the name of the input, and its control is the
printed input. Where a mechanism closes its loops by ball joints, they are `connect` constraints of one point; by
hinges, of two points of the axis, whose six rows say what five would; by anything else, a `weld` to a carrier.
"""

from __future__ import annotations

from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from assur.export.bodies import Bodies, Body, Closure, bodies
from assur.export.shapes import arms, radius
from assur.export.steps import Step
from assur.export.xml_text import Element, child, comment, document, number, numbers, quaternion
from assur.model.mechanism import Input, MechanismRecord
from assur.topology.joints import HELICAL

FloatArray = NDArray[np.float64]
NOTE = "masses and sizes of bodies are nominal; lengths in m, angles in rad; key 'home' is the assembled home"
TIMESTEP = 5e-4
STIFF = {"solref": "0.001 1", "solimp": "0.999 0.9999 0.001 0.5 2"}
"""Constraints that give way for one millisecond, critically damped: the stiffest that the time step allows."""

QUICKNESS = 100.0
"""Natural frequency of the position servos, in rad/s, with the mass of all bodies on each."""


def mjcf(record: MechanismRecord) -> str:
    """The text of the MJCF file of a mechanism.

    Raises what `assur.kinematics.home.home_values` raises: only what closes can be exported.

    >>> from assur.model.registry import load_record
    >>> text = mjcf(load_record("fivebar"))
    >>> text.count("<body "), text.count("<connect "), '<key name="home"' in text
    (5, 2, True)
    """
    model = bodies(record)
    root = ElementTree.Element("mujoco", model=record.name)
    comment(root, f"{record.title}; {NOTE}")
    child(root, "compiler", angle="radian", autolimits="true")
    child(root, "option", timestep=number(TIMESTEP), integrator="implicitfast")
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
    _actuators(record, model, root)
    return document(root)


def _tree(record: MechanismRecord, model: Bodies, world: Element) -> None:
    """Bodies inside each other, with their joints, shapes and sites."""
    made: dict[str, Element] = {"": world}
    for body in model.bodies.values():
        element = child(
            made[body.parent],
            "body",
            name=body_name(body.name),
            pos=numbers(body.position),
            quat=quaternion(body.orientation),
        )
        made[body.name] = element
        if body.parent:
            inertia = numbers([body.inertia] * 3)
            child(element, "inertial", pos=numbers(body.centre), mass=number(body.mass), diaginertia=inertia)
        _joints(element, body)
        _shapes(element, body, model)
    for letter in record.points.values():
        child(made[letter.link], "site", name=letter.name, pos=numbers(model.metre * letter.at))
    if "platform" not in record.points:
        child(made[record.platform.link], "site", name="platform", pos=numbers(model.metre * record.platform.point))
    for closure in model.closures:
        for side, body_of, points in _sides(closure):
            for k, point in enumerate(points, 1):
                child(made[body_of], "site", name=_site(closure, side, k), pos=numbers(point))


def _joints(element: Element, body: Body) -> None:
    for step in body.steps:
        at = numbers(step.at)
        if step.kind == "ball":
            child(element, "joint", name=step.name, type="ball", pos=at)
            continue
        options = {} if step.limits is None else {"range": numbers(step.limits)}
        axis, ref = numbers(step.axis), number(step.home)
        child(element, "joint", name=step.name, type=step.kind, pos=at, axis=axis, ref=ref, **options)


def _shapes(element: Element, body: Body, model: Bodies) -> None:
    size = number(radius(model))
    for centre in body.centres:
        child(element, "geom", type="sphere", size=size, pos=numbers(centre))
    for arm in arms(body, model):
        child(element, "geom", type="capsule", size=size, fromto=numbers([*arm.start, *arm.end]))


def _sides(closure: Closure) -> list[tuple[str, str, FloatArray]]:
    return [("first", closure.first, closure.first_points), ("second", closure.second, closure.second_points)]


def _site(closure: Closure, side: str, number_: int) -> str:
    return f"{closure.joint}.{side}{number_}"


def _closure(equality: Element, closure: Closure) -> None:
    tag = "weld" if closure.kind == "frame" else "connect"
    for k in range(1, len(closure.first_points) + 1):
        first, second = _site(closure, "first", k), _site(closure, "second", k)
        child(equality, tag, name=f"{closure.joint}.{k}", site1=first, site2=second)


def _screws(record: MechanismRecord, model: Bodies, equality: Element) -> None:
    """The advance of each screw, tied to its rotation."""
    for joint in record.joints.values():
        if joint.type is HELICAL:
            slide = f"{joint.name}.advance"
            lead = number(model.steps[slide].ratio)
            child(equality, "joint", name=slide, joint1=slide, joint2=joint.name, polycoef=f"0 {lead} 0 0 0")


def _actuators(record: MechanismRecord, model: Bodies, root: Element) -> None:
    """Position servos called by the inputs, and the home key: every joint, then every control."""
    actuator = child(root, "actuator")
    mass = sum(body.mass for body in model.bodies.values())
    controls = []
    for item in record.inputs:
        ratio = model.metre if item.coordinate.kind == "length" else 1.0
        arm = 1.0 if item.coordinate.kind == "length" else model.size
        stiffness, damping = mass * (QUICKNESS * arm) ** 2, 2 * mass * QUICKNESS * arm**2
        child(
            actuator,
            "general",
            name=item.name,
            joint=record.coordinate_label(item.coordinate),
            gear=number(item.sign),
            gaintype="fixed",
            biastype="affine",
            gainprm=number(stiffness),
            biasprm=numbers([-stiffness * ratio * item.offset, -stiffness, -damping]),
            **_stroke(item, ratio),
        )
        controls.append(ratio * (item.sign * model.home[item.coordinate.index] + item.offset))
    places = np.concatenate([[1.0, 0.0, 0.0, 0.0] if step.kind == "ball" else [step.home] for step in _ordered(model)])
    child(child(root, "keyframe"), "key", name="home", qpos=numbers(places), ctrl=numbers(controls))


def _stroke(item: Input, ratio: float) -> dict[str, str]:
    return {} if item.stroke is None else {"ctrlrange": numbers([ratio * bound for bound in item.stroke])}


def _ordered(model: Bodies) -> list[Step]:
    """Elementary joints in the order of MuJoCo's qpos: that of the bodies, depth first."""
    below: dict[str, list[Body]] = {}
    for body in model.bodies.values():
        below.setdefault(body.parent, []).append(body)
    found: list[Step] = []
    waiting = list(below[""])
    while waiting:
        body = waiting.pop(0)
        found += body.steps
        waiting = below.get(body.name, []) + waiting
    return found


def body_name(link: str) -> str:
    """Name of a link's body: its own, but `world` is taken in MJCF."""
    return "world.link" if link == "world" else link
