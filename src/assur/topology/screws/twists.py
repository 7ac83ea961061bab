"""Ranks of twists: what a link can do at generic configurations, parallelograms as generalised joints or not.

The rank of a matrix that varies analytically with the configuration is the same almost everywhere on one operation mode
and can only drop elsewhere. So the generic rank of a closure, or of a chain's twists, is the **largest** that is seen:
one configuration where it is reached proves it. The motion space that a closure leaves can only grow where that rank
drops, so it is generic only where the closure is. Random configurations of one mode have the generic rank without
exception, and the most frequent rank is then the largest. Where configurations disagree they are of several modes, or
too close to a singular one: then there is no single answer, and it is an error, not a vote.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.errors import AssurError, UsageError
from assur.topology.screws.assembly_equations import Hold
from assur.topology.screws.configurations import configurations, home_is_special
from assur.topology.screws.edges import RANK_GAP, Edge, along, closure
from assur.topology.screws.finite_motion import BLURRED
from assur.topology.screws.linkage import Group, Linkage
from assur.topology.screws.screws import screw_tree

FloatArray = NDArray[np.float64]

CLEAR = 1e3
"""The smallest singular value that counts is at least so many times the largest one that does not."""

COMMON = 1e-12
"""A direction is fixed if its part outside the space, squared and averaged over the configurations, is below this."""

TRIES = 5
"""How many sets of configurations are drawn where a rank is not clear."""

MORE = 4
"""How many times more configurations are drawn where home is special."""


class UnclearRankError(AssurError):
    """Singular values do not say what the rank is, or configurations of one linkage disagree."""

    exit_code = 5


class ShakyError(UnclearRankError):
    """The loops close only where they are singular: instantaneous freedoms stay everywhere and lead nowhere."""


def clear_rank(matrix: FloatArray, scale: float | None = None) -> int:
    """Generic rank of matrices (N, r, c) of one linkage, whose configurations all must agree.

    Args:
        matrix: at N configurations.
        scale: what singular values are compared with, the largest of each matrix by default.

    Errors:
        UnclearRankError: no clear gap between singular values that count and those that do not, or different ranks.

    >>> clear_rank(np.array([[[1.0, 0.0], [0.0, 1e-15]]]))
    1
    """
    if 0 in matrix.shape:
        return 0
    return _clear(np.linalg.svd(matrix, compute_uv=False), scale)


def _clear(singular: NDArray[np.floating[Any]], scale: float | None) -> int:
    largest = np.maximum(singular[:, :1], RANK_GAP) if scale is None else np.full((len(singular), 1), scale)
    counted = singular > RANK_GAP * largest
    ranks = np.sum(counted, axis=1)
    least = np.min(np.where(counted, singular, np.inf), axis=1)
    most = np.max(np.where(counted, 0.0, singular), axis=1)
    if np.any(least < CLEAR * most):
        raise UnclearRankError(
            f"no clear rank: a singular value of {np.min(least):.1e} counts and one of {np.max(most):.1e} does not",
            hint="the configuration is close to a singular one; try another seed or other dimensions",
        )
    if np.any(ranks != ranks[0]):
        raise UnclearRankError(
            f"configurations disagree on a rank: {', '.join(map(str, sorted(set(ranks.tolist()))))}",
            hint="home may lie where operation modes meet; start from a configuration inside one of them",
        )
    return int(ranks[0])


def edges(linkage: Linkage, values: FloatArray, collapsed: bool = True) -> tuple[Edge, ...]:
    """The joints as edges with their twists at some configurations.

    Twists stand at the place of O' in each configuration, in lengths of the linkage; the rate of a translation is
    measured in lengths too, so that columns have one size.

    With `collapsed` each parallelogram is one edge, at the place of its first joint: an orthonormal basis of the
    relative motions that its own loop allows there. Spins of its rods drop out.

    Args:
        linkage: for the joints in the order of its edges.
        values: (N, n) joint values.
        collapsed: whether parallelograms count as one joint.

    Errors:
        UsageError: an input inside a parallelogram that has several freedoms.
    """
    tree = screw_tree(linkage)
    placed = tree.at(values / tree.scales)
    points = placed.frames[:, tree.frames[linkage.platform], :3, 3]  # O' of each configuration
    omega = placed.twists[:, :3]
    moved = placed.twists[:, 3:] + np.cross(omega, points[..., None], axis=1)
    twists = np.concatenate([omega, moved], axis=1)
    inputs: dict[str, tuple[int, ...]] = {}
    for name, component in linkage.inputs:
        inputs[name] = (*inputs.get(name, ()), component)
    slices = linkage.slices
    every = {
        name: Edge(
            name,
            joint.parent,
            joint.child,
            twists[..., slices[name]],
            (name,),
            inputs.get(name, ()),
            not joint.type.ball,
        )
        for name, joint in linkage.joints.items()
    }
    if not collapsed:
        return tuple(every.values())
    owner = {name: group for group in linkage.groups.values() for name in group.joints}
    joined: dict[str, Edge] = {}
    for name, edge in every.items():
        group = owner.get(name)
        if group is None:
            joined[name] = edge
        elif group.name not in joined:
            joined[group.name] = _generalised(group, [every[inner] for inner in group.joints])
    return tuple(joined.values())


def _generalised(group: Group, inner: Sequence[Edge]) -> Edge:
    """One edge for the joints of a parallelogram."""
    basis = motion_space(inner, group.parent, group.child)
    actuated = any(edge.inputs for edge in inner)
    if actuated and basis.shape[-1] > 1:
        raise UsageError(
            f"the parallelogram '{group.name}' has {basis.shape[-1]} freedoms and an input inside",
            hint="only a parallelogram with one freedom can be actuated as one joint; ask for its joints instead",
        )
    driven = (0,) if actuated else ()
    return Edge(group.name, group.parent, group.child, basis, group.joints, driven, basis.shape[-1] == 1)


def generic_values(linkage: Linkage, count: int = 4, seed: int = 0, hold: Hold | None = None) -> FloatArray:
    """Configurations (N, n) where the rank of every closure and of the platform's motion is clear, N >= count.

    Others are drawn where it is not, because they happen to be close to singular ones. Where home itself is special,
    more are drawn and all must agree: then operation modes may meet there, and nothing is outvoted.

    Args:
        linkage: assembled at home.
        count: how many at least.
        seed: of the random directions.
        hold: as in `configurations`.

    Errors:
        UnclearRankError: after several tries. ImmobileError: as in `configurations`.
    """
    values = configurations(linkage, count, seed, hold)
    if home_is_special(linkage, values, hold):
        return _agreeing(linkage, configurations(linkage, MORE * count, seed, hold))
    for attempt in range(1, TRIES + 1):
        try:
            poc_dimensions(edges(linkage, values), linkage.base, linkage.platform)
        except UnclearRankError as error:
            unclear = error
        else:
            return values
        values = configurations(linkage, count, seed + 1000 * attempt, hold)
    raise UnclearRankError(f"{TRIES} sets of configurations were tried; the last: {unclear.message}", hint=unclear.hint)


def _agreeing(linkage: Linkage, values: FloatArray) -> FloatArray:
    """The configurations, if they agree although home is special."""
    try:
        poc_dimensions(edges(linkage, values), linkage.base, linkage.platform)
    except ShakyError:
        raise
    except UnclearRankError as error:
        raise UnclearRankError(
            f"home has freedoms that are lost on the way, and what is reached from it disagrees: {error.message}",
            hint="operation modes may meet at home: ask for mode translation, or write a configuration inside one mode",
        ) from error
    return values


def motion_space(edges: Sequence[Edge], base: str, link: str) -> FloatArray:
    """Orthonormal basis (N, 6, k) of a link's twists relative to the base, (omega, v at O') with lengths of one size.

    Args:
        edges: with twists at N configurations; those of a limb alone for the limb's own motion.
        base: the link that counts as fixed.
        link: the link that moves; the edges connect both.

    Errors:
        UnclearRankError: see `clear_rank`. ShakyError: the loops may be singular wherever they close.
    """
    moves = along(edges, base, link)
    free = _null_space(closure(edges))
    spanned = moves @ free
    left, singular, _ = np.linalg.svd(spanned, full_matrices=False)
    basis: FloatArray = left[..., : _clear(singular, 1.0) if singular.shape[1] else 0]
    return basis


def _null_space(matrix: FloatArray) -> FloatArray:
    """Orthonormal basis (N, c, k) of the null spaces of matrices (N, r, c) of one linkage."""
    count = matrix.shape[-1]
    if not matrix.shape[1]:
        return np.broadcast_to(np.eye(count), (len(matrix), count, count))
    _, singular, turned = np.linalg.svd(matrix)
    _refuse_shaky(singular)
    return np.asarray(np.swapaxes(turned[:, _clear(singular, None) :], -1, -2))


def _refuse_shaky(singular: NDArray[np.floating[Any]]) -> None:
    """Refuse a closure (N, k) with singular values so small that its loops may be singular wherever they close."""
    shares = singular / np.maximum(singular[:, :1], RANK_GAP)
    small = shares[(shares > RANK_GAP) & (shares < BLURRED)]
    if small.size:
        raise ShakyError(
            f"no clear rank: a singular value of {small.min():.1e} may be zero, as where loops close only in singular "
            "configurations: such a mechanism is shaky, with instantaneous freedoms everywhere that lead nowhere",
            hint="its axes are special as written: other directions or another number of limbs avoid that",
        )


def poc_dimensions(edges: Sequence[Edge], base: str, link: str) -> tuple[int, int, int]:
    """(t, r, dim) of the POC set of a link, by rank: of the velocities of O', of the angular velocities, of both.

    Args:
        edges: with twists at N configurations.
        base: the link that counts as fixed.
        link: the link that moves.
    """
    return dimensions(motion_space(edges, base, link))


def dimensions(basis: FloatArray) -> tuple[int, int, int]:
    """(t, r, dim) of a motion space (N, 6, k).

    >>> dimensions(np.eye(6)[None, :, 2:4])
    (1, 1, 2)
    """
    return clear_rank(basis[:, 3:], 1.0), clear_rank(basis[:, :3], 1.0), basis.shape[-1]


def fixed_directions(basis: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Directions in the base that the t part, and the r part, has at all configurations.

    Args:
        basis: (N, 6, k) of a motion space at several configurations, N >= 2.

    Returns:
        Orthonormal rows (a, 3) and (b, 3); all of t's directions are fixed where a = t, and so for r.

    >>> plane, axis = fixed_directions(np.stack([np.eye(6)[:, 2:5]] * 3))
    >>> plane.shape, axis + 0.0
    ((2, 3), array([[0., 0., 1.]]))
    """
    return _common(basis[:, 3:]), _common(basis[:, :3])


def _common(vectors: FloatArray) -> FloatArray:
    """Orthonormal rows of what the column spaces of (N, 3, k) have in common."""
    left, singular, _ = np.linalg.svd(vectors, full_matrices=False)
    used = left * (singular > RANK_GAP)[:, None]
    outside = np.eye(3) - np.mean(used @ np.swapaxes(used, -1, -2), axis=0)
    # the share of a unit vector that lies outside, on average over the configurations, is the square of a sine
    shares, directions = np.linalg.eigh(outside)
    rows: FloatArray = directions[:, shares < COMMON].T
    return rows


def in_platform(linkage: Linkage, values: FloatArray, space: FloatArray) -> FloatArray:
    """A motion space (N, 6, k) at configurations (N, n), in the axes of the platform."""
    tree = screw_tree(linkage)
    back = np.swapaxes(tree.at(values / tree.scales).frames[:, tree.frames[linkage.platform], :3, :3], -1, -2)
    return np.concatenate([back @ space[:, :3], back @ space[:, 3:]], axis=1)
