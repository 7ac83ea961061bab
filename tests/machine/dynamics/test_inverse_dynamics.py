"""Forces along motions: by hand where that is possible, refused where the mechanism does not follow."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import make_interp_spline

import assur
from assur.errors import UsageError
from assur.kinematics.pose import pose_of
from assur.machine.dynamics.prescribed_motion import harmonic, sampled
from assur.machine.masses.link_masses import masses
from assur.model.machine_data import Actuator


@pytest.fixture(scope="module")
def zeng():
    return assur.load("zeng2019")


@pytest.fixture(scope="module")
def delta():
    return assur.load("delta_4s")


@pytest.fixture(scope="module")
def fivebar():
    return assur.load("fivebar")


def test_what_swings_along_the_rails_swings_as_one_body(zeng):
    """y = 20 mm sin(6 t): the motors share m y'', gravity, which has no part along y, aside."""
    answer = zeng.dynamics(harmonic(zeng, [-15, 10, 400], [0, 20, 0], 6.0), gravity=False)
    mass = sum(body.mass for body in masses(zeng).bodies.values())
    expected = -mass * 0.02 * 36.0 * np.sin(6.0 * answer.times)
    np.testing.assert_allclose(answer.forces.sum(axis=1), expected, atol=1e-9 * np.abs(expected).max())
    np.testing.assert_allclose(answer.rates, 0.12 * np.cos(6.0 * answer.times)[:, None] * [1, 1, 1], atol=1e-12)
    assert answer.kinetic_energy == pytest.approx(0.5 * mass * (0.12 * np.cos(6.0 * answer.times)) ** 2)
    assert (answer.status, answer.departure) == ("regular", None)


def test_mean_squares_of_a_sine_and_shares_of_limits(zeng):
    limited = replace(zeng.machine, actuators={"P1": Actuator(force=10.0, speed=0.5, coulomb=2.0)})
    record = assur.Mechanism(**vars(replace(zeng, machine=limited)))
    answer = record.dynamics(harmonic(record, [-15, 10, 400], [0, 20, 0], 6.0), gravity=False)
    np.testing.assert_allclose(answer.rms, answer.peak / np.sqrt(2), rtol=1e-9)
    shares, rubbing = answer.utilisation(), answer.utilisation(friction=True)
    assert shares.force[0] == pytest.approx(answer.peak[0] / 10)
    assert shares.speed[0] == pytest.approx(0.12 / 0.5)
    assert np.isnan([*shares.force[1:], *shares.speed[1:]]).all()
    assert shares.force[0] < rubbing.force[0] <= shares.force[0] + 0.2 + 1e-12


def test_rods_that_weigh_on_their_axes_do_not_swing(delta):
    around = harmonic(delta, [0, 0, -0.9], [0.1, 0, 0], 6.0, count=4)
    assert not delta.dynamics(around).swings


def test_rods_that_weigh_beside_their_axes_swing_and_keep_the_books_of_energy(delta):
    """What the actuators do is what the energies change by: the swing of the rods among them."""
    rods = {name: replace(link, profile=None, mass=0.1, centre=np.array([0.02, 0.0, -0.6])) if "rod" in name else link
            for name, link in delta.machine.links.items()}  # fmt: skip
    beside = assur.Mechanism(**vars(replace(delta, machine=replace(delta.machine, links=rods))))
    asked = beside.dynamics(harmonic(beside, [0, 0, -0.9], [0.1, 0, 0], 20.0, t_end=0.02, count=5))
    work = make_interp_spline(asked.times, asked.answer.power, k=4).integrate(asked.times[0], asked.times[-1])
    energy = asked.kinetic_energy + asked.potential_energy
    assert asked.swings
    assert work == pytest.approx(energy[-1] - energy[0], rel=1e-5)
    spun = np.abs(asked.answer.joint_rates - asked.answer.motion.rates(asked.velocities)).max(axis=1)
    assert spun[0] == pytest.approx(0.0, abs=1e-9)
    assert spun[-1] > 0.01


def test_standing_still_is_statics(zeng):
    pose = [-15.4714, 9.6849, 456.3315]
    answer = zeng.dynamics(sampled(zeng, np.arange(5.0), [pose] * 5), load=[0, 0, -100])
    held = zeng.forces(pose, load=[0, 0, -100]).forces
    np.testing.assert_allclose(answer.forces, np.repeat(held, 5, axis=0), atol=1e-9)


def test_a_motion_that_leaves_the_workspace_is_refused_with_the_moment(fivebar):
    """Straight up, until crank and rod are in line: at y = sqrt((l1 + l2)^2 - g^2)."""
    up = harmonic(fivebar, [0, 200], [0, 100], 1.0)
    refused = fivebar.dynamics(up, "-+", gravity=False)
    height = np.sqrt((100 + 194) ** 2 - 70**2)
    assert refused.departure.time == pytest.approx(np.arcsin((height - 200) / 100), abs=1e-5)
    assert refused.departure.pose == pytest.approx([0, height], abs=1e-3)
    assert (refused.status, len(refused.times), refused.forces.shape) == ("serial", 0, (0, 2))
    assert np.isnan(refused.peak).all()
    assert "a serial singularity" in str(refused)
    assert 0.0 <= refused.departure.margin < 1e-5


def test_a_start_that_is_not_reached_says_what_is_negative(fivebar):
    refused = fivebar.dynamics(harmonic(fivebar, [0, 400], [0, 1], 1.0), "-+", gravity=False)
    assert (refused.status, refused.departure.time) == ("unreachable", 0.0)
    assert refused.departure.quantity
    assert refused.departure.margin < 0


def test_a_limit_of_the_file_bounds_a_motion_unless_it_is_left_aside():
    record = assur.load("three_rps")
    low, high = record.inputs[0].stroke
    pose = pose_of(record, record.home_values)
    size = np.array([high - low if name == "z" else 0.0 for name in record.platform.pose])
    up = harmonic(record, pose, size, 1.0, t_end=1.5)
    refused = record.dynamics(up)
    assert (refused.status, "stroke of" in refused.departure.text) == ("limit", True)
    reached = record.inverse(refused.departure.pose, record.modes.default_working).inputs
    assert np.nanmin(np.abs(reached - high)) < 1e-3 * (high - low)
    assert record.dynamics(up, use_limits=False).status != "limit"


@pytest.mark.parametrize("asked", ["dynamics", "free_motion"])
def test_what_is_no_motion_is_refused_with_what_is_one(fivebar, asked):
    with pytest.raises(UsageError, match=r"3 is no (prescribed motion|release)") as refused:
        getattr(fivebar, asked)(3)
    assert "machine.dynamics" in refused.value.hint
