"""The equations of one set of circles, rods and triangles, in the form of which all roots can be found and counted.

Planar loops are bilinear equations: the linear ones split into z's and z~'s. Other small sets are quadratic equations
in what the linear ones leave. In larger ones the circles may determine the rest, as in a platform on three circles;
with z~ = 1/z they are as many polynomials as there are circles, each of its own degree in every z. What is left is
quadratic again, and every root is followed from a known one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.loops.followed import followed
from assur.kinematics.loops.hinges import NotCirclesError
from assur.kinematics.loops.unknowns import UnknownGroup
from assur.numerics.multihomogeneous import MOST_MONOMIALS, monomial_count, multihomogeneous
from assur.numerics.quadratic_systems import Roots, bilinear, quadratic

ComplexArray = NDArray[np.complex128]

RANK = 1e-9
"""Singular values of equations below this count as zero; their coefficients are of order 1."""
MOST_QUADRATIC = 5
"""Equations whose null space has a few hundred columns."""
MOST_FOLLOWED = 7
"""Equations with 128 paths."""
MOST_LOOPS = 4


def roots_of_set(rows: ComplexArray, known: ComplexArray, groups: Sequence[UnknownGroup]) -> Roots:
    """All roots (N, c) of one set, in the order of its columns, with what is known already as numbers.

    Args:
        rows: (r, 1 + all columns) linear equations in which nothing else that is unknown occurs.
        known: (1 + all columns) the first 1; those of the set may be anything.
        groups: the set's.

    Errors:
        NotCirclesError: the set is too large, or roots that were followed meet.

    Example: 3 z + 3 z~ = 10 on a circle that need not be real.

    >>> found = roots_of_set(np.array([[-10, 3, 3]]), np.array([1, 0, 0]), [UnknownGroup("circle", 1, 1)])
    >>> sorted(found.values.real.round(6).tolist())
    [[0.333333, 3.0], [3.0, 0.333333]]
    """
    columns = [column for group in groups for column in group.columns]
    constant = rows @ np.where(np.isin(range(len(known)), columns), 0.0, known)
    linear = np.concatenate([constant[:, None], rows[:, columns]], axis=1)
    straight = [group for group in groups if group.kind in ("circle", "slider")]
    size = len(groups)
    if len(straight) == size and size % 2 == 0:
        halves = [list(range(1 + half, len(columns) + 1, 2)) for half in (0, 1)]
        splits = [independent(without(linear, halves[1 - half])) for half in (0, 1)]
        if all(len(part) == size // 2 for part in splits):
            return _bilinear(
                groups, known, columns, [part[:, [0, *own]] for part, own in zip(splits, halves, strict=True)]
            )
    count = sum(len(group.quadratic) for group in groups)
    linear = _as_many(independent(linear), sum(group.freedoms for group in groups))
    roots = _on_circles(groups, known, columns, linear) if count > MOST_QUADRATIC else None
    if roots is not None:
        return roots
    if count > MOST_FOLLOWED:
        raise NotCirclesError(f"more than {MOST_FOLLOWED} quadratic equations must be solved at once")
    basis = _affine_basis(linear)
    places = {column: basis[1 + place] for place, column in enumerate(columns)}
    forms = _forms(groups, known, places, places, basis[0], basis[0])
    roots = quadratic(forms) if count <= MOST_QUADRATIC else followed(forms)
    if count > MOST_QUADRATIC and not roots.isolated:
        raise NotCirclesError(f"not all {roots.count} roots of {count} quadratic equations are regular and apart")
    return replace(roots, values=(_with_one(roots.values) @ basis.T)[:, 1:])


def _bilinear(
    groups: Sequence[UnknownGroup], known: ComplexArray, columns: Sequence[int], splits: Sequence[ComplexArray]
) -> Roots:
    """Roots of a set of planar loops."""
    if len(groups) // 2 > MOST_LOOPS:
        raise NotCirclesError(f"more than {MOST_LOOPS} planar loops must be solved at once")
    bases = [_affine_basis(part) for part in splits]
    first, second = ({c: bases[half][1 + k] for k, c in enumerate(columns[half::2])} for half in (0, 1))
    roots = bilinear(_forms(groups, known, first, second, bases[0][0], bases[1][0]))
    size = roots.values.shape[1] // 2
    parts = (roots.values[:, :size], roots.values[:, size:])
    halves = [(_with_one(part) @ basis.T)[:, 1:] for part, basis in zip(parts, bases, strict=True)]
    return replace(roots, values=np.stack(halves, axis=-1).reshape(len(parts[0]), len(columns)))


def _on_circles(
    groups: Sequence[UnknownGroup], known: ComplexArray, columns: Sequence[int], linear: ComplexArray
) -> Roots | None:
    """Roots of a set whose circles determine the rest: with z~ = 1/z, as many polynomials as there are circles.

    None where they do not, or where the polynomials are too large.
    """
    turning = [column for group in groups if group.kind == "circle" for column in group.columns]
    there = [0, *(1 + place for place, column in enumerate(columns) if column in turning)]
    others = [1 + place for place, column in enumerate(columns) if column not in turning]
    if not len(linear) == len(others) == np.linalg.matrix_rank(linear[:, others], tol=RANK):
        return None
    basis = np.zeros((1 + len(columns), len(there)), dtype=complex)
    basis[there] = np.eye(len(there))
    basis[others] = -np.linalg.pinv(linear[:, others]) @ linear[:, there]
    places = {column: basis[1 + place] for place, column in enumerate(columns)}
    rest = [group for group in groups if group.kind != "circle"]
    equations = [_powers(form) for form in _forms(rest, known, places, places, basis[0], basis[0])]
    if any(np.max(np.abs(part)) < RANK for part in equations):
        return None
    if monomial_count(np.array([part.shape for part in equations]) - 1) > MOST_MONOMIALS:
        return None
    roots = multihomogeneous(equations)
    whole = np.stack([roots.values, 1.0 / roots.values], axis=-1).reshape(len(roots.values), len(turning))
    return replace(roots, values=(_with_one(whole) @ basis.T)[:, 1:])


def _powers(form: ComplexArray) -> ComplexArray:
    """Coefficients, power by power of z, of a quadratic form on (1, z, 1/z, ...), times the smallest powers needed."""
    size = len(form) // 2
    steps = np.zeros((len(form), size), dtype=int)
    steps[range(1, len(form)), np.repeat(range(size), 2)] = np.tile([1, -1], size)
    found = np.zeros((5,) * size, dtype=complex)
    np.add.at(found, tuple(np.moveaxis(2 + steps[:, None] + steps[None], -1, 0)), form)
    used = np.nonzero(np.abs(found) >= RANK * np.max(np.abs(found)))
    return found[tuple(slice(axis.min(), axis.max() + 1) for axis in used)]


def _as_many(rows: ComplexArray, count: int) -> ComplexArray:
    """So many equations that follow from more of them: no root is lost, and false ones do not close."""
    if len(rows) == count:
        return rows
    mixing = np.random.default_rng(0).normal(size=(count, len(rows)))
    return np.asarray(mixing @ rows)


def _affine_basis(rows: ComplexArray) -> ComplexArray:
    """Basis (1 + c, 1 + k), columns (1, a solution) and (0, directions), of rows (r, 1 + c) times (1, x) = 0."""
    *_, vectors = np.linalg.svd(rows[:, 1:])
    directions = vectors[len(rows) :].conj().T
    basis = np.zeros((rows.shape[1], 1 + directions.shape[1]), dtype=complex)
    basis[0, 0] = 1.0
    basis[1:, 0] = -np.linalg.pinv(rows[:, 1:]) @ rows[:, 0]
    basis[1:, 1:] = directions
    return basis


Places = dict[int, ComplexArray]
"""Column -> its row of a basis."""


def _forms(
    groups: Sequence[UnknownGroup],
    known: ComplexArray,
    first: Places,
    second: Places,
    one: ComplexArray,
    other_one: ComplexArray,
) -> ComplexArray:
    """The quadratic equations of a set as forms on coordinates, columns outside it being numbers."""
    forms = []
    for group in groups:
        for equation in group.quadratic:
            terms = [
                factor * np.outer(first.get(a, known[a] * one), second.get(b, known[b] * other_one))
                for factor, a, b in equation
            ]
            forms.append(np.sum(terms, axis=0))
    return np.array(forms)


def _with_one(values: ComplexArray) -> ComplexArray:
    return np.concatenate([np.ones((len(values), 1)), values], axis=1)


def without(rows: ComplexArray, columns: Sequence[int]) -> ComplexArray:
    """Orthonormal combinations of rows in which these columns do not occur."""
    if not len(columns) or not len(rows):
        return rows
    left, singular, _ = np.linalg.svd(rows[:, list(columns)])
    return np.asarray(left[:, int(np.sum(singular > RANK)) :].conj().T @ rows)


def independent(rows: ComplexArray) -> ComplexArray:
    """Rows orthonormal on the unknowns with the same span there; the constants, in column 0, come along."""
    left, singular, _ = np.linalg.svd(rows[:, 1:], full_matrices=False)
    rank = int(np.sum(singular > RANK))
    return np.asarray((left[:, :rank].conj().T @ rows) / singular[:rank, None])
