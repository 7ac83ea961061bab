"""Laws of forces and motion, for every mechanism with masses assigned at random; none knows a printed number."""

import numpy as np
import pytest

from assur.joint_graph.frames import frames
from assur.kinematics.status import Status
from assur.kinematics.validation.check import METRES
from assur.machine.forces.actuator_forces import forces_at
from assur.machine.forces.loads import load_of
from assur.machine.forces.reactions import child_points, reactions
from assur.machine.masses.link_masses import masses
from assur.model.pose import LENGTHS
from weighed import motion_of, moved, place, weighed

STEP = 1e-5
"""Seconds on either side of which quantities are compared: their curves then err by some 1e-9."""
TIMES = 0.01 * np.arange(-4, 5)
NOW = 4
FIRST = np.array([3, -32, 168, -672, 0, 672, -168, 32, -3]) / 840 / 0.01
SECOND = np.array([-9, 128, -1008, 8064, -14350, 8064, -1008, 128, -9]) / 5040 / 0.01**2
"""Derivatives in the middle of nine places to the eighth order."""
WRENCH = [3.0, -4.0, 5.0, 0.6, 0.7, -0.8]


@pytest.fixture
def moving(mechanism):
    """The answer of a mechanism that moves under gravity and a load."""
    record = weighed(mechanism)
    return forces_at(record, place(mechanism), load_of(WRENCH), *motion_of(mechanism))


def test_the_mass_matrix_is_symmetric_and_positive(moving):
    (matrix,) = moving.mass_matrix
    assert moving.status[0] in (Status.regular, Status.near_singular)
    np.testing.assert_allclose(matrix, matrix.T, atol=1e-12 * np.abs(matrix).max())
    assert np.linalg.eigvalsh(matrix)[0] > 0
    velocity, _ = motion_of(moving.record)
    assert moving.kinetic_energy[0] == pytest.approx(0.5 * velocity[0] @ matrix @ velocity[0])


def test_power_is_the_change_of_energy(moving):
    """Energies a moment before and after, by mass matrices and heights there: no acceleration goes into them."""
    record, values = moving.record, moving.values
    velocity, acceleration = (part[0] for part in motion_of(record))
    before, after = (
        forces_at(record, moved(record, values, moving.joint_rates[0], sense * STEP), load_of(None))
        for sense in (-1, 1)
    )
    changing = (after.mass_matrix[0] - before.mass_matrix[0]) / (2 * STEP)
    kinetic = velocity @ moving.mass_matrix[0] @ acceleration + 0.5 * velocity @ changing @ velocity
    potential = (after.potential_energy[0] - before.potential_energy[0]) / (2 * STEP)
    twist = moving.motion.platform[0] @ moving.joint_rates[0]
    load = np.dot(WRENCH[3:], twist[:3]) + np.dot(WRENCH[:3], twist[3:])
    size = abs(kinetic) + abs(potential) + abs(load)
    assert moving.power[0] + load == pytest.approx(kinetic + potential, abs=1e-7 * size)
    assert velocity @ changing @ velocity == pytest.approx(2 * velocity @ moving.bias[0], abs=1e-7 * size)


def test_newton_and_euler_for_every_link_give_the_same(moving):
    passed = reactions(moving)
    size = np.abs(moving.forces).max()
    np.testing.assert_allclose(passed.actuators, moving.forces[0], atol=1e-9 * size)
    assert passed.residual <= 1e-9 * (size + 1.0)
    assert passed.equations == 6 * (len(moving.record.links) - 1)


