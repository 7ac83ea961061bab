"""In brief: the numbers that a reader came for."""

from __future__ import annotations

from dataclasses import replace

from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.closure import mobility
from assur.kinematics.modes import Problem
from assur.kinematics.rates.instantaneous import instantaneous
from assur.kinematics.rates.units import is_mixed
from assur.kinematics.status import Status
from assur.report.findings import Findings
from assur.report.sections.performance import SPREAD
from assur.report.sections.position import noun, source_of
from assur.report.sections.proved import right
from assur.report.sections.reach import extents, held_words, share
from assur.results.attempt import REFUSED
from assur.results.kinds import EXACT, RANK, Scalar, Section
from assur.results.plain_text import count


def summary(findings: Findings) -> Section:
    """Audit counts, degrees of freedom, numbers of solutions, volume, share near a singularity."""
    scalars = []
    for part in (_mobility, _solutions, _workspace, _dexterity, _audit):
        try:
            scalars += part(findings)
        except REFUSED:  # its own section says why
            continue
    return Section("In brief", results=scalars)


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
        candidates = f"of {count(answer.candidates, noun(kernel))}" if kernel else source_of(answer)
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
    return [replace(best, name=f"workspace {best.name}", note=of_what), *share(findings)]


def _dexterity(findings: Findings) -> list[Scalar]:
    if is_mixed(findings.record):
        return []  # a number that depends on a characteristic length is nobody's first question
    index = findings.mean_index
    of_what = "mean of 1/cond over the workspace"
    return [Scalar("global condition index", index.value, "", SPREAD, index.error, note=of_what)]


def _audit(findings: Findings) -> list[Scalar]:
    audit = findings.audit
    total = f"of {len(audit.rows)}"
    agree = Scalar(
        f"{findings.given} values that agree", float(audit.ok), total, EXACT, note=f"to the {findings.given} digits"
    )
    if not audit.wrong and not audit.missing:
        return [agree]
    missing = f"and {count(audit.missing, 'value')} missing; " if audit.missing else ""
    of_what = f"{missing}each with its erratum below"
    return [agree, Scalar(f"{findings.given} values that are wrong", float(audit.wrong), total, EXACT, note=of_what)]
