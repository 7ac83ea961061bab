"""Every registered mechanism, and regular configurations of it, for laws that hold for all of them."""

from functools import lru_cache

import numpy as np
import pytest

import assur
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics import border
from assur.kinematics.modes import all_modes
from assur.kinematics.status import Status
from assur.model.pose import QUATERNION, has_quaternion, is_angle
from assur.numerics import rotations
from assur.singularity.examples import singular_examples as find_singular_examples


@pytest.fixture(params=assur.names())
def mechanism(request):
    return _loaded(request.param)


@lru_cache
def _loaded(name):
    return assur.load(name)


@pytest.fixture
def poses(mechanism):
    """Poses (60, m) from the mechanism's workspace box."""
    low, high = np.array([mechanism.box[name] for name in mechanism.platform.pose]).T
    return border.checked_poses(mechanism, np.random.default_rng(1).uniform(low, high, size=(60, len(low))))


@pytest.fixture
def regular(mechanism, poses):
    """Regular solutions over all working modes: (pose, mode text, inputs, joint values)."""
    found = mechanism.inverse(poses)
    rows, branches = np.nonzero(found.exists & (found.status == Status.regular))
    assert len(rows) > 20, "the box of the file holds too few regular poses"
    modes = [all_modes(mechanism, "inverse")[k] for k in branches]
    return list(zip(poses[rows], modes, found.inputs[rows, branches], found.joints[rows, branches], strict=True))


@pytest.fixture
def singular_examples(mechanism):
    return _examples(mechanism.name)


@lru_cache
def _examples(name):
    return find_singular_examples(_loaded(name))


@pytest.fixture
def units(mechanism):
    """Size (k,) of each rate of the pose: the characteristic length for lengths, 1 for turns."""
    kept = [name for name in mechanism.platform.pose if name not in QUATERNION]
    turns = [1.0] * 3 if has_quaternion(mechanism.platform.pose) else []
    return np.array([1.0 if is_angle(name) else characteristic_length(mechanism) for name in kept] + turns)


@pytest.fixture
def apart(mechanism):
    """Distance (...) of poses (..., m), in length units: q and -q are one rotation, angles a turn apart one angle."""
    length = characteristic_length(mechanism)
    pose = mechanism.platform.pose

    def measured(first, second):
        gaps = []
        for k, name in enumerate(pose):
            gap = np.abs(first[..., k] - second[..., k])
            if is_angle(name):
                gap = length * np.abs((gap + np.pi) % (2 * np.pi) - np.pi)
            if name not in QUATERNION:
                gaps.append(gap)
        if has_quaternion(pose):
            columns = [pose.index(name) for name in QUATERNION]
            first, second = first[..., columns], second[..., columns]
            nearer = [np.max(np.abs(first - side * second), axis=-1) for side in (1.0, -1.0)]
            gaps.append(2 * length * np.min(nearer, axis=0))
        return np.max(gaps, axis=0)

    return measured


@pytest.fixture
def moved(mechanism):
    """The pose that is reached from a pose (m,) by a small displacement (k,) in the directions of its rates."""
    pose = mechanism.platform.pose

    def result(start, step):
        answer = np.array(start)
        kept = [k for k, name in enumerate(pose) if name not in QUATERNION]
        answer[kept] += step[: len(kept)]
        if has_quaternion(pose):
            columns = [pose.index(name) for name in QUATERNION]
            turned = rotations.from_vector(step[len(kept) :]) @ rotations.from_quaternion(answer[columns])
            answer[columns] = rotations.to_quaternion(turned)
        return answer

    return result
