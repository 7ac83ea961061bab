"""Distances to triangles, and the volume near a surface, against exact values."""

from math import pi

import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.spatial import KDTree

import assur
from assur.workspace.domain import Box
from assur.workspace.grid import grid_over
from assur.workspace.nearness import divided, near_volume, to_triangles, triangles_of
from assur.workspace.reach import reach
from assur.workspace.region import workspace

FLOOR = np.array([[[-9.0, -9, 0], [9, -9, 0], [-9, 9, 0]], [[9.0, -9, 0], [9, 9, 0], [-9, 9, 0]]])


def region(margin, cells=48, box=None):
    box = box or Box(("x", "y", "z"), (-1.2,) * 3, (1.2,) * 3)
    return reach({"margin": margin}, {}, grid_over(box, cells))


def ball(columns):
    return 1 - columns[0] ** 2 - columns[1] ** 2 - columns[2] ** 2


def test_the_distance_to_a_triangle_is_the_least_over_its_points():
    rng = np.random.default_rng(6)
    corners, points = rng.normal(size=(60, 3, 3)), 2 * rng.normal(size=(60, 3))
    found = to_triangles(points, corners)
    for point, triangle, distance in zip(points, corners, found, strict=True):

        def gap(s, point=point, triangle=triangle):
            return float(np.sum((triangle[0] + s @ (triangle[1:] - triangle[0]) - point) ** 2))

        bounds = {"type": "ineq", "fun": lambda s: 1 - np.sum(s)}
        best = minimize(gap, [0.3, 0.3], bounds=[(0, 1), (0, 1)], constraints=bounds, method="SLSQP", tol=1e-14)
        assert distance == pytest.approx(np.sqrt(best.fun), abs=1e-6)


def test_the_distance_to_a_flat_triangle_is_that_to_a_segment():
    segment = triangles_of(np.array([[0.0, 0.0], [2.0, 0.0]]), np.array([[0, 1]]))
    points = np.array([[1.0, 3.0, 0.0], [5.0, 4.0, 0.0]])
    np.testing.assert_allclose(to_triangles(points, np.repeat(segment, 2, axis=0)), [3.0, 5.0])


def test_divided_triangles_cover_the_same_area_with_short_edges():
    rng = np.random.default_rng(7)
    long = rng.normal(size=(20, 3, 3)) * [30.0, 1.0, 1.0]
    short = divided(long, 2.0)
    edges = np.linalg.norm(short - np.roll(short, 1, axis=1), axis=2)

    def area(triangles):
        return np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1)

    assert edges.max() <= 2.0
    assert area(short).sum() == pytest.approx(area(long).sum())


@pytest.mark.parametrize("distance", [0.05, 0.2, 0.5, 0.9])
def test_the_part_of_a_ball_near_its_middle_plane(distance):
    exact = 2 * pi * (distance - distance**3 / 3)
    assert near_volume(region(ball), [FLOOR], distance) == pytest.approx(exact, rel=5e-3)


def test_two_surfaces_are_counted_once_where_they_overlap():
    wall = FLOOR[:, :, [2, 0, 1]]
    cube = region(lambda columns: 1 + 0 * (columns[0] + columns[1] + columns[2]), 8)
    assert near_volume(cube, [FLOOR, wall], 0.3) == pytest.approx(2.4 * (2 * 0.6 * 2.4 - 0.36), rel=1e-3)


def test_in_a_plane_it_is_the_area_near_a_curve():
    disc = region(lambda columns: 1 - columns[0] ** 2 - columns[1] ** 2, 64, Box(("x", "y"), (-2.0, -1.5), (2.0, 1.5)))
    line = triangles_of(np.array([[-9.0, 0.0], [9.0, 0.0]]), np.array([[0, 1]]))
    exact = 2 * (0.4 * np.sqrt(1 - 0.16) + np.arcsin(0.4))
    assert near_volume(disc, [line], 0.4) == pytest.approx(exact, rel=5e-3)


def test_a_distance_that_the_grid_cannot_resolve_has_no_answer():
    assert near_volume(region(ball, 8), [FLOOR], 0.01) is None


@pytest.fixture(scope="module")
def distances():
    """Nothing depends on y: points of the (x, z) region 0.5 mm apart, and their distances to w = 0 and v = 0."""
    p = assur.load("zeng2019").values
    top = p.l4 - (p.b - p.d)
    x, z = np.meshgrid(np.arange(-109.75, top, 0.5), np.arange(180.25, 480.0, 0.5), indexing="ij")
    line = np.concatenate([np.linspace(-110, top, 4000), top - np.linspace(0, 1, 400) ** 2])

    def curves(x):
        sine_alpha = np.sqrt(np.maximum(1 - ((x + p.b - p.d) / p.l4) ** 2, 0))
        return p.l1 + p.l4 * sine_alpha, p.l1 + p.l6 * np.sqrt(1 - ((x - p.b + p.d) / p.l6) ** 2)

    c1, c3 = curves(x)
    inside = (np.abs(z - c1) <= p.l2) & (np.abs(z - c3) <= p.l6)
    points = [np.stack([line, curve], axis=-1)[curve >= 180.0] for curve in curves(line)]
    tree = KDTree(np.concatenate(points))
    return tree.query(np.stack([x, z], axis=-1)[inside], distance_upper_bound=40.0)[0]


@pytest.mark.parametrize("near", [10.0, 30.0])
def test_the_share_of_the_paper_s_workspace_near_a_parallel_singularity(distances, near):
    found = workspace(assur.load("zeng2019"), near=near, resolution=32)
    assert found.share == pytest.approx(np.mean(distances <= near), rel=5e-3)
