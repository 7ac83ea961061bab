from __future__ import annotations

import numpy as np

from assur.numerics import sparse_vectors, vectors
from assur.numerics.intervals.interval import Interval


def test_the_algebra_is_that_of_vectors():
    rng = np.random.default_rng(1)
    for _ in range(100):
        a, b = (tuple(rng.choice([0, 1, -1, 0.5, 2.25], 3).tolist()) for _ in range(2))
        first, second = (tuple(tuple(rng.choice([0, 1, -1, 0.5], 3).tolist()) for _ in range(3)) for _ in range(2))
        assert sparse_vectors.add(a, b) == vectors.add(a, b)
        assert sparse_vectors.subtract(a, b) == vectors.subtract(a, b)
        assert sparse_vectors.dot(a, b) == vectors.dot(a, b)
        assert sparse_vectors.cross(a, b) == vectors.cross(a, b)
        assert sparse_vectors.scaled(a, 0.5) == vectors.scaled(a, 0.5)
        assert sparse_vectors.apply(first, a) == vectors.apply(first, a)
        assert sparse_vectors.product(first, second) == vectors.product(first, second)


def test_integer_zeros_stay_exact_beside_intervals():
    x = Interval.of(0.1)
    found = sparse_vectors.product(((x, 0, 0), (0, 1, 0), (0, 0, 1)), ((1, 0, 0), (0, x, 0), (0, 0, 1)))
    assert [[type(entry) for entry in row] for row in found] == [
        [Interval, int, int],
        [int, Interval, int],
        [int, int, int],
    ]
    assert found[0][0] is x
