"""`assur check`: every fault of a file at once, and what its joint graph says."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from assur.cli import exit_codes
from assur.cli.called import called
from assur.cli.options import SHARED_DEFAULTS, MechanismName, Outcome, Shared
from assur.cli.output import Verbatim, heading
from assur.results.plain_text import count
from assur.work import stage

if TYPE_CHECKING:
    from rich.console import RenderableType

    from assur.errors import Problem
    from assur.model.mechanism import MechanismRecord
    from assur.results.answers.check import CheckAnswer, ExactAnswer, SoundFacts


def check(
    mechanism: MechanismName,
    /,
    *,
    deep: Annotated[
        bool, Parameter(help="Hold the closed form against the joint graph at thousands of places, built in or not.")
    ] = False,
    shared: Shared = SHARED_DEFAULTS,
) -> Outcome:
    """Every fault of a mechanism's file, each with its line.

    Of the text: its form, names, numbers, formulas and labels; and of the closed
    form and the figures.toml beside it. Where what the loops are made of is
    sound, of the joint graph too: whether it closes and moves, whether its
    inputs determine it, whether pose, orientation and limits are as stated.
    Last, a closed form of your own is held against the joint graph: loops,
    velocities, factors, names of modes, ends of branches, completeness at a few
    problems, what it divides by and draws roots of; and any closed form in exact
    arithmetic. Exit code 3: there is a fault.

    For example:
        assur check my.toml
        assur check my.toml --json
    """
    from assur.kinematics.validation.check import doubts, faults
    from assur.model.examination import examine
    from assur.model.registry import load_record
    from assur.report.labels import label_faults

    with stage("text of the files") as text:
        known, problems = examine(mechanism)
        text.result = count(len(problems), "fault")
    if problems:
        every = [*problems, *((*faults(known), *label_faults(known)) if known else ())]
        every.sort(key=lambda problem: (not problem.file.endswith(".toml"), problem.file, problem.line or 0))
        return _outcome(mechanism, every, (), None)
    record = load_record(mechanism, **shared.dimensions)
    with stage("joint graph and labels") as work:
        found: tuple[Problem, ...] = (*faults(record), *label_faults(record))
        work.result = count(len(found), "fault")
    with stage("closed form") as work:
        found = found or _of_closed_form(record, deep)
        work.result = count(len(found), "fault")
    facts = None if found else _summary(record)
    notes = () if found else (*doubts(record), *_units(record))
    return _outcome(record.name, found, notes, facts, _next(mechanism, record, found))


def _units(record: MechanismRecord) -> Iterator[Problem]:
    """Numbers of the machine that look as if another unit had been meant."""
    from assur.machine.masses.slips import slips
    from assur.model.file.place import place, problem

    for slip in slips(record, {}):
        yield replace(problem(record, place(record, slip.table, slip.name), slip.given, ""), allowed=slip.meant)


def _of_closed_form(record: MechanismRecord, deep: bool) -> tuple[Problem, ...]:
    """What a closed form claims and the joint graph denies; at places, one that is built in is held so by the tests."""
    if record.closed_form is None:
        return ()  # without all the laws that a closed form is held to
    from assur.kinematics.contract.admission import closed_form_problems
    from assur.kinematics.contract.check import exact_problems
    from assur.kinematics.contract.extent import DEEP, IN_FULL

    return closed_form_problems(record, DEEP if deep else IN_FULL, built_in=deep) or exact_problems(record)


def _exact(record: MechanismRecord) -> ExactAnswer | None:
    """What exact arithmetic says of the formulas of a closed form."""
    if record.closed_form is None:
        return None
    from assur.kinematics.contract.exact import exactness
    from assur.results.answers.check import ExactAnswer

    exact = exactness(record)
    proved = exact.proved
    error, general = exact.error if proved else None, exact.general if proved else None
    return ExactAnswer(exact.text, proved, general, error, exact.guarded, exact.undecided)


def _summary(record: MechanismRecord) -> SoundFacts:
    from assur.kinematics.rates.architecture import architecture_text
    from assur.kinematics.rates.motions import general
    from assur.model.registry import is_built_in
    from assur.results.answers.check import SoundFacts

    usual = general(record)
    own = record.closed_form is not None and not is_built_in(record)
    return SoundFacts(
        links=len(record.links),
        joints=len(record.joints),
        freedoms=int(usual.freedoms - usual.internal),
        internal_freedoms=int(usual.internal),
        redundant_inputs=tuple(item.name for item in record.redundant_inputs),
        architecture=architecture_text(record),
        closed_form=record.closed_form is not None,
        closed_form_checked=own,
        closed_form_not_run=record.closed_form_not_run,
        exact=_exact(record),
        unproved=_unproved(record) if own else (),
    )


def _unproved(record: MechanismRecord) -> tuple[str, ...]:
    from assur.kinematics.contract.check import unproved

    return unproved(record)


def _next(mechanism: str, record: MechanismRecord, faults: Iterable[Problem]) -> tuple[str, ...]:
    """What to do with a sound file of one's own; nothing where it is one of the catalogue."""
    if not mechanism.endswith(".toml"):
        return ()
    return *_derivable(mechanism, record, faults), f"next: {called()} page {mechanism}"


