"""Distances from parallel singularities: nothing singular lies nearer, and something does at that distance."""

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.kinematics.closed_form.sweep import inverse_sweep
from assur.model.registry import load_record
from assur.singularity.distance import distance

NAMES = ["zeng2019", "delta_4s", "planar_3rpr", "three_upu", "three_rrc"]


def poses_of(name, count=60):
    region = assur.load(name).workspace(resolution=12)
    return region.interior(4 * count, np.random.default_rng(5))[:count]


def factors_at(record, poses):
    found = inverse_sweep(record, poses.T, want=("exists", "factors"))
    parallel = [item.kind == "parallel" for item in record.closed_form.factor_list]
    return found["factors"][parallel], found["exists"]


@pytest.mark.parametrize("name", NAMES)
def test_a_factor_vanishes_at_the_nearest_pose_and_its_distance_is_the_one_said(name):
    record, poses = load_record(name), poses_of(name)
    found = distance(record, poses)
    there = np.isfinite(found.value)
    assert there.mean() > 0.5
    lengths = [k for k, item in enumerate(record.platform.pose) if item in ("x", "y", "z")]
    gaps = np.linalg.norm((found.nearest - poses)[there][:, lengths], axis=-1)
    np.testing.assert_allclose(gaps, found.value[there], rtol=1e-12)
    here, at_foot = (np.abs(factors_at(record, where[there])[0]).min(axis=0) for where in (poses, found.nearest))
    assert np.all(at_foot <= 1e-2 * np.maximum(here, here.max() / 100))


@pytest.mark.parametrize("name", NAMES)
def test_nothing_singular_is_nearer(name):
    """Straight ways of chance inside the ball, as far as they stay in the workspace, change no sign."""
    record, poses = load_record(name), poses_of(name)
    found = distance(record, poses)
    lengths = [k for k, item in enumerate(record.platform.pose) if item in ("x", "y", "z")]
    rng = np.random.default_rng(7)
    start = np.signbit(factors_at(record, poses)[0])
    nearer = np.zeros(len(poses), dtype=bool)
    for _ in range(60):
        way = rng.normal(size=(len(poses), len(lengths)))
        way /= np.linalg.norm(way, axis=-1, keepdims=True)
        inside = np.ones(len(poses), dtype=bool)
        for share in np.linspace(0.05, 0.95, 19):
            moved = poses.copy()
            moved[:, lengths] += share * np.minimum(found.value, found.reach)[:, None] * way
            values, there = factors_at(record, moved)
            inside &= there
            nearer |= inside & np.any(np.signbit(values) != start, axis=0)
    assert nearer.mean() < 0.02  # a thin fold between the rays may be missed


def test_out_of_reach_there_is_none_and_far_away_it_is_infinite():
    record = load_record("zeng2019")
    found = distance(record, [[0.0, 0.0, 2000.0], [0.0, 0.0, 241.0]], reach=0.5)
    np.testing.assert_array_equal(found.value, [np.nan, np.inf])
    assert found.factor.tolist() == ["", ""]
    assert found.to_json()["distance"] == [None, None]


def test_a_pose_of_angles_and_a_reach_of_nothing_are_refused():
    with pytest.raises(UsageError, match="reach: 0"):
        distance(load_record("zeng2019"), [0.0, 0.0, 241.0], reach=0)
