"""Macaulay's matrices: forms times all monomials of a degree, a column for each monomial of their products."""

from __future__ import annotations

from functools import lru_cache
from itertools import combinations_with_replacement
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

Array = TypeVar("Array", NDArray[np.float64], NDArray[np.complex128])

Monomial = tuple[int, ...]
"""A product of homogeneous variables, by their indices in rising order."""


@lru_cache(maxsize=64)
def monomials(size: int, degree: int) -> tuple[Monomial, ...]:
    """All of a degree in so many variables.

    >>> monomials(2, 2)
    ((0, 0), (0, 1), (1, 1))
    """
    return tuple(combinations_with_replacement(range(size), degree))


@lru_cache(maxsize=64)
def places(size: int, degree: int) -> dict[Monomial, int]:
    """Number of each monomial of a degree."""
    return {monomial: number for number, monomial in enumerate(monomials(size, degree))}


def times(monomial: Monomial, *others: int) -> Monomial:
    """A monomial times variables."""
    return tuple(sorted((*monomial, *others)))


@lru_cache(maxsize=64)
def products(size: int, degree: int) -> NDArray[np.intp]:
    """Numbers (M, n, n) of the M monomials of a degree, times two variables, among those of degree + 2."""
    number = places(size, degree + 2)
    table = [
        [[number[times(row, first, second)] for second in range(size)] for first in range(size)]
        for row in monomials(size, degree)
    ]
    return np.array(table, dtype=np.intp).reshape(-1, size, size)


def macaulay_matrix(forms: Array, degree: int) -> Array:
    """Coefficients (r M, columns) of quadrics (r, n, n) times the M monomials of a degree less two.

    >>> macaulay_matrix(np.array([[[1.0, 0.0], [0.0, -1.0]]]), 3)  # x^3 - x y^2 and x^2 y - y^3
    array([[ 1.,  0., -1.,  0.],
           [ 0.,  1.,  0., -1.]])
    """
    size = forms.shape[-1]
    columns = products(size, degree - 2)
    rows = np.arange(len(columns))
    matrix = np.zeros((len(forms), len(rows), len(places(size, degree))), dtype=forms.dtype)
    for first in range(size):
        for second in range(size):
            matrix[:, rows, columns[:, first, second]] += forms[:, None, first, second]
    answer: Array = matrix.reshape(-1, matrix.shape[-1])
    return answer
