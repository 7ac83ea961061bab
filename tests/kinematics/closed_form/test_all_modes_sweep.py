"""Sweeps in all modes: each row is the sweep of its mode, and the directs are those of one problem at a time."""

from __future__ import annotations

import numpy as np
import pytest

import assur
from assur.kinematics.closed_form.all_modes_sweep import all_modes_sweep, inverse_all_sweep
from assur.kinematics.closed_form.sweep import inverse_sweep
from assur.kinematics.modes import all_modes

COUNT = 4999  # odd, and no multiple of any block
WITH_BRANCHES = [name for name in assur.names() if callable(assur.load(name).closed_form.direct)]
"""Mechanisms whose direct problem is told by branches of signs, not by a polynomial or a search."""


@pytest.fixture(params=WITH_BRANCHES)
def mechanism(request):
    return assur.load(request.param)


@pytest.fixture
def zeng():
    return assur.load("zeng2019")


def poses_of(mechanism, count=COUNT):
    """Random poses (m, N) in the mechanism's box, or about its home pose."""
    rng = np.random.default_rng(5)
    limits = [mechanism.box[name] for name in mechanism.platform.pose]
    return np.array([rng.uniform(low, high, count) for low, high in limits])


def inputs_of(mechanism, count=COUNT):
    """Inputs (n, N): those of poses that exist, and every third with a first input far from them."""
    poses = poses_of(mechanism, 6 * count)
    found = inverse_sweep(mechanism, poses)
    real = found["inputs"][:, found["exists"]]
    assert real.shape[1] > 50
    rng = np.random.default_rng(6)
    picked = real[:, rng.integers(real.shape[1], size=count)]
    picked[0, ::3] = rng.normal(real[0].mean(), 6 * real[0].std(), size=len(picked[0, ::3]))
    return picked


def test_every_row_of_the_expanded_answer_is_its_mode(mechanism):
    poses = poses_of(mechanism)
    inputs, exists = all_modes_sweep(mechanism, "inverse", poses, block=999)
    modes = all_modes(mechanism, "inverse")
    assert inputs.shape == (len(modes), len(mechanism.inputs), COUNT)
    for k, mode in enumerate(modes):
        one = inverse_sweep(mechanism, poses, mode, ("inputs", "exists"))
        np.testing.assert_array_equal(inputs[k], one["inputs"])
        np.testing.assert_array_equal(exists[k], one["exists"])


def test_distinct_numbers_broadcast_to_the_expanded_answer(mechanism):
    poses = poses_of(mechanism)
    distinct, exists = inverse_all_sweep(mechanism, poses)
    expanded, all_exist = all_modes_sweep(mechanism, "inverse", poses)
    axes = (2,) * len(mechanism.modes.working)
    for k, values in enumerate(distinct):
        wide = np.broadcast_to(values, (*axes, COUNT)).reshape(-1, COUNT)
        np.testing.assert_array_equal(wide, expanded[:, k])
    np.testing.assert_array_equal(np.broadcast_to(exists, (*axes, COUNT)).reshape(-1, COUNT), all_exist)


def test_32_inverses_are_12_numbers(zeng):
    distinct, exists = inverse_all_sweep(zeng, poses_of(zeng))
    assert [values.size // COUNT for values in distinct] == [4, 4, 4]
    assert exists.size // COUNT == 4


def test_directs_contain_the_pose_whose_inputs_they_are_given(mechanism):
    poses = poses_of(mechanism)
    found = inverse_sweep(mechanism, poses)
    sizes = np.abs(found["factors"]) / np.abs(found["factors"]).max(axis=1, keepdims=True)
    regular = found["exists"] & np.all(sizes > 1e-3, axis=0)
    assert regular.sum() > 50
    directs, exist = all_modes_sweep(mechanism, "direct", found["inputs"][:, regular])
    gaps = np.abs(directs - poses[:, regular]).max(axis=1)  # (K, N)
    np.testing.assert_array_less(np.where(exist, gaps, np.inf).min(axis=0), 1e-8 * np.ptp(poses))


def test_directs_agree_with_the_solution_set(mechanism):
    inputs = inputs_of(mechanism)
    poses, exist = all_modes_sweep(mechanism, "direct", inputs, block=100)
    found = mechanism.direct(inputs.T)
    np.testing.assert_array_equal(exist.T, found.exists)
    assert exist.any()
    np.testing.assert_array_equal(np.moveaxis(poses, 2, 0)[exist.T], found.poses[exist.T])


@pytest.mark.parametrize(("gap", "exists"), [(0.0, False), (1e-3, True), (-1e-3, True)])
def test_self_motion_is_no_pose(zeng, gap, exists):
    # B = yA1 - l3 - yA2 = 0 lets the platform move with all inputs locked: a curve, of which no sample is listed
    _, exist = all_modes_sweep(zeng, "direct", ([100.0 + gap], [-40.0], [60.0]))
    assert bool(exist.any()) is exists
