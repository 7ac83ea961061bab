"""Printed statements that are no numbers: each is wrong where the evidence of its erratum holds."""

from __future__ import annotations

from collections.abc import Sequence
from typing import cast

from assur.audit.rows import Erratum, Row
from assur.errors import UnknownNameError
from assur.model.schema import Entry


class Statement(Entry):
    """A statement in the words of the source, and the erratum that refutes it."""

    source: str
    quantity: str
    printed: str
    erratum: str


def statement_rows(entries: Sequence[Entry], errata: Sequence[Erratum]) -> list[Row]:
    """One row for each statement: wrong where the evidence of its erratum holds, else ok."""
    by_id = {erratum.id: erratum for erratum in errata}
    rows = []
    for entry in cast("Sequence[Statement]", entries):
        if entry.erratum not in by_id:
            raise UnknownNameError("erratum", entry.erratum, by_id)
        evidence = by_id[entry.erratum].evidence
        rows.append(
            Row(
                source=entry.source,
                quantity=entry.quantity,
                printed=entry.printed,
                computed=evidence.text,
                verdict="wrong" if evidence.holds else "ok",
                erratum=entry.erratum,
                note=f"by the evidence of {entry.erratum}",
            )
        )
    return rows
