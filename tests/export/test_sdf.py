"""The SDF file, read back joint by joint: what each one allows, against the frames of closed configurations."""

from xml.etree import ElementTree

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from assur.export.names import Names
from assur.export.sdf import sdf
from assur.joint_graph.frames import frames
from assur.joint_graph.points import point

TURNING = {"revolute": 1, "universal": 2, "screw": 1}


def floats(text):
    return np.array([float(word) for word in text.split()])


def pose(element):
    numbers = floats(element.find("pose").text)
    assert element.find("pose").get("rotation_format") == "quat_xyzw"
    return Rotation.from_quat(numbers[3:]).as_matrix(), numbers[:3]


def model_of(text):
    root = ElementTree.fromstring(text)
    assert root.get("version") == "1.9"
    return root.find("model")


@pytest.fixture
def model(record):
    return model_of(sdf(record))


def links(model):
    return {element.get("name"): pose(element) for element in model.findall("link")}


def link(name):
    """`world` is SDF's own."""
    return "world.link" if name == "world" else name


def moved(joint, parent_home, child_home, values):
    """Frame of the child in the parent's, for values by axis (a ball's is a rotation): the SDF's rules."""
    turn, place = parent_home[0].T @ child_home[0], parent_home[0].T @ (child_home[1] - parent_home[1])
    in_child, anchor = pose(joint)
    axes = [
        in_child @ floats(joint.find(tag).find("xyz").text) for tag in ("axis", "axis2") if joint.find(tag) is not None
    ]
    kind = joint.get("type")
    slide, swing = np.zeros(3), np.eye(3)
    if kind == "prismatic":
        slide = axes[0] * values[0]
    elif kind == "ball":
        swing = values[0]
    else:
        for axis, value in zip(axes, values, strict=True):
            swing = swing @ Rotation.from_rotvec(value * axis).as_matrix()
    if kind == "screw":
        slide = -axes[0] * values[0] / float(joint.find("thread_pitch").text)
    # the anchor stays where it is, but for the slide
    centre = place + turn @ (anchor + slide)
    return turn @ swing, centre - turn @ swing @ anchor


def relative(near, far):
    return near[0].T @ far[0], near[0].T @ (far[1] - near[1])


def test_the_links_stand_at_home(record, model, home, metre):
    there = links(model)
    for name, (rotation, origin) in frames(record, home).items():
        np.testing.assert_allclose(there[link(name)][0], rotation, atol=1e-9)
        np.testing.assert_allclose(there[link(name)][1], metre * origin, atol=1e-9)


def values_away(record, joint, elsewhere, home, metre):
    """Values of a joint's components away from home, in SI units; a ball's as a rotation in the child."""
    found = []
    for item in record.joint_coordinates(joint.name):
        change = elsewhere[item.index] - home[item.index]
        found.append(metre * change if item.kind == "length" else change)
    if joint.type.letter != "S":
        return found
    start = record.joint_coordinates(joint.name)[0].index
    there, rest = (
        Rotation.from_rotvec(place[start : start + 3]).as_matrix() @ joint.turn for place in (elsewhere, home)
    )
    return [rest.T @ there]


def test_every_joint_moves_its_child_as_in_the_joint_graph(record, model, elsewhere, home, metre):
    there, joints = links(model), {item.get("name"): item for item in model.findall("joint")}
    placed = {name: (turn, metre * place) for name, (turn, place) in frames(record, elsewhere).items()}
    for joint in record.joints.values():
        values = values_away(record, joint, elsewhere, home, metre)
        wanted = relative(placed[joint.parent], placed[joint.child])
        if joint.type.letter == "C":
            first, second = joints[f"{joint.name}.translation"], joints[f"{joint.name}.rotation"]
            between = first.find("child").text
            assert (first.find("parent").text, second.find("child").text) == (link(joint.parent), link(joint.child))
            near = moved(first, there[link(joint.parent)], there[between], values[:1])
            far = moved(second, there[between], there[link(joint.child)], values[1:])
            found = near[0] @ far[0], near[1] + near[0] @ far[1]
        else:
            item = joints[joint.name]
            assert (item.find("parent").text, item.find("child").text) == (link(joint.parent), link(joint.child))
            found = moved(item, there[link(joint.parent)], there[link(joint.child)], values)
        np.testing.assert_allclose(found[0], wanted[0], atol=1e-9, err_msg=joint.name)
        np.testing.assert_allclose(found[1], wanted[1], atol=1e-9, err_msg=joint.name)


def test_every_joint_is_there_loops_and_all(record, model):
    kinds = [item.get("type") for item in model.findall("joint")]
    letters = "".join(sorted(joint.type.letter for joint in record.joints.values()))
    assert kinds[0] == "fixed"
    assert len(kinds) == 1 + len(letters) + letters.count("C")
    for letter, kind in {"S": "ball", "U": "universal", "H": "screw"}.items():
        assert kinds.count(kind) == letters.count(letter)
    assert kinds.count("revolute") == letters.count("R") + letters.count("C")


def test_letters_are_frames_on_their_links(record, model, home, metre):
    there = links(model)
    marks = {item.get("name"): item for item in model.findall("frame")}
    assert set(marks) == set(record.points)
    for letter, item in marks.items():
        turn, place = there[item.get("attached_to")]
        np.testing.assert_allclose(place + turn @ pose(item)[1], metre * point(record, letter, home), atol=1e-9)


def test_limits_count_from_home(record, model, home, metre):
    for joint in record.joints.values():
        for item, limit in zip(record.joint_coordinates(joint.name), joint.limits, strict=False):
            if limit is not None and joint.type.freedoms == 1:
                unit = metre if item.kind == "length" else 1.0
                (found,) = [one for one in model.findall("joint") if one.get("name") == joint.name]
                bounds = [float(found.find(f"axis/limit/{name}").text) for name in ("lower", "upper")]
                np.testing.assert_allclose(bounds, unit * (np.array(limit) - home[item.index]), atol=1e-12)


def test_names_differ_from_each_other_and_from_the_reserved_one():
    names = Names()
    assert [names.new("world", "link"), names.new("A", "link"), names.new("A", "joint")] == [
        "world.link",
        "A",
        "A.joint",
    ]
