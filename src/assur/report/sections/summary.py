"""In brief: the machine, the numbers that a reader came for, and what of them is proved."""

from __future__ import annotations

import contextlib
from collections.abc import Iterable
from dataclasses import replace

from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.closure import mobility
from assur.kinematics.modes import Problem
from assur.kinematics.rates.instantaneous import instantaneous
from assur.kinematics.rates.units import is_mixed
from assur.kinematics.status import Status
from assur.report.findings import Findings
from assur.report.render import scalar_text
from assur.report.sections.performance import SPREAD
from assur.report.sections.position import noun, source_of
from assur.report.sections.proved import right
from assur.report.sections.reach import extents, held_words, largest_cube, share
from assur.results.attempt import REFUSED
from assur.results.kinds import PROVED, RANK, Facts, Scalar, Section
from assur.results.plain_text import count

NUMBERS = 5
"""So many stand in brief: freedoms, solutions of both problems, workspace, and what says most of the motion in it."""


def summary(findings: Findings) -> Section:
    """The machine, the five numbers that matter, and what of it is proved."""
    scalars: list[Scalar] = []
    for part in (_mobility, _solutions, _workspace, _dexterity, share, largest_cube):
        if len(scalars) < NUMBERS:
            with contextlib.suppress(*REFUSED):  # its own section says why
                scalars += part(findings)
    return Section("In brief", results=[*findings.picture("solid"), *scalars[:NUMBERS], _proved(findings, scalars)])


def _proved(findings: Findings, scalars: Iterable[Scalar]) -> Facts:
    """By what right each number is known, then what is proved free of singularities, then the audit."""
    facts = [(scalar.name, f"{scalar.known_by}{f' ({scalar.note})' if scalar.note else ''}") for scalar in scalars]
    for part in (_nowhere, _cube, _audit):
        with contextlib.suppress(*REFUSED):
            facts += part(findings)
    return Facts("What is proved, and what is not", tuple(dict(facts).items()))


def _nowhere(findings: Findings) -> list[tuple[str, str]]:
    names = ", ".join(sorted(findings.nowhere))
    return [("never singular", f"{PROVED}: {names} is nowhere zero inside the workspace")] if names else []


def _cube(findings: Findings) -> list[tuple[str, str]]:
    return [
        (cube.name, f"{scalar_text(cube)} {cube.unit}, {cube.known_by} ({cube.note})")
        for cube in largest_cube(findings)
    ]


def _mobility(findings: Findings) -> list[Scalar]:
    free = mobility(findings.record, findings.home)
    internal = int(instantaneous(findings.record, findings.home).ranks.internal)
    of_what = f"rank {int(free.rank)} of the closure of all loops"
    rest = f"and {internal} internal" if internal else ""
    return [Scalar("degrees of freedom", float(free.freedoms) - internal, rest, RANK, note=of_what)]


def _solutions(findings: Findings) -> list[Scalar]:
    problems: tuple[tuple[Problem, str, SolutionSet], ...] = (
        ("direct", "inputs", findings.direct),
        ("inverse", "pose", findings.inverse),
    )
    scalars = []
    for problem, given, answer in problems:
        table, kernel = findings.table(problem), findings.kernel(problem)
        model = "joint graph" if answer.complete_for == "joint_graph" else "reduced model"
        where = f"at the {given} of {table.source if table else 'home'}"
        where += "" if kernel else f", {source_of(answer)}"
        candidates = f"of {count(answer.candidates, noun(kernel))}" if kernel else ""
        complete = f"{where}; complete for the {model}" if answer.complete else where
        if problem == "direct" and any(solution.status is Status.self_motion for solution in answer):
            complete += "; with the inputs held the platform moves through infinitely many, of which these are some"
        known, low, high = right(findings, problem)
        name = f"real {problem} solutions"
        scalars.append(Scalar(name, float(len(answer)), candidates, known, low=low, high=high, note=complete))
    return scalars


def _workspace(findings: Findings) -> list[Scalar]:
    region, record = findings.workspace, findings.record
    mode = f"mode {region.mode}, " if region.mode else ""
    of_what = f"{mode}file's box{held_words(region, record)}"
    best = extents(findings)[0]
    return [replace(best, name=f"workspace {best.name}", note=of_what)]


def _dexterity(findings: Findings) -> list[Scalar]:
    if is_mixed(findings.record):
        return []  # a number that depends on a characteristic length is nobody's first question
    index = findings.mean_index
    of_what = "mean of 1/cond over the workspace"
    return [Scalar("global condition index", index.value, "", SPREAD, index.error, note=of_what)]


def _audit(findings: Findings) -> list[tuple[str, str]]:
    audit = findings.audit
    said = f"{audit.ok} of {len(audit.rows)} {findings.given} values agree"
    if audit.wrong or audit.missing:
        said += f", {audit.wrong} are wrong and {audit.missing} missing, each with its erratum below"
    return [("audit of the source", said)]
