"""Blocks in the order of solution: what closes by itself."""

import numpy as np
import pytest

from assur.kinematics.closing_blocks.blocks import PLATFORM, _candidates, closing_groups, standing_links
from assur.kinematics.closing_blocks.chains import FreeChain, FreeJoint
from assur.kinematics.closing_blocks.columns import ScrewColumns, assemblies_by_chance
from assur.model.registry import load_record


def blocks(name, problem, **held):
    return [block for group in closing_groups(load_record(name), problem, **held) for block in group.blocks]


@pytest.mark.parametrize(
    ("name", "problem", "joints"),
    [
        ("planar_3rrr", "inverse", [3, 3, 3]),  # each limb, the platform held
        ("planar_3rrr", "direct", [6]),  # the triad
        ("fivebar", "direct", [3]),  # the dyad
        ("gough_stewart", "inverse", [3] * 6),
        ("gough_stewart", "direct", [12]),
        ("delta_4s", "inverse", [3, 2] * 3),  # the arm with one rod, then the other
    ],
)
def test_they_are_limbs_with_the_platform_held_and_assur_chains_with_the_inputs_held(name, problem, joints):
    assert [len(block.joints) for block in blocks(name, problem)] == joints


def test_a_pose_that_does_not_hold_the_platform_leaves_a_joint_for_what_is_open():
    (whole,) = blocks("three_rps", "inverse")
    assert PLATFORM in whole.joints
    assert len(whole.columns) == 18
    assert [len(block.joints) for block in blocks("three_rps", "inverse", whole_pose=True)] == [3, 3, 3]


def test_rods_between_ball_joints_spin_and_nothing_else_is_lost():
    record = load_record("delta_4s")
    (block,) = blocks("delta_4s", "direct")
    assert (len(block.columns), len(block.spins), block.rank) == (36, 6, 30)
    screws = ScrewColumns(record, assemblies_by_chance(record)[:6])
    matrices = block.derivative(screws, [record.base] * len(block.loops))
    assert np.max(np.linalg.matrix_rank(matrices, tol=1e-7)) == block.rank


def test_links_that_stand_still_against_each_other_are_held_alike():
    """So that one of them is held for all, where factors are sought: with the inputs held a leg is one rod."""
    record = load_record("planar_3rpr")
    standing = standing_links(record, "direct", False)
    alike = [link for link, own in standing.items() if list(standing.values()).count(own) > 1]
    assert len(alike) == 6
    for link in alike:
        assert closing_groups(record, "direct", (link,)) == closing_groups(record, "direct", (standing[link],))


def test_of_as_many_chains_those_of_fewer_freedoms_are_a_smaller_block():
    """A carriage on a slide, and on a screw with its nut: held by the slide it leaves the nut to be told, not lost."""
    shaft = FreeJoint("A", ("base", "shaft"), (0,)), FreeJoint("B", ("shaft", "carriage"), (1,))
    nut = FreeChain(("base", "carriage"), shaft)
    slide = FreeChain(("base", "carriage"), (FreeJoint("C", ("base", "carriage"), (2,)),))
    rod = FreeChain(
        ("carriage", "base"), (FreeJoint("D", ("carriage", "rod"), (3,)), FreeJoint("E", ("rod", "base"), (4, 5, 6)))
    )
    pairs = [block.joints for block in _candidates([nut, slide, rod])][:3]
    assert pairs == [("A", "B", "C"), ("C", "D", "E"), ("A", "B", "D", "E")]
