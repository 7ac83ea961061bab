"""The report of a mechanism: its sections in the order of a paper, as one self-contained HTML file."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from pathlib import Path

import assur
from assur.errors import Interrupted, MechanismFileError
from assur.joint_graph.tree import joint_graph
from assur.kinematics.contract.admission import check_closed_form
from assur.kinematics.contract.extent import IN_FULL
from assur.kinematics.home import without_loops
from assur.model.mechanism import MechanismRecord
from assur.report.findings import Findings
from assur.report.numbering import Numbering
from assur.report.render import Page, page_html
from assur.report.sections.accuracy import accuracy
from assur.report.sections.aspects import aspects
from assur.report.sections.auditing import auditing
from assur.report.sections.basis import basis
from assur.report.sections.description import description
from assur.report.sections.forces import forces
from assur.report.sections.performance import performance
from assur.report.sections.position import position
from assur.report.sections.provenance import provenance
from assur.report.sections.reach import reach
from assur.report.sections.singularities import singularities
from assur.report.sections.stiffness import stiffness
from assur.report.sections.summary import summary
from assur.report.sections.topology import topology
from assur.report.sections.velocity import velocity
from assur.results.answers.files import ReportNumber
from assur.results.attempt import REFUSED, reason
from assur.results.files import file_to_write, write_whole
from assur.results.kinds import Facts, Result, Scalar, Section
from assur.work import Progress, stage, ticker

KNOWN = "How the numbers are known"
SECTIONS: tuple[tuple[str, Callable[[Findings], Section]], ...] = (
    ("In brief", summary),
    ("The mechanism", description),
    ("Structure and topology", topology),
    ("Position", position),
    ("Velocity", velocity),
    ("Singularities", singularities),
    ("Workspace", reach),
    ("Aspects", aspects),
    ("Dexterity", performance),
    ("Forces", forces),
    ("Stiffness", stiffness),
    ("Accuracy", accuracy),
    ("Audit of the source", auditing),
    (KNOWN, basis),
    ("Sources and versions", provenance),
)
"""In the order of a paper; adding one is one line."""


ANALYSES = ("audit", "workspace", "examples", "proved", "bounds", "cube", "nowhere")
"""What takes long, and is made before the sections that share it."""


def report_html(
    record: MechanismRecord,
    *,
    progress: Progress | None = None,
    figures: bool = True,
    resolution: int | None = None,
) -> str:
    """The report as one HTML page without any outside resource, the same bytes for the same mechanism.

    Args:
        record: the mechanism; one without closed form or reference data is told so where they are missing.
        progress: called with (steps done, steps in all).
        figures: whether figures are drawn into it.
        resolution: cells of the workspace along each coordinate; by default 64, fewer without closed form.

    Example:
        >>> from assur.model.registry import load_record
        >>> text = report_html(load_record("fivebar"), figures=False, resolution=16)
        >>> text.startswith("<!DOCTYPE html>"), "http://" in text
        (True, False)
    """
    return page_html(report_page(Findings(record, resolution=resolution, illustrated=figures), progress))


def report_page(findings: Findings, progress: Progress | None = None) -> Page:
    """The report as sections of results, before it is rendered; one that is refused is told of among the basis.

    Ctrl-C ends it with `Interrupted`, whose answer is the page of the sections that are done.
    """
    if not joint_graph(findings.record).cut:
        raise MechanismFileError([without_loops(findings.record)])
    check_closed_form(findings.record, IN_FULL)
    sections: dict[str, Section] = {}
    refused: dict[str, str] = {}
    try:
        _make(findings, sections, refused, ticker(len(ANALYSES) + len(SECTIONS), progress))
    except KeyboardInterrupt:
        raise Interrupted(_page(findings, sections.values())) from None
    if refused:
        missing = Facts("Sections that this report does not have", tuple(refused.items()))
        sections[KNOWN] = replace(sections[KNOWN], results=(*sections[KNOWN].results, missing))
    return _page(findings, sections.values())


def _make(findings: Findings, sections: dict[str, Section], refused: dict[str, str], tick: Callable[[], None]) -> None:
    """Make the sections one by one, or note why there is none."""
    for analysis in ANALYSES:
        with stage(analysis), contextlib.suppress(*REFUSED):  # the sections that need it say why
            getattr(findings, analysis)
        tick()
    for title, make in SECTIONS:
        try:
            with stage(title):
                made = make(findings)
        except REFUSED as error:
            refused[title] = reason(error)
        else:
            tick()  # may end it before what is half known is kept
            sections[title] = made
            continue
        tick()


def _page(findings: Findings, sections: Iterable[Section]) -> Page:
    record = findings.record
    numbered = Numbering().numbered(sections)
    return Page(record.title, f"assur {assur.__version__} · {record.name}", record.source, numbered)


def write_report(
    record: MechanismRecord, path: str | Path, progress: Progress | None = None, *, figures: bool = True
) -> Page:
    """Write the report; the file is there whole or, with an `OutputError`, what was there before still is."""
    target = file_to_write(path)
    page = report_page(Findings(record, illustrated=figures), progress)
    write_whole(target, page_html(page))
    return page


def numbers_of(page: Page) -> tuple[ReportNumber, ...]:
    """Every single number of a report: where it stands, its bounds, and by what right it is known.

    >>> from assur.results.kinds import Scalar
    >>> page = Page("", "", "", (Section("S", results=[Scalar("links", 4.0, "", "exact: counted")]),))
    >>> [(item.section, item.name, item.known_by) for item in numbers_of(page)]
    [('S', 'links', 'exact: counted')]
    """
    return tuple(
        ReportNumber(**vars(result), section=title)
        for title, results in _sections(page.sections)
        for result in results
        if isinstance(result, Scalar)
    )


def _sections(sections: Iterable[Section]) -> Iterator[tuple[str, list[Result]]]:
    """(title, results) of every section, those inside others too."""
    for section in sections:
        yield section.title, [result for result in section.results if not isinstance(result, Section)]
        yield from _sections(result for result in section.results if isinstance(result, Section))
