"""Home as the file means it."""

from __future__ import annotations

import numpy as np
import pytest

import assur
from assur.kinematics.pose import pose_of


@pytest.mark.parametrize(("name", "unit"), [("delta_4s", 1.0), ("h4_robot", 1000.0)])
def test_a_symmetric_mechanism_stands_symmetric(name, unit):
    """Joint values are written to ten digits, so that what is zero by symmetry is zero to picometres."""
    mechanism = assur.load(name)
    pose = dict(zip(mechanism.platform.pose, pose_of(mechanism, mechanism.home_values), strict=True))
    off = [value for key, value in pose.items() if key != "z"]
    np.testing.assert_allclose(off, 0.0, rtol=0, atol=2e-12 * unit)
