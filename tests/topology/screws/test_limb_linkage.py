"""A limb by itself: its joints and values among those of the mechanism, and O' on its last axis or centre."""

import numpy as np
import pytest

from assur.kinematics.structure import linkage as structure
from assur.model.registry import load_record
from assur.topology.notation import parse_chain, parse_chains
from assur.topology.screws.configurations import configurations
from assur.topology.screws.limb_linkage import limb_linkage, limb_values
from assur.topology.screws.placing import place
from assur.topology.screws.recognition import recognised
from assur.topology.screws.twists import edges, poc_dimensions
from twist_chains import joint_twists, poses, residuals

HYBRID = "{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]"
# a limb, and the joint whose axis or centre O' is on at home
TIPS = {
    "P[x] R[x] R[x] R[x]": "R3",
    "R[x] R[x] P[y]": "R2",
    "U[x,y] P[z] S": "S1",
    "U[x,y] P[z] U[y,x]": "U2",
    "R[x] C[x]": "C1",
    "R[x] H[x]": "H1",
    "R[y] P(4R)[x]": "R1",
    "R[y] P(4S)[y]": "Pa1.b",
    "R[y] P(4U)[y] P[x]": "Pa1.b",
    "R[y] P(2US)[y]": "Pa1.b",
    HYBRID: "R6",
    "R[x] {P[y] P[z] | P[y] R[x] R[x] P[z]}": "R1",
    "R[x] {P[y] | P[z]} P[x]": "R1",
}
REST = ["S P[x] S", "R[z] R[z] R[z]"]


def in_a_mechanism(text):
    """The text's chain as the second limb of three, with names of its own."""
    chains = parse_chains([REST[0], text, REST[1]])
    return place(chains, seed=3), chains[1]


@pytest.mark.parametrize("text", TIPS)
def test_the_point_is_on_the_last_axis_or_centre(text):
    linkage, chain = in_a_mechanism(text)
    alone = parse_chain(text)
    called = {own.name: joint.name for own, joint in zip(alone.joints, chain.joints, strict=True)}
    joint, dot, corner = TIPS[text].partition(".")
    point = linkage.joints[f"{called[joint]}{dot}{corner}"].point
    np.testing.assert_array_equal(limb_linkage(linkage, chain).point, point)
    # the same rule as for a chain that is placed by itself
    placed = place([alone], seed=0)
    np.testing.assert_array_equal(limb_linkage(placed, alone).point, placed.point)


@pytest.mark.parametrize("text", ["P[x] P[y]", "P(4R)[x] P[z]", "{P[x] | P[x]}", "R[x] {P[y] R[x] | P[y] R[x] R[x]}"])
def test_where_nothing_turns_or_a_loop_does_last_the_point_stays_that_of_the_platform(text):
    linkage, chain = in_a_mechanism(text)
    np.testing.assert_array_equal(limb_linkage(linkage, chain).point, linkage.point)


@pytest.mark.parametrize("text", TIPS)
def test_a_limb_has_its_joints_and_their_values(text):
    linkage, chain = in_a_mechanism(text)
    limb = limb_linkage(linkage, chain)
    inside = [
        linkage.groups[joint.name].joints if joint.name in linkage.groups else [joint.name] for joint in chain.joints
    ]
    assert set(limb.joints) == set().union(*inside)
    assert (limb.base, limb.platform) == ("base", "platform")
    count = sum(len(joint.screws) for joint in linkage.joints.values())
    values = np.arange(2.0 * count).reshape(2, count)
    found = limb_values(linkage, limb, values)
    for name, place_in_limb in limb.slices.items():
        np.testing.assert_array_equal(found[:, place_in_limb], values[:, linkage.slices[name]])


@pytest.mark.parametrize("text", TIPS)
def test_displaced_by_itself_it_moves_as_when_it_is_placed_by_itself(text):
    linkage, chain = in_a_mechanism(text)
    limb = limb_linkage(linkage, chain)
    alone = place([parse_chain(text)], seed=1)
    found, expected = (poc_dimensions(edges(some, configurations(some)), "base", "platform") for some in (limb, alone))
    assert found == expected


def test_the_limbs_of_a_mechanism_with_dimensions_are_closed_with_it():
    """And carry the platform to the same place, whichever is asked."""
    linkage = structure(load_record("zeng2019"))
    values = configurations(linkage, 3)
    whole = poses(linkage, values)[linkage.platform]
    for chain in recognised(linkage):
        limb = limb_linkage(linkage, chain)
        own = limb_values(linkage, limb, values)
        assert np.max(np.abs(residuals(limb, own)), initial=0.0) < 1e-9
        rotation, shift = poses(limb, own)[limb.platform]
        np.testing.assert_allclose(rotation, whole[0], atol=1e-9)
        np.testing.assert_allclose(shift, whole[1], atol=1e-6)


def test_the_last_rotation_leaves_the_point_at_rest_wherever_the_limb_is():
    linkage, chain = in_a_mechanism("P[x] R[x] R[y] R[z]")
    limb = limb_linkage(linkage, chain)
    values = configurations(limb, 4)
    rotation, shift = poses(limb, values)["platform"]
    here = rotation @ limb.point + shift
    last = joint_twists(limb, values)[:, :, -1]
    np.testing.assert_allclose(last[:, 3:] + np.cross(last[:, :3], here), 0, atol=1e-12)
