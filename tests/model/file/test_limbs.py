"""A template that repeats is the same as writing every limb out by hand."""

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from assur.joint_graph.frames import frames
from assur.model.mechanism import MechanismRecord

Read = Callable[[str], MechanismRecord]
Faults = Callable[[str], list[str]]

DELTA = Path(__file__).with_name("delta.toml").read_text(encoding="utf-8")
ANGLES = 'angles = ["turn", 120, "4*pi/3 + turn"]'


def turn(angle: float) -> np.ndarray:
    cosine, sine = math.cos(angle), math.sin(angle)
    return np.array([[cosine, -sine, 0], [sine, cosine, 0], [0, 0, 1]])


def test_every_part_of_a_template_gets_its_number(read: Read) -> None:
    record = read(DELTA)
    limbs = ("leg1", "leg2", "leg3")
    assert list(record.links) == [
        "base",
        "hand",
        *(f"{leg}.{x}" for leg in limbs for x in ("arm", "rod1", "rod2")),
    ]
    assert list(record.joints) == [f"{leg}.{x}" for leg in limbs for x in ("A", "B1", "B2", "C1", "C2")]
    assert list(record.points) == ["leg1.E", "leg2.E", "leg3.E"]
    assert (record.joints["leg2.B1"].parent, record.joints["leg2.C1"].child) == ("leg2.arm", "hand")
    assert record.joint("leg3.M").name == "leg3.A"
    assert [(item.name, item.latex, item.coordinate.joint) for item in record.inputs] == [
        ("q2", "q_{2}", "leg2.A"), ("q3", "q_{3}", "leg3.A"), ("q1", "q_{1}", "leg1.A"),
    ]  # fmt: skip
    assert record.angles["phi1"].index == 0
    assert record.modes.working["s1"].names == {"leg1.A"}
    home = np.degrees(record.home).reshape(3, 11)
    assert home[:, :5] == pytest.approx(np.array([[10, 5, 6, 5, 6]] * 3))
    for own, angle in zip(home, (10, 120, 250), strict=True):  # a rotation vector turns with its limb
        assert own[5:8] == pytest.approx(turn(math.radians(angle)) @ [1, 2, 3])
        assert own[8:] == pytest.approx(own[5:8])


def test_every_vector_of_a_template_is_turned(read: Read) -> None:
    record = read(DELTA)
    first, second, third = (record.joints[f"leg{n}.C1"] for n in (1, 2, 3))
    turns = [turn(math.radians(angle)) for angle in (10, 120, 250)]
    for joint, own in zip((first, second, third), turns, strict=True):
        assert joint.at == pytest.approx([0, 0, -250])
        assert joint.child_at == pytest.approx(own @ [50, -20, 0])
        assert joint.cone_axis == pytest.approx(own @ [1, 0, 0])
    for n, own in enumerate(turns, 1):
        assert record.joints[f"leg{n}.A"].at == pytest.approx(own @ [200, 0, 5])
        assert record.joints[f"leg{n}.A"].axes[0] == pytest.approx(own @ [0, -1, 0])
        expected = np.array([own @ [0, 1, 0], own @ np.array([1, 0, 2]) / math.sqrt(5)])
        assert record.joints[f"leg{n}.B2"].axes == pytest.approx(expected)
        assert record.points[f"leg{n}.E"].at == pytest.approx(own @ [100, 0, 0])


