"""A moved shape is the same solid elsewhere; what is written of a shape makes it anew."""

import numpy as np
import pytest

from assur.numerics import rotations
from assur.scene.shapes import Ball, Bar, Cuboid, Cylinder, Slab

SHAPES = (
    Cylinder(np.array([0.0, 1, 2]), np.array([3.0, 1, 0]), 0.4),
    Ball(np.array([1.0, 2, 3]), 0.7),
    Cuboid(np.array([1.0, 0, 0]), np.diag([1.0, 2.0, 3.0])),
    Bar(np.zeros(3), np.array([2.0, 0, 0]), np.array([0.0, 0, 1]), 0.3, 0.1),
    Slab(np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]), np.array([0.0, 0, 0.5])),
)
TURN = rotations.from_vector(np.array([0.3, -1.1, 0.7]))


def volume(mesh):
    a, b, c = np.moveaxis(mesh.corners, 1, 0)
    return np.sum(a * np.cross(b, c)) / 6


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: shape.kind)
def test_a_moved_shape_has_the_moved_middle_and_the_same_volume(shape):
    here, there = shape.mesh("#102030"), shape.moved(TURN, np.array([5.0, 6, 7])).mesh("#102030")
    assert volume(there) == pytest.approx(volume(here), rel=1e-9)
    low, high = here.corners.min(axis=(0, 1)), here.corners.max(axis=(0, 1))
    back = (there.corners - [5.0, 6, 7]) @ TURN
    if shape.kind in ("box", "bar", "slab"):  # round ones turn about their axis as they like
        np.testing.assert_allclose([back.min(axis=(0, 1)), back.max(axis=(0, 1))], [low, high], atol=1e-9)
    else:
        np.testing.assert_allclose(back.mean(axis=(0, 1)), here.corners.mean(axis=(0, 1)), atol=1e-9)


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: shape.kind)
def test_what_is_written_makes_it_anew(shape):
    plain = shape.to_json()
    assert plain.pop("kind") == shape.kind
    again = type(shape)(
        **{name: np.array(value) if isinstance(value, list) else value for name, value in plain.items()}
    )
    np.testing.assert_array_equal(again.mesh("#000000").corners, shape.mesh("#000000").corners)
