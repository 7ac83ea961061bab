"""`audit`: every printed number of a mechanism's source beside ours, and the evidence of every erratum."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from assur.audit.counts import Count, count_rows
from assur.audit.decoupling import Dependence, dependence_rows
from assur.audit.equations import PrintedEquation, equation_rows
from assur.audit.errata import errata
from assur.audit.reach import PrintedRange, range_rows
from assur.audit.reference import Reference, read_reference
from assur.audit.rows import Audit, Erratum, Row
from assur.audit.statements import Statement, statement_rows
from assur.audit.tables import PrintedTable, direct_rows, inverse_rows
from assur.audit.topology import PrintedDecomposition, PrintedPocSet, decomposition_rows, poc_rows
from assur.errors import UnknownNameError
from assur.kinematics.status import closed_form_of
from assur.model.file.schema import Entry
from assur.model.mechanism import MechanismRecord
from assur.work import stage


@dataclass(frozen=True)
class Kind:
    """A kind of reference entry: its form in the file, and what makes rows of it.

    `make` takes the record and the entry, and the source's letters too where `with_letters`. What is `sampled` is tried
    at poses by chance, for which a closed form is needed.
    """

    form: type[Entry]
    make: Callable[..., list[Row]]
    with_letters: bool = False
    sampled: bool = False

    def rows(self, record: MechanismRecord, reference: Reference, entry: Entry) -> list[Row]:
        """The rows of one entry."""
        return self.make(record, entry, *([reference.definitions] if self.with_letters else []))


KINDS: Mapping[str, Kind] = {
    "poc": Kind(PrintedPocSet, poc_rows),
    "decomposition": Kind(PrintedDecomposition, decomposition_rows),
    "equation": Kind(PrintedEquation, equation_rows, with_letters=True, sampled=True),
    "dependence": Kind(Dependence, dependence_rows),
    "direct": Kind(PrintedTable, direct_rows),
    "inverse": Kind(PrintedTable, inverse_rows),
    "count": Kind(Count, count_rows),
    "range": Kind(PrintedRange, range_rows, sampled=True),
}
"""Array of tables in a reference file -> what it is. Rows come in this order; statements come last."""

FORMS: Mapping[str, type[Entry]] = {**{name: kind.form for name, kind in KINDS.items()}, "statement": Statement}


def audit(record: MechanismRecord) -> Audit:
    """Check every number that the reference data of a mechanism say is printed, and every erratum's evidence.

    That a printed number is wrong is a result; that evidence does not hold is a failure of ours (`claims_hold`).

    Errors:
        UsageError: there are no reference data, the mechanism has other dimensions than they were printed for, or no
            closed form where one is needed.
        MechanismFileError: a reference file has faults.

    Example:
        >>> from assur.model.registry import load_record
        >>> found = audit(load_record("zeng2019"))
        >>> next((row.printed, round(row.computed, 4), row.verdict, row.erratum) for row in found.rows
        ...      if (row.source, row.quantity) == ("Table 1 row 4", "x"))
        ('-128.8290', -83.0873, 'wrong', 'E3')
    """
    reference = reference_of(record)
    if any(kind.sampled and reference.entries[name] for name, kind in KINDS.items()):
        closed_form_of(record)  # refused before the work, not after it
    with stage("evidence of errata"):
        checked = errata(record)
    rows = rows_of(record, tuple(KINDS))
    for entry in reference.entries["statement"]:
        rows += statement_rows(record, entry, checked)
    _check_ids(rows, checked, record)
    return Audit(record.name, record.source, reference.about.origin, tuple(rows), checked)


def rows_of(record: MechanismRecord, kinds: Sequence[str]) -> list[Row]:
    """The rows of some kinds of reference entry only (names of `KINDS`), without errata and statements."""
    reference = reference_of(record)
    rows: list[Row] = []
    for name in kinds:
        with stage(f"printed values of kind {name}") as work:
            rows += [row for entry in reference.entries[name] for row in KINDS[name].rows(record, reference, entry)]
            work.result = f"{len(rows)} rows so far"
    return rows


@lru_cache(maxsize=8)
def reference_of(record: MechanismRecord) -> Reference:
    """The reference data of a mechanism, of all kinds that an audit knows."""
    return read_reference(record, FORMS)


def reference_entry(record: MechanismRecord, kind: str, source: str) -> Any:
    """The entry of a kind with an address, as the reference data have it: for evidence that needs printed digits."""
    entries = {getattr(entry, "source", ""): entry for entry in reference_of(record).entries[kind]}
    if source not in entries:
        raise UnknownNameError(f"{kind} of the reference data of {record.name}", source, entries)
    return entries[source]


def _check_ids(rows: list[Row], checked: tuple[Erratum, ...], record: MechanismRecord) -> None:
    ids = [erratum.id for erratum in checked]
    for row in rows:
        if row.erratum and row.erratum not in ids:
            raise UnknownNameError(f"erratum of {record.name}", row.erratum, ids)
