"""All roots of small systems of quadratic equations, by the null space of a Macaulay matrix.

Each equation is multiplied by every monomial up to a degree at which the null space of the coefficients has as many
dimensions as the system has roots, counted with multiplicity and at infinity. The null space is spanned by the
monomials at the roots, so that "times x_i" acts on it as a matrix whose eigenvalues are the x_i of the roots. These
matrices commute; one Schur form makes all of them triangular, which holds for double roots too. A random rotation of
the homogeneous variables keeps roots at infinity apart. Null space of another dimension: a curve of roots.
(Dreesen, Batselier, De Moor 2012; Wampler 2001 for planar loops as bilinear equations.)
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.numerics.macaulay import macaulay_matrix, monomials, places, times

ComplexArray = NDArray[np.complex128]

NULL = 1e-10
"""Singular values below this share of the largest count as zero; double roots do not bring them near it."""
VANISHING = 1e-12
"""Norm of a form, coefficients being of order 1, that is rounding."""
LINEAR = 1e-9
"""Quadratic parts of equations below this share of their largest coefficient are none."""
AT_INFINITY = 1e-9
"""A root whose homogeneous coordinate is below this share of its largest one is at infinity."""

TRIANGULAR = 1e-13
"""Share of a matrix's norm below which what is under its diagonal is rounding: some times that of Schur's own form."""


@dataclass(frozen=True, eq=False)
class Roots:
    """Roots (N, n), a multiple one as often as it counts, and the number that theory gives, infinity included.

    `isolated` is false where there are curves of roots; then `values` is empty. `error` is the largest residual of
    an equation at a root, equation and root scaled to norm 1; the roots are only as good as that.
    """

    values: ComplexArray
    count: int
    isolated: bool
    error: float = 0.0


def quadratic(forms: ComplexArray) -> Roots:
    """Roots of n quadratic equations (1, x)^T Q_k (1, x) = 0 in n unknowns, forms (n, n + 1, n + 1).

    There are 2^m of them, m the number of equations that stay quadratic when these are combined.

    >>> forms = np.zeros((2, 3, 3), dtype=complex)
    >>> forms[0, [1, 2, 0], [1, 2, 0]] = 1, 1, -25  # x^2 + y^2 = 25
    >>> forms[1, 0, 1], forms[1, 0, 2], forms[1, 0, 0] = 1, -1, 1  # x - y + 1 = 0
    >>> found = quadratic(forms)
    >>> sorted(found.values.real.round(9).tolist()), found.count
    ([[-4.0, -3.0], [3.0, 4.0]], 2)
    """
    forms, chart = _without_common_parts((forms + np.swapaxes(forms, 1, 2)) / 2)
    size = forms.shape[-1]
    if len(forms) < size - 1:
        return Roots(np.zeros((0, len(chart) - 1), dtype=complex), 2 ** (size - 1), isolated=False)
    if size == 1:
        return Roots(chart.T[:, 1:], 1, isolated=True)
    turn = _unitary(size)
    turned = np.einsum("ia,kij,jb->kab", turn, forms, turn)
    degree = size  # n (2 - 1) + 1, with n = size - 1
    found = _roots(macaulay_matrix(turned, degree), 2 ** (size - 1), size, degree, 1)
    if found is None:
        return Roots(np.zeros((0, len(chart) - 1), dtype=complex), 2 ** (size - 1), isolated=False)
    whole = found @ turn.T
    kept = whole[_finite(whole)]
    values = (kept / kept[:, :1]) @ chart.T[:, 1:]
    return Roots(values, 2 ** (size - 1), isolated=True, error=_error(forms, whole, whole))


def _without_common_parts(forms: ComplexArray) -> tuple[ComplexArray, ComplexArray]:
    """Fewer forms in fewer unknowns, and the chart (1 + n, 1 + k) back.

    Combinations of equations whose quadratic parts cancel, as in the difference of two spheres, are linear: they
    take unknowns away, and with them whole curves of roots at infinity. A form that vanishes is left out.
    """
    chart = np.eye(forms.shape[-1], dtype=complex)
    while True:
        sizes = np.linalg.norm(forms, axis=(1, 2))
        forms = forms[sizes > VANISHING] / sizes[sizes > VANISHING, None, None]
        left, singular, _ = np.linalg.svd(forms[:, 1:, 1:].reshape(len(forms), -1))
        rank = int(np.sum(singular > LINEAR))
        if rank == len(forms):
            return forms, chart
        mixed = np.einsum("kj,kab->jab", left.conj(), forms)
        linear = np.concatenate([mixed[rank:, 0, :1], 2 * mixed[rank:, 0, 1:]], axis=1)
        _, sizes, vectors = np.linalg.svd(linear[:, 1:])
        if np.any(sizes < LINEAR):
            return forms, chart
        step = np.zeros((forms.shape[-1], forms.shape[-1] - len(linear)), dtype=complex)
        step[0, 0] = 1.0
        step[1:, 0] = -np.linalg.pinv(linear[:, 1:]) @ linear[:, 0]
        step[1:, 1:] = vectors[len(linear) :].conj().T
        forms = np.einsum("ai,kab,bj->kij", step, mixed[:rank], step)
        chart = chart @ step
        if not rank:
            return forms, chart


def bilinear(forms: ComplexArray) -> Roots:
    """Roots (x, y) of 2 m bilinear equations (1, x)^T B_k (1, y) = 0 in m + m unknowns, forms (2 m, m + 1, m + 1).

    There are C(2 m, m) of them: for m planar loops, at most so many assemblies.

    >>> forms = np.array([[[-1, 0], [0, 1]], [[0, 1], [1, -3]]], dtype=complex)  # x y = 1, x + y = 3 x y
    >>> sorted(bilinear(forms).values.real.round(6).tolist())
    [[0.381966, 2.618034], [2.618034, 0.381966]]
    """
    size = forms.shape[-1]
    loops = size - 1
    count = math.comb(2 * loops, loops)
    if np.any(np.linalg.norm(forms, axis=(1, 2)) <= VANISHING):
        return Roots(np.zeros((0, 2 * loops), dtype=complex), count, isolated=False)
    turn, other = _unitary(size), _unitary(size, seed=1)
    turned = np.einsum("ia,kij,jb->kab", turn, forms, other)
    degree = 1 if loops == 1 else loops + 1  # so that one degree lower the roots are independent already
    rows, columns = monomials(size, degree - 1), places(size, degree)
    matrix = np.zeros((len(forms), len(rows), len(columns), size), dtype=complex)
    for number, row in enumerate(rows):
        for first in range(size):
            matrix[:, number, columns[times(row, first)]] += turned[:, first]
    found = _roots(matrix.reshape(len(forms) * len(rows), -1), count, size, degree, size)
    if found is None:
        return Roots(np.zeros((0, 2 * loops), dtype=complex), count, isolated=False)
    pencil = np.einsum("na,kab->nkb", found, turned)
    *_, last = np.linalg.svd(pencil)
    pairs = np.concatenate([found @ turn.T, last[:, -1].conj() @ other.T], axis=1)
    x, y = pairs[:, :size], pairs[:, size:]
    error = _error(forms, x, y)
    finite = _finite(x) & _finite(y)
    x, y = x[finite], y[finite]
    values = np.concatenate([x[:, 1:] / x[:, :1], y[:, 1:] / y[:, :1]], axis=1)
    return Roots(values, count, isolated=True, error=error)


def _roots(matrix: ComplexArray, count: int, size: int, degree: int, inner: int) -> ComplexArray | None:
    """Homogeneous coordinates (count, size) of the roots; None where the null space has another dimension."""
    null = null_space(matrix, count)
    if null is None:
        return None
    null = null.reshape(-1, inner, count)
    numbers = places(size, degree)
    shifted = [
        null[[numbers[times(row, index)] for row in monomials(size, degree - 1)]].reshape(-1, count)
        for index in range(size)
    ]
    return common_eigenvalues([shifted]).T


def null_space(matrix: ComplexArray, count: int) -> ComplexArray | None:
    """Orthonormal basis (columns, count) of the null space of a matrix; None where it has another dimension."""
    scale = np.linalg.norm(matrix, axis=1, keepdims=True)
    triangle = np.linalg.qr(matrix / np.where(scale > 0, scale, 1.0), mode="r")
    *_, singular, rows = np.linalg.svd(triangle)
    rank = int(np.sum(singular > NULL * singular[0]))
    return rows[rank:].conj().T if rows.shape[0] - rank == count else None


def common_eigenvalues(groups: Sequence[Sequence[ComplexArray]]) -> ComplexArray:
    """Homogeneous coordinates (all coordinates, roots) of the roots, of several points each: projective spaces.

    A group has, for each coordinate of a point, what the null space holds of the monomials times that coordinate.
    """
    size = sum(map(len, groups))
    times = []
    for group in groups:
        weights = _unitary(len(group), seed=2)[0]
        below = np.linalg.pinv(sum(weight * part for weight, part in zip(weights, group, strict=True)))
        times += [below @ part for part in group]
    mixed = sum(weight * part for weight, part in zip(_unitary(size, seed=2)[1], times, strict=True))
    basis = _triangular_basis(mixed)
    return np.stack([np.diag(basis.conj().T @ part @ basis) for part in times])


def _triangular_basis(matrix: ComplexArray) -> ComplexArray:
    """A unitary basis in which a matrix (n, n) is upper triangular: of its eigenvectors where these are apart.

    SciPy's takes as long to load as all of a short answer.
    """
    basis = np.linalg.qr(np.linalg.eig(matrix)[1])[0]
    if np.max(np.abs(np.tril(basis.conj().T @ matrix @ basis, -1)), initial=0.0) > TRIANGULAR * np.linalg.norm(matrix):
        from scipy.linalg import schur

        basis = schur(matrix, output="complex")[1]
    return np.asarray(basis)


def _error(forms: ComplexArray, x: ComplexArray, y: ComplexArray) -> float:
    sizes = np.linalg.norm(forms, axis=(1, 2)) * (np.linalg.norm(x, axis=1) * np.linalg.norm(y, axis=1))[:, None]
    return float(np.max(np.abs(np.einsum("na,kab,nb->nk", x, forms, y)) / sizes, initial=0.0))


def _finite(roots: ComplexArray) -> NDArray[np.bool_]:
    return np.asarray(np.abs(roots[:, 0]) > AT_INFINITY * np.max(np.abs(roots), axis=1))


@lru_cache(maxsize=64)
def _unitary(size: int, seed: int = 0) -> ComplexArray:
    """A fixed random unitary matrix."""
    random = np.random.default_rng([size, seed])
    q, _ = np.linalg.qr(random.normal(size=(size, size)) + 1j * random.normal(size=(size, size)))
    return q
