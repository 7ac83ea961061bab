"""The MJCF file, read back by a reader of its own: nested bodies, joints, sites, constraints and actuators."""

from dataclasses import replace
from itertools import zip_longest
from xml.etree import ElementTree

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from assur.export.bodies import bodies, singly_jointed
from assur.export.mjcf import mjcf
from assur.joint_graph.frames import frames
from assur.joint_graph.points import point


def floats(text):
    return np.array([float(word) for word in text.split()])


def read(text, values):
    """Frames of bodies, and sites, at joint values by name (a ball's is a rotation): MuJoCo's rules."""
    bodies, sites = {}, {}

    def enter(element, turn, place):
        place = place + turn @ floats(element.get("pos"))
        w, x, y, z = floats(element.get("quat"))
        turn = turn @ Rotation.from_quat([x, y, z, w]).as_matrix()
        for joint in element.findall("joint"):
            value = values[joint.get("name")]
            if joint.get("type") == "slide":
                place = place + turn @ floats(joint.get("axis")) * (value - float(joint.get("ref")))
                continue
            anchor = place + turn @ floats(joint.get("pos"))
            if joint.get("type") == "ball":
                turn = turn @ value
            else:
                angle = value - float(joint.get("ref"))
                turn = turn @ Rotation.from_rotvec(angle * floats(joint.get("axis"))).as_matrix()
            place = anchor - turn @ floats(joint.get("pos"))
        bodies[element.get("name")] = (turn, place)
        for site in element.findall("site"):
            sites[site.get("name")] = (turn, place + turn @ floats(site.get("pos")))
        for inner in element.findall("body"):
            enter(inner, turn, place)

    (root,) = ElementTree.fromstring(text).find("worldbody").findall("body")
    enter(root, np.eye(3), np.zeros(3))
    return bodies, sites


def nesting(text):
    """Which body each body hangs on."""
    root = ElementTree.fromstring(text).find("worldbody")
    return {inner.get("name"): outer.get("name") for outer in root.iter("body") for inner in outer.findall("body")}


def body(link):
    """MuJoCo has a body `world` of its own."""
    return "world.link" if link == "world" else link


def named_values(record, joint_values, home, parents, metre):
    """Our joint values as those of the file: SI units, an advance for each screw, a ball away from home."""
    found = {}
    for name, joint in record.joints.items():
        for item in record.joint_coordinates(name):
            value = joint_values[item.index]
            found[record.coordinate_label(item)] = metre * value if item.kind == "length" else value
        start = record.joint_coordinates(name)[0].index
        if joint.type.letter == "H":
            found[f"{name}.advance"] = metre * joint.pitch * joint_values[start] / (2 * np.pi)
        if joint.type.letter == "S":
            there = Rotation.from_rotvec(joint_values[start : start + 3]).as_matrix() @ joint.turn
            rest = Rotation.from_rotvec(home[start : start + 3]).as_matrix() @ joint.turn
            forward = parents.get(body(joint.child)) == body(joint.parent)
            found[name] = rest.T @ there if forward else rest @ there.T
    return found | printed_values(record, joint_values, metre)


def printed_values(record, joint_values, metre):
    """Of actuated joints the printed inputs by their signs."""
    units = [metre if item.coordinate.kind == "length" else 1.0 for item in record.inputs]
    printed = [item.sign * joint_values[item.coordinate.index] + item.offset for item in record.inputs]
    return {
        record.coordinate_label(item.coordinate): item.sign * unit * value
        for item, unit, value in zip(record.inputs, units, printed, strict=True)
    }


def at(record, joint_values, home, metre, text):
    """What the file says at our joint values."""
    return read(text, named_values(record, joint_values, home, nesting(text), metre))


@pytest.fixture
def text(record):
    return mjcf(record)


def test_links_are_where_the_joint_graph_says_at_any_joint_values(record, text, anywhere, home, metre):
    bodies, sites = at(record, anywhere, home, metre, text)
    for link, (rotation, origin) in frames(record, anywhere).items():
        np.testing.assert_allclose(bodies[body(link)][0], rotation, atol=1e-9)
        np.testing.assert_allclose(bodies[body(link)][1], metre * origin, atol=1e-9)
    for letter in record.points:
        np.testing.assert_allclose(sites[letter][1], metre * point(record, letter, anywhere), atol=1e-9)


def gaps(text, home, there):
    """Distances that the constraints want to be nothing: a point of one body, and where it lay in the other at home."""
    found = []
    for item in ElementTree.fromstring(text).findall("equality/connect"):
        (near, place), (far, origin) = home[item.get("body1")], home[item.get("body2")]
        anchor = floats(item.get("anchor"))
        other = far.T @ (place + near @ anchor - origin)
        (near, place), (far, origin) = there[item.get("body1")], there[item.get("body2")]
        found.append(np.linalg.norm(place + near @ anchor - origin - far @ other))
    return found


def test_constraints_hold_where_the_loops_close_and_only_there(record, text, anywhere, elsewhere, home, metre):
    rest, _ = at(record, home, home, metre, text)
    assert max(gaps(text, rest, at(record, elsewhere, home, metre, text)[0])) < 1e-9
    assert max(gaps(text, rest, at(record, anywhere, home, metre, text)[0])) > 1e-4


