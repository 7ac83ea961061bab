"""Every solution of a problem: its values, limits that it exceeds, and what the pose leaves out."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from assur.kinematics.answers.answer import answer
from assur.kinematics.answers.style import texts_of, titles_of
from assur.kinematics.limits import NO_LIMITS
from assur.kinematics.modes import Problem
from assur.kinematics.naming import described_signs
from assur.kinematics.status import Status
from assur.report.findings import Findings
from assur.report.sections.proved import right
from assur.results.answers.position import DirectAnswer, ExceededLimit, InverseAnswer
from assur.results.kinds import Result, Table
from assur.results.typeset_text import short

Positions = DirectAnswer | InverseAnswer


def solutions(findings: Findings, problem: Problem) -> list[Result]:
    """Every real solution: its mode, values, the other mode, status, the gap that is left, whether it keeps the limits;
    and of each the platform's coordinates that the pose leaves out.
    """
    data = answer(findings.direct if problem == "direct" else findings.inverse)
    return [_listed(findings, data), *_left_out(findings, data)]


def _listed(findings: Findings, data: Positions) -> Table:
    record, style, direct = findings.record, findings.style, data.problem == "direct"
    limited = data.limits_stated
    rows = tuple(
        (
            item.mode,
            *texts_of(record, style, item.numbers, direct=direct),
            item.other_mode,
            "yes" if item.home else "",
            item.status.replace("_", " "),
            short(item.residual, 2),
            *([_limits(item.limits.outside)] if limited else []),
        )
        for item in data.solutions
    )
    other = "working mode" if direct else "assembly mode"
    after = ("home", "status", style.kind_title("gap", "length"), *(["limits"] if limited else []))
    columns = ("mode", *titles_of(record, style, direct=direct), other, *after)
    marks = tuple("" if Status[item.status] <= Status.near_singular else "singular" for item in data.solutions)
    title = f"Solutions of the {data.problem} problem"
    return Table(
        title, columns, rows, " ".join(_caption(findings, data)), marks, known_by=right(findings, data.problem)[0]
    )


def _limits(outside: Sequence[ExceededLimit]) -> str:
    """Each limit that a solution exceeds, and by how much."""
    return "; ".join(f"{limit.limit}: by {short(limit.by)} {limit.unit}" for limit in outside) or "within"


def _caption(findings: Findings, data: Positions) -> Iterator[str]:
    yield "All real solutions." if data.complete else "What was found; it is not proved to be all."
    if not data.limits_stated:
        yield f"{NO_LIMITS[0].upper()}{NO_LIMITS[1:]}."
    yield (
        "The gap is the largest that remains over the cut joints of the whole joint graph, or to what was "
        "asked, orientation errors times its characteristic length included. A sign written 0 has merged."
    )
    if any(item.mode.partition("~")[0].strip("+-0") for item in data.solutions):
        yield "A letter tells solutions of the same signs apart; it is not kept along paths."
    tabled = {sign.name for sign in described_signs(findings.record, data.problem) if not sign.written}
    for name, meaning in ((name, meaning) for name, meaning in data.signs.items() if name not in tabled):
        yield f"{name} is + where {meaning}."
    if data.home_by:
        yield f"{data.home_by[0].upper()}{data.home_by[1:]}."
    for pair in data.doubles:
        yield f"{' and '.join(pair.modes)} are a double: one solution, or two too near to tell."
    for text in dict.fromkeys(entry.angles for entry in data.solutions if entry.angles):
        modes = ", ".join(entry.mode for entry in data.solutions if entry.angles == text)
        yield f"{modes}: {text}; phi and psi are one choice of many."


def _left_out(findings: Findings, data: Positions) -> list[Table]:
    """Without these, solutions that differ in nothing else look the same."""
    listed = [item for item in data.solutions if item.parasitic]
    if not listed:
        return []
    style, names = findings.style, tuple(listed[0].parasitic)
    rows = tuple((item.mode, *(style.coordinate(name, item.parasitic[name]) for name in names)) for item in listed)
    columns = ("mode", *map(style.coordinate_title, names))
    caption = "The platform's coordinates that the pose leaves out, of each solution."
    title = f"What the pose leaves out, {data.problem} problem"
    return [Table(title, columns, rows, caption, known_by=right(findings, data.problem)[0])]
