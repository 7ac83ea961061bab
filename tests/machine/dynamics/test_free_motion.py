"""Motions by given forces: by hand, back from the inverse problem, and what ends them."""

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_of
from assur.machine.dynamics.free_motion import free_motion
from assur.machine.dynamics.inverse_dynamics import dynamics
from assur.machine.dynamics.prescribed_motion import harmonic
from assur.machine.dynamics.release import Release, forces_in_time
from assur.machine.masses.link_masses import masses
from assur.model.pose import LENGTHS
from own_machines import OWN, own_machine
from screw_mechanisms import DIFFERENTIAL, loaded
from weighed import weighed

POSE = np.array([-15.0, 10.0, 400.0])


@pytest.fixture(scope="module")
def zeng():
    return assur.load("zeng2019")


@pytest.fixture(scope="module")
def delta():
    return assur.load("delta_4s")


def still(record):
    return np.zeros(len(record.drives))


def test_the_same_force_in_every_motor_speeds_up_the_whole_along_the_rails(zeng):
    """What the heights ask for is left aside, so that nothing but y moves: y = F t^2 / (2 m)."""
    mass = sum(body.mass for body in masses(zeng).bodies.values())
    held = zeng.forces(POSE, acceleration=[0, 1000.0, 0], gravity=False).forces[0]
    moved = zeng.free_motion(Release(POSE, np.zeros(3), 0.2, lambda _: held, count=5), gravity=False)
    assert held.sum() == pytest.approx(mass)
    away = moved.poses - POSE
    np.testing.assert_allclose(away, 500.0 * moved.times[:, None] ** 2 * [0, 1, 0], atol=1e-8)
    np.testing.assert_allclose(moved.accelerations, [[0, 1, 0]] * 5, atol=1e-9)
    assert moved.work[-1] == pytest.approx(mass * 0.02)
    assert moved.kinetic_energy[-1] == pytest.approx(mass * 0.02)


def test_the_forces_of_a_motion_give_it_back(delta):
    around = harmonic(delta, [0, 0, -0.9], [0.1, 0.1, 0], 5 * np.pi, [0, np.pi / 2, 0], t_end=0.04)
    asked = delta.dynamics(around, load=[1, 2, 3])
    pose, velocity, _ = around.at(around.times[:1])
    given = forces_in_time(asked.times, asked.forces, smooth=True)
    moved = delta.free_motion(Release(pose[0], velocity[0], 0.04, given, count=3), load=[1, 2, 3])
    np.testing.assert_allclose(moved.poses, around.at(moved.times)[0], atol=1e-9)
    np.testing.assert_allclose(moved.velocities, around.at(moved.times)[1], atol=1e-7)


def test_a_platform_that_falls_onto_the_end_of_a_stroke_stops_there():
    record = assur.load("three_rps")
    start = Release(pose_of(record, record.home_values), np.zeros(3), 1.0, lambda _: still(record), count=6)
    moved = record.free_motion(start)
    assert (moved.status, moved.departure.quantity[:22]) == ("limit", "the room to the stroke")
    strokes = np.array([item.stroke for item in record.inputs])
    assert np.min(moved.inputs[-1] - strokes[:, 0]) == pytest.approx(0.0, abs=1e-6)
    assert moved.times[-1] == moved.departure.time < 1.0


def test_an_arm_that_falls_straight_stops_at_the_singularity(delta):
    """Arm and rods in one line; where limits do not end it before."""
    fast = np.array([0.0, 0.0, -3.0])
    moved = delta.free_motion(Release(np.array([0, 0, -1.6]), fast, 1.0, lambda _: still(delta), count=3))
    assert moved.status == "serial"
    assert moved.times[-1] < 1.0
    assert moved.departure.margin < 1e-6
    assert "a serial singularity" in str(moved)


def test_a_flat_parallelogram_is_a_constraint_singularity(zeng):
    """Its closure comes back after it has lost its rank; the value there tells."""
    start = Release(np.array([54.0, 50.5, 258.0]), np.array([50.0, 0, -1500.0]), 0.1, lambda _: still(zeng), count=2)
    moved = zeng.free_motion(start)
    assert moved.status == "constraint"


def test_a_start_that_is_not_reached_or_singular_is_told(zeng):
    with pytest.raises(UsageError, match="does not reach the first pose"):
        zeng.free_motion(Release(np.array([0, 0, 5000.0]), np.zeros(3), 1.0, lambda _: still(zeng)))
    fivebar = assur.load("fivebar", l2=150)
    flat = fivebar.free_motion(Release(np.array([0.0, 60.0]), np.zeros(2), 1.0, lambda _: still(fivebar)), "-+")
    assert (flat.status, len(flat.times)) == ("parallel", 1)


def test_a_nut_between_two_screws_falls_as_by_hand(tmp_path):
    """z = (5 + 3) mm a turn of the first screw, which itself moves by 5: one equation for its angle."""
    machine = "[payload]\nmass = 1.0\n[actuators]\nH1 = { rotor = 2e-6, force = 1 }\n"
    masses_of = (
        ("screw = {}", "screw = { mass = 2, inertia = [1e-3, 1e-3, 3e-6, 0, 0, 0] }"),
        ("nut = {}", "nut = { mass = 3 }"),
    )
    record = loaded(tmp_path, DIFFERENTIAL + machine, *masses_of)
    screw, nut = 5e-3 / (2 * np.pi), 8e-3 / (2 * np.pi)
    inertia, pull = 2e-6 + 3e-6 + 2 * screw**2 + 4 * nut**2, 9.81 * (2 * screw + 4 * nut)
    torque = 0.03
    moved = record.free_motion(Release(np.zeros(1), np.zeros(1), 0.02, lambda _: np.array([torque]), count=3))
    turned = 0.5 * (torque - pull) / inertia * moved.times**2
    np.testing.assert_allclose(moved.inputs[:, 0], turned, rtol=1e-9)
    np.testing.assert_allclose(moved.poses[:, 0], 1e3 * nut * turned, rtol=1e-9)
    swing = harmonic(record, [0.0], [4.0], 30.0)
    speeding = -0.004 / nut * 900.0 * np.sin(30.0 * swing.times)
    np.testing.assert_allclose(record.dynamics(swing).forces[:, 0], inertia * speeding + pull, rtol=1e-9)


@pytest.mark.deep
@pytest.mark.parametrize("name", OWN)
def test_mechanisms_of_ones_own_go_where_their_forces_send_them(name):
    """Screws, a Par4 whose rods weigh beside their axes and swing, redundant drives, no closed form."""
    record = weighed(own_machine(name))
    length, pose = characteristic_length(record), pose_of(record, home_values(record))
    size = [0.02 * length if part in LENGTHS else 0.02 for part in record.platform.pose]
    sway = harmonic(record, pose, size, 3.0, t_end=0.2, count=9)
    asked = dynamics(record, sway, use_limits=False)
    start, velocity, _ = (part[0] for part in sway.at(np.zeros(1)))
    given = forces_in_time(asked.times, asked.forces, smooth=True)
    moved = free_motion(record, Release(start, velocity, 0.2, given, count=3), use_limits=False)
    assert moved.drift <= 1e-9
    assert moved.gap <= 1e-10
    away = np.abs(moved.poses - sway.at(moved.times)[0]).max()
    assert away <= 1e-6 * max(length, 1.0)
    assert asked.swings == (name == "par4")
