"""All roots of n polynomials in n unknowns, each of its own degree in every unknown: points on n projective lines.

Three distances between points on three circles have degree 2 in two unknowns z each: 16 roots, where quadratic
equations in z and z~ have 64, of which 48 are at infinity. Each equation is multiplied by every monomial up to the
degree d_k = (sum of its degrees in unknown k) - 1. By the Koszul complex the null space of the coefficients has as
many dimensions there as the system has roots, the permanent of the degrees (Bernstein, Bezout), counted with
multiplicity and at infinity, unless there is a curve of them; and the monomials with one power less of an unknown that
occurs in two equations tell them apart (of one that occurs in a single equation, d_k is one more).
So the roots are the common eigenvalues of n commuting matrices, as in `roots`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import permutations, product

import numpy as np
from numpy.typing import NDArray

from assur.numerics.quadratic_systems import AT_INFINITY, Roots, common_eigenvalues, null_space

ComplexArray = NDArray[np.complex128]
MOST_MONOMIALS = 1500
"""The null space of so many columns takes seconds."""


def root_count(degrees: NDArray[np.intp]) -> int:
    """Number of roots of equations of degrees (n, n), equation by unknown: the permanent.

    >>> root_count(np.array([[2, 2, 0], [0, 2, 2], [2, 0, 2]]))
    16
    """
    size = len(degrees)
    return int(sum(math.prod(degrees[range(size), order]) for order in map(list, permutations(range(size)))))


def monomial_count(degrees: NDArray[np.intp]) -> int:
    """Number of monomials among which `multihomogeneous` looks for the null space."""
    return math.prod(_shape(degrees))


def _shape(degrees: NDArray[np.intp]) -> tuple[int, ...]:
    """Powers of each unknown, 0 to d_k: one more where it occurs in a single equation."""
    single = np.sum(degrees > 0, axis=0) <= 1
    return tuple(int(total) for total in np.sum(degrees, axis=0) + single)


def multihomogeneous(equations: Sequence[ComplexArray]) -> Roots:
    """Roots of n equations, the coefficients of each (e_1 + 1, ..., e_n + 1), power by power of every unknown.

    Roots that are 0 or infinite in some unknown are left out of the values, not of the count.

    >>> meet = np.array([[-2, 0], [0, 1]])  # x y = 2
    >>> line = np.array([[3, -1], [-1, 0]])  # x + y = 3
    >>> found = multihomogeneous([meet, line])
    >>> sorted(found.values.real.round(9).tolist()), found.count
    ([[1.0, 2.0], [2.0, 1.0]], 2)
    """
    equations = [np.asarray(part, dtype=complex) / np.linalg.norm(part) for part in equations]
    degrees = np.array([part.shape for part in equations]) - 1
    count, size = root_count(degrees), len(equations)
    shape = _shape(degrees)
    none = np.zeros((0, size), dtype=complex)
    null = null_space(_multiples(equations, shape), count)
    if null is None:
        return Roots(none, count, isolated=False)
    if not count:
        return Roots(none, 0, isolated=True)
    null = null.reshape(*shape, count)
    pairs = common_eigenvalues([_divided(null, axis) for axis in range(size)]).reshape(size, 2, count)
    pairs = pairs / np.linalg.norm(pairs, axis=1, keepdims=True)
    finite = np.all(np.min(np.abs(pairs), axis=1) > AT_INFINITY, axis=0)
    values = (pairs[:, 1] / pairs[:, 0])[:, finite].T
    return Roots(values, count, isolated=True, error=_error(equations, pairs))


def _multiples(equations: Sequence[ComplexArray], shape: Sequence[int]) -> ComplexArray:
    """Coefficients of the products of all equations with monomials that have no more powers than `shape`."""
    rows = []
    for part in equations:
        for start in product(*(range(whole - own + 1) for whole, own in zip(shape, part.shape, strict=True))):
            row = np.zeros(shape, dtype=complex)
            row[tuple(slice(first, first + own) for first, own in zip(start, part.shape, strict=True))] = part
            rows.append(row.ravel())
    return np.array(rows)


def _divided(null: ComplexArray, axis: int) -> list[ComplexArray]:
    """The null space at the monomials that 1, and that the unknown, divides: (monomials one degree lower, roots)."""
    parts = np.delete(null, -1, axis), np.delete(null, 0, axis)
    return [part.reshape(-1, null.shape[-1]) for part in parts]


def _error(equations: Sequence[ComplexArray], pairs: ComplexArray) -> float:
    """The largest value of an equation of norm 1 at a root, of which every pair (n, 2, roots) has norm 1."""
    worst = 0.0
    for part in equations:
        value = np.repeat(part[..., None], pairs.shape[-1], axis=-1)
        for own in pairs:
            powers = np.arange(len(value))[:, None]
            monomials = own[0] ** (len(value) - 1 - powers) * own[1] ** powers
            value = np.einsum("k...r,kr->...r", value, monomials)
        worst = max(worst, float(np.max(np.abs(value), initial=0.0)))
    return worst