def test_joints_and_loads_change_the_momentum_of_each_link(moving):
    """Velocities and accelerations of links by differences of their places; a joint passes on what it is given."""
    record, metre = moving.record, METRES[moving.record.unit]
    path = moved(record, moving.values, moving.joint_rates[0], TIMES, moving.joint_accelerations[0])
    placed, gravity = frames(record, path), masses(record).gravity
    points, point = child_points(record, moving.values), moving.motion.point[0]
    passed = {link: np.zeros(6) for link in record.links}
    for joint in reactions(moving).joints:
        wrench = about_base(joint.force, joint.moment, points[joint.joint])
        passed[record.joints[joint.joint].child] += wrench
        passed[record.joints[joint.joint].parent] -= wrench
    passed[record.platform.link] += about_base(WRENCH[:3], WRENCH[3:], point)
    size = max(np.abs(wrench).max() for wrench in passed.values())
    for link, (rotation, origin) in placed.items():
        if link == record.base:
            continue
        data = record.machine.links[link]
        centre = metre * (origin + rotation @ data.centre)
        turned, speeding = (np.tensordot(weights, rotation, 1) @ rotation[NOW].T for weights in (FIRST, SECOND))
        spin, change = (
            0.5 * np.array([m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]]) for m in (turned, speeding)
        )
        inertia = rotation[NOW] @ data.inertia @ rotation[NOW].T
        force = data.mass * (np.tensordot(SECOND, centre, 1) - gravity)
        moment = inertia @ change + np.cross(spin, inertia @ spin)
        np.testing.assert_allclose(passed[link], about_base(force, moment, centre[NOW]), atol=1e-6 * size, err_msg=link)


def about_base(force, moment, point):
    """A wrench (6,) at a point (3,), its moment about the base's origin."""
    return np.concatenate([force, moment + np.cross(point, force)])


@pytest.mark.parametrize("at_rest", [True, False])
def test_the_base_bears_the_weight_the_load_and_what_speeds_up(mechanism, at_rest):
    """At rest that is the weight alone, but for rods whose centres lie beside their axes: nothing holds their spin."""
    record = weighed(mechanism)
    motion = (None, None) if at_rest else motion_of(mechanism)
    answer = forces_at(record, place(mechanism), load_of(WRENCH), *motion)
    inertia, gravity = answer.motion.inertia, masses(record).gravity
    force, moment = (part[0] for part in inertia.wrenches(answer.joint_rates, answer.joint_accelerations))
    if at_rest and not answer.unbalanced[0]:
        assert np.abs(force).max() <= 1e-9
    left = inertia.masses[:, None] * gravity - force
    arms = np.cross(inertia.centres[0], left).sum(axis=0) - moment.sum(axis=0)
    point = answer.motion.point[0]
    passed = reactions(answer).base
    expected = np.concatenate([left.sum(axis=0) + WRENCH[:3], arms + np.cross(point, WRENCH[:3]) + WRENCH[3:]])
    np.testing.assert_allclose(passed, expected, atol=1e-9 * np.abs(expected).max())


def test_masses_and_rotors_doubled_double_the_forces(mechanism):
    once, twice = (
        forces_at(weighed(mechanism, factor), place(mechanism), load_of(None), *motion_of(mechanism))
        for factor in (1.0, 2.0)
    )
    np.testing.assert_allclose(twice.forces, 2 * once.forces, rtol=1e-9)


def test_a_load_alone_is_held_by_the_transposed_jacobian(mechanism):
    """Statics by the velocity map, which knows neither wrenches nor links."""
    names = [name for name in LENGTHS if name in mechanism.platform.pose]
    force = np.array([WRENCH[LENGTHS.index(name)] if name in names else 0.0 for name in LENGTHS])
    answer = forces_at(mechanism, place(mechanism), load_of(force, gravity=False))
    rows = [mechanism.platform.pose.index(name) for name in names]
    metre = METRES[mechanism.unit]
    driven = np.array([metre if item.coordinate.kind == "length" else 1.0 for item in mechanism.inputs])
    jacobian = mechanism.velocity_map_at(place(mechanism)[0]).matrix[rows] * metre / driven
    expected = -jacobian.T @ force[[LENGTHS.index(name) for name in names]]
    np.testing.assert_allclose(answer.forces[0], expected, atol=1e-7 * np.abs(expected).max())
