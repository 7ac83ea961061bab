"""Whether numbers at many places on a circle are the values of one rational function."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

ComplexArray = NDArray[np.complex128]

SHARE = 4
"""So many times as many places as the degree: with half of them two branches of a root may look like one function."""
FITS = 1e-8
"""Smallest singular value, all conditions being of length 1, of a function that fits."""


def rational_degree(values: ComplexArray) -> int | None:
    """The least degree of numerator and denominator of a rational function with these values (N,) at circle(N).

    None where there is none of a degree below a quarter of N. On a circle no power is small where others are not, so
    that numbers without a law do not fit.

    >>> z = circle(16)
    >>> rational_degree((1 + z**2) / (3 - z))
    2
    >>> rational_degree(np.sqrt(z)) is None
    True
    """
    powers = circle(len(values))[:, None] ** np.arange(len(values) // SHARE)
    for degree in range(powers.shape[1]):
        basis = powers[:, : degree + 1]
        rows = np.concatenate([basis, -values[:, None] * basis], axis=1)
        rows /= np.linalg.norm(rows, axis=1, keepdims=True)
        if np.linalg.svd(rows, compute_uv=False)[-1] < FITS:
            return degree
    return None


def circle(count: int) -> ComplexArray:
    """Places (count,) all around the unit circle."""
    places: ComplexArray = np.exp(2j * np.pi * np.arange(count) / count)
    return places
