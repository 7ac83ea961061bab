"""Capacity: by trying, and by hand where motors act along the axes."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import linprog

import assur
from assur.errors import UsageError
from assur.kinematics.pose import pose_of
from assur.kinematics.rates.acceleration import reached_in_mode
from assur.machine.forces.capacity import capacity, held_forces
from assur.model.machine_data import Actuator, Gravity, MachineData
from own_machines import own_machine
from weighed import weighed

POSE = [-15.4714, 9.6849, 456.3315]


def limited(name, force, **changes):
    record = assur.load(name)
    labels = [record.coordinate_label(item.coordinate) for item in record.drives]
    machine = replace(record.machine, actuators=dict.fromkeys(labels, Actuator(force=force)), **changes)
    return replace(record, machine=machine)


@pytest.fixture(scope="module")
def zeng():
    return limited("zeng2019", 60.0)


def test_motors_along_the_axes_hold_a_cube_of_forces():
    held = capacity(limited("orthoglide", 50.0, gravity=Gravity(value=0.0)), [0, 0, 0])
    np.testing.assert_allclose(held.per_axis, [[50, 50]] * 3)
    assert held.sphere == pytest.approx(50)
    assert sorted(map(tuple, np.sign(held.vertices))) == sorted(
        (a, b, c) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)
    )
    np.testing.assert_allclose(np.abs(held.vertices), 50)


def test_what_is_held_is_just_held(zeng):
    """At every corner, and at the end of every axis, some motor is at its limit and none beyond it."""
    held = capacity(zeng, POSE)
    ends = [sense * size * np.eye(3)[axis] for axis, pair in enumerate(held.per_axis)
            for sense, size in zip((-1, 1), pair, strict=True)]  # fmt: skip
    for force in (*held.vertices, *ends):
        share = np.abs(zeng.forces(POSE, load=force).forces[0]) / 60
        assert share.max() == pytest.approx(1.0)
    away = np.random.default_rng(0).normal(size=(50, 3))
    away *= held.sphere / np.linalg.norm(away, axis=1, keepdims=True)
    shares = [np.abs(zeng.forces(POSE, load=force).forces[0]).max() / 60 for force in away]
    assert max(shares) <= 1.0 + 1e-9
    assert held.limiting in ("yA1", "yA2", "yA3")


@pytest.mark.deep
def test_with_more_drives_than_freedoms_preload_helps():
    """How far a force goes along random directions, by linear programmes over the forces of all drives."""
    own = weighed(own_machine("two_upr_two_rpu"))
    labels = [own.coordinate_label(item.coordinate) for item in own.drives]
    limits = np.array([100.0, 150.0, 120.0, 80.0])
    actuators = {label: Actuator(force=limit) for label, limit in zip(labels, limits, strict=True)}
    record = replace(own, machine=replace(own.machine, actuators=actuators))
    pose = pose_of(record, record.home_values)
    held = capacity(record, pose)
    own_forces = held.answer.forces[0]
    asked = np.array([record.forces(pose, load=push, gravity=False).forces[0] for push in np.eye(3)]).T
    preload = held.answer.preload[0]
    assert preload.shape == (4, 1)

    def reach(direction):
        """The largest size of a force in a direction: |own + size asked direction + preload s| <= limits."""
        columns = np.column_stack([asked @ direction, preload])
        answer = linprog(
            [-1.0, 0.0],
            A_ub=np.concatenate([columns, -columns]),
            b_ub=np.concatenate([limits - own_forces, limits + own_forces]),
            bounds=[(0, None), (None, None)],
        )
        return answer.x[0]

    faces = held_forces(record, *reached_in_mode(record, pose[None])).faces[0]
    np.testing.assert_allclose([[reach(-axis), reach(axis)] for axis in np.eye(3)], held.per_axis, rtol=1e-7)
    near = faces / np.linalg.norm(faces, axis=1, keepdims=True)
    assert min(reach(direction) for direction in near) == pytest.approx(held.sphere)
    for corner in held.vertices:
        assert reach(corner / np.linalg.norm(corner)) == pytest.approx(np.linalg.norm(corner))
    least = np.abs(own_forces[:, None] + asked @ (held.vertices.T)).max(axis=0) / limits.min()
    assert held.limiting == ""
    assert least.max() > 1.0  # with forces of least norm alone, less would be held


def test_gravity_that_is_too_much_leaves_nothing():
    held = capacity(limited("zeng2019", 1.0), POSE)
    assert (held.sphere, held.per_axis.any(), len(held.vertices)) == (0.0, False, 0)
    assert held.utilisation.max() > 1


def test_a_motor_without_a_limit_is_told():
    record = assur.load("zeng2019")
    bare = replace(record, machine=replace(record.machine, actuators={}))
    with pytest.raises(UsageError, match="no largest force of P1, P2, P3"):
        capacity(bare, POSE)
    assert isinstance(bare.machine, MachineData)
