"""Loops solved in turn: the smallest set of unknowns that has as many equations, then the next.

Such a set is what the theory calls an Assur chain, found here in the equations themselves, special dimensions and all.
A set is solved completely, for all its complex roots. What is known by then enters as numbers, so that every real root
of one set is carried into the next.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.loops.circles import System
from assur.kinematics.loops.equations import RANK, roots_of_set, without
from assur.kinematics.loops.hinges import NotCirclesError
from assur.kinematics.loops.unknowns import UnknownGroup

ComplexArray = NDArray[np.complex128]

REAL = 1e-3
"""A root this near to a real one is tried as an assembly: parts of a double root come out some 1e-8 apart, of a
triple one 1e-5. What is tried in vain does not close."""
DOUBTFUL = 1e-6
"""An assembly of a root that is not real by more than this may be one of a double root, or none: not to be told."""
ACCURATE = 1e-8
"""Residual of scaled equations at their roots up to which the roots are believed."""
MOST_ITEMS = 14


@dataclass(frozen=True)
class Set:
    """Items (their numbers) that are solved together, and how many roots they have, complex and infinite ones too."""

    groups: tuple[int, ...]
    roots: int


@dataclass(frozen=True, eq=False)
class Solved:
    """Unknowns (K, 1 + c) made real, the first 1; by how much that bent them (K,); the sets; how many roots."""

    unknowns: ComplexArray
    bent: NDArray[np.float64]
    sets: tuple[Set, ...]
    looked: int


class CurveError(Exception):
    """A set (`groups`, their numbers) has infinitely many roots, or nearly so."""

    def __init__(self, groups: tuple[int, ...], error: float) -> None:
        super().__init__()
        self.groups = groups
        self.error = error


def solve(system: System) -> Solved:
    """All real solutions of the equations of the loops.

    Errors:
        NotCirclesError: sets that are too large, or lengths and angles that nothing determines.
        CurveError: a set with infinitely many roots, real or not.

    >>> from assur.kinematics.loops.circles import system
    >>> from assur.kinematics.loops.orientations import turnings
    >>> from assur.model.registry import load_record
    >>> record, locked = load_record("fivebar"), {0: 2.2, 1: 0.9}
    >>> found = solve(system(record, turnings(record, locked, None, parallel=())[0], locked, {}))
    >>> found.unknowns.shape, found.sets
    ((2, 5), (Set(groups=(0, 1), roots=2),))
    """
    slid = sorted(system.slides.values())
    if np.linalg.matrix_rank(system.matrix[:, slid], tol=RANK) < len(slid):
        raise NotCirclesError("some lengths are not determined")
    rows = without(system.matrix, slid)
    known = np.zeros((1, system.matrix.shape[1]), dtype=complex)
    known[0, 0] = 1.0
    bent = np.zeros(1)
    left = list(range(len(system.groups)))
    looked, sets = 0, []
    for chosen in _order(rows, system.groups):
        left = [number for number in left if number not in chosen]
        equations = without(rows, _columns(system.groups, left))
        groups = [system.groups[number] for number in chosen]
        roots = [roots_of_set(equations, row, groups) for row in known]
        real = [_real(part.values, row, groups) for part, row in zip(roots, known, strict=True)]
        bent = np.concatenate([np.maximum(own, before) for (_, own), before in zip(real, bent, strict=True)])
        known = np.concatenate([rows_of for rows_of, _ in real])
        looked += sum(len(part.values) for part in roots)
        worst = max(part.error for part in roots)
        if not all(part.isolated for part in roots) or worst > ACCURATE:
            raise CurveError(chosen, worst)
        sets.append(Set(chosen, roots[0].count))
        if not len(known):
            break
    if len(slid):
        known[:, slid] = -(np.linalg.pinv(system.matrix[:, slid]) @ (system.matrix @ known.T)).T
    return Solved(known, bent, tuple(sets), looked)


def _columns(groups: Sequence[UnknownGroup], numbers: Sequence[int]) -> list[int]:
    return [column for number in numbers for column in groups[number].columns]


def _order(rows: ComplexArray, groups: Sequence[UnknownGroup]) -> list[tuple[int, ...]]:
    if len(groups) > MOST_ITEMS:
        raise NotCirclesError(f"more than {MOST_ITEMS} links turn")
    left = list(range(len(groups)))
    order = []
    while left:
        order.append(_closed_set(rows, groups, left))
        left = [number for number in left if number not in order[-1]]
    return order


def _closed_set(rows: ComplexArray, groups: Sequence[UnknownGroup], left: Sequence[int]) -> tuple[int, ...]:
    """The smallest set of groups with as many linear equations as they need."""
    waiting = {groups[number].first for number in left}
    for size in range(1, len(left) + 1):
        for chosen in combinations(left, size):
            here = [groups[number] for number in chosen]
            inside = {group.first for group in here}
            if any(not group.alone and group.circle in waiting - inside for group in here):
                continue
            equations = without(rows, _columns(groups, [number for number in left if number not in chosen]))
            wanted = sum(group.freedoms for group in here)
            if np.linalg.matrix_rank(equations[:, _columns(groups, chosen)], tol=RANK) >= wanted:
                return chosen
    raise NotCirclesError("the loops do not determine all angles with what is locked")


def _real(
    values: ComplexArray, row: ComplexArray, groups: Sequence[UnknownGroup]
) -> tuple[ComplexArray, NDArray[np.float64]]:
    """Rows of unknowns with the real roots of one set filled in, made exactly real, and how far that moved each."""
    columns = [column for group in groups for column in group.columns]
    width = len(row)
    found = np.repeat(row[None], len(values), axis=0)
    found[:, columns] = values
    found = np.hstack([found, values])  # the roots as they were, at the end of each row
    for group in sorted(groups, key=lambda equations: equations.kind != "circle"):
        if group.kind == "triangle":
            good = np.max(np.abs(found[:, list(group.columns)].imag), axis=1) < REAL
            found = found[good]
            found[:, list(group.columns)] = found[:, list(group.columns)].real
            continue
        if group.kind == "ball":
            own = found[:, list(group.columns)]
            good = np.max(np.abs(own.imag), axis=1) < REAL
            found, own = found[good], own[good].real
            found[:, list(group.columns)] = own / np.linalg.norm(own, axis=1, keepdims=True)
            continue
        first, second = found[:, group.first], found[:, group.first + 1]
        good = np.abs(second - np.conj(first)) < REAL * (1.0 + np.abs(first))
        if group.kind == "circle":
            found, first = found[good], first[good]
            good = np.abs(np.abs(first) - 1.0) < REAL
            first = np.exp(1j * np.angle(first))
        elif not group.alone:
            found, first = found[good], first[good]
            share = (first / found[:, group.circle]).real * found[:, group.circle]
            good, first = np.abs(first - share) < REAL * (1.0 + np.abs(first)), share
        if group.kind == "rod":
            good &= np.abs(found[:, group.first + 2].imag) < REAL
            found[:, group.first + 2] = found[:, group.first + 2].real
        found[:, group.first], found[:, group.first + 1] = first, np.conj(first)
        found = found[good]
        if group.alone:  # the circle can be met from either side
            turned = np.exp(1j * np.angle(found[:, [group.first]]))
            both = [found.copy(), found.copy()]
            for part, sense in zip(both, (1.0, -1.0), strict=True):
                part[:, [group.circle]], part[:, [group.circle + 1]] = sense * turned, sense * np.conj(turned)
            found = np.concatenate(both)
    moved = np.abs(found[:, columns] - found[:, width:]) / (1.0 + np.abs(found[:, width:]))
    return found[:, :width], np.max(moved, axis=1, initial=0.0)
