"""Solids whose volumes, cuts and outlines are known exactly."""

from functools import partial
from math import pi, sqrt

import numpy as np
import pytest

from assur.workspace.crossings import root_of
from assur.workspace.domain import Box
from assur.workspace.fields import at_points, sample
from assur.workspace.grid import grid_over
from assur.workspace.projections import shadow
from assur.workspace.sections import cut
from assur.workspace.solids import (
    area_of,
    cuboid,
    intersection,
    mesh,
    solid_where,
    surface_in,
    union,
)

BOX = Box(("x", "y", "z"), (-1.5, -1.3, -1.4), (1.5, 1.3, 1.4))


def ball(columns, radius=1.0, centre=(0.0, 0.0, 0.0)):
    x, y, z = (value - middle for value, middle in zip(columns, centre, strict=True))
    return radius**2 - x**2 - y**2 - z**2


def cylinder(columns):
    return 1.0 - columns[0] ** 2 - columns[1] ** 2 + 0 * columns[2]


def build(field, grid, exact=True):
    crossing = root_of(partial(at_points, field, 3)) if exact else None
    return intersection([solid_where(sample(field, grid), grid, crossing), cuboid(grid)])


def test_the_volume_of_a_ball_converges_with_the_square_of_the_step():
    errors = [build(ball, grid_over(BOX, cells)).volume() / (4 * pi / 3) - 1 for cells in (16, 32, 64)]
    assert all(error < 0 for error in errors)  # facets of a convex body lie inside it
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.1)
    assert errors[1] / errors[2] == pytest.approx(4, rel=0.1)
    assert abs(errors[2]) < 1e-3


def test_every_vertex_lies_on_the_surface_even_of_a_field_with_a_root_in_it():
    # z <= sqrt(1 - x): the field is not smooth at x = 1, where interpolation would be poor
    def field(columns):
        return np.copysign(np.sqrt(np.abs(1 - columns[0])), 1 - columns[0]) - columns[2] + 0 * columns[1]

    grid = grid_over(BOX, 20)
    vertices, _ = mesh(solid_where(sample(field, grid), grid, root_of(partial(at_points, field, 3))))
    inner = vertices[np.all((vertices > grid.low) & (vertices < grid.high), axis=1)]
    x, _, z = inner.T
    # distance from the curve x = 1 - z |z|
    assert len(inner) > 400
    assert np.max(np.abs(x - (1 - z * np.abs(z)))) < 1e-6


def test_two_balls_meet_in_a_lens():
    grid = grid_over(BOX, 64)
    left, right = partial(ball, centre=(-0.5, 0, 0)), partial(ball, centre=(0.5, 0, 0))
    lens = intersection([build(left, grid), build(right, grid)])
    assert lens.volume() == pytest.approx(5 * pi / 12, rel=2e-3)
    both = union([build(left, grid), build(right, grid)])
    assert both.volume() == pytest.approx(2 * 4 * pi / 3 - 5 * pi / 12, rel=2e-3)


def test_a_cylinder_through_nodes_is_cut_by_the_box_exactly():
    # a step of 0.1: nodes at -1 and 1 lie on the surface
    grid = grid_over(Box(("x", "y", "z"), (-1.5, -1.5, -1.4), (1.5, 1.5, 1.4)), 30)
    assert np.sum(sample(cylinder, grid) == 0) > 0
    solid = build(cylinder, grid)
    assert solid.volume() == pytest.approx(2.8 * pi, rel=5e-3)
    assert mesh(solid)[0][:, 2].min() == -1.4
    assert mesh(solid)[0][:, 2].max() == 1.4


@pytest.mark.parametrize("offset", [0.0, 1e-9, -1e-9, 0.01])
def test_a_plane_through_nodes_gives_half_the_box(offset):
    grid = grid_over(BOX, 10)
    solid = build(lambda columns: columns[0] - offset + 0 * columns[1] + 0 * columns[2], grid)
    assert solid.volume() == pytest.approx((1.5 - offset) * 2.6 * 2.8, rel=1e-6)


def test_a_field_of_one_sign_gives_all_or_nothing():
    grid = grid_over(BOX, 8)
    ones = np.ones(grid.shape, dtype=np.float32)
    assert solid_where(ones, grid).volume() == pytest.approx(3 * 2.6 * 2.8)
    assert solid_where(0 * ones, grid).volume() == pytest.approx(3 * 2.6 * 2.8)  # zero is allowed
    assert solid_where(-ones, grid).is_empty()