@pytest.mark.parametrize("values", [np.zeros(11), np.linspace(-1, 1, 11)])
def test_with_equal_joint_values_the_limbs_are_turned_copies(read: Read, values: np.ndarray) -> None:
    """Also when the frames are not parallel to the base's: the limbs' frames turn with them."""
    text = DELTA.replace('axis = "-y", alias', 'axis = "-y", child_axis = [0.1, -1, 0.3], alias')
    record = read(text)
    placed = frames(record, np.tile(values, 3))
    turns = [turn(math.radians(angle)) for angle in (10, 120, 250)]
    for link in ("arm", "rod1"):
        points = [np.array([30.0, -7.0, 11.0])]
        base = [turns[n].T @ placed[f"leg{n + 1}.{link}"][0] @ turns[n] @ points[0] for n in range(3)]
        origins = [turns[n].T @ placed[f"leg{n + 1}.{link}"][1] for n in range(3)]
        for n in (1, 2):
            assert base[n] == pytest.approx(base[0], abs=1e-9)
            assert origins[n] == pytest.approx(origins[0], abs=1e-9)


def test_a_template_is_what_it_would_be_by_hand(read: Read) -> None:
    by_hand = DELTA[: DELTA.index("[limbs.leg]")]
    source = DELTA[DELTA.index("[limbs.leg]") : DELTA.index("[modes]")]
    assert "leg" in source
    text = by_hand + "\n".join(
        f"""
[limbs.leg{chr(96 + n)}]
repeat = {{ about = "z", angles = [{angle}] }}
[limbs.leg{chr(96 + n)}."""
        + source[source.index("[limbs.leg.links]") + len("[limbs.leg.") :]
        .replace("[limbs.leg.", f"[limbs.leg{chr(96 + n)}.")
        .replace('name = "q"', f'name = "{chr(96 + n)}"')
        for n, angle in ((1, '"turn"'), (2, "120"), (3, '"240 deg + turn"'))
    )
    one, three = read(DELTA.replace('order = ["leg2.A", "leg3.A", "leg1.M"]', "")), read(text)
    for n in (1, 2, 3):
        for name in ("A", "B1", "C2"):
            first, second = one.joints[f"leg{n}.{name}"], three.joints[f"leg{chr(96 + n)}1.{name}"]
            assert first.at == pytest.approx(second.at)
            assert first.axes == pytest.approx(second.axes)
            assert first.limits == second.limits
    assert [item.coordinate.index for item in one.inputs] == [item.coordinate.index for item in three.inputs]


def test_count_means_equal_angles_about_any_axis(read: Read) -> None:
    text = DELTA.replace('about = "z", angles = ["turn", 120, "4*pi/3 + turn"]', 'about = ["-1", 0, 0], count = 4')
    text = text[: text.index("[modes]")]
    record = read(text)
    places = [record.joints[f"leg{n}.A"].at for n in (1, 2, 3, 4)]
    assert np.array(places) == pytest.approx(np.array([[200, 0, 5], [200, 5, 0], [200, 0, -5], [200, -5, 0]]))


def test_home_and_names_may_be_given_outside_the_template(read: Read) -> None:
    text = DELTA.replace('A = "turn"\nB1', "B1") + '[home]\n"leg1.A" = 1\n"leg2.M" = 2\n"leg3.A" = 3\n'
    assert np.degrees(read(text).home[::11]) == pytest.approx([1, 2, 3])


