"""Parasitic motion: elements of a POC set that depend on the others wherever on the platform one looks.

At a point p the rotations move the platform by V + W x p beside its pure translations; t + r - dim is the rank of that
part. It is zero at some point of the platform, or seen the other way round at some point of the base, where the motion
is one of a virtual chain: a U moves its centre in no direction, a limb P U in one, and U P the base's centre.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from assur.numerics.least_squares import minimise
from assur.topology.screws.linkage import Linkage
from assur.topology.screws.screws import screw_tree
from assur.topology.screws.twists import in_platform

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.intp]

STARTS = 24
"""Points by chance from which a better one is looked for, in lengths of the linkage."""

ZERO = 1e-9
"""Determinants of parts of unit twists below this are zero."""


def parasitic_elements(linkage: Linkage, values: FloatArray, space: FloatArray) -> int:
    """How many elements of the platform's motion are parasitic.

    Args:
        linkage: assembled at home.
        values: (N, n) generic configurations.
        space: (N, 6, k) the platform's motions there.

    Returns:
        0 where all elements are independent at some point of the platform, or of the base for the inverse motion; else
        the least t + r - dim over the platform's points. A point that no start by chance leads to would be missed.

    >>> from assur.topology.notation import parse_chains
    >>> from assur.topology.screws.placing import place
    >>> from assur.topology.analysis import sample
    >>> for text in ("P[x] U[x,y]", "U[x,y] P[z]", "R[x] R[y]"):
    ...     home = sample(place(parse_chains([text])))
    ...     print(text, parasitic_elements(home.linkage, home.values, home.space))
    P[x] U[x,y] 0
    U[x,y] P[z] 0
    R[x] R[y] 1
    """
    least = least_dependent(in_platform(linkage, values, space))
    return 0 if least and not least_dependent(_at_base(linkage, values, space), most=0) else least


def _at_base(linkage: Linkage, values: FloatArray, space: FloatArray) -> FloatArray:
    """A motion space (N, 6, k) with velocities at the base's point that O' is at home."""
    tree = screw_tree(linkage)
    points = tree.at(values / tree.scales).frames[:, tree.frames[linkage.platform], :3, 3]
    return np.concatenate([space[:, :3], space[:, 3:] - np.cross(space[:, :3], points[..., None], axis=1)], axis=1)


def least_dependent(space: FloatArray, most: int = 3) -> int:
    """Least t + r - dim over the points of the frame that twists (N, 6, k) stand in, `most` + 1 where it is above.

    >>> sphere = np.concatenate([np.eye(3), np.cross([1.0, 2.0, 3.0], np.eye(3))], axis=1).T
    >>> least_dependent(np.stack([sphere] * 2))
    0
    """
    parts = [_rotating(twists) for twists in space]
    largest: int = min(min(part.moved.shape) for part in parts)
    for dependent in range(min(largest, most + 1)):
        if _has_point(parts, dependent):
            return dependent
    return min(largest, most + 1)


@dataclass(frozen=True, eq=False)
class _Part:
    """What rotations move, less pure translations: `moved` (c, r) at the origin, by a unit of p `shares` (3, c, r)."""

    moved: FloatArray
    shares: FloatArray

    def at(self, points: FloatArray) -> FloatArray:
        """(s, c, r) at points (s, 3)."""
        moved: FloatArray = self.moved + np.einsum("sj,jcr->scr", points, self.shares)
        return moved


def _rotating(twists: FloatArray) -> _Part:
    """The part of one configuration's twists (6, k)."""
    _, singular, turned = np.linalg.svd(twists[:3])
    rotations = int(np.sum(singular > 1e-7))
    turning, sliding = twists @ turned[:rotations].T, twists[3:] @ turned[rotations:].T
    across = np.linalg.svd(sliding)[0][:, sliding.shape[1] :].T if sliding.shape[1] else np.eye(3)
    shares = np.stack([across @ np.cross(turning[:3], axis, axisa=0, axisc=0) for axis in np.eye(3)])
    return _Part(across @ turning[3:], shares)


def _has_point(parts: list[_Part], rank: int) -> bool:
    """Whether all parts have at most some rank at one point."""
    size = rank + 1

    def system(points: FloatArray, _: IndexArray) -> tuple[FloatArray, FloatArray]:
        values = [_minors(part.at(points), part.shares, size) for part in parts]
        return np.concatenate([own for own, _ in values], axis=1), np.concatenate([by for _, by in values], axis=1)

    starts = np.random.default_rng(0).normal(size=(STARTS, 3))
    return bool(np.any(minimise(system, starts, tolerance=ZERO).converged))


def _minors(matrices: FloatArray, shares: FloatArray, size: int) -> tuple[FloatArray, FloatArray]:
    """Minors (s, m) of matrices (s, c, r), and their derivatives (s, m, 3) along shares (3, c, r).

    A determinant of size 3 or less is a polynomial of that degree along a line; its odd part without the cubic term,
    the determinant of the direction, is the derivative.
    """
    rows, columns = (list(combinations(range(count), size)) for count in matrices.shape[1:])
    values, slopes = [], []
    for row in rows:
        for column in columns:
            own, by = matrices[:, row][:, :, column], shares[:, row][:, :, column]
            odd = (np.linalg.det(own[:, None] + by) - np.linalg.det(own[:, None] - by)) / 2
            values.append(np.linalg.det(own))
            slopes.append(odd - np.linalg.det(by) if size == 3 else odd)
    return np.stack(values, axis=1), np.stack(slopes, axis=1)
