"""Where actuators hold least: against the drives' own rates, and by the force that a load asks for."""

import numpy as np
import pytest

import assur
from assur.kinematics.pose import pose_of
from assur.machine.forces.weakness import loosest, unfelt, weakness
from weighed import place


@pytest.mark.parametrize("name", ["zeng2019", "three_rps", "gough_stewart"])
def test_a_load_along_the_weakest_twist_asks_for_what_is_said(name):
    """Work of the load is that of the actuators, so their force is one over what they move by, in the ratio told."""
    mechanism = assur.load(name)
    joints = place(mechanism)[0]
    pose = pose_of(mechanism, joints)
    answer = mechanism.forces(pose, gravity=False)
    own = weakness(answer.motion)
    length = answer.motion.length
    load = np.concatenate([own.twist[:3], own.twist[3:] * length])
    forces = mechanism.forces(pose, load=load, gravity=False).forces[0]
    turning = [item.coordinate.kind == "angle" for item in mechanism.drives]
    scaled = forces / np.where(turning, length, 1.0)
    np.testing.assert_allclose(scaled, -own.drives / own.moved * np.sign(-scaled @ own.drives), rtol=1e-6)
    for other in np.eye(6):
        push = np.concatenate([other[:3], other[3:] * length])
        borne = mechanism.forces(pose, load=push, gravity=False).forces[0] / np.where(turning, length, 1.0)
        assert np.linalg.norm(borne) <= 1.0000001 / own.moved


def test_what_is_weak_near_a_singularity_grows_as_one_over_the_distance():
    fivebar = assur.load("fivebar", l2=150)
    near, nearer = (weakness(fivebar.forces([0.0, y], gravity=False, mode="-+").motion) for y in (60.02, 60.01))
    assert near.moved / nearer.moved == pytest.approx(2.0, rel=1e-3)
    assert near.joint == nearer.joint == "P"


def test_an_actuator_that_the_pose_does_not_feel_is_named():
    angle = np.arctan2(200.0, 150.0)
    fivebar = assur.load("fivebar", l2=150)
    stretched = fivebar.forces([-70 + 250 * np.cos(angle), 250 * np.sin(angle)], gravity=False, mode="++")
    assert unfelt(stretched.motion) == ("theta1",)
    assert unfelt(fivebar.forces([0.0, 200.0], gravity=False).motion) == ()
    assert loosest(stretched.motion) in fivebar.joints
