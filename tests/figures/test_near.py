import numpy as np
import pytest
from scipy.spatial import KDTree

from assur.figures.near import TriangleDistance
from assur.workspace.nearness import divided, triangles_of
from assur.workspace.solids import mesh

SURFACES_INSIDE = pytest.mark.parametrize("context", ["zeng2019"], indirect=True)


@pytest.fixture
def surfaces(context):
    return np.concatenate(
        [triangles_of(item.vertices, item.faces) for item in context.workspace.loci if len(item.faces)]
    )


@SURFACES_INSIDE
def test_the_distance_is_that_from_a_dense_cloud_of_the_surfaces(context, surfaces):
    near = context.workspace.near
    cloud = divided(surfaces, near / 5).reshape(-1, 3)
    low, high = np.array(context.workspace.box.intervals).T
    points = np.random.default_rng(2).uniform(low, high, size=(1000, 3))
    found = TriangleDistance(surfaces, 2 * near)(points)
    wanted, _ = KDTree(cloud).query(points)
    close = wanted < near
    assert close.sum() > 30
    np.testing.assert_allclose(found[close], wanted[close], atol=near / 5)
    assert found[wanted > 1.5 * near].min() > near


@SURFACES_INSIDE
def test_its_border_is_at_that_distance_or_on_that_of_the_workspace(context, surfaces):
    vertices, _ = mesh(context.near)
    distance = TriangleDistance(surfaces, 2 * context.workspace.near)(vertices)
    assert distance.max() < 1.05 * context.workspace.near


@SURFACES_INSIDE
def test_its_share_is_that_of_the_workspace(context, surfaces):
    share = context.near.volume() / context.workspace.region.solid.volume()
    assert share == pytest.approx(context.workspace.share, rel=0.03)


@pytest.mark.parametrize("context", ["fivebar"], indirect=True)
def test_without_surfaces_nothing_is_near(context):
    assert not any(len(item.faces) or item.everywhere for item in context.workspace.loci)
    assert context.workspace.share == 0
    assert context.near.is_empty()


@pytest.mark.parametrize("context", ["planar_3rrr"], indirect=True)
def test_where_lengths_and_angles_mix_there_is_no_distance(context):
    assert any(len(item.faces) for item in context.workspace.loci)
    assert context.workspace.share is None
    assert context.near.is_empty()
