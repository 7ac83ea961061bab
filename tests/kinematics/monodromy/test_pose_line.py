"""Conditions of a pose on a complex line: zero where the platform stands so, and their derivatives are differences."""

import numpy as np
import pytest

from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.state import state_of
from assur.kinematics.home import home_values
from assur.kinematics.monodromy.pose_line import PoseLine
from assur.kinematics.pose import pose_of
from assur.model.registry import load_record

ZERO = np.zeros(1, dtype=complex)


@pytest.fixture(params=["planar_3rrr", "three_rps", "h4_robot"])
def line(request):
    record = load_record(request.param)
    rng = np.random.default_rng(4)
    count = len(record.platform.pose)
    return PoseLine(record, pose_of(record, home_values(record)), rng.normal(size=count) + 1j * rng.normal(size=count))


def state_at(line, values):
    return state_of(line.record, values[:, None]).astype(complex)


def test_home_stands_as_home(line):
    gaps, _, _ = line.conditions(state_at(line, home_values(line.record)), ZERO)
    assert np.max(np.abs(gaps)) < 1e-9


def test_another_pose_does_not(line):
    gaps, _, _ = line.conditions(state_at(line, home_values(line.record)), ZERO + 0.3)
    assert np.min(np.abs(gaps)) > 1e-3


def test_derivatives_are_differences(line):
    home, step = home_values(line.record), 1e-6
    far = home + 0.1 * np.random.default_rng(0).normal(size=len(home))
    gaps, slopes, rates = line.conditions(state_at(line, far), ZERO + 0.2)
    later = line.conditions(state_at(line, far), ZERO + 0.2 + step)[0]
    assert np.allclose((later - gaps) / step, rates, rtol=1e-4, atol=1e-5)
    for item in line.record.coordinates:
        if line.record.joints[item.joint].type.ball:
            continue  # whose rates are angular velocities, not those of its rotation vector
        moved = far.copy()
        moved[item.index] += step
        change = (line.conditions(state_at(line, moved), ZERO + 0.2)[0] - gaps)[0] / step
        assert np.allclose(change, slopes[0, :, item.index], rtol=1e-4, atol=1e-4)


def test_lengths_count_in_characteristic_lengths():
    record = load_record("fivebar")
    pose = pose_of(record, home_values(record))
    line = PoseLine(record, pose, np.ones(len(pose), dtype=complex))
    gaps, _, rates = line.conditions(state_of(record, home_values(record)[:, None]).astype(complex), ZERO + 0.5)
    assert np.allclose(gaps, -0.5, rtol=0, atol=1e-9)
    assert np.allclose(rates, -1.0, rtol=0, atol=1e-12)
    assert characteristic_length(record) > 1.0
