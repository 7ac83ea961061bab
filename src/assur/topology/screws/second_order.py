"""Which instantaneous freedoms the second order of the loops blocks: a proof that a shaky linkage moves as it is said.

At an assembly let J be the derivative of the loop equations f, N its null space, and w a row with w J = 0 (a state of
self-stress). A motion that starts with u in N must have w f''(u, u) = 0 for every w. Where the kernel R of all these
quadratic forms is all of N but one dimension, they are multiples of the square of one coordinate of u: so every motion
is tangent to R, and the linkage has no more than dim R finite freedoms. That it has so many is seen by finite steps.

Where more freedoms are blocked together it depends on the signs of the forms, and so on dimensions, whether they have
directions in common along which the linkage can leave: nothing is claimed of those.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.topology.screws.assembly_equations import loop_equations
from assur.topology.screws.edges import along, closure, rank
from assur.topology.screws.finite_motion import BLURRED, follows, walked
from assur.topology.screws.linkage import Linkage
from assur.topology.screws.screws import screw_tree
from assur.topology.screws.twists import CLEAR, UnclearRankError, edges

FloatArray = NDArray[np.float64]

DIFFERENCE = 1e-4
"""Step (rad, lengths) of central differences: their error, 1e-8, is beside forms of 1e-3 and more of what closing the
loops leaves."""

BLOCKED = 1e-6
"""Curvature (1 / rad, 1 / lengths) below which a form is zero."""

WALKS = 24
"""From home, to configurations of the finite motion."""


@dataclass(frozen=True, eq=False)
class SecondOrder:
    """An assembly to the second order.

    Attributes:
        instantaneous: number of its instantaneous freedoms, dim N.
        finite: (n, k) orthonormal directions of joint values (rad, lengths of the linkage), R.
        proved: whether just one freedom is blocked, so that every motion is tangent to R.
    """

    instantaneous: int
    finite: FloatArray
    proved: bool

    @property
    def freedoms(self) -> int:
        """Dim R, which no motion exceeds where that is proved."""
        return int(self.finite.shape[1])


@dataclass(frozen=True, eq=False)
class FiniteMotion:
    """The motion of a shaky linkage.

    Attributes:
        values: (N, n) configurations of it; home alone where it does not move.
        finite: (N, n, F) directions of joint values that it can take there.
        instantaneous: number of instantaneous freedoms, the same at all of them.
        poc: (t, r, dim) of the platform's finite motion.
    """

    values: FloatArray
    finite: FloatArray
    instantaneous: int
    poc: tuple[int, int, int]

    @property
    def freedoms(self) -> int:
        """F, of finite motions."""
        return int(self.finite.shape[-1])


def finite_motion(linkage: Linkage, count: int = 4, seed: int = 0) -> FiniteMotion | None:
    """How a linkage moves whose loops close only where they are singular; None where that is not proved.

    Args:
        linkage: assembled at home, without parallelograms that something else must keep such.
        count: configurations, at least.
        seed: of the walks from home.
    """
    home = np.zeros(len(screw_tree(linkage).scales))
    at_home = second_order(linkage, home)
    if not at_home.proved:
        return None
    if not at_home.freedoms:
        return FiniteMotion(home[None], at_home.finite[None], at_home.instantaneous, (0, 0, 0))
    ends = [
        (end, order)
        for end in walked(linkage, np.repeat(home[None], WALKS, axis=0), seed)
        for order in [second_order(linkage, end)]
        if _alike(order, at_home) and _is_clear(linkage, end, order)
    ]
    if len(ends) < count:
        return None
    values, bases = np.stack([end for end, _ in ends]), np.stack([order.finite for _, order in ends])
    if not (follows(linkage, home[None], at_home.finite[None]) and follows(linkage, values, bases)):
        return None
    poc = _dimensions(along(edges(linkage, values, collapsed=False), linkage.base, linkage.platform) @ bases)
    return FiniteMotion(values, bases, at_home.instantaneous, poc) if poc else None


def second_order(linkage: Linkage, value: FloatArray) -> SecondOrder:
    """The freedoms of an assembly (n,), and those that the second order leaves.

    Args:
        linkage: assembled at home.
        value: (n,) joint values, rad and the linkage's own unit of length.

    >>> from assur.topology.screws.placing import place
    >>> from assur.topology.notation import parse_chains
    >>> crossed = place(parse_chains(["C[z] C[1,0,2]", "C[x] C[1,0,2]"]))
    >>> order = second_order(crossed, np.zeros(8))
    >>> order.instantaneous, order.freedoms, order.proved
    (3, 2, True)
    """
    at = value / screw_tree(linkage).scales
    left, singular, turned = np.linalg.svd(_derivatives(linkage, at[None])[0])
    known = int(np.sum(singular > BLURRED * max(float(singular.max(initial=0.0)), BLURRED)))
    free, stresses = turned[known:].T, left[:, known:]
    count = free.shape[1]
    if not count:
        return SecondOrder(0, free, proved=False)
    # the loops are open by the square of the step there: what that changes is the same on both sides
    ahead, behind = (_derivatives(linkage, at + sign * DIFFERENCE * free.T) for sign in (1, -1))
    slope = (ahead - behind) / (2 * DIFFERENCE)  # (k, rows, n)
    forms = np.einsum("ra,krn,nl->akl", stresses, slope, free)
    forms = (forms + forms.swapaxes(1, 2)) / 2  # (a, k, k)
    _, curved, ways = np.linalg.svd(np.concatenate([forms.reshape(-1, count), np.zeros((1, count))]))
    blocked = int(np.sum(curved > BLOCKED))
    clear = bool(np.min(curved[:blocked], initial=np.inf) >= CLEAR * np.max(curved[blocked:], initial=0.0))
    return SecondOrder(count, free @ ways[blocked:].T, clear and blocked == 1)


def _alike(order: SecondOrder, other: SecondOrder) -> bool:
    return order.proved and (order.instantaneous, order.freedoms) == (other.instantaneous, other.freedoms)


def _is_clear(linkage: Linkage, end: FloatArray, order: SecondOrder) -> bool:
    """Whether the loops are closed so well that ranks at an assembly (n,) are those of its instantaneous freedoms."""
    try:
        graphs = [edges(linkage, end[None], collapsed) for collapsed in (True, False)]
    except UnclearRankError:
        return False
    return all(sum(edge.freedoms for edge in graph) - rank(closure(graph)) == order.instantaneous for graph in graphs)


def _dimensions(moves: FloatArray) -> tuple[int, int, int] | None:
    """(t, r, dim) of twists (N, 6, F); None where configurations disagree or a rank is not clear."""
    t, r, dim = (_clear_rank(part) for part in (moves[:, 3:], moves[:, :3], moves))
    return None if t is None or r is None or dim is None else (t, r, dim)


def _clear_rank(matrix: FloatArray) -> int | None:
    """Rank of matrices (N, rows, F) whose directions are known to what closing double solutions leaves."""
    singular = np.linalg.svd(matrix, compute_uv=False)
    counted = singular > BLURRED
    ranks = np.sum(counted, axis=1)
    least = np.min(np.where(counted, singular, np.inf))
    most = np.max(np.where(counted, 0.0, singular), initial=0.0)
    return int(ranks[0]) if np.all(ranks == ranks[0]) and least >= CLEAR / 10 * most else None


def _derivatives(linkage: Linkage, at: FloatArray) -> FloatArray:
    """Derivatives (N, rows, n) of the loop equations at joint values (N, n), rad and lengths of the linkage."""
    return loop_equations(linkage)(at, np.arange(len(at)))[1]