def test_it_keeps_to_what_every_reader_knows(record, text):
    root = ElementTree.fromstring(text)
    screws = [joint for joint in record.joints.values() if joint.type.letter == "H"]
    constraints = [item.tag for item in root.find("equality")]
    assert len(constraints) - constraints.count("connect") == len(screws) == constraints.count("joint")
    assert all(item.get("body1") and item.get("body2") for item in root.findall("equality/connect"))
    assert {item.tag for item in root.find("actuator")} == {"motor"}
    named = {tag: [item.get("name") for item in root.iter(tag)] for tag in ("body", "joint", "site")}
    assert all(len(item.findall("joint")) <= 1 for item in root.iter("body"))
    assert len(set(named["body"])) == len(named["body"])
    assert not {*named["body"], *named["joint"]} & {*named["site"]}


def test_the_home_key_is_the_reference_of_every_joint_in_the_order_of_the_bodies(record, text):
    root = ElementTree.fromstring(text)
    wanted = []
    for joint in root.find("worldbody").iter("joint"):
        wanted += [1.0, 0.0, 0.0, 0.0] if joint.get("type") == "ball" else [float(joint.get("ref"))]
    key = root.find("keyframe/key")
    assert key.get("name") == "home"
    np.testing.assert_array_equal(floats(key.get("qpos")), wanted)


def length(servo, values):
    return float(servo.get("gear")) * values[servo.get("joint")]


def test_the_length_of_each_motor_is_the_printed_input(record, text, anywhere, home, metre):
    motors = ElementTree.fromstring(text).findall("actuator/motor")
    assert [motor.get("name") for motor in motors] == [item.name for item in record.inputs]
    values = named_values(record, anywhere, home, nesting(text), metre)
    for motor, item in zip(motors, record.inputs, strict=True):
        unit = metre if item.coordinate.kind == "length" else 1.0
        printed = item.sign * anywhere[item.coordinate.index] + item.offset
        assert length(motor, values) == pytest.approx(unit * printed, abs=1e-12)


def test_a_servo_for_each_input_rests_at_the_printed_input(record, home, metre):
    root = ElementTree.fromstring(mjcf(record, servos=True))
    servos = root.findall("actuator/position")
    assert [servo.get("name") for servo in servos] == [item.name for item in record.inputs]
    values = printed_values(record, home, metre)
    controls = floats(root.find("keyframe/key").get("ctrl"))
    np.testing.assert_allclose(controls, [length(servo, values) for servo in servos], atol=1e-12)
    for servo, item in zip(servos, record.inputs, strict=True):
        unit = metre if item.coordinate.kind == "length" else 1.0
        stroke = None if item.stroke is None else unit * np.array(item.stroke)
        assert (servo.get("ctrlrange") is None) == (stroke is None)
        if stroke is not None:
            np.testing.assert_allclose(floats(servo.get("ctrlrange")), stroke)


def test_a_screw_is_tied_to_its_turn(record, text, metre):
    tied = ElementTree.fromstring(text).findall("equality/joint")
    screws = [joint for joint in record.joints.values() if joint.type.letter == "H"]
    assert [item.get("joint2") for item in tied] == [joint.name for joint in screws]
    for item, joint in zip(tied, screws, strict=True):
        assert floats(item.get("polycoef"))[1] == pytest.approx(metre * joint.pitch / (2 * np.pi))


def test_limits_and_strokes_are_ranges_of_the_joints(record, text, metre):
    ranges = {item.get("name"): item.get("range") for item in ElementTree.fromstring(text).iter("joint")}
    driven = {record.coordinate_label(item.coordinate): item for item in record.inputs}
    for joint in record.joints.values():
        for item, limit in zip_longest(record.joint_coordinates(joint.name), joint.limits):
            label = record.coordinate_label(item)
            bounds = [] if limit is None else [np.array(limit)]
            if label in driven:
                one = driven[label]
                bounds = [bound + one.offset / one.sign for bound in bounds]
                bounds += [] if one.stroke is None else [np.sort(np.array(one.stroke) / one.sign)]
            if label in ranges and joint.type.letter != "S":
                assert (ranges[label] is None) == (not bounds)
            if label in ranges and bounds:
                unit = metre if item.kind == "length" else 1.0
                both = [np.max(bounds, axis=0)[0], np.min(bounds, axis=0)[1]]
                np.testing.assert_allclose(floats(ranges[label]), unit * np.array(both))


@pytest.mark.parametrize("record", ["b/J2"], indirect=True)
def test_nominal_bodies_take_no_name_of_a_link(record):
    model = bodies(record)
    between = [f"{step.name}.link" for body in model.bodies.values() for step in body.steps[:-1]]
    assert set(between) <= set(singly_jointed(model).bodies)
    link = replace(model.bodies["world"], name=between[0])
    both = replace(model, bodies={between[0]: link, **model.bodies})
    assert len(singly_jointed(both).bodies) == len(both.bodies) + len(between)
    assert singly_jointed(both).bodies[between[0]].mass == link.mass