def _derivable(mechanism: str, record: MechanismRecord, faults: Iterable[Problem]) -> Iterator[str]:
    """How a closed form may be had: whether there is one is seen only by deriving it, which takes seconds."""
    if record.closed_form is None and not record.closed_form_not_run and not [*faults]:
        yield f"next: {called()} derive {mechanism}, for a closed form where there is one"


def _outcome(
    name: str,
    problems: Iterable[Problem],
    notes: Iterable[Problem],
    facts: SoundFacts | None,
    then: Iterable[str] = (),
) -> Outcome:
    from assur.results.answers.check import CheckAnswer

    faults = tuple(problems)
    answer = CheckAnswer(name, not faults, faults, tuple(notes), facts)
    return Outcome(answer, lambda: _shown(answer, then), exit_codes.BAD_FILE if faults else exit_codes.FINE)


def _shown(data: CheckAnswer, then: Iterable[str]) -> Iterable[RenderableType]:
    if (facts := data.facts) is None:
        yield heading(f"{data.mechanism}: {count(len(data.faults), 'fault')}")
        yield from (Verbatim(problem) for problem in data.faults)
        return
    yield heading(f"{data.mechanism}: sound")
    internal = facts.internal_freedoms
    spins = f" and {count(internal, 'internal freedom')}" if internal else ""
    bodies = f"{count(facts.links, 'link')}, {count(facts.joints, 'joint')}"
    yield f"{bodies}; {count(facts.freedoms, 'freedom')}{spins}"
    if facts.redundant_inputs:
        yield f"redundant inputs, which follow the others: {', '.join(facts.redundant_inputs)}"
    if facts.architecture:
        yield facts.architecture
    if facts.closed_form_not_run:
        yield "its closed form is Python that assur cannot read as formulas, and was not run: the joint graph answers"
    elif facts.closed_form_checked:
        yield "a closed form stands beside it, and agrees with the joint graph"
    elif facts.closed_form:
        yield "a closed form stands beside it"
    else:
        yield "no closed form: it is solved on its joint graph"
    if facts.exact:
        yield Verbatim(facts.exact.says if facts.exact.proved else f"note: {facts.exact.says}")
    if facts.unproved:
        yield Verbatim(
            f"note: its reduced model ends branches by {count(len(facts.unproved), 'margin')} without signs, "
            f"compared with the joint graph at places only: {', '.join(facts.unproved)}"
        )
    yield from (Verbatim(f"note: {note}") for note in data.notes)
    yield from map(Verbatim, then)
