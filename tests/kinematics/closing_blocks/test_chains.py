"""Chains between the links at which free joints meet, and the loops that they close."""

from assur.kinematics.closing_blocks.chains import FreeJoint, chains, joined, loops

#   base --A-- 1 --B-- 2 --C-- base, and 2 --D-- 3 --E-- base; F hangs on 3 and closes nothing
JOINTS = [
    FreeJoint("A", ("base", "1"), (0,)),
    FreeJoint("B", ("1", "2"), (1,)),
    FreeJoint("C", ("2", "base"), (2,)),
    FreeJoint("D", ("2", "3"), (3,)),
    FreeJoint("E", ("3", "base"), (4,)),
    FreeJoint("F", ("3", "4"), (5,)),
]


def test_joints_in_series_are_one_chain_and_what_closes_no_loop_is_left_out():
    listed = chains(JOINTS, "base")
    assert sorted(tuple(sorted(joint.name for joint in chain.joints)) for chain in listed) == [
        ("A", "B"), ("C",), ("D", "E"),
    ]  # fmt: skip
    assert all(set(chain.ends) == {"base", "2"} for chain in listed)


def test_a_ring_is_a_chain_from_a_link_to_itself():
    ring = joined(JOINTS[:3], [], "base")
    (chain,) = chains(ring, "base")
    assert (chain.ends, [joint.name for joint in chain.joints]) == (("base", "base"), ["A", "B", "C"])
    (elsewhere,) = chains(ring, "ground")
    assert len(elsewhere.joints) == 3


def test_links_that_stand_still_become_one_and_take_joints_between_them_away():
    held = joined(JOINTS, ["2"], "base")
    assert [joint.name for joint in held] == ["A", "B", "D", "E", "F"]
    assert sorted(len(chain.joints) for chain in chains(held, "base")) == [2, 2]


def test_every_loop_returns_to_where_it_began():
    """A joint run through from parent to child leads from its first end to its second."""
    listed = list(loops(JOINTS))
    assert len(listed) == 2
    ends = {joint.name: joint.ends for joint in JOINTS}
    for loop in listed:
        away: dict[str, int] = {}
        for name, sense in loop.items():
            first, second = ends[name]
            away[first] = away.get(first, 0) - sense
            away[second] = away.get(second, 0) + sense
        assert not any(away.values())
