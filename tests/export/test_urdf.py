"""The URDF file and the loops beside it, read back: a chain of transforms from the base, then every loop."""

from xml.etree import ElementTree

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from assur.export.sidecar import sidecar
from assur.export.urdf import roll_pitch_yaw, urdf
from assur.joint_graph.frames import frames


def link(name):
    """`world` is the ground's."""
    return "world.link" if name == "world" else name


def floats(text):
    return np.array([float(word) for word in text.split()])


def matrix(turn, place):
    found = np.eye(4)
    found[:3, :3], found[:3, 3] = turn, place
    return found


def origin(element):
    place = element.find("origin")
    return matrix(Rotation.from_euler("xyz", floats(place.get("rpy"))).as_matrix(), floats(place.get("xyz")))


def joint_motion(joint, value):
    axis = floats(joint.find("axis").get("xyz"))
    if joint.get("type") == "prismatic":
        return matrix(np.eye(3), value * axis)
    return matrix(Rotation.from_rotvec(value * axis).as_matrix(), np.zeros(3))


def link_frames(text, values):
    """Frames (4, 4) of the links at joint values by name: URDF's rules."""
    root = ElementTree.fromstring(text)
    carried = {joint.find("child").get("link"): joint for joint in root.findall("joint")}
    found = {}

    def frame(name):
        if name not in found:
            joint = carried.get(name)
            if joint is None:
                found[name] = np.eye(4)
            else:
                near = frame(joint.find("parent").get("link"))
                found[name] = near @ origin(joint) @ joint_motion(joint, values[joint.get("name")])
        return found[name]

    return {element.get("name"): frame(element.get("name")) for element in root.findall("link")}


@pytest.fixture
def text(record):
    return urdf(record)


@pytest.fixture
def beside(record):
    return sidecar(record, "it.urdf")


def away(record, joint, values, home, forward):
    """A ball's rotation away from home, in the carried link's frame."""
    start = record.joint_coordinates(joint.name)[0].index
    there, rest = (Rotation.from_rotvec(place[start : start + 3]).as_matrix() @ joint.turn for place in (values, home))
    return rest.T @ there if forward else rest @ there.T


def urdf_values(record, text, beside, values, home, metre):
    """Our joint values as those of the URDF, by what the sidecar says of them."""
    root = ElementTree.fromstring(text)
    ends = {joint.get("name"): joint.find("child").get("link") for joint in root.findall("joint")}
    labels = {record.coordinate_label(item): item for item in record.coordinates}
    screws = {item["slide"]: item for item in beside["couplings"]}
    found = {}
    for name, entry in beside["joints"].items():
        joint = record.joints[entry["joint"]]
        if "part" in entry:
            forward = ends[f"{joint.name}.rz"] == link(joint.child)
            turned = Rotation.from_matrix(away(record, joint, values, home, forward))
            found[name] = turned.as_euler("XYZ")[("rx", "ry", "rz").index(entry["part"])]
        elif name in screws:
            index = labels[screws[name]["hinge"]].index
            found[name] = screws[name]["ratio"] * (values[index] - home[index])
        else:
            unit = metre if labels[name].kind == "length" else 1.0
            found[name] = unit * values[labels[name].index] - entry["home"]
    return found


def our_frames(text, beside, values):
    """Frames of our links: those of the URDF's, shifted as the sidecar says."""
    return {
        name: frame @ matrix(np.eye(3), beside["links"][name]["frame"])
        for name, frame in link_frames(text, values).items()
        if name in beside["links"]
    }


def test_it_is_a_tree_of_all_links(record, text):
    root = ElementTree.fromstring(text)
    names = [element.get("name") for element in root.findall("link")]
    carried = [joint.find("child").get("link") for joint in root.findall("joint")]
    assert len(set(names)) == len(names)
    assert sorted([link(record.base), *carried]) == sorted(names)
    assert set(map(link, record.links)) <= set(names)
    assert "world" not in names
    assert root.find(".//mimic") is None


