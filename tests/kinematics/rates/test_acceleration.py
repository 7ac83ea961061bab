"""Acceleration on the joint graph: against dual numbers through closed forms, and against second differences."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

import assur
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.border import held_inputs, inputs_of
from assur.kinematics.closure import assemble
from assur.kinematics.pose import pose_of
from assur.kinematics.rates.acceleration import acceleration_at
from assur.model.pose import LENGTHS
from assur.numerics import rotations
from dual_acceleration import dual_acceleration

HERE = Path(__file__).parent
DELTA = HERE.parents[1] / "model" / "file" / "delta.toml"
HEXAPOD = HERE / "hexapod.toml"
STEP = 2e-3


@pytest.mark.parametrize(("name", "mode"), [("fivebar", "-+"), ("zeng2019", "++-++"), ("zeng2019", "++-+-")])
def test_it_is_that_of_the_closed_form(name, mode):
    mechanism = assur.load(name)
    low, high = np.array([mechanism.box[item] for item in mechanism.platform.pose]).T
    rng = np.random.default_rng(0)
    poses = rng.uniform(low, high, (60, len(low)))
    found = mechanism.inverse(poses, mode)
    regular = (found.exists & (found.status == 0))[:, 0]
    assert np.sum(regular) > 10
    rates, second = rng.normal(size=(2, int(np.sum(regular)), len(mechanism.inputs)))
    velocity, acceleration = dual_acceleration(mechanism, poses[regular], rates, second, mode)
    there = acceleration_at(mechanism, found.joints[regular, 0], rates, second)
    np.testing.assert_allclose(there[0], velocity, atol=1e-7 * np.abs(velocity).max())
    np.testing.assert_allclose(there[1], acceleration, atol=1e-7 * np.abs(acceleration).max())


def _path(mechanism, rates, second):
    """Assemblies at five moments along inputs that accelerate evenly, from home."""
    home = mechanism.home_values
    moments = STEP * np.arange(-2, 3)[:, None]
    inputs = inputs_of(mechanism, home) + moments * rates + moments**2 / 2 * second
    found = assemble(mechanism, held_inputs(mechanism, home, inputs), held=mechanism.input_indices, tolerance=1e-15)
    assert np.all(found.closed)
    return home, found.values


def _second(path):
    """Second derivative in the middle of five samples, exact to the fourth order."""
    return np.tensordot([-1, 16, -30, 16, -1], path, 1) / (12 * STEP**2)


def _first(path):
    return np.tensordot([1, -8, 0, 8, -1], path, 1) / (12 * STEP)


@pytest.mark.parametrize(
    ("file", "pose"),
    [
        (DELTA, '["x", "y", "z"]'),
        (HEXAPOD, '["x", "y", "z", "phi", "theta", "psi"]'),
        (HEXAPOD, '["psi", "z", "x", "phi", "theta", "y"]'),
    ],
)
def test_coordinates_agree_with_differences(file, pose, tmp_path):
    text = file.read_text().replace('["x", "y", "z", "qw", "qx", "qy", "qz"]', pose)
    (tmp_path / "changed.toml").write_text(text)
    mechanism = assur.load(tmp_path / "changed.toml")
    rng = np.random.default_rng(2)
    units = [
        characteristic_length(mechanism) / 3 if item.coordinate.kind == "length" else 1 for item in mechanism.inputs
    ]
    rates, second = rng.normal(size=(2, len(mechanism.inputs))) * units
    home, values = _path(mechanism, rates, second)
    poses = pose_of(mechanism, values)
    velocity, acceleration = acceleration_at(mechanism, home, rates, second)
    scale = np.where([name in LENGTHS for name in mechanism.platform.pose], characteristic_length(mechanism), 1.0)
    np.testing.assert_allclose(velocity / scale, _first(poses) / scale, atol=1e-7)
    np.testing.assert_allclose(acceleration / scale, _second(poses) / scale, atol=2e-6)
    assert np.abs(acceleration / scale).min() > 1e-3, "every coordinate must accelerate for this to mean anything"


def test_quaternions_have_angular_velocity_and_acceleration():
    """Against differences of the rotation vector from the middle of the path."""
    mechanism = assur.load(HEXAPOD)
    rates, second = np.random.default_rng(3).normal(size=(2, 6)) * 60.0
    home, values = _path(mechanism, rates, second)
    rotation = mechanism.frames(values)["platform"][0]
    turns = rotations.to_vector(rotation @ rotation[2].T)
    velocity, acceleration = acceleration_at(mechanism, home, rates, second)
    np.testing.assert_allclose(velocity[3:], _first(turns), atol=1e-7)
    # of a rotation vector v from the identity: w = v' + v x v' / 2 + ..., so w' = v'' where v = 0
    np.testing.assert_allclose(acceleration[3:], _second(turns), atol=2e-6)
    assert np.linalg.norm(acceleration[3:]) > 0.05


def test_it_is_known_at_a_serial_singularity_and_not_at_a_parallel_one():
    paper = assur.load("zeng2019")
    serial = paper.inverse([80.0, -74.3479, 237.9038], "++-++").joints[0]  # sin(alpha) = 0
    parallel = paper.inverse([-15.4714, 9.6849, 456.3315], "+++++").joints[0]  # self-motion
    for numbers in acceleration_at(paper, np.array([serial, parallel]), [1.0, 2.0, 3.0], [0.0, 0.0, 0.0]):
        assert np.all(np.isfinite(numbers[0]))
        assert np.all(np.isnan(numbers[1]))


def test_without_a_closed_form_home_s_mode_is_followed_to_the_pose():
    bare = dataclasses.replace(assur.load("fivebar"), closed_form=None)
    with_form = assur.load("fivebar")
    poses = [[0.0, 224.0], [10.0, 230.0], [0.0, 5000.0]]
    found = bare.acceleration(poses, [1.0, 2.0], [0.5, -1.0])
    for numbers, same in zip(found, with_form.acceleration(poses, [1.0, 2.0], [0.5, -1.0], "-+"), strict=True):
        assert np.isnan(numbers).tolist() == [[False, False], [False, False], [True, True]]
        np.testing.assert_allclose(numbers, same, rtol=1e-6)


def test_wrong_shapes_are_refused():
    fivebar = assur.load("fivebar")
    with pytest.raises(assur.UsageError, match="joint values of fivebar: 3 values, 5 wanted"):
        acceleration_at(fivebar, [0.0, 0.0, 0.0], [0.0, 0.0], [0.0, 0.0])
    with pytest.raises(assur.UsageError, match="input rates of fivebar: 1 values, 2 wanted"):
        acceleration_at(fivebar, fivebar.home_values, [0.0], [0.0, 0.0])
