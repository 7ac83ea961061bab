"""Chains recognised in a linkage: the paper's limbs, and labels where neighbouring axes meet."""

import dataclasses

import numpy as np
import pytest

from assur.kinematics.structure import linkage
from assur.model.registry import load_record
from assur.topology.chains import InnerLoop, Parallelogram
from assur.topology.notation import parse_chain, parse_chains, plain_text
from assur.topology.screws.placing import place
from assur.topology.screws.recognition import recognised


def test_the_paper_has_a_hybrid_chain_with_an_inner_loop_and_one_with_two_parallelograms():
    first, second = recognised(linkage(load_record("zeng2019")))
    loop = first.elements[0]
    assert isinstance(loop, InnerLoop)
    assert [[joint.name for joint in branch] for branch in loop.branches] == [["P1", "B1", "C1"], ["P2", "B2", "C2"]]
    assert [joint.name for joint in first.elements[1:]] == ["R3", "R4"]
    assert [type(element) for element in second.elements[1:]] == [Parallelogram, Parallelogram]
    assert [np.round(np.abs(element.axis), 9).tolist() for element in second.elements[1:]] == [[1, 0, 0], [0, 1, 0]]


def test_no_two_axes_of_the_paper_meet_so_no_point_is_labelled():
    joints = [joint for chain in recognised(linkage(load_record("zeng2019"))) for joint in chain.joints]
    assert not any(getattr(joint, "point", "") for joint in joints)


def test_what_is_left_of_closing_loops_is_no_direction():
    """The axis of a file whose home is closed to 1e-14, not [0,-1,56827755550416.35]."""
    found = place(parse_chains(["P[x] R[z] R[z]", "R[z] R[z] R[z]"]))
    joint = next(joint for joint in found.joints.values() if joint.screws[0, :3].any())
    screws = joint.screws.copy()
    screws[0, :3] = (0.0, -1.8e-14, 1.0)
    turned = dataclasses.replace(joint, screws=screws)
    near = dataclasses.replace(found, joints={**found.joints, joint.name: turned})
    assert [plain_text(chain) for chain in recognised(near)] == ["P[x] R[z] R[z]", "R[z] R[z] R[z]"]


MEETING = """
format = 1
name = "wrist"
unit = "mm"
angle = "deg"
base = "base"
platform = { link = "hand", pose = ["x", "y", "z"], orientation = "any" }
[links]
base = {}
one = {}
two = {}
hand = {}
[joints]
A = { type = "revolute", parent = "base", child = "one", at = [0, 0, 10], axis = "z" }
B = { type = "revolute", parent = "one", child = "two", at = [0, 0, 5], axis = "x" }
C = { type = "revolute", parent = "two", child = "hand", at = [%s, 0, 0], axis = "y" }
[inputs]
A = { name = "a" }
[home]
A = 20
B = 30
C = 40
"""


@pytest.mark.parametrize(("offset", "labelled"), [("7", [True, True, False]), ("0", [True, True, True])])
def test_neighbouring_axes_that_meet_share_a_label(tmp_path, offset, labelled):
    # the axis of C, 7 mm along x, runs along y past the point of A and B; with no offset it meets them there
    file = tmp_path / "wrist.toml"
    file.write_text(MEETING % offset, encoding="utf-8")
    (chain,) = recognised(linkage(load_record(file)))
    assert [bool(joint.point) for joint in chain.joints] == labelled
    assert len({joint.point for joint in chain.joints if joint.point}) == 1


@pytest.mark.parametrize(
    ("text", "same"),
    [
        ("R[z]@A P[z] R[z]@A", True),
        ("R[z]@A P[z] P[z] U[z,x]@A", True),
        ("R[z] P[z] R[z]", False),
        ("R[z]@A P[x] S@A", True),
    ],
)
def test_axes_that_meet_across_a_slide_have_one_label(text, same):
    chain = recognised(place([parse_chain(text)]))[0]
    first, last = chain.elements[0].point, chain.elements[-1].point
    assert (first == last != "") == same
    assert not any(item.point for item in chain.elements[1:-1])


def test_an_axis_on_one_line_in_all_limbs_is_common_although_it_slides_along_itself():
    found = recognised(place(parse_chains(["P[z] R[z]@O P[x] R[z]", "P[z] R[z]@O P[y] R[z]"])))
    assert found[0].elements[1].point == found[1].elements[1].point != ""
