"""Every solution of a problem: its values, limits that it exceeds, and what the pose leaves out."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from assur.kinematics.answers.answer import answer
from assur.kinematics.answers.at_border import inputs_at_border, pose_at_border
from assur.kinematics.answers.solution import Solution
from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.limits import NO_LIMITS
from assur.kinematics.modes import Problem
from assur.kinematics.status import Status
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle
from assur.report.findings import Findings
from assur.report.numbers import Style, input_angles, pose_angles, short
from assur.report.sections.proved import right
from assur.results.answers.position import DirectAnswer, ExceededLimit, InputsSolution, InverseAnswer, PoseSolution
from assur.results.kinds import Result, Table


def solutions(findings: Findings, problem: Problem) -> list[Result]:
    """Every real solution: its mode, values, the other mode, status, the gap that is left, whether it keeps the limits;
    and of each the platform's coordinates that the pose leaves out.
    """
    listed = findings.direct if problem == "direct" else findings.inverse
    data = answer(listed)
    return [_listed(findings, problem, listed, data), *_left_out(findings, problem, data.solutions)]


def _listed(findings: Findings, problem: Problem, listed: SolutionSet, data: DirectAnswer | InverseAnswer) -> Table:
    record, style = findings.record, findings.style
    direct = problem == "direct"
    names = record.platform.pose if direct else tuple(actuated.name for actuated in record.inputs)
    angles = pose_angles(record) if direct else input_angles(record)
    other = "working mode" if direct else "assembly mode"
    limited = data.limits_stated
    rows = tuple(
        (
            solution.mode,
            *_values(record, style, solution, angles, direct=direct),
            solution.working_mode if direct else solution.assembly_mode,
            "yes" if answer.home else "",
            solution.status.name.replace("_", " "),
            short(solution.residual, 2),
            *([_limits(answer.limits.outside)] if limited else []),
        )
        for solution, answer in zip(listed, data.solutions, strict=True)
    )
    titles = tuple(style.title(name, angle=angle) for name, angle in zip(names, angles, strict=True))
    after = ("home", "status", style.title("gap", angle=False), *(["limits"] if limited else []))
    columns = ("mode", *titles, other, *after)
    caption = " ".join(_caption(listed, data))
    marks = tuple("" if solution.status <= Status.near_singular else "singular" for solution in listed)
    known = right(findings, problem)[0]
    return Table(f"Solutions of the {problem} problem", columns, rows, caption, marks, known_by=known)


def _values(
    record: MechanismRecord, style: Style, solution: Solution, angles: Sequence[bool], *, direct: bool
) -> tuple[str, ...]:
    values = pose_at_border(record, solution.pose) if direct else inputs_at_border(record, solution.inputs)
    return tuple(style.written(float(value), angle=angle) for value, angle in zip(values, angles, strict=True))


def _limits(outside: Sequence[ExceededLimit]) -> str:
    """Each limit that a solution exceeds, and by how much."""
    return "; ".join(f"{limit.limit}: by {short(limit.by)} {limit.unit}" for limit in outside) or "within"


def _caption(listed: SolutionSet, data: DirectAnswer | InverseAnswer) -> Iterator[str]:
    yield "All real solutions." if listed.complete else "What was found; it is not proved to be all."
    if not data.limits_stated:
        yield f"{NO_LIMITS[0].upper()}{NO_LIMITS[1:]}."
    yield (
        "The gap is the largest that remains over the cut joints of the whole joint graph, or to what was "
        "asked, orientation errors times its characteristic length included. A sign written 0 has merged."
    )
    if any("/" in solution.mode for solution in listed):
        yield "A number tells solutions of the same signs apart."
    if data.home_by:
        yield f"{data.home_by[0].upper()}{data.home_by[1:]}."
    for pair in data.doubles:
        yield f"{' and '.join(pair.modes)} are a double: one solution, or two too near to tell."
    for text in dict.fromkeys(entry.angles for entry in data.solutions if entry.angles):
        modes = ", ".join(entry.mode for entry in data.solutions if entry.angles == text)
        yield f"{modes}: {text}; phi and psi are one choice of many."


def _left_out(findings: Findings, problem: Problem, listed: Sequence[PoseSolution | InputsSolution]) -> list[Table]:
    """Without these, solutions that differ in nothing else look the same."""
    if not any(answer.parasitic for answer in listed):
        return []
    style, names = findings.style, tuple(next(answer.parasitic for answer in listed if answer.parasitic))
    rows = tuple(
        (answer.mode, *(style.written(answer.parasitic[name], angle=is_angle(name)) for name in names))
        for answer in listed
        if answer.parasitic
    )
    columns = ("mode", *(style.title(name, angle=is_angle(name)) for name in names))
    caption = "The platform's coordinates that the pose leaves out, of each solution."
    return [
        Table(
            f"What the pose leaves out, {problem} problem", columns, rows, caption, known_by=right(findings, problem)[0]
        )
    ]
