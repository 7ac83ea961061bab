"""Unit vectors of a line, a plane or space: spread evenly, by chance, and in fans round others."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

NUMBER = {1: 2, 2: 120, 3: 96}
"""Directions that are spread over a line, a plane and space: neighbours are 3 deg and 21 deg apart."""

GOLDEN = (5**0.5 - 1) / 2


def directions(size: int) -> tuple[FloatArray, float]:
    """Unit vectors (D, k) spread over a line, a plane or space, and the angle between neighbours in rad.

    In space they lie on a spiral of golden angles, each on an equal share of the sphere.

    >>> spread, spacing = directions(3)
    >>> spread.shape, np.abs(spread.sum(axis=0)).max() < 0.5, round(spacing, 2)
    ((96, 3), np.True_, 0.36)
    """
    count = NUMBER[size]
    turns = 2 * np.pi * np.arange(count)
    if size == 1:
        return np.array([[1.0], [-1.0]]), 0.0
    if size == 2:
        return np.stack([np.cos(turns / count), np.sin(turns / count)], axis=-1), 2 * np.pi / count
    height = 1.0 - (2.0 * np.arange(count) + 1.0) / count
    angle, radius = turns * GOLDEN, np.sqrt(1.0 - height**2)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), height], axis=-1), (4 * np.pi / count) ** 0.5


def fans(centres: FloatArray, spread: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Unit vectors (N, 2 k, k) round centres (N, k), off by about spread (N,) rad: both ways along a chance basis."""
    axes = basis(rng, centres.shape[-1])
    vectors = centres[:, None] + spread[:, None, None] * np.concatenate([axes, -axes])
    return np.asarray(vectors / np.linalg.norm(vectors, axis=-1, keepdims=True))


def basis(rng: np.random.Generator, size: int) -> FloatArray:
    """An orthonormal basis (k, k) by chance."""
    return np.asarray(np.linalg.qr(rng.normal(size=(size, size)))[0])
