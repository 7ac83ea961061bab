"""Calibration: dimensions come back from poses that were made with them, with noise within their deviations."""

import numpy as np
import pytest

import assur
from assur.errors import UnknownNameError, UsageError
from assur.machine.calibration.fit import calibration

TRUE = {"l1": 100.3, "l2": 193.8, "g": 70.1}


@pytest.fixture(scope="module")
def measured():
    """Inputs as they were meant, one of them off by 0.001 rad, and positions of a five-bar with other dimensions."""
    own = assur.load("fivebar", **TRUE)
    random = np.random.default_rng(2)
    poses = np.array([0.0, 224.0]) + random.uniform(-1, 1, size=(14, 2)) * [40, 25]
    inputs = own.inverse(poses, own.modes.default_working).inputs.reshape(14, 2)
    return inputs - [0.001, 0.0], poses, random.normal(size=(14, 2))


def test_a_round_trip_without_noise(measured):
    inputs, poses, _ = measured
    own = calibration(assur.load("fivebar"), inputs, ["x", "y"], poses)
    for name, value in (TRUE | {"theta1": 0.001, "theta2": 0.0}).items():
        assert own.parameters[name] == pytest.approx(value, abs=1e-8)
    assert own.before > 0.1
    assert own.after < 1e-9
    assert (own.held, own.outliers) == ((), ())


def test_noise_stays_within_deviations_and_what_is_far_beside_is_named(measured):
    inputs, poses, noise = measured
    noisy = poses + 0.01 * noise
    noisy[6] += [0.0, 3.0]
    own = calibration(assur.load("fivebar"), inputs, ["x", "y"], noisy)
    assert own.outliers == (7,)
    assert own.after == pytest.approx(0.01, rel=0.3)
    for name, value in TRUE.items():
        assert abs(own.parameters[name] - value) < 4.0 * own.sigma[name]


def test_what_is_held_stays_and_what_is_not_told_is_held(measured):
    inputs, poses, _ = measured
    own = calibration(assur.load("fivebar"), inputs, ["x", "y"], poses, ["g", "theta2"])
    assert own.held == ("g", "theta2")
    assert set(own.parameters) == {"l1", "l2", "theta1"}
    with pytest.raises(UnknownNameError, match="parameter to hold"):
        calibration(assur.load("fivebar"), inputs, ["x", "y"], poses, ["l9"])


def test_too_few_or_impossible_measurements_are_told(measured):
    inputs, poses, _ = measured
    record = assur.load("fivebar")
    with pytest.raises(UsageError, match="4 numbers are measured, 4 are unknown"):
        calibration(record, inputs[:2], ["x", "y"], poses[:2])
    with pytest.raises(UsageError, match="measurement 1: no pose of fivebar at these inputs"):
        calibration(assur.load("fivebar", l2=50), np.array([[3.0, 0.1]] * 8), ["x", "y"], poses[:8])
    with pytest.raises(UnknownNameError, match="measured length"):
        calibration(record, inputs, ["z"], poses[:, :1])
