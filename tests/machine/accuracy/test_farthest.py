"""The farthest vertex of a zonotope is the longest of all sums with signs."""

import itertools

import numpy as np
import pytest

from assur.machine.accuracy.farthest import farthest


@pytest.mark.parametrize("flat", [(), (2,), (1, 2)], ids=["space", "plane", "line"])
def test_it_is_the_longest_of_all_sums(flat):
    vectors = np.random.default_rng(3).normal(size=(5, 7, 3))
    vectors[..., list(flat)] = 0.0
    vectors[1, 2:] = vectors[1, :1]  # many the same
    signs = np.array(list(itertools.product([-1.0, 1.0], repeat=7)))
    every = np.linalg.norm(np.einsum("sk,nki->nsi", signs, vectors), axis=-1)
    np.testing.assert_allclose(farthest(vectors), every.max(axis=1), rtol=1e-12)


def test_one_vector_and_none():
    assert farthest(np.array([[[3.0, 4.0, 0.0]]])) == [5.0]
    assert farthest(np.zeros((2, 0, 3))).tolist() == [0.0, 0.0]
