"""Coordinates of the platform on the spanning tree: rates against differences, errors against the coordinates."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closure import assemble
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_error, pose_of, pose_rates
from assur.model.pose import QUATERNION, rate_names
from assur.model.registry import load_record
from assur.numerics import rotations

DELTA = Path(__file__).parents[1] / "model" / "file" / "delta.toml"
POSES = [
    ("x", "y", "z"),
    ("z", "theta", "psi"),
    ("y", "phi"),
    ("psi", "x", "phi", "theta"),
    ("x", "y", "z", *QUATERNION),
    (*QUATERNION, "z"),
]


@pytest.fixture(params=POSES, ids="-".join)
def record(request):
    """A mechanism whose pose is told in other coordinates; no loop is closed here."""
    original = load_record(DELTA)
    return dataclasses.replace(original, platform=dataclasses.replace(original.platform, pose=request.param))


def values_of(record, count=6):
    return np.random.default_rng(2).uniform(-1.2, 1.2, size=(count, len(record.coordinates)))


def test_rates_are_the_derivatives_of_the_coordinates(record):
    rng = np.random.default_rng(3)
    for values in values_of(record):
        direction, step = rng.normal(size=len(values)), 1e-6
        rates = pose_rates(record, values) @ direction
        ahead, behind = (pose_of(record, values + side * step * direction) for side in (1, -1))
        change = dict(zip(record.platform.pose, (ahead - behind) / (2 * step), strict=True))
        found = dict(zip(rate_names(record.platform.pose), rates, strict=True))
        for name in set(change) & set(found):
            assert found[name] == pytest.approx(change[name], rel=1e-6, abs=1e-6)
        if "wx" in found:
            turns = [rotations.from_quaternion(dict_of(record, pose)) for pose in (ahead, behind)]
            angular = rotations.to_vector(turns[0] @ turns[1].T) / (2 * step)
            assert [found[name] for name in ("wx", "wy", "wz")] == pytest.approx(angular, rel=1e-5, abs=1e-5)


def dict_of(record, pose):
    return np.array([pose[record.platform.pose.index(name)] for name in QUATERNION])


def test_the_error_of_the_own_pose_is_zero_and_of_another_one_is_not(record):
    values = values_of(record)
    length = characteristic_length(record)

    own = pose_of(record, values)
    assert np.max(np.abs(pose_error(record, values, own, length))) < 1e-12 * length
    other = own[::-1]
    assert np.all(np.max(np.abs(pose_error(record, values, other, length)), axis=-1) > 1e-3)


def test_an_error_does_not_see_whole_turns_nor_the_sign_of_a_quaternion(record):
    values = values_of(record)
    own = pose_of(record, values)
    same = np.array(own)
    for k, name in enumerate(record.platform.pose):
        if name in QUATERNION:
            same[:, k] *= -1.0
        elif name in ("phi", "theta", "psi"):
            same[:, k] += 2 * np.pi
    assert np.max(np.abs(pose_error(record, values, same, 1.0))) < 1e-12


def test_the_inverse_problem_is_solved_by_least_squares_too():
    record = load_record("zeng2019")
    target = np.array([[-15.4714, 9.6849, 456.3315], [10.0, -20.0, 430.0]])
    found = assemble(record, np.broadcast_to(home_values(record), (2, 17)), poses=target)
    assert np.all(found.closed)
    assert pose_of(record, found.values) == pytest.approx(target, abs=1e-9)


def test_a_pose_out_of_reach_is_not_called_closed():
    record = load_record("zeng2019")
    found = assemble(record, home_values(record), poses=np.array([0.0, 0.0, 5000.0]))
    assert not found.closed
    assert found.residual > 1000.0
