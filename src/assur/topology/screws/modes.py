"""Operation modes that meet at home, told from one another, and from shaky linkages, by finite steps.

Where home has instantaneous freedoms that are lost on the way, it may be a branch point of the configuration space:
several motions start there, with other freedoms each. Walks in random directions find them. An instantaneous freedom
is a real one where a step along it leaves the loops open by the square of its length only; where it is not, a
configuration is singular although it cannot be left by that freedom, and a linkage with no others is shaky.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from assur.topology.poc import PocSet
from assur.topology.screws.assembly_equations import Hold
from assur.topology.screws.configurations import ImmobileError, home_is_special
from assur.topology.screws.edges import along, closure, null_basis, rank
from assur.topology.screws.finite_motion import finite_directions, lasting, walked
from assur.topology.screws.linkage import Linkage
from assur.topology.screws.twists import (
    ShakyError,
    UnclearRankError,
    dimensions,
    edges,
    fixed_directions,
    generic_values,
    motion_space,
)

FloatArray = NDArray[np.float64]

WALKS = 24
"""From home, at first; so many again in other directions where none of them meets a regular configuration."""

ROUNDS = 2
"""How often walks are started."""

AROUND = 6
"""Walks from one configuration: to close neighbours; or from a singular one, which is no motion of its own where any
of them meets a regular one."""

CLOSE = 2e-3
"""Steps (rad, lengths) of walks to close neighbours: short beside the way to another mode, and an axis that moves with
the mode turns by much more than its direction is known to."""

MOST = 6
"""Operation modes that are told apart; a home where more meet is answered for these."""


AT_REST = 1e-6
"""A freedom of a joint rests where it has less of every unit motion."""

ROUGH = 0.05
"""What is below this share of finite steps of one length is their curvature."""


@dataclass(frozen=True, eq=False)
class OperationMode:
    """One motion that starts at home.

    Attributes:
        values: (N, n) configurations of it.
        freedoms: F, with parallelograms as one joint.
        poc: (t, r, dim) of the platform.
        real: whether all its instantaneous freedoms lead somewhere. Of a shaky one they do not, and its numbers are
            those of its finite motion, as far as steps tell.
        moving: which freedoms of its joints move.
        met: by how many walks.
    """

    values: FloatArray
    freedoms: int
    poc: tuple[int, int, int]
    real: bool
    moving: tuple[bool, ...] = ()
    met: int = 1

    def __str__(self) -> str:
        return f"F = {self.freedoms}, {PocSet(*self.poc)} with dim {self.poc[-1]}"


def operation_modes(
    linkage: Linkage, count: int = 4, seed: int = 0, hold: Hold | None = None
) -> tuple[OperationMode, ...]:
    """The operation modes that are met around home: real ones first, then those with most freedoms, and met most often.

    Args:
        linkage: assembled at home.
        count: configurations of each, at least.
        seed: of the random directions.
        hold: as in `configurations`.

    Errors:
        ShakyError: none of them is real. ImmobileError: home cannot be left. UnclearRankError: ranks are not clear.
    """
    try:
        values = generic_values(linkage, count, seed, hold)
        if not home_is_special(linkage, values, hold) and np.all(lasting(linkage, values, seed, hold)):
            return (_mode(linkage, values),)
    except (UnclearRankError, ImmobileError) as error:
        unclear: UnclearRankError | ImmobileError | None = error
    else:
        unclear = None
    modes: list[OperationMode] = []
    for number in range(ROUNDS):
        if not any(mode.real for mode in modes):
            modes = _met(linkage, WALKS, seed + number, hold, count, modes)
    ordered = sorted(modes, key=lambda mode: (not mode.real, -mode.freedoms, -mode.met, mode.poc))
    if not ordered:
        if isinstance(unclear, UnclearRankError):
            raise unclear
        at_home = _finite_motion(linkage, np.zeros(_columns(linkage)), hold)
        raise _shaky([at_home]) if at_home.freedoms else _immobile(linkage)
    if not ordered[0].real:
        raise _shaky(ordered)
    return tuple(ordered)


def _met(
    linkage: Linkage, walks: int, seed: int, hold: Hold | None, count: int, before: Sequence[OperationMode]
) -> list[OperationMode]:
    """The modes of configurations at the ends of walks from home, beside those that are known."""
    ends = walked(linkage, np.zeros((walks, _columns(linkage))), seed, hold)
    modes = list(before)
    for value, lasts in zip(ends, lasting(linkage, ends, seed, hold), strict=True):
        mode_at_end = _regular(linkage, value) if lasts else None
        same = (mode for mode in modes if (_are_one(linkage, mode, mode_at_end) if mode_at_end else not mode.real))
        known = next(same, None)
        if known is not None:
            modes[modes.index(known)] = replace(known, met=known.met + 1)
        elif len(modes) < MOST:
            new = (
                _around(linkage, value, seed, hold, count, mode_at_end)
                if mode_at_end
                else _shaky_mode(linkage, value, seed, hold)
            )
            modes += [new] if new else []
    return modes


def _regular(linkage: Linkage, value: FloatArray) -> OperationMode | None:
    """The mode of one configuration (n,), None where its ranks are not clear."""
    try:
        return _mode(linkage, value[None])
    except UnclearRankError:
        return None


def _shaky_mode(linkage: Linkage, value: FloatArray, seed: int, hold: Hold | None) -> OperationMode | None:
    """The finite motion at a singular configuration (n,), None where walks from it meet a regular one."""
    ends = walked(linkage, np.repeat(value[None], AROUND, axis=0), seed, hold)
    lasts = lasting(linkage, ends, seed, hold)
    if any(regular and _regular(linkage, end) for end, regular in zip(ends, lasts, strict=True)):
        return None
    return _finite_motion(linkage, value, hold)


def _finite_motion(linkage: Linkage, value: FloatArray, hold: Hold | None) -> OperationMode:
    """What finite steps follow at a configuration (n,)."""
    tangent = finite_directions(linkage, value, hold)
    moved = along(edges(linkage, value[None], collapsed=False), linkage.base, linkage.platform)[0] @ tangent
    t, r, dim = (_roughly(part) for part in (moved[3:], moved[:3], moved))
    return OperationMode(value[None], tangent.shape[1], (t, r, dim), real=False)


def _roughly(matrix: FloatArray) -> int:
    """The rank of what finite steps measured."""
    return int(np.sum(np.linalg.svd(matrix, compute_uv=False) > ROUGH)) if matrix.size else 0


def _around(
    linkage: Linkage, value: FloatArray, seed: int, hold: Hold | None, count: int, mode: OperationMode
) -> OperationMode | None:
    """A mode with more configurations, walked to from one of them; None where there are not enough of its kind.

    A walk may come back to where modes meet and leave by another one, of the same numbers. So what close neighbours
    of the one have in common, the ends of walks must have too.
    """
    neighbours = walked(linkage, np.repeat(value[None], AROUND, axis=0), seed, hold, CLOSE)
    near = replace(mode, values=np.concatenate([value[None], neighbours]))
    ends = walked(linkage, np.repeat(value[None], 4 * count, axis=0), seed, hold)
    kept = []
    for end in ends:
        mode_at_end = _regular(linkage, end)
        if mode_at_end and _are_one(linkage, near, mode_at_end):
            kept.append(end)
    if len(kept) < count:
        return None
    return replace(mode, values=np.stack(kept[:count]))


def _mode(linkage: Linkage, values: FloatArray) -> OperationMode:
    """What is true at some regular configurations of one mode."""
    collapsed = edges(linkage, values)
    space = motion_space(collapsed, linkage.base, linkage.platform)
    freedoms = sum(edge.freedoms for edge in collapsed) - rank(closure(collapsed))
    return OperationMode(values, freedoms, dimensions(space), real=True, moving=_moving(linkage, values))


def _moving(linkage: Linkage, values: FloatArray) -> tuple[bool, ...]:
    """Which freedoms of the joints move, at all of some configurations."""
    free = null_basis(closure(edges(linkage, values, collapsed=False)))
    moving = np.linalg.norm(free, axis=-1) > AT_REST
    if len(free) < len(values) or np.any(moving != moving[0]):
        raise UnclearRankError(
            "configurations disagree on which joints move",
            hint="home may lie where operation modes meet; start from a configuration inside one of them",
        )
    return tuple(bool(moves) for moves in moving[0])


def _are_one(linkage: Linkage, mode: OperationMode, other: OperationMode) -> bool:
    """Whether a configuration has the numbers and the fixed directions of a mode."""
    if any(getattr(mode, key) != getattr(other, key) for key in ("freedoms", "poc", "real", "moving")):
        return False
    before, after = (
        [len(rows) for rows in fixed_directions(motion_space(edges(linkage, values), linkage.base, linkage.platform))]
        for values in (mode.values, np.concatenate([mode.values, other.values]))
    )
    return before == after


def _columns(linkage: Linkage) -> int:
    return sum(len(joint.screws) for joint in linkage.joints.values())


def _immobile(linkage: Linkage) -> ImmobileError:
    at_home = edges(linkage, np.zeros((1, _columns(linkage))))
    count = sum(edge.freedoms for edge in at_home) - rank(closure(at_home))
    return ImmobileError(
        f"the mechanism does not move: at home it has {count} instantaneous freedom{'' if count == 1 else 's'}, and no "
        "finite step follows them",
        hint="its axes are special as written: other directions, or a limb with one joint more, let it move",
    )


def _shaky(modes: Sequence[OperationMode]) -> ShakyError:
    return ShakyError(
        "the mechanism is shaky: its loops close only where they are singular, and it has instantaneous freedoms that "
        f"finite steps do not follow; those that they do: {'; '.join(map(str, modes))}",
        hint="its axes are special as written: other directions or another number of limbs avoid that",
    )
