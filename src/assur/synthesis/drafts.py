"""Chosen mechanisms of a synthesis with dimensions, and what solves their direct and inverse problems."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from assur.derivation.not_derived import NotDerivedError
from assur.derivation.solution import AnalyticSolution, analytic_solution
from assur.kinematics.modes import Problem
from assur.model.mechanism import MechanismRecord
from assur.results.plain_text import count as plural
from assur.synthesis.designs import Design
from assur.synthesis.drafting.drafting import drafted
from assur.synthesis.synthesis import Synthesis


def chosen(synthesis: Synthesis, number: int) -> Iterator[tuple[int, Design]]:
    """The best mechanisms with their ranks, the best one of each family where families are told."""
    ranks = {id(design): rank for rank, design in enumerate(synthesis.designs, 1)}
    families = (family.designs[0] for family in synthesis.families)
    some = tuple(families) if synthesis.asked.by_families else synthesis.designs
    for design in some[:number]:
        yield ranks[id(design)], design


def drafted_text(design: Design, path: Path) -> str:
    """The text of its mechanism file, with default dimensions and a home.

    Errors:
        AssurError: no default dimensions have its topology; as `drafted`.
    """
    numbers = [f"{limb}.{joint}" for limb, joint in design.actuated]
    return drafted(design.chains, path, actuate=numbers, mode=design.mode).text


def solved_by(record: MechanismRecord, problem: Problem) -> str:
    """What solves a problem of a mechanism, by formulas from its joint graph, or what resists.

    >>> from assur.model.registry import load_record
    >>> solved_by(load_record("fivebar"), "direct")
    'square roots, 2 branches'
    """
    try:
        solution = analytic_solution(record, problem)
        solution.held_against_loops()
    except NotDerivedError as error:
        return f"not derived: {error}"
    return _in_words(solution)


def _in_words(solution: AnalyticSolution) -> str:
    if solution.eliminant is None:
        return f"square roots, {plural(solution.branches, 'branch')}"
    own = solution.components
    if own is None or own.solutions == 1:
        return f"one polynomial of degree {solution.eliminant.degree}"
    degrees = " and ".join(str(part.degree) for part in own.parts)
    return f"{plural(len(own.parts), 'polynomial')} of degree {degrees}, and a mirror sign"
