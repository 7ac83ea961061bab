"""The 3-CRR: linear in the pose for any slope of its rods, isotropic where they are orthogonal."""

import numpy as np
import pytest

import assur

ANGLES = 2 * np.pi * np.arange(3) / 3


@pytest.mark.parametrize("rise", [np.sqrt(0.5), 0.3, 1.0])
def test_the_pose_solves_three_linear_equations(rise):
    mechanism = assur.load("three_crr", rise=float(rise))
    axes = np.stack([np.cos(ANGLES), np.sin(ANGLES), np.full(3, rise)], axis=-1) / np.hypot(1.0, rise)
    pose = np.array([30.0, -40.0, 230.0])
    inputs = axes @ pose - 120.0 * axes[0, 0]
    found = mechanism.direct(inputs)
    assert len(found) == 8
    np.testing.assert_allclose(found.poses[found.exists], np.tile(pose, (8, 1)), rtol=0, atol=1e-10)
    here = mechanism.velocity_map(pose)
    np.testing.assert_allclose(here.matrix, np.linalg.inv(axes), rtol=0, atol=1e-12)


def test_orthogonal_rods_are_isotropic_everywhere():
    mechanism = assur.load("three_crr")
    for pose in ([0.0, 0.0, 210.0], [30.0, -40.0, 230.0]):
        assert mechanism.velocity_map(pose).condition == pytest.approx(1.0, abs=1e-12)


def test_everything_agrees(found):
    assert found.origin == "derived"
    assert found.claims_hold
