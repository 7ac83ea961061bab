"""Boxes and grids: what they hold, and what is refused."""

import numpy as np
import pytest

from assur.errors import UnknownNameError, UsageError
from assur.model.registry import load_record
from assur.workspace.domain import Box, box_of
from assur.workspace.grid import UniformGrid, grid_over

RECORD = load_record("zeng2019")


def test_a_box_is_given_in_order_or_by_name():
    pairs = [[-1, 1], [-2, 2], [3, 4]]
    by_name = {"z": (3, 4), "x": (-1, 1), "y": (-2, 2)}
    assert box_of(RECORD, pairs) == box_of(RECORD, by_name) == Box(("x", "y", "z"), (-1, -2, 3), (1, 2, 4))


def test_what_is_left_out_comes_from_the_file():
    assert box_of(RECORD, None).intervals == [list(RECORD.box[name]) for name in "xyz"]
    assert box_of(RECORD, {"y": (0, 1)}).intervals[1] == [0.0, 1.0]


@pytest.mark.parametrize(
    ("box", "says"),
    [
        ({"x": (90, -110)}, "turned round"),
        ({"x": (5, 5)}, "turned round or empty"),
        ({"x": (0, np.inf)}, "not finite"),
        ({"x": (np.nan, 1)}, "not finite"),
        ([[0, 1], [0, 1]], r"\(3, 2\) wanted"),
        ([0, 1, 2], r"\(3, 2\) wanted|not an array"),
        ({"x": (0, 1, 2)}, "not an array"),
        ({"x": ("0", "1,5")}, "not an array"),
    ],
)
def test_a_box_that_is_none_is_refused(box, says):
    with pytest.raises(UsageError, match=says):
        box_of(RECORD, box)


def test_an_unknown_coordinate_is_refused_with_those_that_exist():
    with pytest.raises(UnknownNameError, match="there is: x, y, z"):
        box_of(RECORD, {"w": (0, 1)})


@pytest.mark.parametrize("resolution", [1, 401, 10.0, "64", True])
def test_a_resolution_that_is_none_is_refused(resolution):
    with pytest.raises(UsageError, match="resolution"):
        grid_over(box_of(RECORD, None), resolution)


def test_the_nodes_cover_the_box_and_one_cell_more():
    grid = grid_over(box_of(RECORD, None), 10)
    first, last = grid.position(np.zeros(3)), grid.position(np.array(grid.shape) - 1.0)
    np.testing.assert_allclose(first, grid.low - grid.step, rtol=1e-14)
    np.testing.assert_allclose(last, grid.high + grid.step, rtol=1e-14)


@pytest.mark.parametrize("size", [1, 200, 10**9])
def test_blocks_give_every_node_once_whatever_their_size(size):
    grid = UniformGrid(box_of(RECORD, None), (4, 5, 6))
    seen = np.zeros(grid.shape)
    for part, (x, y, z) in grid.blocks(size):
        seen[part] += 1
        np.testing.assert_array_equal(x.ravel(), grid.position(np.arange(grid.shape[0])[part, None] * np.ones(3))[:, 0])
        assert y.size == grid.shape[1]
        assert z.size == grid.shape[2]
    assert np.all(seen == 1)


def test_a_plane_box_gets_one_slack_axis():
    grid = grid_over(Box(("x", "y"), (0.0, 0.0), (8.0, 4.0)), 4)
    assert grid.counts == (4, 4, 1)
    assert grid.thickness == grid.high[2] == 1.0  # the smaller step
    assert all(len(columns) == 2 for _, columns in grid.blocks())


def test_more_than_three_coordinates_are_refused():
    with pytest.raises(UsageError, match="1 to 3 coordinates, not 4"):
        grid_over(Box(tuple("abcd"), (0.0,) * 4, (1.0,) * 4), 4)


@pytest.mark.parametrize("size", [1, 2, 3])
def test_spread_points_stay_in_the_box_and_fill_it_better_than_chance(size):
    box = Box(tuple("xyz"[:size]), (-1.0,) * size, (3.0,) * size)
    rng = np.random.default_rng(3)
    points = box.spread(4096, rng)
    assert points.shape == (4096, size)
    assert np.all((points >= -1.0) & (points < 3.0))
    # the mean of (x - 1)^2 over [-1, 3] is 4/3; independent points would be off by 0.02 or so
    assert np.max(np.abs(np.mean((points - 1.0) ** 2, axis=0) - 4 / 3)) < 2e-3
