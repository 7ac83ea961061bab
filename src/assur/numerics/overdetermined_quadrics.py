"""Zeros of more quadrics than unknowns, away from where another quadric vanishes, by linear algebra.

Functionals of a degree that vanish on all multiples of the quadrics are spanned by the values at the zeros, wherever
these are isolated. Composed with "times the other quadric" they keep those at zeros where that does not vanish, and
lose the others, curves of them too. If as many are left at one degree as at the next one, they are all: the Hilbert
function of points grows until it stays. "Times x_i" acts on them with the zeros' x_i as eigenvalues.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.numerics.macaulay import macaulay_matrix, monomials, places, products, times
from assur.numerics.quadratic_systems import common_eigenvalues

ComplexArray = NDArray[np.complex128]
FloatArray = NDArray[np.float64]

DEGREES = (3, 4)
"""Those whose functionals are compared, once composed: at points, and at products of two of their coordinates."""
ZERO, NOT_ZERO = 1e-11, 1e-7
"""Singular values, as shares of the largest, up to where one counts as zero and from where it does not."""
STEPS = 4
"""Newton's, from eigenvalues."""


def zeros_apart(forms: FloatArray, other: FloatArray) -> ComplexArray | None:
    """All common zeros (k, n), of length 1, of quadrics (r, n, n) at which another one (n, n) is not zero.

    None where that is not known: ranks are in doubt, zeros meet, or there are more than n.

    >>> circle, x, y = np.diag([-25.0, 1, 1]), np.zeros((3, 3)), np.zeros((3, 3))
    >>> x[[0, 0, 1], [0, 1, 0]], y[[0, 0, 2], [0, 2, 0]] = (-6, 1, 1), (-8, 1, 1)  # x = 3 and y = 4, or at infinity
    >>> zeros = zeros_apart(np.array([circle, x, y]), np.diag([1.0, 0, 0]))
    >>> (zeros / zeros[:, :1]).real.round(6).tolist()
    [[1.0, 3.0, 4.0]]
    """
    size = forms.shape[-1]
    spaces = [_composed(forms, other, degree) for degree in DEGREES]
    if spaces[0] is None or spaces[1] is None or spaces[0].shape[1] != spaces[1].shape[1]:
        return None
    functionals = spaces[1].astype(complex)
    if not functionals.shape[1]:
        return np.zeros((0, size), dtype=complex)
    number = places(size, 2)
    shifted = [functionals[[number[times(row, index)] for row in monomials(size, 1)]] for index in range(size)]
    return _polished(forms, common_eigenvalues([shifted]).T)


def _composed(forms: FloatArray, other: FloatArray, degree: int) -> FloatArray | None:
    """Orthonormal basis (M, k) of what is left of the functionals of a degree, on monomials of two degrees less."""
    _, sizes, right = np.linalg.svd(np.linalg.qr(macaulay_matrix(forms, degree), mode="r"))
    rank = _rank(sizes)
    if rank is None:
        return None
    null = right[rank:].T
    left = np.einsum("mijk,ij->mk", null[products(other.shape[-1], degree - 2)], other)
    basis, sizes, _ = np.linalg.svd(left, full_matrices=False)
    rank = _rank(sizes)
    return None if rank is None else np.asarray(basis[:, :rank])


def _rank(sizes: FloatArray) -> int | None:
    """How many of these singular values are not zero; None where one may be or not."""
    shares = sizes / max(float(sizes[0]), ZERO) if len(sizes) else sizes
    return None if np.any((shares > ZERO) & (shares < NOT_ZERO)) else int(np.sum(shares >= NOT_ZERO))


def _polished(forms: FloatArray, zeros: ComplexArray) -> ComplexArray | None:
    """Zeros (k, n) to all digits, by least squares; None where one is none, or is not regular, or two are one."""
    zeros = zeros / np.linalg.norm(zeros, axis=1, keepdims=True)
    for _ in range(STEPS):
        slopes = 2 * np.einsum("rij,kj->kri", forms, zeros)
        values = 0.5 * np.einsum("kri,ki->kr", slopes, zeros)
        along = np.conj(zeros)[:, None]  # what changes a zero's length alone is left out
        zeros = zeros - np.einsum(
            "kir,kr->ki", np.linalg.pinv(np.concatenate([slopes, along], axis=1))[..., :-1], values
        )
        zeros = zeros / np.linalg.norm(zeros, axis=1, keepdims=True)
    sizes = np.linalg.svd(np.concatenate([slopes, along], axis=1), compute_uv=False)
    alike = np.abs(np.conj(zeros) @ zeros.T) - np.eye(len(zeros))
    sound = np.all(np.abs(values) < ZERO) and np.all(sizes[:, -1] > NOT_ZERO * sizes[:, 0])
    return zeros if sound and np.max(alike, initial=0.0) < 1.0 - NOT_ZERO else None
