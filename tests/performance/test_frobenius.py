"""The smooth condition index: its value from singular values, its gradient from differences, its place beside c."""

import dataclasses

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.model.pose import LENGTHS, QUATERNION, rate_names
from assur.numerics import rotations
from assur.performance.frobenius import smooth_condition
from assur.performance.indices import indices
from catalogue import each

NAMES = each()
SAME_EVERYWHERE = {"tripteron", "three_crr"}
"""Each input moves the platform along a direction of its own: J is the same everywhere."""


@pytest.mark.parametrize("name", NAMES)
def test_the_value_is_the_index_and_bounds_that_of_the_2_norm(name, regular_poses):
    mechanism = assur.load(name)
    mode = mechanism.modes.default_working
    poses = regular_poses(mechanism, mode, 40)
    found = smooth_condition(mechanism, poses, mode)
    beside = indices(mechanism, poses, mode)
    np.testing.assert_allclose(found.value, beside["frobenius"], rtol=1e-8)
    c, r = beside["condition"], beside.velocity_factors.shape[-1]
    assert np.all(found.value >= c * (1 - 1e-9))
    assert np.all(found.value <= r / (r - 2 + c + 1 / c) * (1 + 1e-9))
    assert found.length == beside.length


@pytest.mark.parametrize("name", NAMES)
def test_the_gradient_is_that_of_differences(name, regular_poses):
    mechanism = assur.load(name)
    columns, step = mechanism.platform.pose, 1e-5
    poses = regular_poses(mechanism, mechanism.modes.default_working, 40)
    found = smooth_condition(mechanism, poses)
    size = np.array([characteristic_length(mechanism) if item in LENGTHS else 1.0 for item in rate_names(columns)])
    near = np.full(found.gradient.shape, np.nan)
    for k, rate in enumerate(rate_names(columns)):
        ends = [
            smooth_condition(mechanism, _moved(columns, poses, rate, sign * step * size[k]), None, found.length).value
            for sign in (1.0, -1.0)
        ]
        near[:, k] = (ends[0] - ends[1]) / (2 * step * size[k])
    fine = np.all(np.isfinite(near), axis=-1) & (found.value > 0.02)
    assert fine.sum() >= 5
    gaps = np.max(np.abs(found.gradient - near) * size, axis=-1)[fine]
    sizes = np.max(np.abs(near) * size, axis=-1)[fine]
    assert np.median(gaps / (1e-3 + sizes)) < 1e-6
    assert np.max(gaps / (1e-3 + sizes)) < 1e-2  # near a border the difference itself is poor
    assert (np.max(sizes) > 1e-3) == (name not in SAME_EVERYWHERE)


def _moved(columns, poses, rate, step):
    """Poses (N, m) moved by a step of one rate; turns of a quaternion about the base's axes."""
    moved = poses.copy()
    if rate in columns:
        moved[:, columns.index(rate)] += step
        return moved
    places = [columns.index(name) for name in QUATERNION]
    axis = np.eye(3)[("wx", "wy", "wz").index(rate)]
    turned = rotations.from_vector(step * axis) @ rotations.from_quaternion(poses[:, places])
    moved[:, places] = rotations.to_quaternion(turned)
    return moved


def test_at_isotropy_it_is_smooth_where_the_2_norm_has_a_kink():
    mechanism = assur.load("orthoglide")
    step = np.array([[1e-3, 0.0, 0.0], [-1e-3, 0.0, 0.0]])
    kinked = indices(mechanism, step)["condition"]
    smooth = smooth_condition(mechanism, step).value
    assert np.all(1 - kinked > 1e-7)
    assert np.all(1 - smooth < 1e-3 * (1 - kinked))


def test_out_of_reach_there_is_none_and_without_closed_form_it_is_refused():
    found = smooth_condition(assur.load("zeng2019"), [[0.0, 0.0, 2000.0], [-15.4714, 9.6849, 456.3315]])
    assert np.isnan(found.value).tolist() == [True, False]
    assert np.isnan(found.gradient).all(axis=-1).tolist() == [True, False]
    bare = dataclasses.replace(assur.load("zeng2019"), closed_form=None)
    with pytest.raises(UsageError, match="no closed form"):
        smooth_condition(bare, [0.0, 0.0, 241.0])
