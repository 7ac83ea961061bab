"""Every registered mechanism, and regular configurations of it, for laws that hold for all of them.

Those whose closed form is derived are there once more, with the derived file in the place of the written one.
"""

import shutil
from functools import lru_cache
from pathlib import Path
from tempfile import mkdtemp

import numpy as np
import pytest

import assur
from assur.derivation.kept import derived_closed_form
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics import border
from assur.kinematics.modes import all_modes
from assur.kinematics.status import Status
from assur.model.pose import QUATERNION, has_quaternion, is_angle
from assur.numerics import rotations
from assur.singularity.examples import singular_examples as find_singular_examples

DERIVED = ("zeng2019", "fivebar", "delta_4s", "linear_delta_4s", "linear_delta_4r", "orthoglide", "tsai_platform",
           "three_p2us", "three_crr", "tripteron", "planar_3rpr", "planar_3rrr", "three_rrc", "h4_robot",
           "three_rps")  # fmt: skip
"""That of the 3-RPR has legs of either sign, and so more branches than the written one."""
REPLACED = [pytest.param(f"{name}, derived", marks=pytest.mark.deep) for name in DERIVED]


@pytest.fixture(params=[*assur.names(), *REPLACED])
def mechanism(request):
    return _loaded(request.param)


@lru_cache
def _loaded(name):
    plain, _, derived = name.partition(", ")
    return assur.load(_replaced(plain) if derived else plain)


def _replaced(name):
    """The mechanism's folder with its derived closed form."""
    written = assur.load(name)
    folder = Path(mkdtemp()) / name
    shutil.copytree(written.file.parent, folder)
    (folder / "closed_form.py").write_text(derived_closed_form(written), encoding="utf-8")
    return folder


@pytest.fixture
def poses(request, mechanism):
    """Poses (60, m) from the mechanism's workspace box."""
    return _poses(request.node.callspec.params["mechanism"])


@lru_cache
def _poses(name):
    mechanism = _loaded(name)
    low, high = np.array([mechanism.box[coordinate] for coordinate in mechanism.platform.pose]).T
    drawn = border.checked_poses(mechanism, np.random.default_rng(1).uniform(low, high, size=(60, len(low))))
    drawn.setflags(write=False)
    return drawn


@pytest.fixture
def regular(request, mechanism):
    """Regular solutions over all working modes: (pose, mode text, inputs, joint values)."""
    return _regular(request.node.callspec.params["mechanism"])


@lru_cache
def _regular(name):
    mechanism, poses = _loaded(name), _poses(name)
    found = mechanism.inverse(poses)
    rows, branches = np.nonzero(found.exists & (found.status == Status.regular))
    assert len(rows) > 20, "the box of the file holds too few regular poses"
    modes = [all_modes(mechanism, "inverse")[k] for k in branches]
    return tuple(zip(poses[rows], modes, found.inputs[rows, branches], found.joints[rows, branches], strict=True))


@pytest.fixture
def singular_examples(request, mechanism):
    return _examples(request.node.callspec.params["mechanism"])


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