CASES: list[tuple[str, str, list[str]]] = [
    ('child = "arm", at', 'child = "amr", at',
     ["21: limbs.leg.joints.A.child: unknown link 'amr'; there is: arm, base, hand, rod1, rod2",
      "? did you mean 'arm'?"]),
    ('at = ["R", 0, 5]', 'at = ["Q", 0, 5]',
     ["21: limbs.leg.joints.A.at[0]: unknown parameter 'Q'; there is: R, r, turn"]),
    ('axis = "-y"', "axis = [0, 0, 0]",
     ["21: limbs.leg.joints.A.axis: an axis of length zero; allowed: a vector that has a direction"]),
    ('axes = ["y", [1, 0, 2]] }\nB2', 'axes = ["y", "-y"] }\nB2',
     ["22: limbs.leg.joints.B1.axes: two parallel axes; allowed: two that are not",
      "? two parallel axes are one freedom: use a revolute"]),
    ('meaning = "driven"', "mass = -3", ["17: limbs.leg.links.arm.mass: -3; allowed: zero or a positive number"]),
    ("[limbs.leg.home]", "[limbs.leg.homes]",
     ["30: limbs.leg.homes: unknown key; "
      "allowed here: chain, generalised, home, inputs, joints, links, points, repeat", "? did you mean 'home'?"]),
    ("B1 = [5, 6]\n", "",
     ["30: limbs.leg.home: lacks B1; every joint needs a value near one assembled configuration",
      "? add B1 = [0, 0], or a better guess"]),
    ("B1 = [5, 6]", "B1 = 5", ["32: limbs.leg.home.B1: 1 values; allowed: 2 (first, second)"]),
    ("[limbs.leg.home]\nA", "[limbs.leg.home]\nD = 3\nA",
     ["31: limbs.leg.home.D: unknown joint 'D'; there is: A, B1, B2, C1, C2, M"]),
    ("M = { name", "C1 = { name",
     ["27: limbs.leg.inputs.C1: 'C1' has 3 components; allowed: C1.rx or C1.ry or C1.rz"]),
    ("M = { name", "N = { name",
     ["27: limbs.leg.inputs.N: unknown joint 'N'; there is: A, B1.first, B1.second, B2.first, B2.second, C1.rx, C1.ry, "
      "C1.rz, C2.rx, C2.ry, C2.rz, M"]),
    ("rod2 = {}", "rod2 = {}\nweight = {}",
     ["20: limbs.leg.links.weight: 'weight' is not connected to the base; allowed: one connected graph"]),
    ('A = { type = "revolute"', 'A = { type = "rotary"',
     ['21: limbs.leg.joints.A.type: "rotary"; '
      "allowed: cylindrical, helical, planar, prismatic, revolute, spherical, universal"]),
    ('E = { link = "arm"', 'A = { link = "arm"',
     ["29: limbs.leg.points.A: a joint has the name 'leg1.A' already; the first one is in line 21; "
      "allowed: another name",
      "37: modes.working.s2: unknown quantity 'leg2.E.z'; there is:"]),
    (ANGLES, "count = 1", ["15: limbs.leg.repeat.count: 1; allowed: greater than or equal to 2"]),
    (ANGLES, "count = 1000000000", ["15: limbs.leg.repeat.count: 1000000000; allowed: less than or equal to 60"]),
    (ANGLES, "count = 3.0", ["15: limbs.leg.repeat.count: 3.0; allowed: a whole number"]),
    (ANGLES, "count = true", ["15: limbs.leg.repeat.count: true; allowed: a whole number"]),
    (ANGLES, "angles = []", ["15: limbs.leg.repeat.angles: a list of 0; allowed: at least 1"]),
    (ANGLES, 'angles = ["R", 1, 2]', []),
    (ANGLES, 'angles = ["R*turn", 1, "R + turn"]',
     ['15: limbs.leg.repeat.angles[2]: "R + turn": the sum of an angle and a plain number; '
      "allowed: angles with angles, plain numbers with plain numbers", "? a unit makes an angle of a number: 90 deg"]),
    (ANGLES, "angles = [0, 5, 9], count = 3",
     ["15: limbs.leg.repeat: count and angles; allowed: one of the two", "? count = 3 means every 120 deg"]),
    (ANGLES, "angles = [0, 5, 9], count = 60",
     ["15: limbs.leg.repeat: count and angles; allowed: one of the two", "? count = 3 means every 120 deg"]),
    ("[limbs.leg.links]\narm", "[limbs.leg.joints.X]\n[limbs.leg.links]\narm",
     ["16: limbs.leg.joints.X.type: missing; "
      "allowed: cylindrical, helical, planar, prismatic, revolute, spherical, universal"]),
    (", " + ANGLES, "",
     ["15: limbs.leg.repeat: neither count nor angles; allowed: one of the two", "? count = 3 means every 120 deg"]),
    ('repeat = { about = "z", ' + ANGLES + " }\n", "",
     ["14: limbs.leg.repeat: missing; this key must be there", '? repeat = { about = "z", count = 3 }']),
    ('about = "z"', 'about = "w"',
     ['15: limbs.leg.repeat.about: "w"; '
      'allowed: x, y, z, -x, -y, -z, or a vector such as ["0", "cos(30 deg)", "sin(30 deg)"]']),
    ('about = "z"', "about = [0, 0, 0]",
     ["15: limbs.leg.repeat.about: an axis of length zero; allowed: a vector that has a direction"]),
    ("[links]", "[points]\nleg2 = { link = 'hand' }\n[links]",
     ["16: limbs.leg: a point has the name 'leg2' already; the first one is in line 12; allowed: another name"]),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "expected"), CASES)
