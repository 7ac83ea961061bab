"""In brief: the numbers that a reader came for."""

from __future__ import annotations

from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.closure import mobility
from assur.kinematics.modes import Problem
from assur.kinematics.rates.instantaneous import instantaneous
from assur.report.findings import REFUSED, Findings
from assur.report.numbers import count, extent_unit
from assur.report.sections.performance import mixed_units
from assur.report.sections.position import how_found, noun
from assur.report.sections.reach import held_words, size_name
from assur.results.kinds import Scalar, Section


def summary(found: Findings) -> Section:
    """Audit counts, degrees of freedom, numbers of solutions, volume, share near a singularity."""
    scalars = []
    for part in (_mobility, _solutions, _workspace, _dexterity, _audit):
        try:
            scalars += part(found)
        except REFUSED:  # its own section says why
            continue
    return Section("In brief", results=scalars)


def _mobility(found: Findings) -> list[Scalar]:
    free = mobility(found.record, found.home)
    internal = int(instantaneous(found.record, found.home).ranks.internal)
    known = f"rank {int(free.rank)} of the closure of all loops"
    rest = f"and {internal} internal" if internal else ""
    return [Scalar("degrees of freedom", float(free.freedoms) - internal, rest, known)]


def _solutions(found: Findings) -> list[Scalar]:
    problems: tuple[tuple[Problem, str, SolutionSet], ...] = (
        ("direct", "inputs", found.direct),
        ("inverse", "pose", found.inverse),
    )
    scalars = []
    for problem, given, answer in problems:
        table, kernel = found.table(problem), found.kernel(problem)
        model = "joint graph" if answer.complete_for == "joint_graph" else "reduced model"
        where = f"at the {given} of {table.source if table else 'home'}"
        candidates = f"of {count(answer.candidates, noun(kernel))}" if kernel else how_found(answer)
        known = f"complete for the {model}" if answer.complete else "not proved to be all"
        name = f"real {problem} solutions"
        scalars.append(Scalar(name, float(len(answer)), candidates, f"{where}; {known}"))
    return scalars


def _workspace(found: Findings) -> list[Scalar]:
    region, record = found.workspace, found.record
    extent = Scalar(
        f"workspace {size_name(region)}",
        region.volume,
        extent_unit(record, region.box.names),
        f"mode {region.mode}, file's box{held_words(region, record)}",
        region.volume_error,
    )
    if region.share is None:
        return [extent]
    near = f"within {region.near:g} {record.unit} of a parallel singularity"
    return [extent, Scalar("share near a singularity", round(100 * region.share, 1), "%", near)]


def _dexterity(found: Findings) -> list[Scalar]:
    if mixed_units(found.record):
        return []  # a number that depends on the unit of length is nobody's first question
    index = found.global_index
    return [Scalar("global condition index", index.value, "", "mean of 1/cond over the workspace", index.error)]


def _audit(found: Findings) -> list[Scalar]:
    audit = found.audit
    total = f"of {len(audit.rows)}"
    agree = Scalar(f"{found.given} values that agree", float(audit.ok), total, f"to the {found.given} digits")
    if not audit.wrong and not audit.missing:
        return [agree]
    missing = f"and {count(audit.missing, 'value')} missing; " if audit.missing else ""
    known = f"{missing}each with its erratum below"
    return [agree, Scalar(f"{found.given} values that are wrong", float(audit.wrong), total, known)]
