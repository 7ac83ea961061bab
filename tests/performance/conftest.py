"""Regular poses of every registered mechanism, and its Jacobian from differences of the inverse solution alone."""

import numpy as np
import pytest

from assur.kinematics.status import Status
from assur.model.pose import QUATERNION, rate_names
from assur.numerics import rotations

STEP = 1e-4


def _regular_poses(mechanism, mode, wanted=100, seed=8):
    """Up to `wanted` poses spread over the file's box at which the mode is regular; fewer only where it reaches few."""
    rng = np.random.default_rng(seed)
    box = np.array([mechanism.box[name] for name in mechanism.platform.pose])
    found = np.zeros((0, len(box)))
    for _ in range(60):
        poses = rng.uniform(box[:, 0], box[:, 1], size=(200, len(box)))
        if QUATERNION[0] in mechanism.platform.pose:
            columns = [mechanism.platform.pose.index(name) for name in QUATERNION]
            poses[:, columns] /= np.linalg.norm(poses[:, columns], axis=-1, keepdims=True)
        fine = mechanism.inverse(poses, mode=mode).status[:, 0] == Status.regular
        found = np.concatenate([found, poses[fine]])
        if len(found) >= wanted:
            break
    return found[:wanted]


def _moved(mechanism, poses, step):
    """Poses (N, 2, k, m): each moved by +-step of every rate in turn; turns of a quaternion about the base's axes."""
    names = mechanism.platform.pose
    found = np.broadcast_to(poses[:, None, None], (len(poses), 2, len(rate_names(names)), poses.shape[-1])).copy()
    for row, name in enumerate(rate_names(names)):
        for side, sign in enumerate((1.0, -1.0)):
            if name in names:
                found[:, side, row, names.index(name)] += sign * step
                continue
            axis = np.eye(3)[("wx", "wy", "wz").index(name)]
            columns = [names.index(part) for part in QUATERNION]
            turn = rotations.from_vector(sign * step * axis) @ rotations.from_quaternion(poses[:, columns])
            found[:, side, row, columns] = rotations.to_quaternion(turn)
    return found


def _slopes(mechanism, poses, mode, step=STEP):
    """dq/dx (N, F, k) by central differences of the inverse solution; NaN where a neighbour is out of reach."""
    inputs = mechanism.inverse(_moved(mechanism, poses, step), mode=mode).inputs[..., 0, :]
    return np.swapaxes(inputs[:, 0] - inputs[:, 1], -1, -2) / (2 * step)


@pytest.fixture(scope="session")
def regular_poses():
    """The function `regular_poses(mechanism, mode, wanted, seed)`."""
    return _regular_poses


@pytest.fixture(scope="session")
def slopes():
    """The function `slopes(mechanism, poses, mode, step)`."""
    return _slopes
