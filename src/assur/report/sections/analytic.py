"""The analytic solution, derived from the joint graph alone: why links do not turn, then set by set."""

from __future__ import annotations

from collections.abc import Iterator

from assur.derivation.not_derived import NotDerivedError
from assur.derivation.printed_derivation import PrintedProblem, printed_derivation
from assur.derivation.reasons import sentences
from assur.derivation.solution import AnalyticSolution, analytic_solution
from assur.derivation.written_solution import WrittenFormula, WrittenPart
from assur.kinematics.modes import Problem
from assur.model.mechanism import MechanismRecord
from assur.report.formulas.latex import latex_mathml
from assur.report.formulas.mathml import display
from assur.results.kinds import Facts, Formulas, PrintedFormula, Result, Section

SAID = (
    "Derived from the joint graph alone, without the formulas above: set by set of links from the loop equations in "
    "which nothing else is unknown, by linear elimination and a square root for each choice of two."
)
HELD = {
    True: "each closes every loop, which was held against them modulo a prime of 160 bits",
    False: "NOT ALL of them close every loop",
}
PROBLEMS: tuple[Problem, ...] = ("direct", "inverse")


def analytic_solutions(record: MechanismRecord) -> Iterator[Section]:
    """The section of the problems that formulas solve; none where there is no such problem."""
    solved: dict[Problem, AnalyticSolution] = {}
    for problem in PROBLEMS:
        try:
            solved[problem] = analytic_solution(record, problem)
        except NotDerivedError:
            continue
    if solved:
        parts = printed_derivation(record, solved, {}).problems
        yield Section("Analytic solution", SAID, [_problem(own) for own in parts])


def _problem(own: PrintedProblem) -> Section:
    solution = own.written.solution
    count = "is 1 branch" if solution.branches == 1 else f"are {solution.branches} branches"
    results: list[Result | Section] = []
    if reasons := [*sentences(solution.placed)]:
        results.append(Facts("Links that do not turn", tuple((str(k), text) for k, text in enumerate(reasons, 1))))
    results += [formulas for part in own.written.parts() for formulas in _formulas(part)]
    return Section(
        f"The {own.problem} problem by formulas",
        f"There {count}; {HELD[own.closes]}.",
        results,
    )


def _formulas(part: WrittenPart) -> Iterator[Formulas]:
    """The formulas of a set; words before and after them are its caption."""
    lines = [formula for block in part.blocks if not isinstance(block, str) for formula in block]
    said = [block for block in part.blocks if isinstance(block, str) and block.endswith(".")]
    if lines:
        first = [part.blocks[0].partition(" The loop equations")[0]] if isinstance(part.blocks[0], str) else []
        yield Formulas(part.title, tuple(map(_line, lines)), " ".join([*first, *said]))


def _line(formula: WrittenFormula) -> PrintedFormula:
    return PrintedFormula(display(latex_mathml(formula.latex)))
