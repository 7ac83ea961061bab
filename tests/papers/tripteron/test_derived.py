"""The tripteron: one pose, eight knees, decoupled."""

import numpy as np

import assur


def test_one_pose_with_eight_choices_of_knees():
    mechanism = assur.load("tripteron")
    found = mechanism.direct([170.0, 150.0, 190.0])
    assert len(found) == 8
    np.testing.assert_allclose(found.poses[found.exists], np.tile([210.0, 190.0, 230.0], (8, 1)), rtol=0, atol=1e-12)
    knees = found.joints[:, [item.index for item in mechanism.coordinates if item.joint.endswith(".B")]]
    assert len(np.unique(knees.round(9), axis=0)) == 8


def test_velocities_are_those_of_the_sliders():
    here = assur.load("tripteron").velocity_map([210.0, 190.0, 230.0])
    np.testing.assert_allclose(here.matrix, np.eye(3), rtol=0, atol=1e-12)


def test_everything_agrees(found):
    assert found.origin == "derived"
    assert found.claims_hold
