"""Printed values beside ours: rows of an audit as cells of tables."""

from __future__ import annotations

import re
from collections.abc import Sequence

from assur.audit.documents import computed_text
from assur.audit.rows import Row
from assur.audit.tables import PrintedTable as Printed
from assur.report.findings import Findings
from assur.report.formulas.symbols import GREEK
from assur.results.kinds import Table
from assur.results.typeset_text import minus

ORDER = ("ok", "missing", "wrong")


def computed(row: Row) -> str:
    """Ours, to the printed digits."""
    text = computed_text(row)
    return text if isinstance(row.computed, str) else minus(text)


def verdict(row: Row) -> str:
    """The verdict in words, with the erratum that explains it."""
    return f"{row.verdict}, see {row.erratum}" if row.erratum else row.verdict


def quantity(row: Row) -> str:
    """What the row is a value of, Greek letters as letters.

    >>> quantity(Row("Eq. (4)", "xi, LOOP1", "3", 3, "ok"))
    'ξ, LOOP1'
    """
    return re.sub(r"[A-Za-z]+", lambda word: GREEK.get(word[0], word[0]), row.quantity)


def number(text: str) -> str:
    """Printed digits as they stand, with a true minus."""
    return minus(text) if text[:1] in "-0123456789" else text


def solutions_beside(findings: Findings, entry: Printed, rows: Sequence[Row]) -> Table:
    """One line for each line of a printed table of solutions, and for each solution that it leaves out."""
    lines: dict[str, list[Row]] = {}
    for row in rows:
        if row.source.startswith((f"{entry.source} row ", f"{entry.source} missing ")):
            lines.setdefault(row.source.removeprefix(entry.source).strip(), []).append(row)
    names = [row.quantity for row in next(iter(lines.values()))]
    columns = [
        "line",
        *(f"{name} {what}" for name in names for what in (findings.given, "computed")),
        "verdict",
        "why",
    ]
    cells, marks = [], []
    for line, parts in lines.items():
        values = [text for row in parts for text in (number(row.printed) or None, computed(row))]
        worst = max((row.verdict for row in parts), key=ORDER.index)
        wrong = [row.quantity for row in parts if row.verdict == "wrong"]
        which = f" in {', '.join(wrong)}" if 0 < len(wrong) < len(parts) else ""
        errata = " ".join(dict.fromkeys(row.erratum for row in parts if row.erratum))
        cells.append((line, *values, f"{worst}{which}{f', see {errata}' if errata else ''}", parts[0].note))
        marks.append(worst)
    caption = (
        f"The {findings.given} digits of {entry.source} beside the solution that is nearest; agreement is judged by "
        "the digits of the result and of what it was computed from. A line that is missing is a real solution that is "
        "not listed."
    )
    return Table(f"{entry.source}, {findings.given} and computed", tuple(columns), tuple(cells), caption, tuple(marks))
