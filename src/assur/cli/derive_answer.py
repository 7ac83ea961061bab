"""The answer of `assur derive`: what was derived, as data."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Sequence
from dataclasses import asdict, replace
from pathlib import Path

from assur.cli import exit_codes
from assur.cli.derive_text import resistance, shown
from assur.cli.options import Outcome
from assur.cli.paths import output_file
from assur.derivation.closed_conditions import closed_conditions
from assur.derivation.closed_form_formulas import ClosedFormFormulas
from assur.derivation.constraint_couples import COPLANAR, coplanar_couples
from assur.derivation.dimension_relations import is_stated
from assur.derivation.elimination import SolvedSet
from assur.derivation.factor_meanings import FactorMeanings
from assur.derivation.home_conditions import conditions_at_home
from assur.derivation.kept import derived_closed_form, derived_document
from assur.derivation.linear import value_of
from assur.derivation.linear_span import NoIdentityError
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.orientations import LinkOrientations
from assur.derivation.phrases import direction
from assur.derivation.platform_rotation import posed_entries
from assur.derivation.pose_system import UNKNOWNS
from assur.derivation.proof import proof
from assur.derivation.reach_meanings import ReachMeanings
from assur.derivation.reasons import left_out, sentences
from assur.derivation.resisting_set import ResistingSetError
from assur.derivation.solution import AnalyticSolution, analytic_solution
from assur.derivation.solution_count import SECONDS, SolutionCount, solution_count
from assur.errors import AssurError, UsageError
from assur.kinematics.modes import Problem
from assur.mechanism import Mechanism
from assur.results.answers.answer import ABSENT, Absent
from assur.results.answers.derivation import (
    CountedSolutions,
    DerivationAnswer,
    DerivedCase,
    DerivedChoice,
    DerivedComponents,
    DerivedFactor,
    DerivedProblem,
    DerivedReason,
    DerivedRelation,
    DerivedSet,
    ResistingSet,
)
from assur.results.files import write_whole

NAMES: dict[str, Problem] = {"direct": "direct", "inverse": "inverse"}
FEW_SECONDS = 30.0
"""For a count that nobody asked for."""


def outcome(
    record: Mechanism,
    problem: str,
    output: str | None,
    latex: str | None = None,
    c: str | None = None,
    prove: bool = False,
    square_roots: bool = False,
) -> Outcome:
    """What was derived, as data and for a person; written where a file is named."""
    document = None if latex is None else output_file(latex, (".tex",))
    path = None if output is None else output_file(output, (".py",))
    source = None if c is None else output_file(c, (".c",))
    if (path is not None or source is not None) and problem != "both":
        raise UsageError("a closed form has both problems", hint="leave --problem out")
    if record.redundant_inputs and (path is not None or source is not None):
        names = ", ".join(item.name for item in record.redundant_inputs)
        raise UsageError(
            f"a closed form has no redundant inputs, and {names} would be", hint="leave them out of [inputs] first"
        )
    asked: tuple[Problem, ...] = ("direct", "inverse") if problem == "both" else (problem,)  # type: ignore[assignment]
    parts = tuple(_derived(record, name) for name in asked)
    fine = all(part.status == "derived" for part in parts)
    not_written = _not_written(record, path, source) if fine and (path or source) else ""
    parts = tuple(_with_count(record, part, prove) for part in parts)
    if document is not None:
        _write_document(document, record, parts)
    fine = fine and not not_written
    fine = fine and all(part.count is ABSENT or part.count.solutions in (None, part.branches) for part in parts)
    if prove:
        parts = tuple(_with_proof(record, part) for part in parts)
        fine = fine and all(part.not_proved is ABSENT for part in parts)
    data = DerivationAnswer(
        record.name,
        parts,
        str(path) if path is not None and fine else None,
        not_written or ABSENT,
        ABSENT if document is None else str(document),
        str(source) if source is not None and fine else ABSENT,
        factors=tuple(own for part in parts if part.problem == "inverse" and not part.why for own in _factors(record)),
    )
    answers = [part.square_roots for part in parts] if square_roots else []
    return Outcome(data, lambda: shown(data), exit_code=exit_codes.of_answers([*answers, "yes" if fine else "open"]))


def _not_written(record: Mechanism, path: Path | None, source: Path | None) -> str:
    """Write the closed form as a file that is read, and as C; why it cannot be written, where it cannot."""
    from assur.export.c99 import c99_text
    from assur.model.kernels.reading import names_of

    try:
        text = derived_closed_form(record)
    except NotDerivedError as error:
        return str(error)
    if path is not None:
        write_whole(path, text)
    if source is not None:
        form = names_of(text, Path("closed_form.py"))["CLOSED_FORM"]
        write_whole(source, c99_text(record.with_closed_form(form, text)))
    return ""


def _write_document(path: Path, record: Mechanism, parts: Sequence[DerivedProblem]) -> None:
    """What was derived, for print, with the theory's loops where it has them."""
    from assur.derivation.document import document
    from assur.derivation.printed_derivation import printed_derivation
    from assur.derived_topology import topology

    why = {NAMES[own.problem]: "; ".join(resistance(own)) if own.why else "" for own in parts}

    def written() -> str:
        solved = {NAMES[own.problem]: analytic_solution(record, NAMES[own.problem]) for own in parts if not own.why}
        try:
            loops = topology(record)
        except AssurError:  # a mechanism may have formulas and no topology that the theory gives
            loops = None
        return document(printed_derivation(record, solved, {key: own for key, own in why.items() if own}), loops)

    write_whole(path, derived_document(record, why, written))


