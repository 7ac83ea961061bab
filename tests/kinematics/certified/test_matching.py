from __future__ import annotations

import dataclasses

import numpy as np
import pytest

import assur
from assur.kinematics.certified import signs
from assur.kinematics.certified.certify import certified_direct
from assur.kinematics.certified.proofs import Proofs
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
