"""Motions as virtual chains: series of joints through one point, that move the platform as it is to move.

A name may have several rows, motions with as many translations and rotations that are not the same.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from assur.errors import UnknownNameError
from assur.synthesis.placed_series import PlacedSeries, at_point, series_of
from assur.synthesis.positions import CYCLE, SWAP
from assur.synthesis.required import RequiredMotion
from assur.topology.directions import NAMED, Vector
from assur.topology.notation import parse_chain
from assur.topology.poc import PocSet

FloatArray = NDArray[np.float64]

Symmetry = Literal["none", "about z", "sphere"]
"""Which turns of all joints leave a virtual chain the same motion."""

TURNS: Mapping[Symmetry, tuple[FloatArray, ...]] = {
    "none": (np.eye(3),),
    "about z": (np.eye(3), SWAP),
    "sphere": (np.eye(3), CYCLE, CYCLE @ CYCLE),
}
"""Ways to turn a limb that can follow a virtual chain of each symmetry, such that it follows it again."""

POSES = 4
REACH = 0.05
"""A virtual chain stands in so many poses, home and others, displaced by up to so many rad or lengths."""


@dataclass(frozen=True)
class VirtualChain(RequiredMotion):
    """A motion that has places, not directions alone.

    Attributes:
        row: which of the motions with that name.
        text: the virtual chain, whose labelled axes run through one point.
        base: directions that it singles out in the base.
        platform: directions that it singles out in the platform.
        symmetry: turns that leave it the same.
    """

    row: str = ""
    text: str = ""
    base: tuple[Vector, ...] = ()
    platform: tuple[Vector, ...] = ()
    symmetry: Symmetry = "none"

    @property
    def marks(self) -> tuple[tuple[Vector, ...], tuple[Vector, ...]]:
        """As of any motion."""
        return self.base, self.platform

    @cached_property
    def series(self) -> PlacedSeries:
        """Its joints at home, the labelled point in the origin."""
        return series_of([parse_chain(self.text)], np.random.default_rng(len(self.text)))

    @cached_property
    def values(self) -> FloatArray:
        """Joint values (POSES, dim) at which limbs are looked at."""
        displaced = np.random.default_rng(self.dim).uniform(-REACH, REACH, (POSES, self.dim))
        displaced[0] = 0.0
        return displaced

    @property
    def poc(self) -> PocSet:
        """The numbers of its POC set, O' a general point."""
        _, _, twists = self.series.repeated(POSES).at(self.values)
        there = at_point(twists, np.random.default_rng(0).normal(size=3))
        t, r = (int(np.linalg.matrix_rank(part, tol=1e-9).max()) for part in (there[:, 3:], there[:, :3]))
        return PocSet(t, r, self.dim)


_X, _Y, _Z = NAMED["x"], NAMED["y"], NAMED["z"]

_ROWS = (
    VirtualChain("3T", (_X, _Y, _Z), (), None, "PPP", "P[x] P[y] P[z]", (), (), "sphere"),
    VirtualChain("3T1R", (_X, _Y, _Z), (_Z,), None, "PPPR", "P[x] P[y] P[z] R[z]", (_Z,), (_Z,), "about z"),
    VirtualChain("2T1R", (_X, _Y), (_Z,), None, "E", "P[x] P[y] R[z]", (_Z,), (_Z,), "about z"),
    VirtualChain("2T", (_X, _Y), (), None, "PP", "P[x] P[y]", (_Z,), (_Z,), "about z"),
    VirtualChain("2R", (), (_X, _Y), None, "U", "R[x]@O R[y]@O", (_X,), (_Y,)),
    VirtualChain("3R", (), (_X, _Y, _Z), None, "S", "R[x]@O R[y]@O R[z]@O", (), (), "sphere"),
    VirtualChain("1T1R", (_Z,), (_Z,), None, "C", "P[z] R[z]@O", (_Z,), (_Z,), "about z"),
    VirtualChain("1T1R", (_X,), (_Z,), None, "PR", "P[x] R[z]@O", (_X, _Z), (_Z,)),
    VirtualChain("1T1R", (_X,), (_Z,), None, "RP", "R[z]@O P[x]", (_Z,), (_X, _Z)),
    VirtualChain("2T1R", (_X, _Y), (_X,), None, "PPR", "P[x] P[y] R[x]@O", (_X, _Z), (_X,)),
    VirtualChain("2T1R", (_X, _Y), (_X,), None, "RPP", "R[x]@O P[x] P[y]", (_X,), (_X, _Z)),
    VirtualChain("1T2R", (_Z,), (_X, _Y), None, "PU", "P[z] R[x]@O R[y]@O", (_X, _Z), (_Y,)),
    VirtualChain("1T2R", (_Z,), (_X, _Y), None, "UP", "R[x]@O R[y]@O P[z]", (_X,), (_Y, _Z)),
    VirtualChain("1T2R", (_Z,), (_X, _Y), None, "RPR", "R[x]@O P[z] R[y]", (_X,), (_Y,)),
    VirtualChain("2T2R", (_Y, _Z), (_X, _Y), None, "PPU", "P[y] P[z] R[x]@O R[y]@O", (_X,), (_Y,)),
    VirtualChain("2T2R", (_Y, _Z), (_X, _Y), None, "UPP", "R[x]@O R[y]@O P[x] P[z]", (_X,), (_Y,)),
    VirtualChain("3T2R", (_X, _Y, _Z), (_X, _Y), None, "PPPU", "P[x] P[y] P[z] R[x] R[y]", (_X,), (_Y,)),
    VirtualChain("1T3R", (_Z,), (_X, _Y, _Z), None, "PS", "P[z] R[x]@O R[y]@O R[z]@O", (_Z,), (), "about z"),
    VirtualChain("2T3R", (_X, _Y), (_X, _Y, _Z), None, "PPS", "P[x] P[y] R[x]@O R[y]@O R[z]@O", (_Z,), (), "about z"),
)

VIRTUAL_CHAINS: Mapping[str, tuple[VirtualChain, ...]] = {
    name: tuple(row for row in _ROWS if row.name == name) for name in dict.fromkeys(row.name for row in _ROWS)
}
"""The rows of each name."""


def rows_named(text: str) -> tuple[VirtualChain, ...]:
    """All rows of a name, as "1T2R", or one of them, as "1T2R:PU", upper or lower case.

    Errors:
        UnknownNameError: another name, or a row that it does not have.

    >>> [row.row for row in rows_named("1T2R")], [row.text for row in rows_named("1t2r:up")]
    (['PU', 'UP', 'RPR'], ['R[x]@O R[y]@O P[z]'])
    """
    name, _, row = text.strip().upper().partition(":")
    rows = VIRTUAL_CHAINS.get(name, ())
    kept = tuple(one for one in rows if row in ("", one.row))
    if not kept:
        known = [f"{one.name}:{one.row}" for one in rows] if rows else list(VIRTUAL_CHAINS)
        raise UnknownNameError("motion", text, known)
    return kept
