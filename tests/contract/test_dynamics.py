"""The law of motion in time, for every mechanism with masses assigned at random, swinging rods too."""

import numpy as np
import pytest

import assur
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_error, pose_of
from assur.machine.dynamics.free_motion import free_motion
from assur.machine.dynamics.inverse_dynamics import dynamics
from assur.machine.dynamics.prescribed_motion import harmonic
from assur.machine.dynamics.release import Release, forces_in_time
from assur.model.pose import LENGTHS, QUATERNION, rate_names
from weighed import weighed

pytestmark = pytest.mark.deep
T_END = 0.05


@pytest.mark.parametrize("name", assur.names())
def test_the_forces_of_a_motion_give_it_back(name):
    """The integration of the second route knows the forces alone, and nothing of the pose."""
    record = weighed(assur.load(name))
    length = characteristic_length(record)
    sizes = {**dict.fromkeys(LENGTHS, 0.01 * length), **dict.fromkeys(QUATERNION, 0.01)}
    size = [sizes.get(name, 0.01) for name in record.platform.pose]
    sway = harmonic(record, pose_of(record, home_values(record)), size, 10.0, t_end=T_END, count=17)
    asked = dynamics(record, sway, use_limits=False)
    start, velocity, _ = (part[0] for part in sway.at(np.zeros(1)))
    given = forces_in_time(asked.times, asked.forces, smooth=True)
    moved = free_motion(record, Release(start, velocity, T_END, given, count=3), use_limits=False)
    assert moved.departure is None
    away = pose_error(record, moved.values, sway.at(moved.times)[0], length) / length
    assert np.abs(away).max() <= 1e-6
    assert moved.drift <= 1e-9


@pytest.mark.parametrize("name", assur.names())
def test_a_release_under_gravity_keeps_its_energy_for_a_second_or_up_to_what_ends_it(name):
    record = weighed(assur.load(name))
    at_rest = np.zeros(len(rate_names(record.platform.pose)))
    start = Release(pose_of(record, home_values(record)), at_rest, 1.0, lambda _: np.zeros(len(record.drives)))
    moved = free_motion(record, start)
    assert moved.kinetic_energy[-1] > 0.0
    assert moved.drift <= 1e-9
    assert moved.gap <= 1e-10