def test_a_ball_outside_the_box_leaves_nothing():
    grid = grid_over(BOX, 16)
    assert build(partial(ball, centre=(2.6, 0, 0)), grid).volume() == 0.0
    # it reaches the spare cell only
    assert build(partial(ball, centre=(2.55, 0, 0)), grid).volume() == 0.0


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("value", [-0.6, 0.0, 0.35])
def test_cuts_of_a_ball_are_circles(axis, value):
    solid = build(ball, grid_over(BOX, 48))
    area, polygons = cut(solid, axis, value, (-2.0, 2.0))
    assert area == pytest.approx(pi * (1 - value**2), rel=5e-3)
    assert len(polygons) == 1
    np.testing.assert_allclose(np.linalg.norm(polygons[0], axis=1), sqrt(1 - value**2), rtol=5e-3)


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_cut_keeps_its_coordinates_in_order_and_turns_counter_clockwise(axis):
    # a brick with corners that tell its axes apart
    low, high = np.array([0.0, 10.0, 20.0]), np.array([1.0, 12.0, 23.0])
    grid = grid_over(Box(("x", "y", "z"), tuple(low), tuple(high)), 4)
    rest = [k for k in range(3) if k != axis]
    for area, polygons in (
        cut(cuboid(grid), axis, low[axis] + 0.5, (low[axis], high[axis])),
        shadow(cuboid(grid), axis),
    ):
        (polygon,) = polygons
        assert area == pytest.approx(np.prod((high - low)[rest]))
        np.testing.assert_allclose(polygon.min(axis=0), low[rest])
        np.testing.assert_allclose(polygon.max(axis=0), high[rest])
        x, y = polygon.T
        assert np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) / 2 == pytest.approx(area)


@pytest.mark.parametrize("value", [-1.4, 1.4])
def test_a_cut_at_the_end_of_the_box_is_that_just_inside(value):
    grid = grid_over(BOX, 40)
    assert cut(build(cylinder, grid), 2, value, (-1.4, 1.4))[0] == pytest.approx(pi, rel=5e-3)


def test_a_hole_is_cut_and_projected_as_a_hole():
    grid = grid_over(BOX, 40)

    def tube(columns):
        return np.minimum(cylinder(columns), columns[0] ** 2 + columns[1] ** 2 - 0.25)

    for area, polygons in (cut(build(tube, grid), 2, 0.1, (-1.4, 1.4)), shadow(build(tube, grid), 2)):
        assert area == pytest.approx(0.75 * pi, rel=5e-3)
        signed = sorted(np.sum(p[:, 0] * np.roll(p[:, 1], -1) - p[:, 1] * np.roll(p[:, 0], -1)) / 2 for p in polygons)
        assert signed == pytest.approx([-0.25 * pi, pi], rel=1e-2)


def test_a_shadow_counts_what_lies_behind_itself_once():
    grid = grid_over(BOX, 40)
    balls = union([build(partial(ball, radius=0.5, centre=(x, 0.1, z)), grid) for x, z in ((-0.2, -0.7), (0.2, 0.7))])
    lens = 2 * 0.25 * np.arccos(0.4) - 0.2 * sqrt(1 - 0.16)
    assert shadow(balls, 2)[0] == pytest.approx(2 * 0.25 * pi - lens, rel=5e-3)


def test_the_surface_inside_a_region_is_cut_exactly_by_it():
    grid = grid_over(BOX, 40)

    def plane(columns):
        return 0.8 * columns[2] - 0.6 * columns[0] + 0 * columns[1]

    cutter = solid_where(sample(plane, grid), grid, root_of(partial(at_points, plane, 3)))
    vertices, faces = surface_in(build(cylinder, grid), cutter)
    assert area_of(vertices, faces) == pytest.approx(pi / 0.8, rel=5e-3)  # an ellipse
    assert np.max(np.abs(plane(vertices.T))) < 1e-6
    assert set(faces.ravel()) == set(range(len(vertices)))


def test_no_surface_lies_in_a_region_that_the_cutter_misses():
    grid = grid_over(BOX, 20)
    cutter = solid_where(sample(partial(ball, radius=0.2), grid), grid)
    far = build(lambda columns: columns[0] - 1.0 + 0 * columns[1] + 0 * columns[2], grid)
    vertices, faces = surface_in(far, cutter)
    assert vertices.shape == (0, 3)
    assert faces.shape == (0, 3)
