"""Rims of zero surfaces that touch the border of their region, against curves that are known exactly."""

import numpy as np
import pytest

from assur.workspace.domain import Box
from assur.workspace.grid import grid_over
from assur.workspace.reach import reach
from assur.workspace.rims import rim_edges

TILT = 0.3


def depth(columns):
    """Of a ball of radius 1, negative outside."""
    return 1.0 - sum(np.square(column) for column in columns)


def factor(columns):
    """Zero on a tilted plane, with a root of the depth on top: as a branch has it, and as it goes on past its end."""
    inside = depth(columns)
    return columns[1] - TILT * columns[0] - 0.4 * np.copysign(np.sqrt(np.abs(inside)), inside)


def of_ball(low, cells):
    """The zero surface: vertices and faces, or segments in a plane."""
    names = ("x", "y", "z")[: len(low)]
    grid = grid_over(Box(names, low, (1.2, 1.3, 1.25)[: len(low)]), cells)
    return reach({"depth": depth}, {"factor": factor}, grid).zero_surface("factor"), grid


@pytest.mark.parametrize("cells", [9, 14, 23])
def test_the_rim_lies_where_the_factor_is_zero_on_the_border(cells):
    (vertices, faces, area), grid = of_ball((-1.2, -1.3, -0.4), cells)
    rim = vertices[np.unique(rim_edges(faces))]
    on_border = rim[rim[:, 2] > -0.4 + 1e-9]
    step = np.max(grid.step)
    assert len(on_border) > cells
    assert np.max(np.abs(1.0 - np.linalg.norm(on_border, axis=1))) < 0.5 * step**2  # facets of a ball lie inside it
    # a plane through the middle: at most as far off as the facets are, and a share of a step by what is read inside
    assert np.max(np.abs(on_border[:, 1] - TILT * on_border[:, 0])) < 0.08 * step
    # it goes all the way round, down to the floor, without teeth
    ends = np.arctan2(on_border[:, 0] * np.hypot(1.0, TILT), on_border[:, 2])
    assert np.max(np.diff(np.sort(ends))) < 1.5 * step
    assert area == pytest.approx(true_area(-0.4), rel=0.5 * step**2)


def true_area(floor):
    """Of (y - 0.3 x)^2 = 0.16 depth on one side above a floor: half of an ellipsoid, an image of a sphere."""
    normal = np.array([-TILT, 1.0, 0.0])
    image = 0.4 * np.linalg.inv(np.linalg.cholesky(np.outer(normal, normal) + 0.16 * np.eye(3)).T)
    height, turn = np.meshgrid((np.arange(800) + 0.5) / 400 - 1, np.pi * (np.arange(800) + 0.5) / 400, indexing="ij")
    across = np.sqrt(1 - height**2)
    sphere = np.stack([across * np.cos(turn), across * np.sin(turn), height], axis=-1)
    points = sphere @ image.T
    sizes = np.linalg.det(image) * np.linalg.norm(sphere @ np.linalg.inv(image), axis=-1)
    return float(np.sum(sizes[(points @ normal > 0) & (points[..., 2] > floor)]) * 4 * np.pi / sizes.size)


@pytest.mark.parametrize("cells", [9, 16])
def test_in_a_plane_a_singular_curve_ends_on_the_border(cells):
    (vertices, segments, _), grid = of_ball((-1.2, -1.3), cells)
    ends, count = np.unique(segments, return_counts=True)
    tips = vertices[ends[count == 1]]
    assert len(tips) == 2
    true = np.array([-1.0, 1.0])[:, None] * np.array([1.0, TILT]) / np.hypot(1.0, TILT)
    assert np.max(np.abs(tips[np.argsort(tips[:, 0])] - true)) < 0.08 * np.max(grid.step)
