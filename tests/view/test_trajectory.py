"""Trajectories stay in their mode, are assemblies at every moment, and end where they began."""

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closure import closure_error
from assur.kinematics.naming import mode_names
from assur.view.snapshot import start, to_poses
from assur.view.trajectory import around, through


@pytest.mark.parametrize("name", ["fivebar", "zeng2019", "three_rps"])
def test_a_round_is_closed_and_every_moment_is_an_assembly(name):
    here = start(assur.load(name))
    found = around(here)
    record, size = here.record, characteristic_length(here.record)
    assert found.reason is None
    assert np.all(np.diff(found.shares) > 0)
    assert np.max(closure_error(record, found.joints)) < 1e-8 * size
    assert {mode_names(record, row) for row in found.joints} == {here.modes}
    assert found.at(1.0) == pytest.approx(here.values, abs=1e-6 * size)
    assert found.at(0.0) == pytest.approx(here.values)


def test_it_passes_the_poses_that_were_kept():
    here = to_poses(start(assur.load("fivebar")), [0.0, 200.0])
    found = through(here, [np.array([20.0, 200.0]), np.array([0.0, 220.0])])
    poses = np.array([assur.load("fivebar").point("P", row)[:2] for row in found.joints])
    for wanted in ([20.0, 200.0], [0.0, 220.0]):
        assert np.min(np.linalg.norm(poses - wanted, axis=1)) < 1e-6


def test_one_that_cannot_be_gone_says_so_and_goes_as_far_as_it_can():
    here = start(assur.load("fivebar"))
    found = through(here, [np.array([0.0, 400.0])])
    assert "leg1 is 112 mm too short" in str(found.reason)
    straight, height = np.sqrt(294.0**2 - 70.0**2), here.pose[1]
    assert found.end == pytest.approx((straight - height) / (2 * (400.0 - height)), abs=1e-4)
    assert here.record.point("P", found.at(found.end))[1] == pytest.approx(straight, abs=1e-2)


def test_what_is_said_is_of_the_corner_on_the_way_to_which_it_stops():
    here = start(assur.load("fivebar"))
    found = through(here, [np.array([10.0, 220.0]), np.array([0.0, 310.0]), np.array([0.0, 400.0])])
    missing = np.hypot(310.0, 70.0) - 294.0
    assert f"leg1 is {missing:.3g} mm too short" in str(found.reason)


def test_a_round_that_is_gone_ends_at_its_end():
    assert around(start(assur.load("fivebar"))).end == 1.0


def test_it_needs_somewhere_to_go():
    with pytest.raises(UsageError, match="needs a pose"):
        through(start(assur.load("fivebar")), [])
