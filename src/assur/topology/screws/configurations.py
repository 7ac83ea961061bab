"""Assembled configurations of a linkage, finitely displaced from home along its own freedom.

A random direction is projected onto the null space of the closure, a step is taken, the loops are closed again, and
so on until the joints have moved by some tenths of a radian or of the linkage's length. So every configuration is
connected with home by a motion of the linkage, in the operation mode that home is in.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.errors import AssurError
from assur.numerics.least_squares import minimise
from assur.topology.screws.assembly_equations import CLOSED, EXACTLY, STILL, AssemblyEquations, Hold, projected
from assur.topology.screws.edges import rank
from assur.topology.screws.linkage import Linkage
from assur.topology.screws.screws import ScrewTree, screw_tree

FloatArray = NDArray[np.float64]


STEPS = 2
"""How many steps are taken from home."""

STEP = 0.22
"""Largest displacement of a joint (rad, lengths) in one step."""

ASTRAY = 0.75
"""Closing the loops may undo so much of a step; a motion along the freedom loses little of it."""

TRIES = 4
"""How often other directions, in smaller steps, are tried where loops do not close."""


class ImmobileError(AssurError):
    """The linkage does not move finitely where it should, so that ranks cannot be taken after displacement."""

    exit_code = 5


def configurations(linkage: Linkage, count: int = 4, seed: int = 0, hold: Hold | None = None) -> FloatArray:
    """Joint values (count, n), rad and the linkage's own unit of length, with all loops closed to 1e-11.

    Home is never among them, because it may be special; only a linkage without any freedom, which has nothing else,
    answers home. A linkage without loops or conditions is displaced at will, by angles up to pi.

    A P(4S) or P(2US) stays a parallelogram only if something holds it. Where a single limb carries the platform
    nothing does, so there all of them are held: their short links stay parallel. In a mechanism they are left to
    themselves unless `hold` says otherwise.

    Args:
        linkage: assembled at home.
        count: how many.
        seed: of the random directions.
        hold: "parallelograms" to keep all P(4S) and P(2US) parallelograms in a mechanism too; "orientation" for the
            translation mode, which does the same and in which the platform does not turn.

    Errors:
        ImmobileError: the loops do not close anywhere but at home although they have a freedom there.

    >>> from assur.topology.chains import Chain, ChainJoint
    >>> from assur.joints.revolute import REVOLUTE
    >>> from assur.topology.screws.placing import place
    >>> limb = Chain(tuple(ChainJoint(REVOLUTE, ((0.0, 0.0, 1.0),)) for _ in range(3)))
    >>> planar = place([limb, limb, limb])
    >>> values = configurations(planar)
    >>> values.shape, bool(np.all(np.isfinite(values)))
    ((4, 9), True)
    """
    tree = screw_tree(linkage)
    rng = np.random.default_rng(seed)
    system = AssemblyEquations.of(linkage, tree, hold)
    columns = len(tree.scales)
    if not system.rows:
        return rng.uniform(-1.0, 1.0, (count, columns)) * np.where(_turning(tree), np.pi, tree.scales)
    assemblies = np.zeros((0, columns))
    for attempt in range(TRIES):
        values, moved = _displaced(system, rng.normal(size=(count, columns)), STEP / (attempt + 1))
        if values is None:
            return np.zeros((count, columns))
        assemblies = np.concatenate([assemblies, values[moved]])
        if len(assemblies) >= count:
            return assemblies[:count] * tree.scales
    raise ImmobileError(
        f"the loops of the linkage have a freedom at home but do not close {count} times after a finite displacement",
        hint="a joint at a dead centre, or a freedom that is only instantaneous; start from another configuration",
    )


def closed_by_chance(linkage: Linkage, count: int, seed: int = 0, hold: Hold | None = None) -> FloatArray:
    """Assemblies (M, n), M <= count, anywhere: joint values by chance, loops closed from there.

    Args:
        linkage: assembled at home.
        count: of the joint values that are drawn.
        seed: of the draw.
        hold: as in `configurations`.
    """
    tree = screw_tree(linkage)
    system = AssemblyEquations.of(linkage, tree, hold)
    rng = np.random.default_rng(seed)
    start = rng.uniform(-1.0, 1.0, (count, len(tree.scales))) * np.where(_turning(tree), np.pi, 1.0)
    closed = minimise(system.at, start, tolerance=CLOSED, max_steps=80)
    values = minimise(system.at, closed.x[closed.converged], tolerance=EXACTLY, max_steps=25).x
    return np.asarray(values * tree.scales)


def home_is_special(linkage: Linkage, values: FloatArray, hold: Hold | None = None) -> bool:
    """Whether home has instantaneous freedoms more than configurations (N, n) that are displaced from it.

    Several operation modes may pass through such a home, and which one a configuration is in is then a matter of
    chance; `hold` may say which one is meant.

    Args:
        linkage: assembled at home.
        values: displaced configurations.
        hold: as it was for them.
    """
    tree = screw_tree(linkage)
    system = AssemblyEquations.of(linkage, tree, hold)
    at = np.concatenate([np.zeros((1, values.shape[1])), values / tree.scales])
    jacobian = system.at(at, np.arange(len(at)))[1]
    return rank(jacobian[:1]) < rank(jacobian[1:])


def _turning(tree: ScrewTree) -> NDArray[np.bool_]:
    turning: NDArray[np.bool_] = np.any(tree.screws[:, :3] != 0.0, axis=1)
    return turning


def _displaced(
    system: AssemblyEquations, target: FloatArray, step: float
) -> tuple[FloatArray, NDArray[np.bool_]] | tuple[None, None]:
    """Values (N, n) after some steps towards targets (N, n), and which of them have arrived; None if nothing moves."""
    values = np.zeros_like(target)
    arrived = np.ones(len(values), dtype=bool)
    for number in range(STEPS):
        # The loops must be closed here, or equations that imply each other at home would seem to be independent.
        direction = projected(system.at(values, np.arange(len(values)))[1], target)
        size = np.max(np.abs(direction), axis=1, keepdims=True)
        if number == 0 and np.all(size < STILL * np.max(np.abs(target))):
            return None, None
        aim = values + step * direction / np.maximum(size, STILL)
        closed = minimise(system.at, aim, tolerance=CLOSED, max_steps=30)
        # No motion leads to an assembly that is rigid, or far from where the step went, or back.
        near = np.max(np.abs(closed.x - aim), axis=1) < ASTRAY * step
        values, arrived = closed.x, arrived & closed.converged & near & (size[:, 0] > STILL)
    return values, arrived
