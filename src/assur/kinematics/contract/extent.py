"""How much a check of a closed form looks at."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Extent:
    """How much is looked at.

    Attributes:
        name: what the check is called.
        poses: problems of each kind.
        solutions: so many of them are held against the laws of single solutions.
        motions: so many of these against motions of the joint graph.
        primes: so many at most, modulo which the formulas are looked at in exact arithmetic.
        assemblies: starts of the joint graph's own assemblies, beside home.
        problems: so many are given to the joint graph's own solvers.
        formulas: whether divisors, radicands and zeros of factors are looked at.
    """

    name: str
    poses: int
    solutions: int
    motions: int
    primes: int
    assemblies: int = 0
    problems: int = 0
    formulas: bool = False


AT_LOAD = Extent("load", poses=50, solutions=400, motions=60, primes=1)
"""On the first use: a few tenths of a second."""
IN_FULL = Extent("full", poses=200, solutions=2000, motions=120, primes=48, assemblies=32, problems=5, formulas=True)
"""Of `assur check`, and before anything is proved: some seconds."""
DEEP = Extent("deep", poses=4000, solutions=40_000, motions=1000, primes=48, assemblies=400, problems=30, formulas=True)
"""Of `assur check --deep`: some minutes."""
EXTENTS = (AT_LOAD, IN_FULL, DEEP)
"""Each looks at all that those before it look at, and more."""
