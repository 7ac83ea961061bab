"""Every type of joint in the form of the file, and what the record makes of it."""

import math
from collections.abc import Callable

import numpy as np
import pytest

from assur.joints.catalogue import JOINT_TYPES
from assur.model.mechanism import Joint, MechanismRecord

Read = Callable[[str], MechanismRecord]
FRAME = """
format = 1
name = "arm"
unit = "mm"
angle = "deg"
base = "base"
platform = {{ link = "hand", pose = ["x", "y", "z"] }}
parameters = {{ h = {{ value = 30 }}, slant = {{ value = 30, unit = "deg" }} }}
links = {{ base = {{}}, hand = {{}} }}
inputs = {{ "J.{component}" = {{ name = "q", sign = -1, offset = 10, stroke = [-90, 90] }} }}
home = {{ J = {home} }}
[joints]
J = {{ type = "{kind}", parent = "base", child = "hand", {keys} }}
"""


def joint_of(read: Read, kind: str, keys: str) -> tuple[Joint, MechanismRecord]:
    components = JOINT_TYPES[kind].components
    home = str(list(range(30, 30 + len(components)))) if len(components) > 1 else "30"
    text = FRAME.format(kind=kind, keys=keys, home=home, component=components[0])
    record = read(text)
    assert [item.component for item in record.coordinates] == list(components)
    assert [item.index for item in record.coordinates] == list(range(len(components)))
    return record.joint("J"), record


def test_revolute(read: Read) -> None:
    keys = 'axis = ["sin(slant)", 0, "cos(slant)"], at = ["h", 1, "-h/2"], child_at = [0, 0.5, 2]'
    joint, record = joint_of(read, "revolute", keys + ', limits = [-45, "1 rad"]')
    assert joint.axes == pytest.approx(np.array([[0.5, 0, math.sqrt(0.75)]]))
    assert joint.at.tolist() == [30, 1, -15]
    assert joint.child_at.tolist() == [0, 0.5, 2]
    assert joint.limits == (pytest.approx((-math.pi / 4, 1.0)),)
    assert joint.turn.tolist() == np.eye(3).tolist()
    assert record.home == pytest.approx([math.radians(30)])
    (own,) = record.inputs
    assert (own.name, own.latex, own.sign, own.offset) == ("q", "q", -1.0, pytest.approx(math.radians(10)))
    assert own.stroke == pytest.approx((-math.pi / 2, math.pi / 2))


def test_prismatic(read: Read) -> None:
    joint, record = joint_of(read, "prismatic", 'axis = "-y", limits = [0, "2*h"]')
    assert joint.axes.tolist() == [[0, -1, 0]]
    assert joint.at.tolist() == joint.child_at.tolist() == [0, 0, 0]
    assert joint.limits == ((0.0, 60.0),)
    assert record.home.tolist() == [30.0]
    assert (record.inputs[0].offset, record.inputs[0].stroke) == (10.0, (-90.0, 90.0))


def test_helical(read: Read) -> None:
    joint, _ = joint_of(read, "helical", 'axis = "z", pitch = "-h/5", limits = [0, 720]')
    assert joint.pitch == -6.0
    assert joint.limits == (pytest.approx((0.0, 4 * math.pi)),)


def test_cylindrical(read: Read) -> None:
    joint, record = joint_of(read, "cylindrical", "axis = [3, 0, 4], limits = { rotation = [-90, 90] }")
    assert joint.axes == pytest.approx(np.array([[0.6, 0, 0.8]]))
    assert joint.limits == (None, pytest.approx((-math.pi / 2, math.pi / 2)))
    assert record.home == pytest.approx([30.0, math.radians(31)])


def test_universal(read: Read) -> None:
    joint, record = joint_of(read, "universal", 'axes = ["x", [0, 2, 2]], limits = { first = [0, 60] }')
    assert joint.axes == pytest.approx(np.array([[1, 0, 0], [0, math.sqrt(0.5), math.sqrt(0.5)]]))
    assert joint.limits == (pytest.approx((0, math.pi / 3)), None)
    assert record.home == pytest.approx(np.radians([30, 31]))


def test_spherical(read: Read) -> None:
    joint, record = joint_of(read, "spherical", 'cone = { axis = [0, -5, 0], angle = "slant" }')
    assert joint.axes.shape == (0, 3)
    assert joint.cone == pytest.approx(math.pi / 6)
    assert joint.cone_axis is not None
    assert joint.cone_axis.tolist() == [0, -1, 0]
    assert joint.limits == (None, None, None)
    assert record.home == pytest.approx(np.radians([30, 31, 32]))
    assert joint_of(read, "spherical", "at = [0, 0, 1]")[0].cone is None


@pytest.mark.parametrize("axis", ["x", "-y", "z"])
@pytest.mark.parametrize("child", ["[1, 2, 3]", "[0, -1, 1e-4]", '"z"'])
def test_child_axis_turns_the_child_by_the_smallest_rotation(read: Read, axis: str, child: str) -> None:
    joint, _ = joint_of(read, "revolute", f'axis = "{axis}", child_axis = {child}')
    own = np.array([0, 0, 1] if child == '"z"' else eval(child), dtype=float)  # noqa: S307 our own text
    own /= np.linalg.norm(own)
    assert joint.turn @ own == pytest.approx(joint.axes[0], abs=1e-12)
    assert joint.turn @ joint.turn.T == pytest.approx(np.eye(3), abs=1e-12)
    assert np.linalg.det(joint.turn) == pytest.approx(1)
    angle = math.acos(max(-1.0, min(1.0, (np.trace(joint.turn) - 1) / 2)))
    assert angle == pytest.approx(math.acos(float(own @ joint.axes[0])), abs=1e-7)


def test_a_component_must_be_named_where_there_are_several(read: Read) -> None:
    _, record = joint_of(read, "cylindrical", 'axis = "x"')
    assert record.inputs[0].coordinate.component == "translation"
    assert record.inputs[0].coordinate.kind == "length"


def test_vectors_of_a_record_cannot_be_changed(read: Read) -> None:
    joint, record = joint_of(read, "revolute", 'axis = "x"')
    for vector in (joint.at, joint.child_at, record.home, record.platform.point):
        with pytest.raises(ValueError, match="read-only"):
            vector[0] = 1.0
