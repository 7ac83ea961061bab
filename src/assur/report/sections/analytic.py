"""The analytic solution, derived from the joint graph alone: why links do not turn, then set by set.

What a report says of it is kept with what was derived, as data: lists that begin with the kind of their part.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from assur.derivation.kept import derived_text
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.patience import TooLongError, patience
from assur.derivation.printed_derivation import PrintedProblem, printed_derivation
from assur.derivation.printed_velocities import PrintedVelocities
from assur.derivation.reasons import left_out, sentences
from assur.derivation.solution import AnalyticSolution, analytic_solution
from assur.derivation.written_parts import WrittenFormula, WrittenPart
from assur.kinematics.modes import Problem
from assur.model.mechanism import MechanismRecord
from assur.report.formulas import latex, mathml
from assur.results.kinds import Facts, Formulas, PrintedFormula, Result, Section

SAID = (
    "Derived from the joint graph alone, without the formulas above: set by set of links from the loop equations in "
    "which nothing else is unknown, by linear elimination and a square root for each choice of two."
)
HELD = {
    True: "each closes every loop, which was held against them modulo a prime of 160 bits",
    False: "NOT ALL of them close every loop",
}
SECONDS = 8
"""Of the processor's time, that a report waits for both problems; all else of it takes about as long."""
LATE = "Whether formulas solve the {} problem is not known: a report tries for {} s, `assur derive` to the end."
PROBLEMS: tuple[Problem, ...] = ("direct", "inverse")
PRINTERS = (Path(__file__), *sorted(Path(latex.__file__).parent.glob("*.py")))


def analytic_solutions(record: MechanismRecord) -> Iterator[Section]:
    """The section of the problems that formulas solve; none where there is no such problem."""
    text = derived_text(
        record, "section of a report", lambda: json.dumps([_plain(part) for part in _sections(record)]), PRINTERS
    )
    for own in json.loads(text):
        yield _part(own)


def _plain(part: Result | Section) -> list[Any]:
    """A part as data. Errors: TypeError, where it is of a kind that this section has not."""
    if isinstance(part, Section):
        return ["section", part.title, part.text, [_plain(own) for own in part.results]]
    if isinstance(part, Facts):
        return ["facts", part.title, part.items]
    if isinstance(part, Formulas):
        return ["formulas", part.title, [line.mathml for line in part.lines], part.caption]
    raise TypeError(type(part).__name__)


def _part(data: list[Any]) -> Any:
    """The part that such data are of."""
    kind, title, *rest = data
    if kind == "section":
        return Section(title, rest[0], [_part(own) for own in rest[1]])
    if kind == "facts":
        return Facts(title, tuple((label, text) for label, text in rest[0]))
    return Formulas(title, tuple(map(PrintedFormula, rest[0])), rest[1])


def _sections(record: MechanismRecord) -> Iterator[Section]:
    solved: dict[Problem, AnalyticSolution] = {}
    late: list[Problem] = []
    with patience(SECONDS):
        for problem in PROBLEMS:
            try:
                solved[problem] = analytic_solution(record, problem)
            except TooLongError:
                late.append(problem)
            except NotDerivedError:
                continue
    if late:
        yield Section("Analytic solution", LATE.format(" and the ".join(late), SECONDS), [])
    if solved:
        derivation = printed_derivation(record, solved, {})
        parts: list[Result | Section] = [_problem(own) for own in derivation.problems]
        if derivation.velocities is not None:
            parts.append(_velocities(derivation.velocities))
        yield Section("Analytic solution", SAID, parts)


def _problem(own: PrintedProblem) -> Section:
    solution = own.written.solution
    count = "is 1 branch" if solution.branches == 1 else f"are {solution.branches} branches"
    results: list[Result | Section] = []
    if reasons := [*sentences(solution.placed)]:
        results.append(Facts("Links that do not turn", tuple((str(k), text) for k, text in enumerate(reasons, 1))))
    if omitted := [*left_out(solution.placed, solution.loops.cranks)]:
        results.append(Facts("Left out", tuple((str(k), text) for k, text in enumerate(omitted, 1))))
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
    """A formula, which the page breaks where it has no more room."""
    written = " ".join([formula.left, formula.relation, *formula.rows])
    return PrintedFormula(mathml.display(latex.latex_mathml(written)))


def _velocities(own: PrintedVelocities) -> Formulas:
    """The equations between rates; where both determinants vanish is the caption."""
    said = []
    for kind, name in (("parallel", "det Jp"), ("serial", "det Jq")):
        places = [f"{f'${factor.formula} = 0$: ' if factor.formula else ''}{factor.meaning}"
                  for factor in own.factors if factor.kind == kind]  # fmt: skip
        where = f"vanishes where {'; '.join(places)}" if places else "never vanishes"
        said.append(f"{name}, the determinant of the {'left' if kind == 'parallel' else 'right'} side, {where}.")
    loose = [factor.meaning for factor in own.factors if factor.kind == "constraint"]
    said += [f"The platform is no longer kept from turning where {meaning}." for meaning in loose]
    lines = tuple(map(_line, own.equations))
    return Formulas("Velocities and singular configurations", lines, " ".join(said))