def test_a_fault_in_a_template_is_told_once_at_its_line(
    read: Read, faults: Faults, old: str, new: str, expected: list[str]
) -> None:
    assert old in DELTA
    text = DELTA.replace(old, new, 1)
    if not expected:
        read(text)
        return
    found = faults(text)
    wanted = [f"    hint: {line[2:]}" if line.startswith("? ") else f"f.toml:{line}" for line in expected]
    if wanted[-1].endswith("there is:"):  # a long list
        found = [*found[:-2], found[-2][: len(wanted[-1])]]
    assert found == wanted


def test_the_limbs_of_two_templates_may_not_have_one_name(faults: Faults) -> None:
    legs = DELTA[DELTA.index("[limbs.leg]") : DELTA.index("[modes]")].replace(ANGLES, "count = 12")
    second = legs.replace("[limbs.leg", "[limbs.leg1").replace('name = "q"', 'name = "p"')
    text = DELTA[: DELTA.index("[limbs.leg]")] + legs + second
    assert faults(text) == [
        f"f.toml:{text[: text.index('[limbs.leg1]')].count(chr(10)) + 1}: limbs.leg1: "
        "a limb has the name 'leg11' already; the first one is in line "
        f"{text[: text.index('[limbs.leg]')].count(chr(10)) + 1}; allowed: another name"
    ]


@pytest.mark.parametrize("table", ["links", "joints", "inputs", "generalised", "points", "home"])
def test_a_table_of_a_template_that_is_none_ends_the_reading(faults: Faults, table: str) -> None:
    text = f"[limbs.leg]\nrepeat = {{ about = 'z', count = 3 }}\n{table} = 3"
    assert faults(text) == [f"f.toml:3: limbs.leg.{table}: 3; allowed: a table {{ ... }}"]


@pytest.mark.parametrize(("old", "new"), [("120", '"turn"'), ("120", "370"), ('"4*pi/3 + turn"', '"2*pi + turn"')])
def test_two_limbs_at_one_place_are_refused(faults: Faults, old: str, new: str) -> None:
    (told,) = faults(DELTA.replace(ANGLES, ANGLES.replace(old, new, 1)))
    which = ("1 and 2", 1) if old == "120" else ("1 and 3", 2)
    assert told == (
        f"f.toml:15: limbs.leg.repeat.angles[{which[1]}]: limbs {which[0]} at one place; "
        "allowed: each limb at its own angle"
    )


def test_inputs_of_a_template_may_have_an_offset_for_each_limb(read: Read, faults: Faults) -> None:
    """In the order in which they are numbered, whatever the order of the inputs; as many as limbs, and nowhere else."""
    lines = DELTA.splitlines()
    (own,) = [line for line in lines if '"q"' in line]
    given = own.replace("}", ", offsets = [1, 2, 30] }")
    record = read(DELTA.replace(own, given))
    unit = record.angle_unit
    assert {item.name: round(item.offset / unit, 9) for item in record.inputs} == {"q1": 1.0, "q2": 2.0, "q3": 30.0}
    (fault,) = faults(DELTA.replace(own, given.replace("2, ", "")))
    assert "2 offsets of 3 limbs" in fault
