import dataclasses

import numpy as np
import pytest

import assur
from assur.kinematics import position
from assur.kinematics.certified import signs
from assur.kinematics.certified.branches import JudgedBranches
from assur.kinematics.certified.certify import certified_direct
from assur.kinematics.certified.matching import Candidates, matched
from assur.kinematics.certified.proofs import Proofs
from assur.kinematics.certified.result import Doubt
from assur.model.registry import load_record
from assur.numerics.intervals.interval import Interval

TABLE_1 = [162.6907, -143.3209, -24.6776]


@pytest.fixture
def with_proofs(monkeypatch):
    """A certificate in which the proofs from the legs are changed on their way."""

    def certified(change):
        own = signs.proofs
        monkeypatch.setattr(signs, "proofs", lambda legs, found: change(own(legs, found)))
        return certified_direct(assur.load("zeng2019"), TABLE_1)

    return certified


def some(known, rows):
    return Proofs(known.pose[rows], known.alone[rows], known.rows[rows])


def test_without_the_legs_the_closed_form_stands_alone(with_proofs):
    found = with_proofs(lambda known: some(known, []))
    assert found.proved
    assert {item.how for item in found} == {"closed form over intervals"}


def test_a_pose_that_the_closed_form_lacks_is_a_disagreement_not_an_answer(with_proofs):
    """One pose too many, 1 mm beside another: the sum of both proofs is no proof."""

    def doubled(known):
        beside = Interval(known.pose.low[:1] + 1, known.pose.high[:1] + 1, known.pose.defined[:1])
        pose = Interval.of(np.concatenate([known.pose.low, beside.low]), np.concatenate([known.pose.high, beside.high]))
        return dataclasses.replace(known, pose=pose, alone=pose, rows=np.append(known.rows, known.rows[0]))

    found = with_proofs(doubled)
    assert not found.proved
    assert any("disagree" in item.meaning for item in found.undecided)


def test_both_proofs_are_intersected(with_proofs):
    both = certified_direct(assur.load("zeng2019"), TABLE_1)
    alone = with_proofs(lambda known: some(known, []))
    for narrow, wide in zip(both, alone, strict=True):
        assert np.all((narrow.pose.low >= wide.pose.low) & (narrow.pose.high <= wide.pose.high))
        assert narrow.how == "closed form over intervals, and Krawczyk on the legs"


def test_a_branch_whose_bounds_hold_two_proved_poses_does_not_hide_one():
    """One branch that exists, with bounds about both poses that the legs prove, and one that may merge."""
    record, inputs = load_record("fivebar"), np.array([2.2, 0.9])
    poses = Interval.of([[0.0, 0.0], [1.0, 1.0]], [[0.1, 0.1], [1.1, 1.1]])
    alone = Interval.of([[-0.1, -0.1], [0.9, 0.9]], [[0.2, 0.2], [1.2, 1.2]])
    doubt = Doubt("m", np.array([-1.0]), np.array([1.0]), "may merge")
    branches = JudgedBranches(
        Interval.of([[-1.0, -1.0], [-9.0, -9.0]], [[2.0, 2.0], [9.0, 9.0]]),
        Interval.of(np.zeros((2, 2))),
        np.array([True, False]),
        np.array([False, False]),
        np.array([False, True]),
        ((1, doubt),),
        {},
    )
    found = matched(
        record,
        inputs,
        Candidates(branches, ("+", "-"), ("-+", "-+")),
        Proofs(poses, alone, np.array([0, 1])),
        position.direct(record, inputs),
        "",
    )
    assert (len(found.solutions), found.proved) == (2, True)
    assert found.headline == "proved, 2 solutions and no other"


@pytest.mark.parametrize(
    ("second", "modes", "count"), [([0.05, 0.05], "++", 1), ([0.05, 0.05], "+-", 2), ([0.5, 0.5], "++", 2)]
)
def test_two_branches_that_may_be_one_pose_count_once(second, modes, count):
    """Both certainly exist; where neither modes nor bounds tell them apart nobody knows that they are two."""
    record, inputs = load_record("fivebar"), np.array([2.2, 0.9])
    low = np.array([[0.0, 0.0], second])
    both, none = np.array([True, True]), np.array([False, False])
    branches = JudgedBranches(Interval.of(low, low + 0.1), Interval.of(np.zeros((2, 2))), both, none, none, (), {})
    nothing = Interval.of(np.zeros((0, 2)))
    found = matched(
        record,
        inputs,
        Candidates(branches, tuple(modes), ("-+", "-+")),
        Proofs(nothing, nothing, np.zeros(0, dtype=int)),
        position.direct(record, inputs),
        "",
    )
    assert (len(found), found.proved) == (count, count == 2)
    assert [item.meaning for item in found.undecided] == ["one pose or two"] * (2 - count)
