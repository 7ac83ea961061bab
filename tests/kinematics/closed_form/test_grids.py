"""Grids: their parts are those of the whole."""

import numpy as np
import pytest

from assur.kinematics.closed_form.grids import Grid
from exact_grids import exact_axis

NAMES, COUNTS = ("x", "y", "z"), (7, 5, 11)
LOW, HIGH = (-110.0, -250.0, -420.0), (80.0, 100.0, 480.0)


@pytest.mark.parametrize("part", [slice(0, 385), slice(0, 1), slice(10, 12), slice(9, 300), slice(384, 385)])
def test_poses_of_a_part_are_those_of_the_whole(part):
    axes = [exact_axis(low, high, count) for low, high, count in zip(LOW, HIGH, COUNTS, strict=True)]
    poses = np.array([axis.ravel() for axis in np.meshgrid(*axes, indexing="ij")])
    np.testing.assert_array_equal(Grid(NAMES, LOW, HIGH, COUNTS).poses(part), poses[:, part])


def test_grids_of_one_coordinate_and_of_one_place():
    np.testing.assert_array_equal(Grid(("x",), (0.0,), (4.0,), (5,)).poses(slice(1, 4)), [[1, 2, 3]])
    np.testing.assert_array_equal(Grid(("x", "y"), (0.0, 1.0), (4.0, 3.0), (1, 1)).poses(slice(0, 1)), [[2], [2]])
