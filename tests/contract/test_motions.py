"""Laws of motion in time, for every mechanism with masses assigned at random; none knows a printed number."""

import numpy as np
import pytest
from scipy.interpolate import make_interp_spline

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_of
from assur.machine.dynamics.free_motion import free_motion
from assur.machine.dynamics.inverse_dynamics import dynamics
from assur.machine.dynamics.prescribed_motion import sampled
from assur.machine.dynamics.release import Release
from assur.machine.forces.actuator_forces import forces_at
from assur.machine.forces.loads import load_of
from assur.model.pose import LENGTHS, rate_names
from catalogue import each
from weighed import weighed

WRENCH = [3.0, -4.0, 5.0, 0.6, 0.7, -0.8]


@pytest.fixture
def record(mechanism):
    """With masses at random; with its own where nothing drives the spin of rods, as which one they have would count."""
    at_home = forces_at(mechanism, mechanism.home_values[None], load_of(None, gravity=False))
    return mechanism if np.abs(at_home.motion.idle).max() > 1e-9 else weighed(mechanism)


def test_what_is_left_to_itself_keeps_its_energy_and_needs_no_forces(record):
    """A motion that begins with some velocity, under gravity; the inverse problem is asked what moves it so."""
    length = characteristic_length(record)
    velocity = np.array([0.3 * length if name in LENGTHS else 0.3 for name in rate_names(record.platform.pose)])
    start = Release(
        pose_of(record, home_values(record)), velocity, 0.05, lambda _: np.zeros(len(record.drives)), count=2
    )
    moved = free_motion(record, start)
    assert moved.departure is None
    assert moved.drift <= 1e-9
    assert moved.gap <= 1e-10
    asked, held = (
        forces_at(record, moved.values[1:], load_of(None), moved.velocities[1:], change)
        for change in (moved.accelerations[1:], 0 * moved.accelerations[1:])
    )
    assert np.abs(asked.forces).max() <= 1e-8 * np.abs(held.forces).max()


@pytest.mark.parametrize("mechanism", each(), indirect=True)
def test_the_work_of_actuators_and_load_is_the_change_of_energy(record):
    """Along a smooth motion through poses that were met before: work is integrated, energies are those of places."""
    away = -0.04 * np.sin(np.linspace(0.0, 2.0, 25))[:, None] * np.ones(len(record.platform.pose))
    units = np.array([characteristic_length(record) if name in LENGTHS else 1.0 for name in record.platform.pose])
    times = np.linspace(0.0, 0.4, 25)
    moved = dynamics(record, sampled(record, times, pose_of(record, home_values(record)) + away * units), load=WRENCH)
    assert moved.departure is None
    twists = (moved.answer.motion.platform @ moved.answer.joint_rates[..., None])[..., 0]
    power = np.sum(moved.forces * moved.rates, axis=1) + twists @ np.roll(WRENCH, 3)
    work = make_interp_spline(times, power, k=5).antiderivative()(times)
    energy = moved.kinetic_energy + moved.potential_energy
    size = np.abs(work).max() + np.ptp(moved.kinetic_energy) + np.ptp(moved.potential_energy)
    assert work == pytest.approx(energy - energy[0], abs=1e-6 * size)
