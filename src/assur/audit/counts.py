"""Printed numbers of solutions: how many branches a problem has, how many of them are real."""

from __future__ import annotations

from typing import Literal

from assur.audit.reference import Digits
from assur.audit.rows import Row
from assur.audit.tables import solve
from assur.kinematics.position import branch_count
from assur.model.file.schema import Entry
from assur.model.mechanism import MechanismRecord


class Count(Entry):
    """A number of solutions at a given pose or at given inputs: of all branches, of the real or the other ones."""

    source: str
    quantity: str
    problem: Literal["direct", "inverse"]
    given: tuple[Digits, ...]
    of: Literal["branches", "real", "not_real"]
    printed: Digits
    erratum: str = ""


def count_rows(record: MechanismRecord, entry: Count) -> list[Row]:
    """One row: the number of the closed form's branches, or of those that exist."""
    branches = branch_count(record, entry.problem)
    real = len(solve(record, entry.problem, entry.given))
    computed = {"branches": branches, "real": real, "not_real": branches - real}[entry.of]
    off = entry.printed.value - computed
    return [
        Row(
            source=entry.source,
            quantity=entry.quantity,
            printed=entry.printed.text,
            computed=computed,
            verdict="ok" if off == 0 else "wrong",
            erratum="" if off == 0 else entry.erratum,
            tolerance=0.0,
            off_by=off,
            note="closed form, every branch",
        )
    ]
