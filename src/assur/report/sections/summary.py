"""In brief: the numbers that a reader came for."""

from __future__ import annotations

from assur.errors import UsageError
from assur.kinematics.closure import mobility
from assur.kinematics.modes import Problem
from assur.kinematics.solutions import SolutionSet
from assur.report.findings import Findings
from assur.report.numbers import count, shown_unit
from assur.results.kinds import Scalar, Section


def summary(found: Findings) -> Section:
    """Audit counts, degrees of freedom, numbers of solutions, volume, share near a singularity."""
    scalars = []
    for part in (_mobility, _solutions, _workspace, _dexterity, _audit):
        try:
            scalars += part(found)
        except UsageError:  # its own section says why
            continue
    return Section("In brief", results=scalars)


def _mobility(found: Findings) -> list[Scalar]:
    free = mobility(found.record, found.home)
    known = f"rank {int(free.rank)} of the closure of all loops"
    return [Scalar("degrees of freedom", float(free.freedoms), "", known)]


def _solutions(found: Findings) -> list[Scalar]:
    model = "joint graph" if found.form.complete_for == "joint_graph" else "reduced model"
    problems: tuple[tuple[Problem, str, SolutionSet], ...] = (
        ("direct", "inputs", found.direct),
        ("inverse", "pose", found.inverse),
    )
    scalars = []
    for problem, given, answer in problems:
        table = found.table(problem)
        where = f"at the {given} of {table.source if table else 'home'}"
        branches = f"of {count(answer.candidates, 'branch')}"
        known = f"{where}; complete for the {model}"
        scalars.append(Scalar(f"real {problem} solutions", float(len(answer)), branches, known))
    return scalars


def _workspace(found: Findings) -> list[Scalar]:
    region = found.workspace
    what = "workspace volume" if len(region.box.names) == 3 else "workspace area"
    near = f"within {region.near:g} {found.record.unit} of a parallel singularity"
    share = None if region.share is None else round(100 * region.share, 1)
    return [
        Scalar(
            what,
            region.volume,
            shown_unit(region.unit),
            f"mode {region.mode}, file's box",
            region.volume_error,
        ),
        Scalar("share near a singularity", share, "%", near),
    ]


def _dexterity(found: Findings) -> list[Scalar]:
    index = found.global_index
    return [Scalar("global condition index", index.value, "", "mean of 1/cond over the workspace", index.error)]


def _audit(found: Findings) -> list[Scalar]:
    audit = found.audit
    total = f"of {len(audit.rows)}"
    missing = f"and {count(audit.missing, 'value')} missing; " if audit.missing else ""
    return [
        Scalar("printed values that agree", float(audit.ok), total, "to the printed digits"),
        Scalar(
            "printed values that are wrong",
            float(audit.wrong),
            total,
            f"{missing}each with its erratum below",
        ),
    ]
