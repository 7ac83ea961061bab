"""Drives where nobody chose any: admissible, near the base, one for each limb, and said."""

from itertools import product

import pytest

import assur
from assur.synthesis.drafting.inputs import inputs_for
from assur.topology.answers import answers
from assur.topology.notation import parse_chains


def driven(texts):
    found = assur.topology(texts)
    assert found.actuation.verdict == "valid"
    assert found.coupling_degree is not None
    return found


def test_nobody_drives_a_platform_that_does_not_move():
    """A planar loop of four R turns between a base and a platform that two skew R hold."""
    found = driven(["R[x]", "R[y]", "R[z] R[z] R[z] R[z]"])
    assert (found.dof, found.internal_freedoms, str(found.poc)) == (1, 1, "t⁰ r⁰")
    assert (found.inputs, found.inputs_by, found.coupling_degree) == ((), "admissible set", 0)
    assert found.xi == (2, 3)
    assert "actuated: nothing, for the platform does not move" in found.notes[0]


@pytest.mark.parametrize(
    ("texts", "inputs", "degree"),
    [
        # parallel slides at the base are bad drives: the third and the fourth limb's are no use beside the others
        (["P[x] R[x] R[x] U[x,z]", "P[y] R[y] R[y] U[y,z]"] * 2, ("P1", "P2", "P3", "R7"), 2),
        (["U[x,y] P[z] R[y]", "U[x,y] P[z] R[y]", "R[y] P[z] U[y,x]"], ("P1", "P2", "R3"), 1),
        (["U[x,y] P[z] R[y]", "U[x,y] P[z] R[y]", "S P[z] R[x]"], ("P1", "P2"), 1),
        (["P[z] R[x] R[x] U[x,z]", "P[z] R[y] R[y] U[y,z]"] * 2, None, None),
        (["R[z] R[z] R[z] P(4R)[z] R[z]"] * 2, None, None),
        (["{R[z] R[z] R[z] | R[z] R[z] R[z]} R[x] R[x]", "P[z] S"], None, None),
    ],
)
def test_an_admissible_set_takes_the_place_of_first_joints_that_do_not_determine_a_mechanism(texts, inputs, degree):
    found = driven(texts)
    if inputs is not None:
        assert (found.inputs, found.coupling_degree) == (inputs, degree)
    data = answers(found)
    assert (data.inputs_by, data.inputs) == (found.inputs_by, found.inputs)
    if found.inputs_by == "admissible set":
        assert found.notes[0].startswith("actuated: ")
        assert all(name.split(".")[0] in found.notes[0] for name in found.inputs)


def test_of_sets_with_one_joint_for_each_limb_it_is_the_nearest_to_the_base():
    texts = ["P[x] R[x] R[x] U[x,z]", "P[y] R[y] R[y] U[y,z]"] * 2
    found = driven(texts)
    limbs = [[joint.name for joint in chain.joints if joint.name[0] in "PR"] for chain in parse_chains(texts)]
    distance = {name: place for names in limbs for place, name in enumerate(names)}
    every = {frozenset(names) for names in found.actuation.sets}
    one_each = [names for names in product(*limbs) if frozenset(names) in every]
    assert sum(map(distance.get, found.inputs)) == min(sum(map(distance.get, names)) for names in one_each)


def test_first_joints_that_determine_a_mechanism_are_kept_and_so_are_those_that_are_given():
    texts = ["P[x] R[x] R[x] R[x]", "P[y] R[y] R[y] R[y]", "P[z] R[z] R[z] R[z]"]
    assert (driven(texts).inputs, driven(texts).inputs_by) == (("P1", "P2", "P3"), "first joints")
    given = assur.topology(texts, actuate=["1.1", "2.1"])
    assert (given.inputs, given.inputs_by, given.coupling_degree) == (("P1", "P2"), "given", None)


@pytest.mark.parametrize("texts", [["S P[x] S", "S P[y] S", "S P[z] S"], ["U[x,y] R[y] S", "S R[x]"]])
def test_where_no_joints_that_can_be_driven_determine_a_mechanism_it_says_so(texts):
    found = assur.topology(texts)
    assert (found.inputs_by, found.coupling_degree) == ("first joints", None)
    assert found.actuation.verdict == "too few"
    assert found.actuation.sets == ()


def test_a_draft_is_driven_by_the_same_joints():
    texts = ["P[x] R[x] R[x] U[x,z]", "P[y] R[y] R[y] U[y,z]"] * 2
    assert inputs_for(parse_chains(texts), None, "home")[0] == driven(texts).inputs
