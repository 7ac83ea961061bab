"""The demonstration's end: the audit, the figures, the report and the page."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from assur.cli.auditing import rows_table, summary
from assur.cli.claims import Ledger
from assur.cli.options import Plain
from assur.cli.paths import output_folder
from assur.cli.progress import progress
from assur.mechanism import Mechanism
from assur.report.findings import Findings

ROUNDING = 1e-9
"""Largest difference of two routes to a pose, as a share of the mechanism's size."""
MOST = 1e6
"""Bytes of a page."""
BEGINNINGS = {".png": b"\x89PNG", ".pdf": b"%PDF", ".tex": b"\\begin{figure", ".json": b"{"}
"""How a sound file of each kind begins."""


def audit(ledger: Ledger, findings: Findings, shared: Plain) -> None:
    """Every printed number beside ours; every erratum is a claim of ours."""
    record = findings.record
    ledger.section(f"Audit of {record.source}")
    with progress("audit", shared):
        found = findings.audit
    differing = [row for row in found.rows if row.verdict != "ok"]
    ledger.show([rows_table(differing), "", f"{summary(found)} (the ones that agree: assur audit {record.name})", ""])
    ledger.show(["Errata of the source; a check mark says that our evidence for it, computed just now, holds"])
    for erratum in found.errata:
        ledger.claim(f"{erratum.id}, {erratum.where}", erratum.evidence.holds is True, erratum.finding)


def figures(ledger: Ledger, findings: Findings, folder: Path, shared: Plain) -> list[Path]:
    """Every figure as a picture, for print and as data."""
    from assur.figures.catalogue import write

    ledger.section("Figures")
    with progress("figures", shared) as step:
        paths = write(findings.record, output_folder(str(folder)), progress=step, context=findings)
    ledger.show([", ".join(path.name for path in paths if path.suffix == ".png")])
    kinds = {suffix: [path for path in paths if path.suffix == suffix] for suffix in BEGINNINGS}
    sound = [path for path in paths if path.read_bytes().startswith(BEGINNINGS[path.suffix])]
    ledger.claim(
        "every figure is there as a picture, for print, and as data",
        len(sound) == len(paths) and len({len(group) for group in kinds.values()}) == 1,
        ", ".join(f"{len(group)} {suffix[1:]}" for suffix, group in kinds.items()),
    )
    return paths


def report(ledger: Ledger, findings: Findings, path: Path, shared: Plain) -> list[Path]:
    """The report in one file, made of what has been found already."""
    from assur.cli.self_contained import outside_needs
    from assur.report.render import page_html
    from assur.report.report import report_page
    from assur.results.files import write_whole

    ledger.section("Report")
    with progress("report", shared) as step:
        write_whole(path, page_html(report_page(findings, step)))
    text = path.read_text(encoding="utf-8")
    needs = outside_needs(text)
    found = f"{path.name}, {len(text) / 1e6:.1f} MB, loads {', '.join(needs) or 'nothing'}"
    ledger.claim("the report is one file that needs nothing outside itself", not needs, found)
    return [path]


def page(ledger: Ledger, record: Mechanism, path: Path, shared: Plain) -> list[Path]:
    """The mechanism in one file, to be moved by hand."""
    from assur.cli.self_contained import outside_needs
    from assur.kinematics.border import inputs_of
    from assur.kinematics.home import home_values
    from assur.kinematics.pose import pose_of
    from assur.kinematics.position import direct
    from assur.page import page_html, scene
    from assur.results.files import write_whole

    ledger.section("Page")
    with progress("page", shared) as step:
        found = scene(record, progress=step)
        write_whole(path, page_html(found))
    needs, size = outside_needs(path.read_text(encoding="utf-8")), path.stat().st_size
    ledger.claim(
        "the page is one file under 1 MB that needs nothing outside itself",
        size < MOST and not needs,
        f"{path.name}, {size / 1e6:.2f} MB, loads {', '.join(needs) or 'nothing'}",
    )
    shown = np.array([pose_of(record, np.array(mode["values"])) for mode in found["branches"]["assembly"]])
    solved = direct(record, inputs_of(record, home_values(record)))
    gaps = np.linalg.norm(shown[:, None] - solved.poses[solved.exists], axis=-1)
    gap = float(gaps.min(axis=1).max()) if gaps.size else np.inf
    ledger.claim(
        "its assembly modes, set on the joint graph, are the poses of the closed form",
        len(shown) == np.count_nonzero(solved.exists) and gap < ROUNDING * found["size"],
        f"{len(shown)} modes, at most {gap:.1e} {record.unit} apart",
    )
    return [path]
