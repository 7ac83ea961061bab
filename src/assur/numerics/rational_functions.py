"""Whether numbers at many places are the values of one rational function."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

ComplexArray = NDArray[np.complex128]

MORE = 4
"""Places beyond as many as a rational function of a degree has coefficients."""
FITS = 1e-7
"""Smallest singular value, all conditions being of length 1, of a function that fits."""


def rational_degree(places: ComplexArray, values: ComplexArray) -> int | None:
    """The least degree of numerator and denominator of a rational function with these values (N,) at places (N,).

    None where there is none that `MORE` places would not refute. Polynomials are orthogonalised on the places, since
    powers are nearly dependent (P. Brubeck, Y. Nakatsukasa, L. N. Trefethen 2021).

    >>> places = np.exp(1j * np.arange(16)) * np.linspace(0.5, 1.0, 16)
    >>> rational_degree(places, (1 + places**2) / (3 - places))
    2
    >>> rational_degree(places, np.sqrt(places)) is None
    True
    """
    for degree in range((len(places) - MORE - 2) // 2 + 1):
        basis = _orthogonal_polynomials(places, degree)
        rows = np.concatenate([basis, -values[:, None] * basis], axis=1)
        rows /= np.linalg.norm(rows, axis=1, keepdims=True)
        if np.linalg.svd(rows, compute_uv=False)[-1] < FITS:
            return degree
    return None


def _orthogonal_polynomials(places: ComplexArray, degree: int) -> ComplexArray:
    """Values (N, degree + 1) of polynomials orthogonal on the places."""
    columns = [np.ones(len(places), dtype=complex)]
    for _ in range(degree):
        new = places * columns[-1]
        for _ in range(2):
            for column in columns:
                new = new - column * (column.conj() @ new) / len(places)
        columns.append(new * np.sqrt(len(places)) / np.linalg.norm(new))
    return np.stack(columns, axis=1)
