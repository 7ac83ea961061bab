"""Clearances against solids of another library, links that must meet, and pairs that are left out."""

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.joint_graph.frames import frames
from assur.scene.bodies import bodies, solid
from assur.scene.collisions import collisions
from assur.scene.sampled import sampled
from assur.scene.sizes import thickness, with_thickness
from catalogue import each
from drawn_drafts import DRAFTS, draft


def test_no_pair_shares_a_joint_and_every_other_is_there(every):
    record = every.record
    found = {frozenset(item.links) for item in collisions(record, record.home_values[None]).pairs}
    hinged = {frozenset((joint.parent, joint.child)) for joint in record.joints.values()}
    links = [body.link for body in bodies(record)]
    assert found == {frozenset((a, b)) for a in links for b in links if a != b} - hinged


@pytest.mark.parametrize("name", ["zeng2019", "tripteron", pytest.param("delta_4s", marks=pytest.mark.deep)])
def test_clearances_are_those_of_manifold_at_every_pose(name):
    """The least distance of all parts, one by one and without any bounds, at each of a few poses."""
    record = assur.load(name)
    joints = sampled(record, 4, seed=1)
    made = {body.link: [solid(item.shape) for item in (*body.fused, *body.pins)] for body in bodies(record)}
    placed = frames(record, joints)
    size = 1e3 * np.ptp(every_origin(placed), axis=0).max()
    for item in collisions(record, joints).pairs[::5]:
        gaps = []
        for row in range(len(joints)):
            own = [
                [part.transform(np.column_stack([placed[link][0][row], placed[link][1][row]])) for part in made[link]]
                for link in item.links
            ]
            gaps.append(min(a.min_gap(b, size) for a in own[0] for b in own[1]))
        assert item.clearance == pytest.approx(min(gaps), rel=1e-3, abs=1e-6 * size)
        assert item.meeting == sum(gap <= 1e-9 * size for gap in gaps)
        if min(gaps) > 0:
            assert item.row == int(np.argmin(gaps))


def every_origin(placed):
    return np.concatenate([origin for _, origin in placed.values()])


def test_what_lies_in_one_place_meets():
    """Two cranks of a five-bar with their feet in one place, as thick as ever, meet; as far apart as they are not."""
    record = assur.load("fivebar")
    apart = {item.links: item for item in collisions(record, record.home_values[None]).pairs}
    assert apart["crank1", "crank2"].meeting == 0
    close = with_thickness(assur.load("fivebar", g=3.0), thickness(record))
    met = {item.links: item for item in collisions(close, sampled(close, 30)).pairs}
    assert met["crank1", "crank2"].meeting > 0
    assert met["crank1", "crank2"].clearance == 0.0


def test_steps_are_told():
    record, told = assur.load("fivebar"), []
    collisions(record, record.home_values[None], lambda done, total: told.append((done, total)))
    assert told == [(k + 1, 5) for k in range(5)]


def test_a_single_row_is_refused():
    record = assur.load("fivebar")
    with pytest.raises(UsageError, match=r"joint values of shape \(5,\)"):
        collisions(record, record.home_values)


@pytest.mark.parametrize("what", each(DRAFTS, ["a hybrid", "parallelograms along upright rails"]))
def test_nothing_of_a_draft_meets_at_home(what):
    record = draft(what)
    assert collisions(record, record.home_values[None]).meeting == ()
