"""Kinds of operation modes of a linkage: what its assemblies move like, wherever they are, not at home alone.

Joint values by chance are closed by Gauss-Newton; each assembly that lasts is walked from, and what it moves like there
is its kind. Components of the configuration space that are met seldom may be missed: nothing proves that kinds are all.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.topology.screws.assembly_equations import Hold
from assur.topology.screws.configurations import closed_by_chance
from assur.topology.screws.edges import closure, rank
from assur.topology.screws.finite_motion import lasting, walked
from assur.topology.screws.linkage import Linkage
from assur.topology.screws.parallelograms import crossed
from assur.topology.screws.twists import (
    ShakyError,
    UnclearRankError,
    dimensions,
    edges,
    fixed_directions,
    in_platform,
    motion_space,
)

FloatArray = NDArray[np.float64]

STARTS = 120
"""Joint values by chance that are closed."""

TRIED = 3
"""Assemblies of the same numbers that are walked from: where modes differ in their fixed directions alone."""

IN_PLANE = 1e-3
"""Least singular value of three unit vectors that nearly lie in a plane."""

WALKS = 8
"""From each, of which most must get away."""


@dataclass(frozen=True)
class ModeKind:
    """What assemblies of one kind have in common.

    Attributes:
        t, r, dim: of the platform's POC set.
        freedoms: F, with parallelograms as one joint.
        rank: of the closure of all joints.
        fixed_in_base: how many directions of the translations, and of the rotations, stand still in the base.
        fixed_in_platform: the same in the platform's frame.
        crossed: names of the parallelograms that have crossed over.
    """

    t: int
    r: int
    dim: int
    freedoms: int
    rank: int
    fixed_in_base: tuple[int, int]
    fixed_in_platform: tuple[int, int]
    crossed: tuple[str, ...] = ()


def kinds_met(linkage: Linkage, seed: int = 0, hold: Hold | None = None) -> dict[ModeKind, FloatArray]:
    """Kinds of modes with configurations (N, n) of each, those first that are met most often.

    Args:
        linkage: assembled at home.
        seed: of the joint values by chance.
        hold: as in `assur.topology.screws.configurations.configurations`.
    """
    assemblies = closed_by_chance(linkage, STARTS, seed, hold)
    assemblies = assemblies[lasting(linkage, assemblies, seed, hold)]
    alike: dict[tuple[object, ...], list[FloatArray]] = {}
    for value in assemblies:
        if (numbers := numbers_at(linkage, value[None])) is not None:
            alike.setdefault((*numbers, crossed(linkage, value)), []).append(value)
    met: dict[ModeKind, FloatArray] = {}
    for _, values in sorted(alike.items(), key=lambda pair: -len(pair[1])):
        for value in values[:TRIED]:
            own = kind_around(linkage, value, seed, hold)
            if own is not None:
                met.setdefault(own[0], own[1])
    return met


def kind_around(
    linkage: Linkage, value: FloatArray, seed: int = 0, hold: Hold | None = None
) -> tuple[ModeKind, FloatArray] | None:
    """The kind of an assembly (n,) and configurations (N, n) of it; None where walks from it lead to several."""
    numbers = numbers_at(linkage, value[None])
    ends = walked(linkage, np.repeat(value[None], WALKS, axis=0), seed, hold)
    same = [end for end in ends if numbers_at(linkage, end[None]) == numbers]
    if numbers is None or len(same) < WALKS / 2:
        return None
    values = np.stack([value, *same])
    try:
        space = motion_space(edges(linkage, values), linkage.base, linkage.platform)
    except (UnclearRankError, ShakyError):
        return None
    t, r, dim, freedoms, rank_of_closure = numbers
    fixed = (_fixed(space), _fixed(in_platform(linkage, values, space)))
    return ModeKind(t, r, dim, freedoms, rank_of_closure, *fixed, crossed(linkage, value)), values


def numbers_at(linkage: Linkage, values: FloatArray) -> tuple[int, int, int, int, int] | None:
    """t, r, dim, F and the rank of the closure at configurations (N, n), None where ranks are not clear.

    They are not where the three axes of a ball joint lie in a plane: it then lacks a freedom that it has.
    """
    every = edges(linkage, values, collapsed=False)
    balls = [edge.twists[:, :3] for edge in every if linkage.joints[edge.name].type.ball]
    if any(np.min(np.linalg.svd(axes, compute_uv=False)) < IN_PLANE for axes in balls):
        return None
    try:
        collapsed = edges(linkage, values)
        space = motion_space(collapsed, linkage.base, linkage.platform)
        freedoms = sum(edge.freedoms for edge in collapsed) - rank(closure(collapsed))
        return *dimensions(space), freedoms, rank(closure(every))
    except (UnclearRankError, ShakyError):
        return None


def _fixed(space: FloatArray) -> tuple[int, int]:
    translations, rotations = fixed_directions(space)
    return len(translations), len(rotations)
