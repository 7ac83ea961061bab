"""First route: what the rules expect of limbs side by side, from the dimensions of their common motions alone.

With independent freedoms in every limb, rank closure = Σ f - dim M, so the constraint degrees add up to
D(S) = dim(∩ M_i) - |S| over any set S of limbs with one actuator each; the coupling degree is half the least
Σ|ΔD| over all orders, Eq. (6).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise, permutations

from assur.synthesis.wanted import WantedMotion
from assur.topology.intersection import parallel
from assur.topology.motion import Mode, Motion
from assur.topology.refusals import Refusal

Set = frozenset[int]


@dataclass(frozen=True)
class Expected:
    """What the rules say of limbs in their positions.

    Attributes:
        platform: the motion of the platform.
        dims: dim of the motion that the limbs of each set, of two or more, have in common.
        reaches: whether the platform's motion is the wanted one.
    """

    platform: Motion
    dims: Mapping[Set, int]
    reaches: bool

    @property
    def coupling_degree(self) -> int:
        """κ of Eq. (6)."""
        count = max(map(len, self.dims))
        return min(self._coupling(order) for order in permutations(range(count)))

    def xi(self, order: Sequence[int], freedoms: Sequence[int]) -> tuple[int, ...]:
        """ξ of each loop, Eq. (4), where the limbs come in this order: dim of both sides less what they share.

        Args:
            order: of the limbs.
            freedoms: sum of f of each limb, all of them independent.
        """
        found, before = [], freedoms[order[0]]
        for end in range(2, len(order) + 1):
            after = self.dims[frozenset(order[:end])]
            found.append(before + freedoms[order[end - 1]] - after)
            before = after
        return tuple(found)

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


def expected(motions: Sequence[Motion], motion: WantedMotion) -> Expected | Refusal:
    """What the rules say of limbs with these motions, side by side.

    >>> from assur.synthesis.wanted import MOTIONS
    >>> from assur.topology.notation import parse_chain
    >>> from assur.topology.union import serial
    >>> limbs = [serial(parse_chain(text), "translation") for text in ("C[x] R[x] R[x]", "C[y] R[y] R[y]", "C[z] R[z] R[z]")]
    >>> found = expected(limbs, MOTIONS["3T"])
    >>> found.reaches, found.coupling_degree
    (True, 1)
    """
    mode: Mode = "free" if motion.rotations else "translation"
    dims = {}
    platform: Motion | Refusal = Refusal("there are no limbs")
    for chosen in _sets(len(motions)):
        platform = parallel([motions[index] for index in sorted(chosen)], mode)
        if isinstance(platform, Refusal):
            return platform
        dims[chosen] = platform.dim
    if isinstance(platform, Refusal):
        return platform
    return Expected(platform, dims, _reaches(platform, motion))


def _sets(count: int) -> Iterator[Set]:
    """Sets of two or more, that of all last."""
    for size in range(2, count + 1):
        yield from map(frozenset, combinations(range(count), size))


def _reaches(platform: Motion, motion: WantedMotion) -> bool:
    moves = all(platform.translations.contains(direction) for direction in motion.translations)
    turns = all(platform.rotations.contains(direction) for direction in motion.rotations)
    return moves and turns and platform.dim == motion.dim