def test_links_are_where_the_joint_graph_says_at_any_joint_values(record, text, beside, anywhere, home, metre):
    values = urdf_values(record, text, beside, anywhere, home, metre)
    assert set(values) == {joint.get("name") for joint in ElementTree.fromstring(text).findall("joint")}
    found = our_frames(text, beside, values)
    for name, (rotation, place) in frames(record, anywhere).items():
        np.testing.assert_allclose(found[link(name)], matrix(rotation, metre * place), atol=1e-9)


def side(entry, links):
    w, x, y, z = entry["orientation"]
    turn = Rotation.from_quat([x, y, z, w]).as_matrix()
    return links[entry["link"]] @ matrix(turn, entry["position"])


def loop_gap(record, loop, links, values, home, metre, couplings):
    """How far the parent's frame, moved by the steps, is from the child's."""
    frame = side(loop["parent"], links)
    ratios = {item["slide"]: item["ratio"] for item in couplings}
    labels = {record.coordinate_label(item): item for item in record.coordinates}
    for step in loop["steps"]:
        if step["kind"] == "ball":
            turn = away(record, record.joints[loop["joint"]], values, home, forward=True)
            frame = frame @ matrix(turn, np.zeros(3))
            continue
        axis = np.array(step["axis"])
        if step["name"] in ratios:
            index = labels[loop["joint"]].index
            frame = frame @ matrix(np.eye(3), ratios[step["name"]] * (values[index] - home[index]) * axis)
            continue
        value = values[labels[step["name"]].index] * (metre if step["kind"] == "slide" else 1.0) - step["home"]
        turned = Rotation.from_rotvec(value * axis).as_matrix()
        frame = frame @ (matrix(np.eye(3), value * axis) if step["kind"] == "slide" else matrix(turned, np.zeros(3)))
    return np.max(np.abs(frame - side(loop["child"], links)))


def test_loops_close_where_ours_do_and_only_there(record, text, beside, anywhere, elsewhere, home, metre):
    assert {loop["joint"] for loop in beside["loops"]}.isdisjoint(entry["joint"] for entry in beside["joints"].values())
    assert len(beside["loops"]) == len(record.joints) - len(record.links) + 1
    for place, closed in ((elsewhere, True), (anywhere, False)):
        links = link_frames(text, urdf_values(record, text, beside, place, home, metre))
        found = [loop_gap(record, loop, links, place, home, metre, beside["couplings"]) for loop in beside["loops"]]
        assert (max(found) < 1e-9) == closed


def test_the_sidecar_says_the_inputs_and_the_platform(record, text, beside, home, metre):
    for entry, item in zip(beside["inputs"], record.inputs, strict=True):
        unit = metre if item.coordinate.kind == "length" else 1.0
        assert entry["name"] == item.name
        assert entry["sign"] * unit * home[item.coordinate.index] + entry["offset"] == pytest.approx(
            unit * (item.sign * home[item.coordinate.index] + item.offset)
        )
    links = link_frames(text, dict.fromkeys(beside["joints"], 0.0))
    point = links[beside["platform"]["link"]] @ [*beside["platform"]["position"], 1.0]
    rotation, place = frames(record, home)[record.platform.link]
    np.testing.assert_allclose(point[:3], metre * (rotation @ record.platform.point + place), atol=1e-9)


@pytest.mark.parametrize("pitch", [0.3, np.pi / 2, np.pi / 2 - 1e-13, np.pi / 2 - 1e-7, -np.pi / 2])
def test_angles_give_the_rotation_back_also_at_a_right_angle(pitch):
    turn = Rotation.from_euler("xyz", [0.7, pitch, -2.0]).as_matrix()
    np.testing.assert_allclose(Rotation.from_euler("xyz", roll_pitch_yaw(turn)).as_matrix(), turn, atol=1e-14)
