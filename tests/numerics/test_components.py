"""Small matrices by components, against the plain ones."""

from __future__ import annotations

import numpy as np
import pytest

from assur.numerics import components, rotations

RNG = np.random.default_rng(3)


@pytest.mark.parametrize("size", [0.0, 1e-9, 1e-5, 0.0099, 0.0101, 1.0, 3.1, 5.0])
@pytest.mark.parametrize("batch", [(), (7,), (2, 3)])
def test_rotations_are_those_of_rotation_vectors(size, batch):
    vector = RNG.normal(size=(*batch, 3))
    vector *= size / np.linalg.norm(vector, axis=-1, keepdims=True)
    np.testing.assert_allclose(components.from_vector(vector), rotations.from_vector(vector), atol=3e-15)
    axis = np.array([2.0, -1.0, 2.0]) / 3
    turned = components.about_axis(axis, vector[..., 0])
    np.testing.assert_allclose(turned, rotations.about_axis(axis, vector[..., 0]), atol=3e-15)


@pytest.mark.parametrize("size", [0.0, 1e-3, 0.0099, 0.0101, 0.5, 3.0])
def test_the_left_jacobian_is_the_rate_of_turning(size):
    vector = size * np.array([2.0, -1.0, 2.0]) / 3
    step = 1e-6
    for k, column in enumerate(components.left_jacobian(vector).T):
        ahead, behind = (components.from_vector(vector + sign * step * np.eye(3)[k]) for sign in (1, -1))
        np.testing.assert_allclose(rotations.to_vector(ahead @ behind.T) / (2 * step), column, atol=1e-9)


def test_products_are_those_of_numpy_and_keep_the_batch_last_in_memory():
    first, second = (components.from_vector(RNG.normal(size=(50, 3))) for _ in range(2))
    vector = RNG.normal(size=(50, 3))
    np.testing.assert_allclose(components.product(first, second), first @ second, atol=1e-15)
    back = components.product_turned_back(first, second)
    np.testing.assert_allclose(back, first @ second.swapaxes(1, 2), atol=1e-15)
    np.testing.assert_allclose(components.applied(first, vector), (first @ vector[..., None])[..., 0], atol=1e-15)
    crossed = np.cross(first, vector[..., None], axis=1)
    np.testing.assert_allclose(components.crossed(first, vector), crossed, atol=1e-15)
    assert components.product(first, second).strides[0] == 8
    assert components.zeros((50,), 6, 2).strides[0] == 8
    np.testing.assert_array_equal(components.by_components(vector), vector)
