"""The audit as data and as a person reads it, and the two documents made of it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

from rich.console import RenderableType
from rich.text import Text

from assur.audit.audit import audit
from assur.audit.documents import computed_text, documents
from assur.audit.rows import Audit, Row
from assur.cli.numbers import NUMBER
from assur.cli.options import Outcome, Shared
from assur.cli.output import heading, table, words
from assur.cli.paths import made
from assur.cli.progress import progress
from assur.mechanism import Mechanism
from assur.results.files import write_whole

CLAIM_FAILS = 1
EQUATION = "left - right"
COLOURS = {"ok": "", "wrong": "red", "missing": "yellow"}


def outcome(record: Mechanism, folder: Path | None, shared: Shared) -> Outcome:
    """The audit; exit code 1 where the evidence of an erratum does not hold."""
    with progress("audit", shared):
        found = audit(record)
    written: list[Path] = []
    if folder is not None:
        made(folder)
        written = [write_whole(folder / name, text) for name, text in documents(found).items()]
    return Outcome(found, lambda: _shown(found, written), 0 if found.claims_hold else CLAIM_FAILS)


def _shown(audit: Audit, written: Sequence[Path]) -> Iterable[RenderableType]:
    yield heading(f"{audit.mechanism}, audit of {audit.source}")
    yield rows_table(audit.rows)
    yield ""
    yield summary(audit)
    yield ""
    if audit.errata:
        yield heading("errata, each by evidence that was computed just now")
        yield table(
            ("id", "holds", "finding"),
            [
                (item.id, item.evidence.word, f"{item.where}: {item.finding}\n{item.evidence.text}")
                for item in audit.errata
            ],
            left=("id", "holds", "finding"),
            styles=["red" if item.evidence.holds is False else "" for item in audit.errata],
        )
    if not audit.claims_hold:
        yield "A claim of ours does not hold."
    for path in written:
        yield f"written: {path}"


def rows_table(rows: Sequence[Row]) -> RenderableType:
    """Printed values beside ours, with verdicts."""
    return table(
        ("where", "printed", "computed", "verdict"),
        [
            (_where(row), _cell(row.printed), _cell(computed_text(row)), f"{row.verdict} {row.erratum}".strip())
            for row in rows
        ],
        wrap=("where", "printed", "computed"),
        left=("where", "verdict"),
        styles=[COLOURS[row.verdict] for row in rows],
    )


def _where(row: Row) -> str:
    return row.source if row.quantity == EQUATION else f"{row.source}: {row.quantity}"


def _cell(text: str) -> str | Text:
    """Numbers are set right, words and formulas left."""
    return text if NUMBER.fullmatch(text) else words(text)


def summary(audit: Audit) -> str:
    """How many rows are what."""
    return f"{len(audit.rows)} rows: {audit.ok} ok, {audit.wrong} wrong, {audit.missing} missing"
