"""Where ways of poses turn back, against the closed forms that say where a mode exists."""

import numpy as np
import pytest

import assur
from assur.kinematics.closure import closure_error
from assur.kinematics.following.turning import turnings
from assur.kinematics.following.ways import Straight
from assur.kinematics.pose import pose_of


def ways(record, count=1500, seed=1):
    """Ways from poses that exist to others that do not, a twelfth of the box long; joint values at their starts."""
    rng = np.random.default_rng(seed)
    low, high = np.array([record.box[name] for name in record.platform.pose]).T
    start = rng.uniform(low, high, size=(count, len(low)))
    end = start + rng.normal(size=start.shape) * (high - low) / 12
    mode = record.modes.default_working
    first, last = (record.inverse(poses, mode=mode) for poses in (start, end))
    rows = first.exists[:, 0] & ~last.exists[:, 0]
    return start[rows], end[rows], first.joints[rows, 0]


def existing(record, start, end):
    """Share of the way at which the closed form stops to exist for the first time, by sampling and halving."""

    def exists(share):
        return record.inverse(start + share[:, None] * (end - start), mode=record.modes.default_working).exists[:, 0]

    low, high = np.zeros(len(start)), np.ones(len(start))
    for share in np.linspace(1.0, 0.0, 129):
        high = np.where(exists(np.full(len(start), share)), high, share)
    low = high - 1 / 128
    for _ in range(30):
        middle = 0.5 * (low + high)
        there = exists(middle)
        low, high = np.where(there, middle, low), np.where(there, high, middle)
    return low


@pytest.mark.parametrize("name", ["fivebar", "zeng2019", "delta_4s"])
def test_ways_turn_back_where_the_closed_form_ends(name):
    record = assur.load(name)
    start, end, joints = ways(record)
    found = turnings(Straight(record, start, end), joints)
    there = found.located
    assert np.mean(there) > 0.6
    gaps = np.abs(found.share - existing(record, start, end))[there]
    assert np.median(gaps) < 1e-5
    assert np.quantile(gaps, 0.95) < 1e-3
    assert np.max(closure_error(record, found.joints[there])) < 1e-6 * np.max(np.abs(end))
    share = np.sum((pose_of(record, found.joints) - start) * (end - start), axis=1) / np.sum((end - start) ** 2, axis=1)
    assert np.all(share[there] <= found.share[there])


def test_a_way_that_stays_inside_never_turns():
    record = assur.load("fivebar")
    start, end = np.array([[0.0, 200.0]]), np.array([[10.0, 210.0]])
    joints = record.inverse(start, mode="-+").joints[:, 0]
    found = turnings(Straight(record, start, end), joints)
    assert not found.located[0]
