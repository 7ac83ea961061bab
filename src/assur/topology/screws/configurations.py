"""Assembled configurations of a linkage, finitely displaced from home along its own freedom.

A random direction is projected onto the null space of the closure, a step is taken, the loops are closed again, and
so on until the joints have moved by some tenths of a radian or of the linkage's length. So every configuration is
connected with home by a motion of the linkage, in the operation mode that home is in.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import networkx as nx
import numpy as np
from numpy.typing import NDArray

from assur.errors import AssurError
from assur.numerics.least_squares import minimise
from assur.topology.screws.edges import rank
from assur.topology.screws.linkage import Group, Linkage
from assur.topology.screws.screws import PlacedLinks, ScrewTree, screw_tree

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.intp]
Hold = Literal["orientation", "parallelograms"]
Equations = Callable[[FloatArray, IndexArray], tuple[FloatArray, FloatArray]]

CLOSED = 1e-11
"""Rotation (rad) and gap (lengths) below which a loop is closed."""

EXACTLY = 5e-15
"""Rotation (rad) and gap (lengths) that rounding leaves of a loop."""

STEPS = 2
"""How many steps are taken from home."""

STEP = 0.22
"""Largest displacement of a joint (rad, lengths) in one step."""

ASTRAY = 0.75
"""Closing the loops may undo so much of a step; a motion along the freedom loses little of it."""

NULL = 1e-7
"""Singular values of the closure below this share of the largest count as zero."""

STILL = 1e-6
"""Rates below this share of a random one are rounding errors of zero."""

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

TRIES = 4
"""How often other directions, in smaller steps, are tried where loops do not close."""

CROSSED = 1e-6
"""Unit vectors along the short links of a parallelogram differ by more, where it has crossed over."""

UNSTEADY = ("P(4S)", "P(2US)")
"""Parallelograms that their own loop does not keep such."""


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
    system = _System.of(linkage, tree, hold)
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
    system = _System.of(linkage, tree, hold)
    rng = np.random.default_rng(seed)
    start = rng.uniform(-1.0, 1.0, (count, len(tree.scales))) * np.where(_turning(tree), np.pi, 1.0)
    closed = minimise(system.at, start, tolerance=CLOSED, max_steps=80)
    values = minimise(system.at, closed.x[closed.converged], tolerance=EXACTLY, max_steps=25).x
    return np.asarray(values * tree.scales)


def crossed(linkage: Linkage, value: FloatArray) -> tuple[str, ...]:
    """Names of the parallelograms whose short links are not parallel at an assembly (n,): they have crossed over."""
    tree = screw_tree(linkage)
    frames = tree.at(value[None] / tree.scales).frames[0, :, :3, :3]

    def skew(group: Group) -> float:
        turned = frames[tree.frames[group.child]] - frames[tree.frames[group.parent]]
        return float(np.linalg.norm(turned @ _short_side(linkage, group)))

    return tuple(group.name for group in linkage.groups.values() if skew(group) > CROSSED)


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
    system = _System.of(linkage, tree, hold)
    rng = np.random.default_rng(seed)
    values = start / tree.scales
    # a walk has neither inputs nor a pose to hold nor a mode to keep, so no way or guard of the follower fits it
    heading = rng.normal(size=values.shape)
    heading[1::2] *= rng.random(heading[1::2].shape) < 0.5  # a motion may be of few joints
    alive = np.ones(len(values), dtype=bool)
    for number in range(WALK):
        direction = _projected(system.at(values, np.arange(len(values)))[1], heading)
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
    system = _System.of(linkage, tree, hold)
    if not system.rows or not len(values):
        return np.ones(len(values), dtype=bool)
    at = np.repeat(values / tree.scales, WAYS, axis=0)
    target = np.random.default_rng(seed).normal(size=at.shape)
    direction = _projected(system.at(at, np.arange(len(at)))[1], target, DOUBTFUL)
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
    system = _System.of(linkage, tree, None)
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


def loop_equations(linkage: Linkage, hold: Hold | None = None) -> Equations:
    """Residuals (N, rows) and derivatives (N, rows, n) at joint values (N, n), rad and lengths of the linkage."""
    return _System.of(linkage, screw_tree(linkage), hold).at


def finite_directions(linkage: Linkage, value: FloatArray, hold: Hold | None = None) -> FloatArray:
    """Orthonormal directions (n, k) of joint values in which an assembly (n,) can really be left, by finite steps.

    To the accuracy of the steps: where an assembly is regular, the null space of its closure is exact.

    Args:
        linkage: assembled at home.
        value: an assembly of it.
        hold: as in `configurations`.
    """
    tree = screw_tree(linkage)
    system = _System.of(linkage, tree, hold)
    count = 2 * len(value)
    at = np.repeat(value[None] / tree.scales, count, axis=0)
    target = np.random.default_rng(0).normal(size=at.shape)
    direction = _projected(system.at(at, np.arange(count))[1], target, BLURRED)
    direction /= np.maximum(np.linalg.norm(direction, axis=1, keepdims=True), STILL)
    closed = minimise(system.at, at + FINITE[0] * direction, tolerance=CLOSED, max_steps=100)
    steps = (closed.x - at)[closed.converged] / FINITE[0]
    _, singular, turned = np.linalg.svd(steps, full_matrices=False)
    kept: FloatArray = turned[singular > CURVED * max(float(singular.max(initial=0.0)), 1.0)].T
    return kept


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
    system = _System.of(linkage, tree, hold)
    at = np.concatenate([np.zeros((1, values.shape[1])), values / tree.scales])
    jacobian = system.at(at, np.arange(len(at)))[1]
    return rank(jacobian[:1]) < rank(jacobian[1:])


def _turning(tree: ScrewTree) -> NDArray[np.bool_]:
    turning: NDArray[np.bool_] = np.any(tree.screws[:, :3] != 0.0, axis=1)
    return turning


def _displaced(
    system: _System, target: FloatArray, step: float
) -> tuple[FloatArray, NDArray[np.bool_]] | tuple[None, None]:
    """Values (N, n) after some steps towards targets (N, n), and which of them have arrived; None if nothing moves."""
    values = np.zeros_like(target)
    arrived = np.ones(len(values), dtype=bool)
    for number in range(STEPS):
        # The loops must be closed here, or equations that imply each other at home would seem to be independent.
        direction = _projected(system.at(values, np.arange(len(values)))[1], target)
        size = np.max(np.abs(direction), axis=1, keepdims=True)
        if number == 0 and np.all(size < STILL * np.max(np.abs(target))):
            return None, None
        aim = values + step * direction / np.maximum(size, STILL)
        closed = minimise(system.at, aim, tolerance=CLOSED, max_steps=30)
        # No motion leads to an assembly that is rigid, or far from where the step went, or back.
        near = np.max(np.abs(closed.x - aim), axis=1) < ASTRAY * step
        values, arrived = closed.x, arrived & closed.converged & near & (size[:, 0] > STILL)
    return values, arrived


def _projected(jacobian: FloatArray, target: FloatArray, null: float = NULL) -> FloatArray:
    """The part of targets (N, n) in the null space of jacobians (N, r, n), of singular values below a share."""
    _, singular, turned = np.linalg.svd(jacobian, full_matrices=False)
    used = turned * (singular > null * np.maximum(singular[:, :1], NULL))[..., None]
    rest: FloatArray = target - np.einsum("nki,nk->ni", used, np.einsum("nki,ni->nk", used, target))
    return rest


@dataclass(frozen=True, eq=False)
class _System:
    """The equations: closed loops, and what is held.

    Attributes:
        loops: pairs (v, 2) of frames that coincide.
        steady: frame of a link that keeps its orientation, or -1.
        held: frames (p, 2) of the links next to each parallelogram that is held.
        sides: (p, 3) directions of their short links at home.
    """

    tree: ScrewTree
    loops: IndexArray
    steady: int
    held: IndexArray
    sides: FloatArray

    @classmethod
    def of(cls, linkage: Linkage, tree: ScrewTree, hold: Hold | None) -> _System:
        groups = _held(linkage, hold)
        frames = [(tree.frames[group.child], tree.frames[group.parent]) for group in groups]
        sides = np.array([_short_side(linkage, group) for group in groups]).reshape(-1, 3)
        steady = tree.frames[linkage.platform] if hold == "orientation" else -1
        return cls(tree, tree.loops, steady, np.array(frames, dtype=np.intp).reshape(-1, 2), sides)

    @property
    def rows(self) -> int:
        return 6 * len(self.loops) + 3 * len(self.held) + 3 * (self.steady >= 0)

    def at(self, values: FloatArray, _: IndexArray) -> tuple[FloatArray, FloatArray]:
        """Residuals (k, rows) and Jacobians (k, rows, n) at values (k, n) in rad and lengths of the linkage."""
        placed = self.tree.at(values)
        parts = [self.tree.misfit(placed, self.loops[:, 0], self.loops[:, 1])]
        if self.steady >= 0:
            residual, jacobian = self.tree.misfit(placed, np.array([self.steady]), np.array([0]))
            parts.append((residual[..., :3], jacobian[..., :3, :]))
        if len(self.held):
            parts.append(self._skewed(placed))
        count, columns = values.shape
        residuals = [residual.reshape(count, -1) for residual, _ in parts]
        jacobians = [jacobian.reshape(count, -1, columns) for _, jacobian in parts]
        return np.concatenate(residuals, axis=1), np.concatenate(jacobians, axis=1)

    def _skewed(self, placed: PlacedLinks) -> tuple[FloatArray, FloatArray]:
        """By how much short links of parallelograms differ in direction, (k, p, 3), and the Jacobian (k, p, 3, n)."""
        far, near = (
            np.einsum("kpij,pj->kpi", placed.frames[:, self.held[:, end], :3, :3], self.sides) for end in (0, 1)
        )
        omega = placed.twists[:, None, :3]
        far_spin, near_spin = (omega * self.tree.paths[self.held[:, end]][:, None] for end in (0, 1))
        jacobian = np.cross(far_spin, far[..., None], axis=-2) - np.cross(near_spin, near[..., None], axis=-2)
        return far - near, jacobian


def _held(linkage: Linkage, hold: Hold | None) -> list[Group]:
    """The parallelograms that must be held such: if it is asked for, or if a single limb carries the platform."""
    groups = [group for group in linkage.groups.values() if group.kind in UNSTEADY]
    return groups if groups and (hold or _single_limb(linkage)) else []


def _single_limb(linkage: Linkage) -> bool:
    """Whether some joint, or some parallelogram as one joint, is the only connection of platform and base."""
    inside = {name for group in linkage.groups.values() for name in group.joints}
    ends = [(joint.parent, joint.child) for name, joint in linkage.joints.items() if name not in inside]
    ends += [(group.parent, group.child) for group in linkage.groups.values()]
    built: nx.MultiGraph[str] = nx.MultiGraph(ends)
    bridges = {frozenset(pair) for pair in nx.bridges(built)}
    rest: nx.Graph[str] = nx.Graph([pair for pair in ends if frozenset(pair) not in bridges])
    rest.add_nodes_from((linkage.base, linkage.platform))
    return not nx.has_path(rest, linkage.base, linkage.platform)


def _short_side(linkage: Linkage, group: Group) -> FloatArray:
    """Unit vector (3,) from one hinge to the other on the near link, at home."""
    near = [name for name in group.joints if group.parent in (linkage.joints[name].parent, linkage.joints[name].child)]
    side: FloatArray = linkage.joints[near[1]].point - linkage.joints[near[0]].point
    return side / np.linalg.norm(side)
