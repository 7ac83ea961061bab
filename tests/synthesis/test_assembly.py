import dataclasses
from collections import Counter

import pytest

from assur.synthesis import assembly
from assur.synthesis.assembly import MEMBERS, Range, Sought, assemble
from assur.synthesis.classes import classes
from assur.synthesis.expected import Counts
from assur.synthesis.required import MOTIONS
from assur.topology.symbolic.refusals import Refusal

SPACE, ANY = MOTIONS["3T"], Range(0, 9)


def sought(degrees=ANY, *, symmetric):
    return Sought(SPACE, degrees, ((0, 1, 2),), symmetric=symmetric)


@pytest.fixture(scope="module")
def by_rotations(small):
    """The largest class with each number of rotations."""
    found = sorted(classes(small.limbs), key=len)
    return {members[0].known.poc.r: members for members in found}


def test_all_mechanisms_of_equal_limbs_are_found(by_rotations):
    found = assemble([by_rotations[1]] * 3, sought(symmetric=True))
    assert found.tally.combinations == found.tally.with_motion == found.tally.tried == len(by_rotations[1])
    assert len(found.designs) + found.tally.unfixed == len(by_rotations[1])
    assert all(design.symmetric for design in found.designs)
    assert found.tally.coupling_degrees == Counter({1: len(by_rotations[1])})


def test_of_different_limbs_the_simplest_are_found(by_rotations):
    found = assemble([by_rotations[1], by_rotations[2], by_rotations[3]], sought(symmetric=False))
    assert len(found.designs) == MEMBERS
    assert {design.symmetric for design in found.designs} == {False}
    assert {design.redundant.collapsed for design in found.designs} == {0}
    joints = [design.joints for design in found.designs]
    assert joints == sorted(joints)


def test_limbs_that_leave_another_motion_are_not_looked_at_one_by_one(by_rotations):
    found = assemble([by_rotations[3]] * 3, sought(symmetric=True))
    assert (found.designs, found.tally.with_motion, found.tally.tried) == ((), 0, 0)
    assert found.tally.combinations == len(by_rotations[3])


def test_coupling_degrees_that_are_not_wanted_are_counted_only(by_rotations):
    found = assemble([by_rotations[1]] * 3, sought(Range(2, 9), symmetric=True))
    assert (found.designs, found.tally.tried) == ((), 0)
    assert found.tally.coupling_degrees[1] == len(by_rotations[1])


def test_where_the_rules_refuse_the_twists_answer(by_rotations, monkeypatch):
    monkeypatch.setattr(assembly, "expected", lambda *_: Refusal("a reason"))
    found = assemble([by_rotations[1]] * 3, sought(symmetric=True))
    assert {(design.known.route, design.known.refusal) for design in found.designs} == {("twists", "a reason")}
    assert {design.coupling_degree for design in found.designs} == {1}
    assert assemble([by_rotations[1]] * 3, sought(Range(2, 2), symmetric=True)).designs == ()


def test_a_disagreement_on_freedoms_is_said(by_rotations, monkeypatch):
    """Rules that take three free limbs for three translations."""
    right = assembly.expected

    def wrong(motions, motion):
        return dataclasses.replace(right(motions, motion), reaches=True, counts=None)

    monkeypatch.setattr(assembly, "expected", wrong)
    found = assemble([by_rotations[3]] * 3, sought(symmetric=True))
    assert found.designs == ()
    assert len(found.tally.disagreements) == len(by_rotations[3])
    first = by_rotations[3][0]
    text = " | ".join(chain.text for chain in first.chains)
    assert found.tally.disagreements[0] == f"{text}: the rules say F = 3, the twists 6"


def test_a_disagreement_on_loops_is_said(by_rotations, monkeypatch):
    right = assembly.expected

    def wrong(motions, motion):
        found = right(motions, motion)
        dims = {some: size + (len(some) == 2) for some, size in found.counts.dims.items()}
        return dataclasses.replace(found, counts=Counts(dims, found.counts.freedoms))

    monkeypatch.setattr(assembly, "expected", wrong)
    found = assemble([by_rotations[1]] * 3, sought(symmetric=True))
    assert found.designs == ()
    assert "the rules say ξ = (4, 5), κ = 2, the twists (5, 4), 1" in found.tally.disagreements[0]
