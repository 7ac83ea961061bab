"""All roots of larger systems of quadratic equations, each followed from one of x_k^2 = r_k by a homotopy.

There are as many paths as n quadratic equations have roots at most, 2^n (Bezout). Where all of them end at roots that
are apart and regular, infinite ones among them, there are no others.
"""

from __future__ import annotations

from itertools import product

import numpy as np
from numpy.typing import NDArray

from assur.numerics.expanded import ExpandedSystem
from assur.numerics.homotopy import PathEnd, solve
from assur.numerics.monodromy import random_complex
from assur.numerics.quadratic_systems import AT_INFINITY, Roots

ComplexArray = NDArray[np.complex128]


def followed(forms: ComplexArray) -> Roots:
    """Roots of n quadratic equations (1, x)^T Q_k (1, x) = 0 in n unknowns, forms (n, n + 1, n + 1).

    They are not `isolated` where a path ends where roots meet, or nowhere; the values are some of the others.

    >>> forms = np.zeros((2, 3, 3), dtype=complex)
    >>> forms[0, [1, 2, 0], [1, 2, 0]] = 1, 1, -25  # x^2 + y^2 = 25
    >>> forms[1, [1, 0], [2, 0]] = 1, -12  # x y = 12
    >>> found = followed(forms)
    >>> sorted(found.values.real.round(9).tolist()), found.isolated
    ([[-4.0, -3.0], [-3.0, -4.0], [3.0, 4.0], [4.0, 3.0]], True)
    """
    size = forms.shape[-1]
    forms = forms / np.linalg.norm(forms, axis=(1, 2), keepdims=True)
    rng = np.random.default_rng(0)
    first = random_complex(rng, size - 1)
    start = np.zeros_like(forms)
    for k, value in enumerate(first):
        start[k, k + 1, k + 1], start[k, 0, 0] = 1.0, -(value**2)
    start *= random_complex(rng, size - 1)[:, None, None]
    rows, columns = np.triu_indices(size)
    ends = [
        (part + np.swapaxes(part, 1, 2))[:, rows, columns] / np.where(rows == columns, 2.0, 1.0)
        for part in (forms, start)
    ]
    coefficients = np.stack([ends[0], ends[1] - ends[0]])[None]
    system = ExpandedSystem(coefficients, np.stack([rows, columns], axis=1), size)
    signs = np.array(list(product((1.0, -1.0), repeat=size - 1)))
    found = solve(system, np.concatenate([np.ones((len(signs), 1)), signs * first], axis=1), all_regular=True)
    regular = found.end == PathEnd.regular
    x = found.x[regular]
    finite = x[np.abs(x[:, 0]) > AT_INFINITY]
    error = np.max(np.abs(np.einsum("na,kab,nb->nk", x, forms, x)), initial=0.0)
    return Roots(finite[:, 1:] / finite[:, :1], len(signs), bool(np.all(regular)), float(error))
