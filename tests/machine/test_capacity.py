"""Capacity: by trying, and by hand where motors act along the axes."""

from dataclasses import replace

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.machine.capacity import capacity
from assur.model.machine_data import Actuator, Gravity, MachineData

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
