"""Printed tables of solutions: each row beside the real solution that is nearest to it, and those that no row has."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from assur.audit.constraints import broken
from assur.audit.printed import Printed
from assur.audit.reference import Digits
from assur.audit.rows import Row
from assur.audit.tolerance import half_units, tolerances
from assur.errors import UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.points import quantity
from assur.kinematics import border
from assur.kinematics.answers import at_border
from assur.kinematics.answers.solution import Solution
from assur.kinematics.modes import Problem
from assur.kinematics.position import direct, inverse
from assur.kinematics.status import Status
from assur.model.file.schema import Entry
from assur.model.file.values import Value
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle

FloatArray = NDArray[np.float64]


class Requirement(Entry):
    """A formula of the joint graph that is positive where a configuration can be built."""

    positive: Value
    otherwise: str


class TableRow(Entry):
    """One line of a table; its erratum shows where a value is wrong or a note is due."""

    row: str
    values: tuple[Digits, ...]
    erratum: str = ""


class PrintedTable(Entry):
    """Poses at given inputs, or inputs at a given pose; `erratum` explains the solutions that it leaves out."""

    source: str
    given: tuple[Digits, ...]
    rows: tuple[TableRow, ...]
    requires: tuple[Requirement, ...] = ()
    erratum: str = ""


@dataclass(frozen=True, eq=False)
class _Border:
    """A problem at the border: names and units of its results, and how they are read from a solution."""

    record: MechanismRecord
    problem: Problem

    @property
    def names(self) -> tuple[str, ...]:
        return self.record.platform.pose if self.problem == "direct" else border.input_names(self.record)

    @property
    def angular(self) -> list[bool]:
        if self.problem == "direct":
            return [is_angle(name) for name in self.record.platform.pose]
        return [actuated.coordinate.kind == "angle" for actuated in self.record.inputs]

    @property
    def units(self) -> list[str]:
        return [self.record.angle if angular else self.record.unit for angular in self.angular]

    def result(self, solution: Solution) -> FloatArray:
        values = solution.pose if self.problem == "direct" else solution.inputs
        return self.outside(values)

    def outside(self, values: FloatArray) -> FloatArray:
        direct_problem = self.problem == "direct"
        to_border = at_border.pose_at_border if direct_problem else at_border.inputs_at_border
        return np.asarray(to_border(self.record, values), dtype=float)

    def inside(self, values: FloatArray) -> FloatArray:
        direct_problem = self.problem == "direct"
        from_border = at_border.pose_from_border if direct_problem else at_border.inputs_from_border
        return from_border(self.record, values)

    def aligned(self, values: FloatArray, printed: FloatArray) -> FloatArray:
        """Results with their angles turned to within half a turn of the printed ones."""
        turn = 360.0 if self.record.angle == "deg" else 2.0 * np.pi
        turns = np.round((printed - values) / turn) * self.angular
        return np.asarray(values + turns * turn)

    def distance(self, values: FloatArray, printed: FloatArray) -> float:
        """Distance of two results, an angle of 1 rad counting as the characteristic length."""
        gap = self.inside(values) - self.inside(printed)
        size = np.where(self.angular, characteristic_length(self.record), 1.0)
        return float(np.linalg.norm(gap * size))


def direct_rows(record: MechanismRecord, entry: PrintedTable) -> list[Row]:
    """Rows for a table of direct solutions."""
    return _table_rows(_Border(record, "direct"), entry)


def inverse_rows(record: MechanismRecord, entry: PrintedTable) -> list[Row]:
    """Rows for a table of inverse solutions."""
    return _table_rows(_Border(record, "inverse"), entry)


def solve(record: MechanismRecord, problem: Problem, given: Sequence[Printed]) -> list[Solution]:
    """The real solutions of a printed problem."""
    values = np.array([digits.value for digits in given])
    if problem == "direct":
        return list(direct(record, at_border.inputs_from_border(record, values)))
    return list(inverse(record, at_border.pose_from_border(record, values)))


def _table_rows(view: _Border, entry: PrintedTable) -> list[Row]:
    solutions = solve(view.record, view.problem, entry.given)
    if not solutions:
        raise UsageError(f"{entry.source}: there is no real solution to compare it with")
    rows: list[Row] = []
    claimed: dict[int, str] = {}
    for line in entry.rows:
        if len(line.values) != len(view.names):
            raise UsageError(f"{entry.source} row {line.row}: {len(line.values)} values, {len(view.names)} wanted")
        of_line, nearest = _line_rows(view, entry, line, solutions)
        agreeing = sum(row.verdict == "ok" for row in of_line)
        if 2 * agreeing >= len(of_line):
            if nearest in claimed:
                again = f"the same solution as row {claimed[nearest]}"
                of_line = [_with_note(row, again, line.erratum) for row in of_line]
            claimed.setdefault(nearest, line.row)
        rows += of_line
    left_out = [solution for index, solution in enumerate(solutions) if index not in claimed]
    for number, solution in enumerate(left_out, start=1):
        rows += _missing_rows(view, entry, number, solution)
    return rows


def _line_rows(
    view: _Border, entry: PrintedTable, line: TableRow, solutions: Sequence[Solution]
) -> tuple[list[Row], int]:
    """Rows of one printed line, and the index of the nearest solution."""
    printed = np.array([digits.value for digits in line.values])
    results = [view.aligned(view.result(solution), printed) for solution in solutions]
    nearest = int(np.argmin([view.distance(result, printed) for result in results]))
    solution, computed = solutions[nearest], results[nearest]
    allowed = tolerances(view.record, view.problem, solution.pose, solution.working_mode, entry.given, line.values)
    off = printed - computed
    agrees = np.abs(off) <= allowed
    note = _note(view, entry, line, solution, agrees)
    notes = [note if np.all(agrees) or not agrees[k] else "" for k in range(len(agrees))]
    return [
        Row(
            source=f"{entry.source} row {line.row}",
            quantity=name,
            printed=digits.text,
            computed=float(computed[k]),
            verdict="ok" if agrees[k] else "wrong",
            erratum=line.erratum if notes[k] or not agrees[k] else "",
            tolerance=float(allowed[k]),
            off_by=float(off[k]),
            unit=view.units[k],
            note=notes[k],
        )
        for k, (name, digits) in enumerate(zip(view.names, line.values, strict=True))
    ], nearest


def _note(view: _Border, entry: PrintedTable, line: TableRow, solution: Solution, agrees: NDArray[np.bool_]) -> str:
    """What a reader has to know about a line: what it breaks, or what the solution that it names is."""
    if not np.all(agrees):
        rows, given = list(line.values), list(entry.given)
        pose, inputs = (rows, given) if view.problem == "direct" else (given, rows)
        reasons = broken(view.record, *_both(view.record, pose, inputs), *_halves(view.record, pose, inputs))
        what = "no solution" if 2 * np.sum(agrees) < len(agrees) else "not this solution"
        return f"{what}: {reasons or 'every length is right'}; nearest is {solution.mode}"
    notes = [] if solution.status <= Status.near_singular else [f"its status is {solution.status.name}"]
    joints = np.array(list(solution.joints.values()))
    notes += [
        condition.otherwise
        for condition in entry.requires
        if not float(quantity(view.record, condition.positive, joints)) > 0
    ]
    return "; ".join(notes)


def _both(record: MechanismRecord, pose: list[Printed], inputs: list[Printed]) -> tuple[FloatArray, FloatArray]:
    return (
        at_border.pose_from_border(record, np.array([digits.value for digits in pose])),
        at_border.inputs_from_border(record, np.array([digits.value for digits in inputs])),
    )


def _halves(record: MechanismRecord, pose: list[Printed], inputs: list[Printed]) -> tuple[FloatArray, FloatArray]:
    return (
        at_border.pose_from_border(record, half_units(pose)),
        at_border.inputs_from_border(record, half_units(inputs)),
    )


def _missing_rows(view: _Border, entry: PrintedTable, number: int, solution: Solution) -> list[Row]:
    """Rows for a real solution that no line of the table has."""
    return [
        Row(
            source=f"{entry.source} missing {number}",
            quantity=name,
            printed="",
            computed=float(value),
            verdict="missing",
            erratum=entry.erratum,
            unit=unit,
            note=f"a real solution, {solution.mode}, that the table does not list",
        )
        for name, unit, value in zip(view.names, view.units, view.result(solution), strict=True)
    ]


def _with_note(row: Row, note: str, erratum: str) -> Row:
    return replace(row, note="; ".join(filter(None, (row.note, note))), erratum=row.erratum or erratum)
