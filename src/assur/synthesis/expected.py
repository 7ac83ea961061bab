"""First route: what the rules expect of limbs side by side, from the dimensions of their common motions alone.

With independent freedoms in every limb, rank closure = Σ f - dim M, so the constraint degrees add up to
D(S) = dim(∩ M_i) - |S| over any set S of limbs with one actuator each; the coupling degree is half the least
Σ|ΔD| over all orders, Eq. (6).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise, permutations

from assur.synthesis.required import RequiredMotion
from assur.topology.symbolic.intersection import parallel
from assur.topology.symbolic.motion import Mode, Motion
from assur.topology.symbolic.refusals import Refusal

Set = frozenset[int]


@dataclass(frozen=True)
class Counts:
    """What the rules count, where they answer for every set of limbs.

    Attributes:
        dims: dim of the motion that the limbs of each set, of two or more, have in common.
        freedoms: sum of f of each limb, all of them independent.
    """

    dims: Mapping[Set, int]
    freedoms: Sequence[int]

    @property
    def coupling_degree(self) -> int:
        """κ of Eq. (6)."""
        return min(self._coupling(order) for order in permutations(range(len(self.freedoms))))

    def xi(self, order: Sequence[int]) -> tuple[int, ...]:
        """ξ of each loop, Eq. (4), where the limbs come in this order: dim of both sides less what they share."""
        ranks, before = [], self.freedoms[order[0]]
        for end in range(2, len(order) + 1):
            after = self.dims[frozenset(order[:end])]
            ranks.append(before + self.freedoms[order[end - 1]] - after)
            before = after
        return tuple(ranks)

    def _coupling(self, order: Sequence[int]) -> int:
        """The largest κ of the Assur chains in one order; the first loop takes two limbs, each other one more."""
        ends = range(2, len(order) + 1)
        sums = [0, *(self.dims[frozenset(order[:end])] - end for end in ends)]
        chains, run = [], 0
        for before, after in pairwise(sums):
            run += abs(after - before)
            if after == 0:
                chains.append(run // 2)
                run = 0
        return max(chains, default=0)


@dataclass(frozen=True)
class Expected:
    """What the rules say of limbs in their positions.

    Attributes:
        platform: the motion of the platform.
        reaches: whether it is the required one.
        counts: None where the rules refuse on a part of the limbs.
    """

    platform: Motion
    reaches: bool
    counts: Counts | None


def expected(motions: Sequence[Motion], motion: RequiredMotion) -> Expected | Refusal:
    """What the rules say of limbs with these motions, side by side.

    >>> from assur.synthesis.required import MOTIONS
    >>> from assur.topology.notation import parse_chain
    >>> from assur.topology.symbolic.union import serial
    >>> limbs = [serial(parse_chain(f"C[{u}] R[{u}] R[{u}]"), "translation") for u in "xyz"]
    >>> found = expected(limbs, MOTIONS["3T"])
    >>> found.reaches, found.counts.coupling_degree, found.counts.xi((0, 1, 2))
    (True, 1, (5, 4))
    """
    mode: Mode = "free" if motion.rotations else "translation"
    platform = parallel(motions, mode)
    if isinstance(platform, Refusal):
        return platform
    some = {chosen: parallel([motions[index] for index in sorted(chosen)], mode) for chosen in _sets(len(motions))}
    dims = {chosen: shared.dim for chosen, shared in some.items() if isinstance(shared, Motion)}
    counts = Counts(dims, [limb.freedoms for limb in motions]) if len(dims) == len(some) else None
    return Expected(platform, _reaches(platform, motion), counts)


def _sets(count: int) -> Iterator[Set]:
    """Sets of two or more."""
    for size in range(2, count + 1):
        yield from map(frozenset, combinations(range(count), size))


def _reaches(platform: Motion, motion: RequiredMotion) -> bool:
    moves = all(platform.translations.contains(direction) for direction in motion.translations)
    turns = all(platform.rotations.contains(direction) for direction in motion.rotations)
    return moves and turns and platform.dim == motion.dim
