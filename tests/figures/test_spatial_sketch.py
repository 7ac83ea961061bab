"""The spatial sketch of a topology: where joints stand, what axes they have, of any notation."""

from itertools import combinations

import numpy as np
import pytest

from assur.derived_topology import topology
from assur.figures.spatial_sketch import limbs_of, sketch_drawing
from assur.figures.style import styled

SERIAL = ("P[x] R[x] R[x] R[x]", "P[y] R[y] R[y] R[y]", "P[z] R[z] R[z] R[z]")
LOOP = ("{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", "P[y] P(4R)[x] P(4R)[y]")
KINDS = {
    "serial": SERIAL,
    "general axes": ("U P S",) * 6,
    "inner loop": LOOP,
    "uneven branches": ("R[z] R[z] C[z]", "{P[y] R[x] R[x] | P[y] R[x]} R[y] R[y]"),
    "ball bars": ("R[y] P(4S)[y]", "R[z] R[1,1,0] P(4S)[x]"),
    "passive limb": ("P[z] R[y] S", "P[z] R[y] S", "P[z] R[1,1,0] S", "U P U"),
    "a joint between base and platform": ("R[z] R[z] R[z] R[z]", "R[z]"),
    "plane and screw": ("R[x] E[z] S", "H[z] U[x,y]"),
    "one limb": ("R[x] R[x] P[z]",),
    "named links": (
        *("R[y] P(4S)[y] <left>", "R[y] P(4S)[y] <left>", "R[x] P(4S)[x] <right>", "R[x] P(4S)[x] <right>"),
        *("<left> R[z]", "<right> R[z]"),
    ),
    "delta": "delta_4s",
    "two plates": "h4_robot",
}


def drawn(asked):
    linkage = topology(asked).linkage
    with styled():
        return linkage, sketch_drawing(linkage)


@pytest.mark.parametrize("kind", KINDS)
def test_limbs_stand_from_base_to_platform_no_joint_on_another(kind):
    linkage, drawing = drawn(KINDS[kind])
    limbs, joints = drawing.data["limbs"], drawing.data["joints"]
    assert sorted(name for limb in limbs for name in limb) == sorted(linkage.joints) == sorted(joints)
    places = {name: joint["at"] for name, joint in joints.items()}
    for first, second in combinations(places, 2):
        assert np.linalg.norm(places[first] - places[second]) > 0.1, (first, second)
    for name, joint in linkage.joints.items():
        if linkage.base in (joint.parent, joint.child):
            assert places[name][2] == 0.0
        else:
            assert places[name][2] > 0.0
    for limb in limbs:
        ends = [name for name in limb if linkage.platform in (linkage.joints[name].parent, linkage.joints[name].child)]
        assert ends
        assert all(places[name][2] == max(places[own][2] for own in limb) for name in ends)


def test_axes_are_those_that_the_notation_writes():
    _, drawing = drawn(("P[x] R[0.6,0.8,0] R[x]", "C[y] R[z] U[x,z]"))
    axes = {name: joint["axes"] for name, joint in drawing.data["joints"].items()}
    wanted = {"P1": "x", "R2": "x", "C1": "y", "R3": "z", "U1": "xz"}
    for name, letters in wanted.items():
        assert np.allclose(np.abs(axes[name]), [np.eye(3)["xyz".index(letter)] for letter in letters]), name
    assert np.allclose(np.abs(axes["R1"]), [[0.6, 0.8, 0.0]])


def test_what_is_driven_is_filled_and_limbs_have_numerals():
    linkage, drawing = drawn(SERIAL)
    filled = sum(joint["driven"] for joint in drawing.data["joints"].values())
    assert filled == len(linkage.inputs) == 3
    words = [text.get_text() for text in drawing.figure.axes[0].texts]
    assert [word for word in words if set(word) <= set("IVX")] == ["I", "II", "III"]
    assert [len(limb) for limb in limbs_of(linkage)] == [4, 4, 4]