def _derived(record: Mechanism, problem: Problem) -> DerivedProblem:
    try:
        solution = analytic_solution(record, problem)
        solution.held_against_loops()
    except ResistingSetError as error:
        resists = ResistingSet(
            tuple(direction.name for direction in error.left),
            tuple(tuple(unknown.name for unknown in direction.unknowns) for direction in error.left),
        )
        return DerivedProblem(
            problem, "not_derived", str(error), None, None, tuple(_reasons(error.placed)), (*record.generalised,),
            _sets(error.sets), {}, {}, resists=resists, left_out=(*left_out(error.placed),), sides=error.placed.sides,
        )  # fmt: skip
    except NotDerivedError as error:
        whole = ResistingSet((record.platform.link,), UNKNOWNS) if problem == "direct" else ABSENT
        return DerivedProblem(problem, "not_derived", str(error), None, None, (), (), (), {}, {}, resists=whole)
    return DerivedProblem(
        problem, "derived", "", solution.branches, True, tuple(_reasons(solution.placed)), (*record.generalised,),
        _sets(solution.sets, ReachMeanings(solution)), {own.symbol.name: str(own.formula) for own in solution.lengths},
        dict(_results(solution)), solution.group.sentence if solution.group else "",
        square_roots="yes" if solution.eliminant is None else "no" if _no_tower(solution) else "open",
        components=_components(solution), sides=solution.placed.sides,
        left_out=(*left_out(solution.placed, solution.loops.cranks),),
        vanish_at_home=tuple(map(str, conditions_at_home(solution))), relations=(*_relations(solution),),
        conditions=tuple(f"{own} != 0" for own in solution.length_conditions),
    )  # fmt: skip


def _relations(solution: AnalyticSolution) -> Iterator[DerivedRelation]:
    for own in solution.loops.relations:
        yield DerivedRelation(str(own.symbol), str(own.formula), is_stated(solution.symbols, own))


def _no_tower(solution: AnalyticSolution) -> bool:
    """Whether it is proved that square roots alone do not solve it."""
    return any(own is not None and own.no_tower for own in (solution.components, solution.group))


def _components(solution: AnalyticSolution) -> DerivedComponents | Absent:
    own = solution.components
    if own is None:
        return ABSENT
    degrees = tuple(part.degree for part in own.parts)
    unknown = None if own.unknown is None else own.unknown.name
    return DerivedComponents(unknown, degrees, own.solutions, own.sentence)


