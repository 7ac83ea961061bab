"""Shapes: sizes at which they reach points and boxes."""

import math

import numpy as np
import pytest

from assur.errors import UsageError
from assur.workspace.certified.boxes import Boxes
from assur.workspace.certified.shapes import Shape, shape_about

RNG = np.random.default_rng(6)
SHAPES = [Shape(name, ("x", "y", "z"), (1.0, -2.0, 0.5), 0.4) for name in ("cube", "cylinder", "ball")]


def holds(shape, size, point):
    """Whether a shape of a size holds a point, from what the shape is."""
    x, y, z = np.abs(np.subtract(point, shape.centre))
    if shape.name == "cube":
        return max(x, y, z) <= size / 2
    if shape.name == "ball":
        return math.hypot(x, y, z) <= size / 2
    return math.hypot(x, y) <= size / 2 and z <= shape.ratio * size / 2


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: shape.name)
def test_the_size_at_which_a_point_is_reached(shape):
    points = RNG.normal(size=(3, 200)) * 3
    for point, size in zip(points.T, shape.size(points), strict=True):
        assert holds(shape, size * (1 + 1e-12), point)
        assert not holds(shape, size * (1 - 1e-12), point)


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: shape.name)
def test_no_point_of_a_box_is_reached_before_the_box(shape):
    ends = np.sort(RNG.normal(size=(2, 3, 100)) * 3, axis=0)
    touching = shape.touching(Boxes(ends[0], ends[1]))
    points = ends[0][..., None] + RNG.uniform(size=(3, 100, 50)) * (ends[1] - ends[0])[..., None]
    sizes = shape.size(points.reshape(3, -1)).reshape(100, 50)
    assert np.all(touching[:, None] <= sizes)
    nearest = np.clip(np.array(shape.centre)[:, None], ends[0], ends[1])
    np.testing.assert_allclose(touching, shape.size(nearest), rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: shape.name)
def test_the_box_around_holds_the_shape(shape):
    low, high = shape.around(3.0)
    outside = np.stack([high * 1.0, low * 1.0], axis=1)
    outside[:, 0] += 1e-9
    outside[:, 1] -= 1e-9
    assert np.all(shape.size(outside) > 3.0)
    for axis in range(3):
        face = np.array(shape.centre)[:, None]
        face[axis] = high[axis]
        assert shape.size(face)[0] >= 3.0


def test_misuse():
    with pytest.raises(UsageError, match="hold phi"):
        shape_about("cube", ("x", "y", "phi"), (0.0, 0.0, 0.0))
    with pytest.raises(UsageError, match="three lengths"):
        shape_about("cylinder", ("x", "y"), (0.0, 0.0))
    for centre in ((0.0,), {"x": 0.0}, {"x": 0.0, "q": 1.0}, (math.nan, 0.0)):
        with pytest.raises(UsageError, match="centre"):
            shape_about("ball", ("x", "y"), centre)
    for ratio in (0.0, -1.0, math.nan):
        with pytest.raises(UsageError, match="ratio"):
            shape_about("cylinder", ("x", "y", "z"), (0.0, 0.0, 0.0), ratio)
