"""Distances from parallel singularities: something is singular at that distance, and nothing that is seen is nearer.

Second routes: poses by chance in the ball, and the triangles of the loci of a workspace.
"""

import dataclasses
from functools import cache

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.kinematics.closed_form.sweep import inverse_sweep
from assur.kinematics.status import scale
from assur.model.registry import load_record
from assur.singularity.distance import distance
from assur.singularity.rays import ON_SURFACE
from assur.workspace.nearness import to_triangles, triangles_of

NAMES = ("zeng2019", "delta_4s", "planar_3rpr", "three_upu", "three_rrc", "fivebar", "gough_stewart")
COUNT, TRIES = 40, 4000
WITHIN = {"three_upu": 0.3, "fivebar": 0.0}
"""Least share of poses with a singularity within the characteristic length, where that is less than half of them."""

MISSED = {"delta_4s": 0.03, "fivebar": 0.1}
"""Greatest share of poses with something nearer. The Delta: in the wedges in which the borders of two legs meet. The
five-bar: in an island of its workspace, behind a gap and as thin as the steps of the rays."""


@cache
def case(name):
    """The mechanism, poses of its workspace, and their distances."""
    record = load_record(name)
    region = assur.load(name).workspace(resolution=12)
    poses = region.interior(4 * COUNT, np.random.default_rng(5))[:COUNT]
    return record, poses, distance(record, poses)


def lengths_of(record):
    return [k for k, name in enumerate(record.platform.pose) if name in ("x", "y", "z")]


def factors_at(record, poses):
    """Parallel factors (F, N) over their scales, and whether the mode reaches the poses (N,)."""
    found = inverse_sweep(record, poses.T, want=("exists", "factors"))
    parallel = [k for k, item in enumerate(record.closed_form.factor_list) if item.kind == "parallel"]
    scales = [scale(record, record.closed_form.factor_list[k].scale) for k in parallel]
    return found["factors"][parallel] / np.array(scales)[:, None], found["exists"]


@pytest.mark.parametrize("name", NAMES)
def test_the_factor_that_is_named_vanishes_at_the_nearest_pose(name):
    record, poses, found = case(name)
    there = np.isfinite(found.value)
    assert there.mean() >= WITHIN.get(name, 0.5)
    gaps = np.linalg.norm((found.nearest - poses)[there][:, lengths_of(record)], axis=-1)
    np.testing.assert_allclose(gaps, found.value[there], rtol=1e-9)
    assert np.all(found.value[there] <= found.reach)
    values, reached = factors_at(record, found.nearest[there])
    assert np.all(reached)
    names = [item.name for item in record.closed_form.factor_list if item.kind == "parallel"]
    rows = [names.index(factor) for factor in found.factor[there]]
    assert np.all(np.abs(values[rows, np.arange(len(rows))]) <= ON_SURFACE)
    assert np.all(found.factor[~there] == "")


@pytest.mark.parametrize("name", NAMES)
def test_nothing_singular_is_nearer(name):
    """Poses by chance in the ball have the signs that the factors have at its middle."""
    record, poses, found = case(name)
    columns, rng = lengths_of(record), np.random.default_rng(7)
    nearer = []
    for pose, value in zip(poses, np.minimum(found.value, found.reach), strict=True):
        way = rng.normal(size=(TRIES, len(columns)))
        radius = value * 0.999 * rng.random((TRIES, 1)) ** (1 / len(columns))
        moved = np.repeat(pose[None], TRIES + 1, axis=0)
        moved[1:, columns] += radius * way / np.linalg.norm(way, axis=-1, keepdims=True)
        values, there = factors_at(record, moved)
        nearer.append(np.any(there & np.any(np.signbit(values) != np.signbit(values[:, :1]), axis=0)))
    assert np.mean(nearer) <= MISSED.get(name, 0.0)


@pytest.mark.parametrize(
    ("name", "held"),
    [("zeng2019", None), pytest.param("orthoglide", None, marks=pytest.mark.deep), ("planar_3rpr", {"phi": 0.2})],
)
def test_it_is_the_distance_from_the_triangles_of_the_loci(name, held):
    """Within the cells of the grid that they are made on; a nearer one outside the box has no triangle."""
    record = load_record(name)
    region = assur.load(name).workspace(resolution=48, held=held)
    poses = region.interior(600, np.random.default_rng(3))[:30]
    columns = [record.platform.pose.index(free) for free in region.box.names]
    found = distance(record, poses)
    corners = np.concatenate([triangles_of(locus.vertices, locus.faces) for locus in region.loci if len(locus.faces)])
    points = np.zeros((len(poses), 3))
    points[:, : len(columns)] = poses[:, columns]
    near = [np.min(to_triangles(np.repeat(point[None], len(corners), axis=0), corners)) for point in points]
    cell = float(np.max(np.subtract(region.box.high, region.box.low))) / 48
    seen = np.array(near) < found.reach - cell
    assert np.all(found.value[seen] <= np.array(near)[seen] + cell)
    feet = found.nearest[:, columns]
    inside = np.all((feet >= region.box.low) & (feet <= region.box.high), axis=-1)
    agree = np.abs(found.value - near) <= cell
    assert np.mean(agree[inside]) >= 0.9  # slivers thinner than a cell have no triangles
    assert inside.sum() >= 5


def test_close_by_it_is_the_factor_over_its_slope():
    record, step = load_record("zeng2019"), 1e-4
    pose = np.array([0.0, 0.0, 238.0])
    values = factors_at(record, pose + step * np.concatenate([np.zeros((1, 3)), np.eye(3), -np.eye(3)]))[0]
    slopes = np.linalg.norm(values[:, 1:4] - values[:, 4:], axis=1) / (2 * step)
    expected = np.abs(values[:, 0]) / np.maximum(slopes, 1e-12)
    found = distance(record, pose)
    assert found.value == pytest.approx(np.min(expected), rel=0.02)
    assert expected.argmin() == [item.name for item in record.closed_form.factor_list].index(str(found.factor))


def test_an_answer_does_not_depend_on_what_else_is_asked():
    record, poses, found = case("zeng2019")
    for k in range(3):
        assert float(distance(record, poses[k]).value) == pytest.approx(found.value[k], rel=1e-12)


def test_a_singular_pose_has_none_and_a_batch_keeps_its_shape():
    record = load_record("zeng2019")
    near = distance(record, [0.0, 0.0, 241.0]).nearest
    here = distance(record, np.broadcast_to(near, (2, 1, 3)))
    assert here.value.shape == here.factor.shape == (2, 1)
    assert np.all(here.value < 1e-3)


def test_out_of_reach_there_is_none_and_far_away_it_is_infinite():
    record = load_record("zeng2019")
    found = distance(record, [[0.0, 0.0, 2000.0], [0.0, 0.0, 241.0]], reach=0.5)
    np.testing.assert_array_equal(found.value, [np.nan, np.inf])
    assert found.factor.tolist() == ["", ""]


def test_no_poses_have_no_distances():
    assert distance(load_record("zeng2019"), np.zeros((0, 3))).value.shape == (0,)


@pytest.mark.parametrize("reach", [0, -1.0, np.nan, np.inf])
def test_a_reach_that_is_none_is_refused(reach):
    with pytest.raises(UsageError, match="reach: "):
        distance(load_record("zeng2019"), [0.0, 0.0, 241.0], reach=reach)


def test_without_closed_form_it_is_refused():
    with pytest.raises(UsageError, match="no closed form"):
        distance(dataclasses.replace(load_record("zeng2019"), closed_form=None), [0.0, 0.0, 241.0])
