"""A closed form held against its joint graph: every law, at seeded places, with all that does not hold."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.closure import RANK_GAP
from assur.kinematics.contract.algebra import Algebra
from assur.kinematics.contract.borders import cut_short, ends, named_by_signs
from assur.kinematics.contract.completeness import missing, random_assemblies
from assur.kinematics.contract.curves import broken_curves, lacking_curves
from assur.kinematics.contract.determinants import wrong_factors
from assur.kinematics.contract.dimensions import changed, with_dimensions
from assur.kinematics.contract.extent import Extent
from assur.kinematics.contract.kernel import questions, recorded
from assur.kinematics.contract.mismatch import Mismatch
from assur.kinematics.contract.places import inputs, poses
from assur.kinematics.contract.positions import open_loops, other_questions
from assur.kinematics.contract.rates import wrong_rates
from assur.kinematics.contract.signs import wrong_signs
from assur.kinematics.contract.solutions import Solutions, solutions, solves
from assur.kinematics.contract.solvers import lacking
from assur.kinematics.contract.statuses import false_statuses
from assur.kinematics.contract.systems import unsolved
from assur.kinematics.contract.undeclared import is_declared, undeclared
from assur.kinematics.contract.zeros import false_zeros
from assur.kinematics.modes import Problem
from assur.kinematics.rates.motions import motions
from assur.model.mechanism import MechanismRecord
from assur.work import stage

FloatArray = NDArray[np.float64]


SIZE = 700
"""Of a mechanism of many joints fewer motions are looked at: its number of joint values, squared, over this many."""
FEWEST = 16
AT_ENDS = 24
"""Solutions at ends of branches whose status is held against the joint graph's."""
JOINTS = 24
"""The same for solutions, of which each takes as long as there are joint values."""


@stage("closed form against the joint graph")
def at_places(record: MechanismRecord, extent: Extent, seed: int = 0) -> list[Mismatch]:
    """What of a closed form does not hold at so many places; the laws in their order, the first that is broken alone.

    >>> from assur.model.registry import load_record
    >>> from assur.kinematics.contract.extent import AT_LOAD
    >>> at_places(load_record("fivebar"), AT_LOAD)
    []
    """
    random = np.random.default_rng(seed)
    drawn: dict[Problem, FloatArray] = {"inverse": poses(record, extent.poses, random)}
    there = solutions(record, "inverse", drawn["inverse"]).spread(_most(record, extent))
    asked = [there]
    if len(there) and solves(record, "direct"):
        drawn["direct"] = inputs(record, there.inputs, extent.poses, random)
        asked.append(solutions(record, "direct", drawn["direct"]).spread(_most(record, extent)))
    near = {
        problem: ends(record, problem, given, random)
        for problem, given in drawn.items()
        if named_by_signs(record, problem)
    }
    asked += [
        solutions(record, problem, reached.given).spread(_most(record, extent)) for problem, reached in near.items()
    ]
    broken = (
        _first(_positions, asked)
        or unsolved(there)
        or _first(_motions(extent, there), asked[: len(drawn)])
        or _first(false_statuses, [found.spread(AT_ENDS) for found in asked[len(drawn) :]])
    )
    if broken:
        return broken
    joints = random_assemblies(record, extent.assemblies, random)
    cut = [item for problem, reached in near.items() for item in cut_short(record, problem, reached)]
    broken = cut or missing(there, joints, motions(record, joints, RANK_GAP))
    return broken or lacking(there, extent.problems, random)


@stage("radicands, divisors and margins of the closed form")
def of_declarations(record: MechanismRecord, extent: Extent, seed: int = 0) -> tuple[list[Mismatch], bool]:
    """Radicands and divisors that are not declared, and margins that are neither; of polynomials in wider checks.

    The second answer: whether all is declared with any dimensions.

    >>> from assur.model.registry import load_record
    >>> from assur.kinematics.contract.extent import IN_FULL
    >>> of_declarations(load_record("fivebar"), IN_FULL)
    ([], True)
    """
    found, general = list[Mismatch](), True
    for question in questions(record):
        if extent.formulas or question == "self_motion" or named_by_signs(record, question):
            kernel = recorded(record, question)
            if not is_declared(kernel, Algebra(kernel)):
                general, known = False, Algebra(kernel, general=False)
                if not is_declared(kernel, known):
                    found += undeclared(kernel, known, _solved(record, extent, seed).get(question))
    return found, general


