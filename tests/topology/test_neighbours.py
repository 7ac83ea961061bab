"""Neighbours differ in one thing, and are written as chains that can be read back."""

import pytest

from assur.topology.neighbours import neighbours
from assur.topology.notation import parse_chains


def changes(texts, driven, sets=()):
    return {near.change: near for near in neighbours(parse_chains(texts), driven, sets)}


def test_joints_are_relaxed_unless_they_are_driven():
    found = changes(["P[x] R[x] S", "P[y] R[y] S"], ["P1", "P2"])
    assert {"R1 to C", "R1 to U", "R1 to S", "R2 to S"} <= set(found)
    assert not any(change.startswith("P1") for change in found)
    near = found["R1 to S"]
    assert near.chains == ("P[x] S S", "P[y] R[y] S")
    assert near.actuate == ("1.1", "2.1")


@pytest.mark.parametrize(
    ("limb", "merged"),
    [
        ("R[z] P[x] R[x]", "R[z] C[x]"),
        ("R[z] R[x] R[y]", "R[z] U[x,y]"),
        ("R[z] U[x,y] R[z]", "R[z] S"),
    ],
)
def test_neighbours_are_merged_into_the_joint_that_has_their_freedoms(limb, merged):
    assert (merged, "R[z] R[z]") in {near.chains for near in changes([limb, "R[z] R[z]"], ["R1"]).values()}


def test_parallel_axes_are_no_universal_joint():
    assert not any("merged" in change for change in changes(["R[z] R[z] R[z]", "R[z] R[z]"], ["R1"]))


def test_limbs_are_joined_at_the_last_joints_that_they_have_alike():
    found = changes(["P[x] R[x] R[z]", "P[y] R[y] R[-z]", "P[z] R[x] R[y]"], ["P1", "P2", "P3"])
    (joined,) = (near for change, near in found.items() if "joined" in change)
    assert joined.chains == ("{P[x] R[x] | P[y] R[y]} R[z]", "P[z] R[x] R[y]")
    assert joined.actuate == ("1.1", "1.3", "2.1")


def test_a_joint_that_is_driven_is_not_shared():
    assert not any("joined" in change for change in changes(["R[x] R[z]", "R[y] R[z]"], ["R2", "R3"]))


def test_drives_are_moved_to_other_sets():
    found = changes(["R[z] R[z] R[z]", "R[z] R[z]"], ["R1", "R4"], [("R1", "R4"), ("R1", "R2")])
    assert [change for change in found if "drives" in change] == ["drives moved to R1, R2"]
    assert found["drives moved to R1, R2"].actuate == ("1.1", "1.2")
