"""Rates and accelerations of all joints: to second order loops stay closed and the pose goes as given."""

import numpy as np
import pytest

import assur
from assur.kinematics.closure import closure_error
from assur.kinematics.pose import pose_of
from assur.kinematics.validation.check import METRES
from assur.machine.masses.link_masses import masses
from assur.machine.motion.inertia import link_inertia
from assur.machine.motion.joint_motion import closed_motion
from assur.machine.motion.screws import rate_units
from assur.model.pose import LENGTHS
from weighed import motion_of, place, weighed

THIRD_ORDER = 0.16
"""What half the time leaves: 1/8 where all terms up to the second order agree, 1/4 where the second does not."""


@pytest.mark.parametrize("name", ["zeng2019", "planar_3rrr", "three_crr", "fivebar"])
def test_loops_stay_closed_and_the_pose_goes_as_given(name):
    record = weighed(assur.load(name))
    start = place(record)
    motion = closed_motion(link_inertia(record, start, masses(record)), start)
    velocity, acceleration = motion_of(record)
    rates = motion.rates(velocity)
    second = motion.second(rates, acceleration)
    units = np.array([1.0 / METRES[record.unit] if name in LENGTHS else 1.0 for name in record.platform.pose])

    def after(seconds):
        joints = start + (seconds * rates + seconds**2 / 2 * second) / rate_units(record)
        moved = pose_of(record, joints[0]) - pose_of(record, start[0])
        given = (seconds * velocity[0] + seconds**2 / 2 * acceleration[0]) * units
        return closure_error(record, joints)[0], np.linalg.norm((moved - given) / units)

    for long, short in zip(after(2e-2), after(1e-2), strict=True):
        assert short < THIRD_ORDER * long
