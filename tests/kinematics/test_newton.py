"""Newton's method as one recorded step: the same assemblies as damped least squares, and honest where there is none."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

import assur
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closure import assemble, closing_system, closure_error
from assur.kinematics.newton import ENOUGH, Newton, targets
from assur.kinematics.newton_step import NewtonStep
from assur.kinematics.pose import pose_error, pose_of
from assur.model.registry import load_record
from catalogue import each

EVERY_TYPE = Path(__file__).parent / "rates" / "every_type.toml"
POSES = [("x", "y", "z"), ("z", "theta", "psi"), ("y", "phi"), ("psi", "x", "phi", "theta"), ("qw", "qx", "qy", "qz")]


def units(mechanism):
    length = characteristic_length(mechanism)
    return np.array([length if item.kind == "length" else 1.0 for item in mechanism.coordinates])


def starts(mechanism, count=40, away=0.04, push=0.01):
    """Assemblies around home, with their inputs pushed a little."""
    rng, held = np.random.default_rng(1), list(mechanism.input_indices)
    around = mechanism.home_values + rng.uniform(-away, away, (count, len(mechanism.coordinates))) * units(mechanism)
    closed = assemble(mechanism, around, held=held)
    start = closed.values[closed.closed]
    start[:, held] += rng.uniform(-push, push, (len(start), len(held))) * units(mechanism)[held]
    return start


@pytest.mark.parametrize("name", each())
def test_neighbouring_starts_close_as_by_least_squares(name):
    mechanism = assur.load(name)
    held, length = mechanism.input_indices, characteristic_length(mechanism)
    start = starts(mechanism)
    found = Newton(mechanism, NewtonStep(held))(start)
    values = found.values
    expected = assemble(mechanism, start, held=held, near=True)
    assert len(start) > 30
    closed = found.residual <= ENOUGH
    assert np.mean(closed[expected.closed]) > 0.97
    assert not np.any(closed[~expected.closed])
    np.testing.assert_array_equal(values[:, list(held)], start[:, list(held)])
    assert np.all(closure_error(mechanism, values[closed]) <= 2 * ENOUGH * length)
    both = closed & expected.closed
    one, other = (pose_of(mechanism, part[both]) for part in (values, expected.values))
    np.testing.assert_allclose(one, other, rtol=0, atol=1e-9 * max(length, 1.0))


@pytest.mark.parametrize("name", each())
def test_at_given_poses_the_platform_is_there(name):
    mechanism = assur.load(name)
    length = characteristic_length(mechanism)
    poses = pose_of(mechanism, starts(mechanism))
    begun = np.repeat(mechanism.home_values[None], len(poses), axis=0)
    found = Newton(mechanism, NewtonStep((), mechanism.platform.pose))(begun, poses)
    values, closed = found.values, found.residual <= ENOUGH
    assert np.mean(closed) > 0.7
    assert np.max(closure_error(mechanism, values[closed])) <= 2 * ENOUGH * length
    assert np.max(np.abs(pose_error(mechanism, values[closed], poses[closed], length))) <= 1e-10 * length


@pytest.mark.parametrize("pose", POSES, ids="-".join)
def test_every_kind_of_pose_and_of_joint(pose):
    """Screws and balls among them, in one loop: where the platform is asked for, it is."""
    original = load_record(EVERY_TYPE)
    record = dataclasses.replace(original, platform=dataclasses.replace(original.platform, pose=pose))
    rng, home = np.random.default_rng(2), np.array(record.home)
    around = assemble(record, home + 0.1 * rng.normal(size=(30, len(home))) * units(record))
    there = around.values[around.closed]
    assert len(there) > 20
    poses = pose_of(record, there)
    begun = there + 1e-3 * rng.normal(size=there.shape) * units(record)
    found = Newton(record, NewtonStep((), pose))(begun, poses)
    values, closed, length = found.values, found.residual <= ENOUGH, characteristic_length(record)
    assert np.mean(closed) > 0.9
    assert np.max(closure_error(record, values[closed])) <= 2 * ENOUGH * length
    assert np.max(np.abs(pose_error(record, values[closed], poses[closed], length))) < 1e-10 * length


def test_the_step_is_the_least_one_of_the_closing_system():
    """From an assembly that is pushed a little, against singular values of a derivative that is written elsewhere."""
    mechanism = assur.load("zeng2019")
    start = starts(mechanism, push=1e-4)
    program = Newton(mechanism, NewtonStep(mechanism.input_indices)).program
    changes = program.matrix("change", program(mechanism, start), (start.shape[1], 1))[:, :, 0]
    columns = np.setdiff1d(range(start.shape[1]), mechanism.input_indices)
    gaps, derivative = closing_system(mechanism, start, None)
    scaled = derivative[:, :, columns] * units(mechanism)[columns]
    for k in range(len(start)):
        expected = np.linalg.lstsq(scaled[k], -gaps[k], rcond=1e-8)[0]
        np.testing.assert_allclose(changes[k, columns], expected, atol=1e-6 * np.abs(expected).max())


def test_starts_that_are_far_do_not_count_as_closed():
    mechanism = assur.load("fivebar")
    far = np.array([[0.0, 0.1, np.pi, 0.1, 0.0]])
    gaps = Newton(mechanism, NewtonStep((0, 3)))(np.repeat(far, 3, axis=0)).residual
    assert not np.any(gaps <= ENOUGH)


def test_an_empty_batch():
    mechanism = assur.load("fivebar")
    found = Newton(mechanism, NewtonStep(mechanism.input_indices))(np.empty((0, 5)))
    assert (found.values.shape, found.residual.shape, found.steps) == ((0, 5), (0,), 0)


def test_numbers_of_poses_are_those_of_the_platform():
    mechanism = assur.load("gough_stewart")
    poses = pose_of(mechanism, mechanism.home_values)[None]
    numbers = targets(mechanism, poses)
    np.testing.assert_allclose(numbers[:9].reshape(3, 3) @ numbers[:9].reshape(3, 3).T, np.eye(3), atol=1e-12)