def _solved(record: MechanismRecord, extent: Extent, seed: int) -> dict[str, Solutions]:
    """Solutions of the problems that are answered by signs."""
    random = np.random.default_rng(seed)
    there = solutions(record, "inverse", poses(record, extent.poses, random))
    found = {"inverse": there}
    if len(there) and solves(record, "direct") and named_by_signs(record, "direct"):
        found["direct"] = solutions(record, "direct", inputs(record, there.inputs, extent.poses, random))
    return found


@stage("curves and zeros of factors of the closed form")
def of_formulas(record: MechanismRecord, extent: Extent, seed: int = 0) -> list[Mismatch]:
    """Curves that do not close, and zeros of factors at which nothing is singular.

    >>> from assur.model.registry import load_record
    >>> from assur.kinematics.contract.extent import IN_FULL
    >>> of_formulas(load_record("fivebar"), IN_FULL)
    []
    """
    solved = _solved(record, extent, seed)
    found = list[Mismatch]()
    if "direct" in solved:
        direct = recorded(record, "direct")
        found = [*broken_curves(direct, solved["direct"]), *lacking_curves(solved["inverse"])]
    return found or false_zeros(recorded(record, "inverse"), solved["inverse"])


@stage("closed form with other dimensions")
def at_other_dimensions(record: MechanismRecord, extent: Extent, seed: int = 1) -> tuple[list[Mismatch], bool]:
    """What does not hold with other dimensions, and whether there are any: else each choice is a question of its own.

    >>> from assur.model.registry import load_record
    >>> from assur.kinematics.contract.extent import AT_LOAD
    >>> at_other_dimensions(load_record("fivebar"), AT_LOAD)
    ([], True)
    """
    random = np.random.default_rng(seed)
    other = changed(record, random)
    if other is None:
        return [], False
    less = dataclasses.replace(
        extent, poses=extent.poses // 2, solutions=extent.solutions // 2, motions=FEWEST, problems=0
    )
    broken = at_places(other, less, seed)
    if broken:
        for name, value in other.overrides.items():  # one dimension at a time says more
            alone = with_dimensions(record, {name: value})
            own = at_places(alone, less, seed) if alone is not None else []
            if own:
                return own, True
    return broken, True


def _most(record: MechanismRecord, extent: Extent) -> int:
    """How many solutions are looked at: fewer of a mechanism with many joints, each of which takes longer."""
    return int(extent.solutions * min(1.0, JOINTS / len(record.coordinates)))


def _first(laws: Callable[[Solutions], list[Mismatch]], asked: Sequence[Solutions]) -> list[Mismatch]:
    return next((broken for found in asked if (broken := laws(found))), [])


def _positions(solutions: Solutions) -> list[Mismatch]:
    return open_loops(solutions) or [*other_questions(solutions), *wrong_signs(solutions)]


def _motions(extent: Extent, answer: Solutions) -> Callable[[Solutions], list[Mismatch]]:
    """The laws of motions, and whether what moves there is found from the other side; `answer`: all that is known."""

    def laws(solutions: Solutions) -> list[Mismatch]:
        record = solutions.record
        if not len(solutions):
            return []
        share = min(1.0, SIZE / len(record.coordinates) ** 2)
        some = solutions.spread(max(FEWEST, int(share * extent.motions)))
        motion = motions(record, some.joints, RANK_GAP)
        return (
            wrong_rates(some, motion)
            or wrong_factors(solutions)
            or false_statuses(some, motion)
            or missing(answer, some.joints, motion)
        )

    return laws
