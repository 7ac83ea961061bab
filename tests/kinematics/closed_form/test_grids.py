"""Grids: their parts are those of the whole, and boxes and counts that make none are refused."""

import numpy as np
import pytest

from assur.errors import UsageError
from assur.kinematics.closed_form.grids import Grid, grid_over
from exact_grids import exact_axis

COUNTS = (7, 5, 11)


@pytest.mark.parametrize("part", [slice(0, 385), slice(0, 1), slice(10, 12), slice(9, 300), slice(384, 385)])
def test_poses_of_a_part_are_those_of_the_whole(zeng, part):
    axes = [exact_axis(*zeng.box[name], count) for name, count in zip(zeng.platform.pose, COUNTS, strict=True)]
    poses = np.array([axis.ravel() for axis in np.meshgrid(*axes, indexing="ij")])
    np.testing.assert_array_equal(grid_over(zeng, COUNTS).poses(part), poses[:, part])


def test_grids_of_one_coordinate_and_of_one_place():
    np.testing.assert_array_equal(Grid(("x",), (0.0,), (4.0,), (5,)).poses(slice(1, 4)), [[1, 2, 3]])
    np.testing.assert_array_equal(Grid(("x", "y"), (0.0, 1.0), (4.0, 3.0), (1, 1)).poses(slice(0, 1)), [[2], [2]])


@pytest.mark.parametrize("counts", [(), (1, 1), (0, 1, 1), (1, 1, 1.5), (-3, 2, 2)])
def test_refuses_counts(zeng, counts):
    with pytest.raises(UsageError, match="counts"):
        grid_over(zeng, counts)


@pytest.mark.parametrize("limits", [(1.0, 0.0), (np.nan, 1.0), (0.0, np.inf)])
def test_refuses_boxes(zeng, limits):
    with pytest.raises(UsageError, match="box"):
        grid_over(zeng, (2, 2, 2), {"x": limits})
