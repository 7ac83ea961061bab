"""All solutions of a generic member of a family of polynomial systems, from one: they change places round a loop.

Followed along a closed path of parameters that goes round the places where solutions meet, a solution comes back as
another one. Loops by chance reach every solution where the family is irreducible (Duff et al. 2019).
"""

from __future__ import annotations

import itertools
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from assur.numerics.expanded import ExpandedSystem
from assur.numerics.homotopy import PathEnd, distinct, follow

ComplexArray = NDArray[np.complex128]
Family = Callable[[ComplexArray, ComplexArray], ExpandedSystem]
"""(parameters at t = 1, at t = 0) -> the systems on the way."""
MOST_LOOPS = 60


def all_solutions(
    family: Family, parameters: ComplexArray, solution: ComplexArray, degree: int, rng: np.random.Generator
) -> ComplexArray:
    """Solutions (k, n) at complex parameters (q,), found from one (n,): k is `degree`, or fewer after many loops.

    Args:
        family: the systems on a straight way between two sets of parameters.
        parameters: generic and complex, of size about 1.
        solution: of the system at these parameters.
        degree: how many solutions there are.
        rng: chooses the loops.

    Example: the three roots of x^3 = q y^3.

    >>> from assur.numerics.expanded import expand, unknowns
    >>> def family(first, last):
    ...     x, y, t = unknowns(3)
    ...     q = last[0] + (first[0] - last[0]) * t
    ...     return expand([x * x * x - q * y * y * y])
    >>> found = all_solutions(family, np.array([1 + 0j]), np.array([1, 1 + 0j]), 3, np.random.default_rng(0))
    >>> np.sort_complex(found[:, 0] / found[:, 1]).round(9)
    array([-0.5-0.8660254j, -0.5+0.8660254j,  1. +0.j       ])
    """
    solutions = (solution / np.linalg.norm(solution))[None]
    for _ in range(MOST_LOOPS):
        corners = [parameters, *(random_complex(rng, len(parameters)) for _ in range(2)), parameters]
        x = solutions
        for first, last in itertools.pairwise(corners):
            ends = follow(family(first, last), x, np.zeros(len(x), dtype=int))
            x = ends.x[ends.end == PathEnd.regular]
        both = np.concatenate([solutions, x])
        solutions = both[distinct(both)]
        if len(solutions) >= degree:
            break
    return solutions


def random_complex(rng: np.random.Generator, count: int) -> ComplexArray:
    """Complex numbers (count,) of size about 1."""
    return np.asarray((rng.normal(size=count) + 1j * rng.normal(size=count)) / np.sqrt(2))
