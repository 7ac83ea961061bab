"""How far sums of vectors reach that count between minus once and once each: the farthest vertex of a zonotope."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
APART = 1e-9
"""Share of the longest by which vectors are moved, so that no three lie in a plane; the sums are of those not moved."""


def farthest(vectors: FloatArray) -> FloatArray:
    """The longest sum (N,) of t vectors (N, t, 3) with signs.

    The farthest point v is a vertex, and its signs are those of its products with the vectors. A cone of directions
    with the same signs has an edge across two of the vectors; there these two alone have none. So signs across each
    pair, with all four of the pair, are all that can be.

    >>> farthest(np.array([[[3.0, 0.0, 0.0], [0.0, 4.0, 0.0]]]))
    array([5.])
    """
    count = vectors.shape[1]
    size = np.max(np.linalg.norm(vectors, axis=-1), axis=1, initial=0.0)[:, None, None]
    moved = vectors + APART * size * np.random.default_rng(0).normal(size=(count, 3))
    longest = np.linalg.norm(np.sum(vectors, axis=1), axis=-1)
    firsts, seconds = np.triu_indices(count, 1)
    for first, second in zip(firsts, seconds, strict=True):
        across = np.cross(moved[:, first], moved[:, second])
        signs = np.sign(np.einsum("nij,nj->ni", moved, across))
        signs[:, [first, second]] = 0.0
        rest = np.einsum("ni,nij->nj", signs, vectors)
        pair = vectors[:, first], vectors[:, second]
        for sense in (1.0, -1.0):
            either = pair[0] + sense * pair[1]
            ends = np.maximum(np.linalg.norm(rest + either, axis=-1), np.linalg.norm(rest - either, axis=-1))
            longest = np.maximum(longest, ends)
    return np.asarray(longest)
