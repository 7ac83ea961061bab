"""Small motions: against energies, against the whole motion, and where nothing pulls."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.kinematics.pose import pose_of
from assur.machine.dynamics.release import Release
from assur.machine.dynamics.small_motions import displaced, small_motions
from assur.model.machine_data import Actuator

POSE = [-15.0, 10.0, 400.0]
LOAD = [1.0, -2.0, 3.0]


def frictionless(name):
    record = assur.load(name)
    actuators = {key: replace(item, viscous=0.0) for key, item in record.machine.actuators.items()}
    return assur.Mechanism(**vars(replace(record, machine=replace(record.machine, actuators=actuators))))


def test_what_pulls_back_is_the_curvature_of_the_energies():
    """Second differences of heights less works of constant forces and load; along the paper's y nothing pulls."""
    record = assur.load("zeng2019")
    about = small_motions(record, POSE, load=LOAD)
    held, step = about.answer.forces[0], 0.5

    def energy(pose):
        there = record.forces(pose)
        return there.potential_energy[0] - (held @ record.inverse(pose, "++-++").inputs[0] + np.dot(LOAD, pose)) / 1e3

    for along in np.eye(3)[[0, 2]]:
        values = [energy(np.array(POSE) + sense * step * along) for sense in (-1, 0, 1)]
        curvature = (values[0] - 2 * values[1] + values[2]) / (step / 1e3) ** 2
        assert along @ about.stiffness @ along == pytest.approx(curvature, rel=1e-4)
    np.testing.assert_allclose(about.stiffness, about.stiffness.T, atol=1e-7 * np.abs(about.stiffness).max())
    np.testing.assert_allclose(about.stiffness[1], 0.0, atol=1e-7 * np.abs(about.stiffness).max())


def test_a_small_motion_swings_as_it_is_told():
    """The linear Delta, 0.1 mm off along x; a quarter of a swing later it passes the middle."""
    record = frictionless("linear_delta_4s")
    pose = pose_of(record, record.home_values)
    about = small_motions(record, pose)
    assert (about.stable, len(about.frequencies)) == (True, 2)
    held = about.answer.forces[0]
    off, quarter = pose + np.array([0.1, 0.0, 0.0]), 0.25 / about.frequencies[0]
    moved = record.free_motion(Release(off, np.zeros(3), quarter, lambda _: held, count=2))
    assert moved.poses[:, 0] == pytest.approx([0.1, 0.0], abs=1e-4)


def test_friction_damps_and_a_flat_mechanism_stays():
    record = assur.load("fivebar")
    flat = small_motions(record, [0.0, 224.0])
    assert (flat.stable, flat.frequencies.size) == (True, 0)
    assert np.linalg.eigvalsh(flat.damping)[0] > 0.0
    assert sorted(flat.poles.real) == pytest.approx([*sorted(flat.poles.real)[:2], 0.0, 0.0])


def test_where_there_is_no_equation_there_are_no_numbers():
    record = assur.load("zeng2019")
    about = small_motions(record, [0.0, 0.0, 5000.0])
    assert np.isnan(about.poles).all()
    assert about.frequencies.size == 0


def test_a_quaternion_is_displaced_by_turns_in_the_base_frame():
    record = assur.load("gough_stewart")
    pose = pose_of(record, record.home_values)
    moved = displaced(record, pose, np.diag([0.0, 0.0, 0.1, 0.2, 0.2, 0.2])[[2, 3]])
    assert moved[0, :3] - pose[:3] == pytest.approx([0, 0, 0.1 / record_metre(record)])
    assert np.linalg.norm(moved[:, 3:], axis=1) == pytest.approx([1, 1])
    assert abs(moved[1, 3:] @ pose[3:]) == pytest.approx(np.cos(0.1))


def record_metre(record):
    return {"mm": 1e-3, "m": 1.0}[record.unit]


def test_it_prints_what_it_says():
    about = small_motions(assur.load("zeng2019"), POSE)
    assert str(about) == "small motions of zeng2019: not stable; nothing swings"
    assert isinstance(about.answer.record.machine.actuators["P1"], Actuator)
