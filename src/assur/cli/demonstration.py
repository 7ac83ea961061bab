"""The demonstration: its parts in order, and what comes out of it."""

from __future__ import annotations

import time
from collections.abc import Iterable
from pathlib import Path

from rich.console import RenderableType

from assur.cli import demo_position
from assur.cli.called import called
from assur.cli.claims import Ledger
from assur.cli.options import Outcome, Plain
from assur.cli.output import heading
from assur.mechanism import Mechanism, load
from assur.results.answers.installation import DemonstrationAnswer
from assur.results.plain_text import count

MECHANISM = "zeng2019"
BEGIN_WITH = "fivebar"
"""A small mechanism, good to begin one's own with."""
CLAIM_FAILS = 1


def outcome(folder: Path, shared: Plain) -> Outcome:
    """Run every part; exit code 1 where a claim fails. Where one of solutions does, what stands on them is left out."""
    begin = time.monotonic()
    record = load(MECHANISM)
    ledger = Ledger(silent=shared.json)
    ledger.show([heading(f"{record.name}: {record.title}"), record.source])
    demo_position.topology(ledger, record)
    demo_position.direct(ledger, record)
    demo_position.inverse(ledger, record)
    files = [] if ledger.failed else _analysed(ledger, record, folder, shared)
    seconds = time.monotonic() - begin
    written = tuple(str(path) for path in files)
    answer = DemonstrationAnswer(record.name, tuple(ledger.claims), ledger.failed, written, round(seconds, 1))
    return Outcome(answer, lambda: _shown(ledger, folder, files, seconds), CLAIM_FAILS if ledger.failed else 0)


def _analysed(ledger: Ledger, record: Mechanism, folder: Path, shared: Plain) -> list[Path]:
    """Everything that stands on the solutions of the position problems; the files that were written."""
    from assur.cli import demo_analysis, demo_documents
    from assur.report.findings import Findings

    demo_analysis.velocity(ledger, record)
    findings = Findings(record)
    demo_analysis.singularities(ledger, findings, shared)
    demo_analysis.workspace(ledger, findings, shared)
    demo_documents.audit(ledger, findings, shared)
    files = demo_documents.figures(ledger, findings, folder / "figures", shared)
    files += demo_documents.report(ledger, findings, folder / "report.html", shared)
    return [*files, *demo_documents.page(ledger, record, folder / "page.html", shared)]


def _shown(ledger: Ledger, folder: Path, files: list[Path], seconds: float) -> Iterable[RenderableType]:
    total = count(len(ledger.claims), "claim")
    yield ""
    yield heading(f"{total} checked, {'all hold' if not ledger.failed else f'{ledger.failed} FAIL'}; {seconds:.0f} s")
    if files:
        yield f"{count(len(files), 'file')} in {folder}; open these two in a browser:"
        yield f"  {folder / 'report.html'}: all of the above, with its figures"
        yield f"  {folder / 'page.html'}: the mechanism, to be moved by hand"
    else:
        yield "no files: what stands on the solutions was left out"
    for claim in ledger.claims:
        if not claim.holds:
            yield f"fails: {claim.section}: {claim.claim}: {claim.outcome}"
    yield ""
    yield "Next, a mechanism of your own:"
    yield f"  {called()} new my.toml --from {BEGIN_WITH}"
