"""Finite steps from assemblies of a linkage: walks along a motion, and which freedoms are more than instantaneous."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.numerics.least_squares import minimise
from assur.topology.screws.assembly_equations import CLOSED, EXACTLY, STILL, AssemblyEquations, Hold, projected
from assur.topology.screws.linkage import Linkage
from assur.topology.screws.screws import screw_tree

FloatArray = NDArray[np.float64]


WALK, WALK_STEP = 6, 0.1
"""Steps of a walk from a branch point, and the largest displacement of a joint (rad, lengths) in each."""

STUCK = 0.3
"""A walk that gets on by less than this share of a step follows no motion."""

BLURRED = 2e-5
"""Share of the largest below which a closure's singular value may be zero: where two solutions of the loops coincide,
closing them to 1e-11 finds joints to its root, 3e-6, and leaves that much of a singular value that is zero."""

DOUBTFUL = 1e-4
"""Share of the largest below which a singular value is tried as if it were zero: several solutions may coincide."""

FINITE = (8e-3, 2e-3)
"""Steps (rad, lengths) by which instantaneous freedoms are tried."""

STRAIGHT = 1e-4
"""A correction by less than this share of a step follows no curve: the motion is straight in its joints."""

CURVED = 0.1
"""Directions in which many steps together get on by less than this share of the longest are curvature."""

WAYS = 3
"""Random freedoms that are tried at a configuration."""


def walked(
    linkage: Linkage, start: FloatArray, seed: int = 0, hold: Hold | None = None, step: float = WALK_STEP
) -> FloatArray:
    """Joint values (M, n), M <= N, where walks from assemblies (N, n) end after several small steps.

    Each walk goes on in the direction in which it went, roughly, so that it follows a motion that starts at a branch
    point also where random directions there are none of any motion. Walks that do not get away are left out.

    Args:
        linkage: assembled at home.
        start: assemblies of it.
        seed: of the random directions.
        hold: as in `configurations`.
        step: the largest displacement of a joint (rad, lengths) in each step.
    """
    tree = screw_tree(linkage)
    system = AssemblyEquations.of(linkage, tree, hold)
    rng = np.random.default_rng(seed)
    values = start / tree.scales
    # a walk has neither inputs nor a pose to hold nor a mode to keep, so no way or guard of the follower fits it
    heading = rng.normal(size=values.shape)
    heading[1::2] *= rng.random(heading[1::2].shape) < 0.5  # a motion may be of few joints
    alive = np.ones(len(values), dtype=bool)
    for number in range(WALK):
        direction = projected(system.at(values, np.arange(len(values)))[1], heading)
        size = np.max(np.abs(direction), axis=1, keepdims=True)
        aim = values + step * direction / np.maximum(size, STILL)
        closed = minimise(system.at, aim, tolerance=CLOSED, max_steps=60)
        moved = closed.x - values
        gone = np.max(np.abs(moved), axis=1)
        alive &= closed.converged & (size[:, 0] > STILL) & (gone < 2 * step)
        # a first step in a direction of no motion may come back nearly to the start
        alive &= (gone > STUCK * step) | (number == 0)
        heading = moved / np.maximum(gone, STILL)[:, None] + 0.2 * rng.normal(size=values.shape)
        values = closed.x
    if not np.any(alive):
        return np.zeros((0, len(tree.scales)))
    # where two solutions coincide an error of the loops is the square of the joints': the loops are closed further
    polished = minimise(system.at, values[alive], tolerance=EXACTLY, max_steps=25)
    return np.asarray(polished.x * tree.scales)


def lasting(linkage: Linkage, values: FloatArray, seed: int = 0, hold: Hold | None = None) -> NDArray[np.bool_]:
    """Whether all instantaneous freedoms at assemblies (N, n) lead somewhere, (N,).

    Along a motion, closing the loops after a step along its tangent takes a correction by the square of the step. Along
    a freedom that is instantaneous only, the correction is as long as the step.

    Args:
        linkage: assembled at home.
        values: assemblies of it.
        seed: of the random freedoms that are tried.
        hold: as in `configurations`.
    """
    tree = screw_tree(linkage)
    system = AssemblyEquations.of(linkage, tree, hold)
    if not system.rows or not len(values):
        return np.ones(len(values), dtype=bool)
    at = np.repeat(values / tree.scales, WAYS, axis=0)
    target = np.random.default_rng(seed).normal(size=at.shape)
    direction = projected(system.at(at, np.arange(len(at)))[1], target, DOUBTFUL)
    size = np.linalg.norm(direction, axis=1, keepdims=True)
    direction /= np.maximum(size, STILL)
    shares = []
    for step in FINITE:
        aim = at + step * direction
        closed = minimise(system.at, aim, tolerance=CLOSED, max_steps=60)
        share = np.linalg.norm(closed.x - aim, axis=1) / step
        shares.append(np.where(closed.converged, share, np.inf))
    steps = FINITE[1] / FINITE[0]
    lasts = (shares[1] < STRAIGHT) | (shares[1] < 2 * steps * shares[0])
    lasts &= np.isfinite(shares[1])
    rigid = size[:, 0] < STILL * np.linalg.norm(target, axis=1)
    every: NDArray[np.bool_] = np.all((lasts | rigid).reshape(len(values), WAYS), axis=1)
    return every


def follows(linkage: Linkage, values: FloatArray, bases: FloatArray, seed: int = 0) -> bool:
    """Whether finite steps from assemblies (N, n) along directions (N, n, k) are steps of motions.

    Args:
        linkage: assembled at home.
        values: assemblies of it, which may be singular.
        bases: orthonormal directions of joint values, rad and lengths of the linkage.
        seed: of the directions that are tried, as many as there are and more.
    """
    tree = screw_tree(linkage)
    system = AssemblyEquations.of(linkage, tree, None)
    tries = bases.shape[-1] + WAYS
    at = np.repeat(values / tree.scales, tries, axis=0)
    rates = np.random.default_rng(seed).normal(size=(len(at), bases.shape[-1], 1))
    direction = (np.repeat(bases, tries, axis=0) @ rates)[..., 0]
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    shares = []
    for step in FINITE:
        aim = at + step * direction
        closed = minimise(system.at, aim, tolerance=CLOSED, max_steps=60)
        # as in walks: joints at double solutions are known to the root of what is left of the loops
        polished = minimise(system.at, closed.x, tolerance=EXACTLY, max_steps=25)
        share = np.linalg.norm(polished.x - aim, axis=1) / step
        shares.append(np.where(closed.converged, share, np.inf))
    return bool(np.all((shares[1] < STRAIGHT) | (shares[1] < 2 * FINITE[1] / FINITE[0] * shares[0])))


def finite_directions(linkage: Linkage, value: FloatArray, hold: Hold | None = None) -> FloatArray:
    """Orthonormal directions (n, k) of joint values in which an assembly (n,) can really be left, by finite steps.

    To the accuracy of the steps: where an assembly is regular, the null space of its closure is exact.

    Args:
        linkage: assembled at home.
        value: an assembly of it.
        hold: as in `configurations`.
    """
    tree = screw_tree(linkage)
    system = AssemblyEquations.of(linkage, tree, hold)
    count = 2 * len(value)
    at = np.repeat(value[None] / tree.scales, count, axis=0)
    target = np.random.default_rng(0).normal(size=at.shape)
    direction = projected(system.at(at, np.arange(count))[1], target, BLURRED)
    direction /= np.maximum(np.linalg.norm(direction, axis=1, keepdims=True), STILL)
    closed = minimise(system.at, at + FINITE[0] * direction, tolerance=CLOSED, max_steps=100)
    steps = (closed.x - at)[closed.converged] / FINITE[0]
    _, singular, turned = np.linalg.svd(steps, full_matrices=False)
    kept: FloatArray = turned[singular > CURVED * max(float(singular.max(initial=0.0)), 1.0)].T
    return kept
