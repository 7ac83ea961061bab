"""Dexterity against differences of the inverse solution, and its mean against quadrature."""

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.kinematics.rates.motions import input_units, pose_units
from assur.kinematics.status import Status
from assur.performance.dexterity import dexterity, global_condition_index
from assur.workspace.region import workspace

MECHANISM = assur.load("zeng2019")
ROW_3 = [-15.4714, 9.6849, 456.3315]


@pytest.mark.parametrize("name", assur.names())
def test_the_factors_are_singular_values_of_the_differentiated_inverse(name, regular_poses, slopes):
    mechanism = assur.load(name)
    mode = mechanism.modes.default_working
    poses = regular_poses(mechanism, mode)
    assert len(poses) == 100
    differences = in_one_unit(mechanism, slopes(mechanism, poses, mode))
    known = np.all(np.isfinite(differences), axis=(-1, -2))
    ok = known & (np.linalg.cond(np.where(known[:, None, None], differences, 1.0)) < 1e3)
    assert np.sum(ok) > 80
    exact = np.sort(1 / np.linalg.svd(differences[ok], compute_uv=False), axis=-1)[:, ::-1]
    found = dexterity(mechanism, poses[ok], mode)
    np.testing.assert_allclose(found.velocity_factors, exact, rtol=1e-3)
    np.testing.assert_allclose(found.condition_index, 1 / np.linalg.cond(differences[ok]), rtol=1e-3)


def in_one_unit(mechanism, inverses):
    """J_L^-1 from J^-1 (..., n, k): lengths over the characteristic length where they mix with angles."""
    rates, inputs = pose_units(mechanism), input_units(mechanism)
    return inverses * rates / inputs[:, None] if np.ptp(rates) or np.ptp(inputs) else inverses


@pytest.mark.parametrize("batch", [(), (1,), (3, 1, 2), (0,)])
def test_any_batch_shape(batch):
    poses = np.broadcast_to(ROW_3, (*batch, 3))
    found = dexterity(MECHANISM, poses)
    assert found.condition_index.shape == batch
    assert found.velocity_factors.shape == (*batch, 3)
    assert found.status.shape == batch
    np.testing.assert_array_equal(
        found.condition_index, np.broadcast_to(dexterity(MECHANISM, ROW_3).condition_index, batch)
    )


def test_many_poses_give_what_single_ones_give(monkeypatch, regular_poses):
    poses = regular_poses(MECHANISM, "++-++", 50)
    whole = dexterity(MECHANISM, poses)
    monkeypatch.setattr("assur.performance.dexterity.BLOCK", 7)
    np.testing.assert_array_equal(dexterity(MECHANISM, poses).condition_index, whole.condition_index)


def test_missing_numbers_are_labelled_and_null_in_json():
    p = MECHANISM.values
    x = -15.4714
    flat = p.l1 + np.sqrt(p.l6**2 - (x - p.b + p.d) ** 2)  # v = 0
    upright = p.l1 + np.sqrt(p.l4**2 - (x + p.b - p.d) ** 2) + p.l2  # u1 = u2 = 0
    poses = [ROW_3, [x, 0.0, flat], [x, 0.0, upright], [90.0, 0.0, 300.0]]
    found = dexterity(MECHANISM, poses)
    names = [Status(int(code)).name for code in found.status]
    assert names[0] == "regular"
    assert names[1] == "constraint"  # E14: a flat parallelogram is more than parallel
    assert names[3] == "unreachable"
    np.testing.assert_array_equal(found.defined, [True, False, False, False])
    assert np.all(np.isnan(found.velocity_factors[1:]))
    assert np.all(np.isnan(found.condition_index[1:]))


def test_the_index_goes_to_zero_towards_a_parallel_singularity():
    p = MECHANISM.values
    flat = p.l1 + np.sqrt(p.l6**2 - (ROW_3[0] - p.b + p.d) ** 2)
    gaps = np.array([10.0, 1.0, 0.1, 0.01])
    index = dexterity(MECHANISM, [[ROW_3[0], 0.0, flat + gap] for gap in gaps]).condition_index
    assert np.all(np.diff(index) < 0)
    assert index[-1] / gaps[-1] == pytest.approx(index[-2] / gaps[-2], rel=0.05)  # linearly


def test_the_mean_over_the_paper_s_workspace_is_that_of_quadrature_within_its_error():
    """Second route: nothing depends on y, so a midpoint rule over the exact interval of z at x = 80 - s^2."""
    p = MECHANISM.values
    n = 300
    s = np.sqrt(190.0) * (np.arange(n) + 0.5) / n
    x = p.l4 - p.b + p.d - s**2
    c1 = p.l1 + np.sqrt(p.l4**2 - (x + p.b - p.d) ** 2)
    c3 = p.l1 + np.sqrt(p.l6**2 - (x - p.b + p.d) ** 2)
    top = np.minimum(480.0, np.minimum(c1 + p.l2, c3 + p.l6))
    bottom = np.maximum(180.0, np.maximum(c1 - p.l2, c3 - p.l6))
    span = np.maximum(top - bottom, 0.0)
    z = bottom[:, None] + span[:, None] * (np.arange(n) + 0.5) / n
    poses = np.stack(np.broadcast_arrays(x[:, None], 0.0, z), axis=-1)
    index = dexterity(MECHANISM, poses).condition_index
    weights = np.broadcast_to((2 * s * span)[:, None], index.shape)
    exact = np.nansum(weights * index) / np.sum(weights * np.isfinite(index))
    found = global_condition_index(MECHANISM, workspace(MECHANISM, resolution=16))
    assert abs(found.value - exact) < 1.3 * found.error  # three standard errors
    assert found.error < 0.01 * exact
    assert found.points > 20_000


def test_the_error_of_the_mean_covers_other_seeds():
    region = workspace(MECHANISM, resolution=8, near=300)
    best = global_condition_index(MECHANISM, region, 2**17).value
    found = [global_condition_index(MECHANISM, region, 2**11, np.random.default_rng(seed)) for seed in range(12)]
    inside = [abs(item.value - best) <= item.error for item in found]
    assert sum(inside) >= 9
    assert all(abs(item.value - best) > 0 for item in found)


def test_an_empty_region_has_no_mean():
    found = global_condition_index(MECHANISM, workspace(MECHANISM, box={"x": (200, 300)}, resolution=8))
    assert (found.value, found.error, found.points) == (None, None, 0)


@pytest.mark.parametrize("count", [0, 100, 1e5, True])
def test_a_number_of_points_that_is_none_is_refused(count):
    with pytest.raises(UsageError, match="count"):
        global_condition_index(MECHANISM, workspace(MECHANISM, resolution=4), count)
