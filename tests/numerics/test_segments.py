"""Distances of segments against those of the same segments as convex bodies, parallel and crossing ones among them."""

import numpy as np

from assur.numerics.convex_distance import convex_distance
from assur.numerics.segments import segment_distances


def test_they_are_those_of_convex_bodies():
    rng = np.random.default_rng(4)
    for k in range(200):
        p, q, r, s = rng.integers(-2, 3, size=(4, 3)).astype(float) if k % 2 else rng.normal(size=(4, 3))
        found = float(segment_distances(p, q, r, s))
        wanted = convex_distance(np.array([p, q]), np.array([r, s]), np.eye(3)[None], np.zeros((1, 3)))[0]
        np.testing.assert_allclose(found, wanted, atol=1e-5)


def test_known_ones():
    x = np.array([1.0, 0, 0])
    parallel = segment_distances(0 * x, x, np.array([0.0, 2, 0]), np.array([1.0, 2, 0]))
    apart = segment_distances(0 * x, x, np.array([3.0, 0, 0]), np.array([4.0, 0, 0]))
    points = segment_distances(x, x, -x, -x)
    crossing = segment_distances(-x, x, np.array([0.0, -1, 0]), np.array([0.0, 1, 0]))
    np.testing.assert_allclose([parallel, apart, points, crossing], [2.0, 2.0, 2.0, 0.0], atol=1e-15)
