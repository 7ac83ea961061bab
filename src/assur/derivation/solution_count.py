"""How many solutions the loop equations have over complex numbers: counted modulo two primes, beside all elimination.

Dimensions and what is given are drawn. Of nearly all of these the count modulo a prime is that over complex numbers, so
two that agree are evidence, and no proof. It bounds the number of real solutions, and is not it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from assur.derivation.carried_vectors import CarriedVectors
from assur.derivation.linear import value_of
from assur.derivation.loop_equations import loop_equations
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.orientations import orientations
from assur.derivation.pose_system import pose_system
from assur.derivation.residue_systems import ResidueSystem, residue_system
from assur.derivation.symbols import GivenSymbols
from assur.derivation.witness import ModularWitness
from assur.kinematics.modes import Problem
from assur.model.mechanism import MechanismRecord
from assur.numerics.prime_field import SMALL

SEEDS = (1, 2)
DRAWS = 50
"""Until every dimension has a residue: a root of a drawn number has one in two of them."""
SECONDS = 60.0
"""Of the processor."""


@dataclass(frozen=True)
class SolutionCount:
    """A count, or why there is none.

    Attributes:
        solutions: over complex numbers, with their multiplicities; None where they are not counted, or infinitely many.
        why: why there is no count; "" where there is.
        primes, seeds: modulo which, and what dimensions and inputs were drawn by.
        program: that counted.
        of: what is counted: the platform's poses, where it turns in space, or solutions for all unknown directions.
    """

    solutions: int | None
    why: str
    primes: tuple[int, ...]
    seeds: tuple[int, ...]
    program: str
    of: Literal["poses", "solutions"] = "solutions"


def solution_count(record: MechanismRecord, problem: Problem, seconds: float = SECONDS) -> SolutionCount:
    """The count of a mechanism's problem, each of two in half of the time. Errors: NotDerivedError.

    >>> from assur.model.registry import load_record
    >>> solution_count(load_record("fivebar"), "direct").solutions
    2
    """
    primes, counts, program = list[int](), list[int | None](), ""
    of: Literal["poses", "solutions"] = "solutions"
    for seed in SEEDS:
        system = _system(record, problem, seed)
        primes.append(system.prime)
        of = "poses" if system.even else "solutions"
        try:
            own, program = system.count(seconds / len(SEEDS))
        except TimeoutError as error:
            return SolutionCount(None, str(error), tuple(primes), SEEDS, program, of)
        counts.append(own)
    why = "" if len({*counts}) == 1 else f"the counts differ: {counts}"
    if not why and counts[0] is None:
        why = "infinitely many solutions"
    return SolutionCount(None if why else counts[0], why, tuple(primes), SEEDS, program, of)


def _system(record: MechanismRecord, problem: Problem, seed: int) -> ResidueSystem:
    """What is counted at drawn dimensions and inputs, modulo a drawn prime of 31 bits."""
    for draw in range(DRAWS):
        witness = ModularWitness(seed + len(SEEDS) * draw, SMALL)
        symbols = GivenSymbols(record, problem, witness)
        system = _at(symbols)
        if system is not None:
            return system
    raise ArithmeticError("no draw at which every dimension has a residue")


def _at(symbols: GivenSymbols) -> ResidueSystem | None:
    """Loop equations and squares of directions; else, of the direct problem, what limbs say of the platform's pose."""
    try:
        placed = orientations(symbols)
        loops, carried = loop_equations(symbols, placed), CarriedVectors(symbols, placed)
    except NotDerivedError:
        if symbols.problem == "inverse":
            raise
        return pose_system(symbols)
    unknowns = [*loops.lengths.values(), *(own for direction in loops.directions for own in direction.unknowns)]
    one = {across: length for length, across in loops.oblique.items()}
    equations = [value_of(form).xreplace(one) for form in loops.forms]
    equations += [direction.quadric for direction in loops.directions]
    equations += carried.leanings(loops.directions)
    return residue_system(equations, unknowns, symbols.witness)
