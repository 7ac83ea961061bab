"""Audit: every printed number beside ours, and every erratum with the evidence that was computed for it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence

from assur.audit.rows import Audit, Erratum, Row
from assur.report.findings import Findings
from assur.report.sections.printed import computed, number, quantity, verdict
from assur.results.kinds import EXACT, Facts, Scalar, Section, Table
from assur.results.typeset_text import short

SHOWN = ("where", "quantity", "printed", "computed", "off by", "verdict", "what is behind it")


def auditing(findings: Findings) -> Section:
    """Counts, what does not agree, every row, errata."""
    audit = findings.audit
    said = (
        f"The numbers, equations and statements of {audit.source}, checked as printed. The tolerance of a row is "
        "half a unit of its last printed place, and that of every printed number which it was computed from "
        "times the local sensitivity; nothing is added to make a row pass."
        if audit.origin == "printed"
        else "The reference data of this mechanism are derived, not printed: every row is a claim of ours."
    )
    scalars = [
        Scalar("agree", float(audit.ok), f"of {len(audit.rows)} rows", EXACT, note="verdict ok"),
        Scalar("wrong", float(audit.wrong), f"of {len(audit.rows)} rows", EXACT, note="each names its erratum"),
        Scalar("missing", float(audit.missing), f"of {len(audit.rows)} rows", EXACT, note="should have been listed"),
    ]
    wrong = [row for row in audit.rows if row.verdict != "ok"]
    tables = [_table(findings, "Rows that do not agree", wrong, SHOWN)] if wrong else []
    every = _table(findings, "Every row", audit.rows, tuple(CELLS), folded=True)
    errata = [_errata(audit)] if audit.errata else []
    return Section("Audit of the source", said, [*scalars, _addresses(audit), *tables, every, *errata])


def _addresses(audit: Audit) -> Table:
    """Counts by address: a table, the equations, a paragraph."""
    counts: dict[str, Counter[str]] = {}
    for row in audit.rows:
        counts.setdefault(_address(row.source), Counter())[row.verdict] += 1
    rows = tuple(
        (where, str(verdicts.total()), *(str(verdicts[name]) for name in ("ok", "wrong", "missing")))
        for where, verdicts in counts.items()
    )
    marks = tuple(
        "wrong" if verdicts["wrong"] else "missing" if verdicts["missing"] else "" for verdicts in counts.values()
    )
    return Table("Rows by address", ("where", "rows", "ok", "wrong", "missing"), rows, marks=marks, known_by=EXACT)


def _address(source: str) -> str:
    words = source.split(" row ")[0].split(" missing ")[0].split(",")[0]
    return "Equations" if words.startswith("Eq") else words


def _table(
    findings: Findings, title: str, rows: Sequence[Row], columns: Sequence[str], *, folded: bool = False
) -> Table:
    titles = tuple(findings.given if name == "printed" else name for name in columns)
    cells = tuple(tuple(CELLS[name](row) for name in columns) for row in rows)
    caption = f"“Off by” is {findings.given} less computed."
    return Table(title, titles, cells, caption, tuple(row.verdict for row in rows), folded)


def _off(row: Row) -> str:
    return "" if row.off_by is None or row.verdict == "ok" else short(row.off_by, 4)


def _tolerance(row: Row) -> str:
    return "" if row.tolerance is None else short(row.tolerance, 2)


CELLS: dict[str, Callable[[Row], str]] = {
    "where": lambda row: row.source,
    "quantity": quantity,
    "printed": lambda row: number(row.printed),
    "computed": computed,
    "off by": _off,
    "tolerance": _tolerance,
    "verdict": verdict,
    "what is behind it": lambda row: row.note,
}


def _errata(audit: Audit) -> Section:
    entries = [_erratum(audit, erratum) for erratum in audit.errata]
    holds = sum(erratum.evidence.holds is True for erratum in audit.errata)
    said = (
        f"{len(entries)} entries; the evidence of {holds} holds. Evidence is a function that runs with every audit: "
        "the findings are ours, and who disagrees can run them."
    )
    return Section("Errata", said, entries)


def _erratum(audit: Audit, erratum: Erratum) -> Facts:
    rows = list(dict.fromkeys(row.source for row in audit.rows if row.erratum == erratum.id))
    facts = [
        ("printed", erratum.printed),
        ("finding", erratum.finding),
        ("evidence", erratum.evidence.text),
        ("it holds", erratum.evidence.word),
        ("read, not computed", erratum.not_computed),
        ("rows", ", ".join(rows)),
        ("status", erratum.status),
    ]
    return Facts(f"{erratum.id} · {erratum.where}", tuple((label, text) for label, text in facts if text))
