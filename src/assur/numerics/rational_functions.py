"""Whether numbers at many places of the plane are the values of one rational function."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.numerics.monodromy import random_complex

ComplexArray = NDArray[np.complex128]

SPREAD = 2.0
"""Logarithm of how much farther away, or nearer, than 1 places are. On one circle a branch of a root is fitted better
and better from degree to degree, down to any size; not where there are places all around its branch points."""
SHARE = 3
"""So many times as many places as the degree, at least."""
NOISE = 1e-9
"""Largest singular value, of 1, that counts as zero."""
GAP = 1e-3
"""Largest share of the one before it: values without a law fall by factors of 2 to 50, the others by 10,000."""


def rational_degree(places: ComplexArray, values: ComplexArray) -> int | None:
    """The degree of the rational function with these values (N,) at places (N,); None where there is none.

    It is the rank of the matrix of divided differences between one half of the places and the other (K. Loewner; A. C.
    Antoulas, B. D. O. Anderson 1986), each row and column as on the sphere, where infinity is a place like others. Of a
    degree above a third of N nothing is told.

    >>> z = scattered(np.random.default_rng(0), 48)
    >>> rational_degree(z, (1 + z**2) / (3 - z)), rational_degree(z, z / z)
    (2, 0)
    >>> rational_degree(z, np.sqrt(z)) is None
    True
    """
    if len(values) < SHARE:
        return None
    scaled = values / max(float(np.median(np.abs(values))), float(np.finfo(float).tiny))
    (rows, columns), (one, other) = (np.split(part[: len(part) // 2 * 2], 2) for part in (places, scaled))
    differences = (one[:, None] - other) / (rows[:, None] - columns)
    differences *= (_stretched(rows) / _stretched(one))[:, None] * (_stretched(columns) / _stretched(other))
    sizes = np.linalg.svd(differences, compute_uv=False)
    sizes = np.concatenate([[1.0], sizes / max(1.0, sizes[0])])
    ends = (sizes[1:] < NOISE) & (sizes[1:] < GAP * sizes[:-1])
    degree = int(np.argmax(ends))
    return degree if ends[degree] and degree * SHARE <= len(values) else None


def scattered(rng: np.random.Generator, count: int) -> ComplexArray:
    """Places (count,) all around zero, near it and far away."""
    places = random_complex(rng, count)
    return np.asarray(places / np.abs(places) * np.exp(rng.uniform(-SPREAD, SPREAD, count)))


def _stretched(numbers: ComplexArray) -> NDArray[np.float64]:
    """By how much the plane is larger than the sphere at numbers (N,): the square root of it."""
    return np.asarray(np.sqrt(1.0 + np.abs(numbers) ** 2))
