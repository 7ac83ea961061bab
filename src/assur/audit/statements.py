"""Printed statements that are no numbers: each is wrong where the evidence of its erratum holds."""

from __future__ import annotations

from collections.abc import Sequence

from assur.audit.rows import Erratum, Row
from assur.errors import UnknownNameError
from assur.model.file.schema import Entry
from assur.model.mechanism import MechanismRecord


class Statement(Entry):
    """A statement in the words of the source, and the erratum that refutes it."""

    source: str
    quantity: str
    printed: str
    erratum: str


def statement_rows(record: MechanismRecord, entry: Statement, errata: Sequence[Erratum]) -> list[Row]:
    """One row: wrong where the evidence of the statement's erratum holds, else ok; none where it was not run."""
    by_id = {erratum.id: erratum for erratum in errata}
    if entry.erratum not in by_id:
        raise UnknownNameError(f"erratum of {record.name}", entry.erratum, by_id)
    holds = by_id[entry.erratum].evidence.holds
    if holds is None:
        return []
    return [
        Row(
            source=entry.source,
            quantity=entry.quantity,
            printed=entry.printed,
            computed="does not hold" if holds else "not refuted",
            verdict="wrong" if holds else "ok",
            erratum=entry.erratum,
            note=f"by the evidence of {entry.erratum}",
        )
    ]
