"""A screw in series with what lies along its axis, in every order and sense of the joints."""

from itertools import product
from pathlib import Path

import numpy as np
import pytest

from assur.kinematics.border import inputs_of
from assur.kinematics.closure import closure_error
from assur.kinematics.coaxial_screws import merged_pair
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_of
from assur.kinematics.position import direct, inverse
from assur.model.file.reader import read_text
from assur.model.registry import load_record

HELI4 = Path(__file__).with_name("heli4.toml")
KINDS = {"R": ("revolute", 0), "P": ("prismatic", 0), "H": ("helical", 10), "G": ("helical", -4)}
LIFT = """
format = 1
name = "lift"
title = "lift"
unit = "mm"
angle = "deg"
base = "base"
platform = {{ link = "nut", pose = ["z"] }}
[links]
base = {{}}
middle = {{}}
nut = {{}}
[joints]
{first}
{second}
P = {{ type = "prismatic", parent = "base", child = "nut", at = [40, 0, 0], child_at = [40, 0, 0], axis = "z" }}
[inputs]
{driven} = {{ name = "q" }}
[home]
A = 0
B = 0
P = 0
"""


def lift(first, second, turned, driven):
    """A nut on rails that two coaxial joints move, each written from either of its links, the middle one turned."""
    ends = (("base", "middle", "[0, 0, 0]", "[5, 0, 2]"), ("middle", "nut", "[5, 0, 3]", "[0, 0, 1]"))
    lines = {}
    for name, kind, back, (parent, child, at, child_at) in zip("AB", (first, second), turned, ends, strict=True):
        if back:
            parent, child, at, child_at = child, parent, child_at, at
        pitch = f", pitch = {KINDS[kind][1]}" if KINDS[kind][1] else ""
        lines[name] = (
            f'{name} = {{ type = "{KINDS[kind][0]}", parent = "{parent}", child = "{child}", '
            f'at = {at}, child_at = {child_at}, axis = "z"{pitch} }}'
        )
    return LIFT.format(first=lines["A"], second=lines["B"], driven=driven)


CASES = [
    (*kinds, turned, driven)
    for kinds, driven in ((("R", "H"), "A"), (("H", "R"), "A"), (("H", "G"), "A"), (("H", "G"), "B"), (("G", "R"), "A"))
    for turned in product((False, True), repeat=2)
]


@pytest.mark.parametrize(("first", "second", "turned", "driven"), CASES)
def test_a_nut_on_rails_stands_where_its_screws_bring_it(first, second, turned, driven, tmp_path):
    record = read_text(lift(first, second, turned, driven), tmp_path / "lift.toml")
    pair = merged_pair(record, "inverse")
    assert [joint.type.letter for joint in pair.record.joints.values()] == ["P", "C"]
    home = home_values(record)
    inputs = inputs_of(record, home) + 2.2
    moved = direct(record, inputs)
    assert moved.complete
    joints = moved.joints[moved.exists]
    assert len(joints) == 1
    assert np.max(closure_error(record, joints)) < 1e-9
    # the nut does not turn: the angles of both joints, seen from the base, add up to none
    sense = [-1.0 if back else 1.0 for back in turned]
    own = joints[0, "AB".index(driven)] * sense["AB".index(driven)]
    other = -own
    angles = (own, other) if driven == "A" else (other, own)
    rise = sum(KINDS[kind][1] * angle / (2 * np.pi) for kind, angle in zip((first, second), angles, strict=True))
    assert pose_of(record, joints[0])[0] - pose_of(record, home)[0] == pytest.approx(rise, abs=1e-9)
    back = inverse(record, pose_of(record, joints[0]))
    assert back.complete
    assert ("as one cylindrical joint" in back.reason) == ("R" not in (first, second))
    assert back.inputs[back.exists] == pytest.approx(inputs[None], abs=1e-6)


@pytest.mark.deep
def test_a_heli4_has_as_many_assemblies_as_a_search_finds():
    record = load_record(str(HELI4))
    inputs = inputs_of(record, home_values(record)) + np.radians([3.0, -2.0, 4.0, 1.0])
    answer, searched = direct(record, inputs), direct(record, inputs, method="search")
    assert answer.complete
    poses, others = (pose_of(record, own.joints[own.exists]) for own in (answer, searched))
    assert len(poses) == len(others) == 8
    assert poses[np.lexsort(poses.T[:3].round(3))] == pytest.approx(others[np.lexsort(others.T[:3].round(3))], abs=1e-6)


def test_the_inverse_of_a_heli4_holds_its_screw_within_half_a_turn_of_home():
    """Sixteen with each way in which its plates stand; a screw that is threaded a turn on makes others."""
    record = load_record(HELI4)
    home = home_values(record)
    pose = pose_of(record, home) + np.array([5.0, -3.0, 4.0, 0.3])
    found = inverse(record, pose)
    assert found.complete
    assert "within half a turn of home's, since each turn more is another solution" in found.right
    joints = found.joints[found.exists]
    (screw,) = [item.index for item in record.coordinates if record.joints[item.joint].type.screw]
    assert np.max(np.abs(joints[:, screw] - home[screw])) <= np.pi + 1e-9
    assert np.max(closure_error(record, joints)) < 1e-9
    assert np.max(np.abs(pose_of(record, joints) - pose)) < 1e-7
    assert len(joints) % 16 == 0