def _sets(parts: Sequence[SolvedSet], reach: ReachMeanings | None = None) -> tuple[DerivedSet, ...]:
    return tuple(
        DerivedSet(
            tuple(direction.name for direction in part.directions),
            tuple(tuple(unknown.name for unknown in direction.unknowns) for direction in part.directions),
            tuple(f"{value_of(form)} = 0" for form in part.equations),
            tuple(f"{value_of(form)} = 0" for form in part.lines),
            tuple(f"{condition} != 0" for condition in part.conditions),
            {own.symbol.name: str(own.formula) for own in part.formulas},
            tuple(DerivedChoice(own.symbol.name, own.radicand.name, str(own.quantity)) for own in part.roots),
            part.count,
            {} if reach is None else dict(_meanings(reach, part)),
        )
        for part in parts
    )


def _with_count(record: Mechanism, part: DerivedProblem, prove: bool) -> DerivedProblem:
    """A problem with its number of solutions, where that is asked for or a set resists."""
    if not prove and part.resists is ABSENT:
        return part
    try:
        own = solution_count(record, NAMES[part.problem], SECONDS if prove else FEW_SECONDS)
    except NotDerivedError as error:
        own = SolutionCount(None, str(error), (), (), "")
        return part if part.resists is ABSENT else replace(part, count=CountedSolutions(**asdict(own)))
    return replace(part, count=CountedSolutions(**asdict(own)))


def _with_proof(record: Mechanism, part: DerivedProblem) -> DerivedProblem:
    """A problem with an identity for each step; why there are none, where that is so."""
    if part.status != "derived":
        return part
    try:
        solution = analytic_solution(record, NAMES[part.problem])
        part = replace(part, closed=tuple(_closed(solution)))
        return replace(part, proof=proof(solution))
    except NoIdentityError as error:
        return replace(part, not_proved=str(error))


def _closed(solution: AnalyticSolution) -> Iterator[DerivedCase]:
    """What holds where conditions do not."""
    for own in closed_conditions(solution):
        texts = (tuple(map(str, formulas)) for formulas in (own.vanish, own.formulas))
        vanish, formulas = texts
        yield DerivedCase(str(own.condition), vanish, own.outcome, own.freedoms, own.links, formulas)


def _meanings(reach: ReachMeanings, part: SolvedSet) -> Iterator[tuple[str, str]]:
    """Of radicands and conditions what it means that they fail."""
    for root in part.roots:
        yield root.radicand.name, reach.radicands[root.radicand].text
    for condition in part.conditions:
        yield str(condition), reach.condition(part, condition).text


def _factors(record: Mechanism) -> Iterator[DerivedFactor]:
    """The factors of both determinants; none where the velocity equations do not follow."""
    inverse = analytic_solution(record, "inverse")
    formulas, meanings = ClosedFormFormulas(inverse, inverse, {}), FactorMeanings(inverse)
    with contextlib.suppress(NotDerivedError):
        for name, kind, value in formulas.factors:
            yield DerivedFactor(name, kind, str(value), meanings.of(value, kind, shared=formulas.is_shared(value)).text)
        for name, value in coplanar_couples(inverse).items():
            yield DerivedFactor(name, "constraint", str(value), COPLANAR)


def _reasons(placed: LinkOrientations) -> Iterator[DerivedReason]:
    for text, own in zip(sentences(placed), placed.reasons, strict=True):
        axes = direction(own.first), direction(own.second)
        yield DerivedReason(text, own.link, own.carrier, axes, (own.first_joints, own.second_joints))


def _results(solution: AnalyticSolution) -> Iterator[tuple[str, str]]:
    if solution.symbols.problem == "inverse":
        yield from ((own.symbol.name, str(own.formula)) for own in solution.lengths)
    else:
        yield from zip("xyz", map(str, solution.point), strict=True)
        yield from ((name, str(formula)) for name, formula in posed_entries(solution))
