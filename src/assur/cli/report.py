"""`assur report`: everything about one mechanism in one file."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

from assur.cli.options import SHARED_DEFAULTS, MechanismName, Outcome, Shared

ENDINGS = (".html", ".htm")


def report(
    mechanism: MechanismName,
    /,
    *,
    output: Annotated[
        str,
        Parameter(name=("-o", "--output"), metavar="FILE", help="The file to be written; report.html if left out."),
    ] = "report.html",
    latex: Annotated[
        str | None,
        Parameter(metavar="DIR", help="Write it as a folder for LaTeX as well: report.tex, figures, tables."),
    ] = None,
    shared: Shared = SHARED_DEFAULTS,
) -> Outcome:
    """Write one self-contained HTML file about a mechanism.

    Formulas, tables beside the source's values, figures, errata, citations and
    versions, with nothing outside the file. An old file is replaced whole or
    not at all. Every volume, area and count says by what right it is known.
    With --latex the same report is a folder too: report.tex with nomenclature,
    numbered equations and bibliography, figures as PDF, tables as LaTeX and
    CSV; run pdflatex report.tex twice in it.
    With --json: all single numbers, with their bounds.

    For example:
        assur report zeng2019 -o report.html
        assur report ./my.toml --set l2=300 -o my.html
        assur report zeng2019 -o report.html --latex paper
    """
    record = shared.mechanism(mechanism)
    from assur.cli.interruption import handing_over
    from assur.cli.output import heading
    from assur.cli.paths import made, output_file, planned_folder
    from assur.cli.progress import progress, stages
    from assur.report.findings import Findings
    from assur.report.paper import write_paper
    from assur.report.render import Page, page_html
    from assur.report.report import numbers_of, report_page
    from assur.results.answers.answer import ABSENT
    from assur.results.answers.files import WrittenReport
    from assur.results.files import write_whole
    from assur.results.plain_text import count

    path = output_file(output, ENDINGS)
    folder = planned_folder(latex) if latex else None

    def stopped(page: Page) -> Outcome:
        answer = WrittenReport(record.name, None, numbers_of(page))
        titles = ", ".join(section.title for section in page.sections) or "none"
        return Outcome(answer, lambda: [heading(f"{record.name}, report: not written"), f"sections done: {titles}"])

    findings = Findings(record)
    with handing_over(Page, stopped), progress("report", shared) as step:
        page = report_page(findings, stages(step))
        write_whole(path, page_html(page))
        files = write_paper(findings, page, made(folder)) if folder else []
    size = path.stat().st_size
    answer = WrittenReport(record.name, str(path), numbers_of(page), size, tuple(map(str, files)) if folder else ABSENT)
    lines = [f"written: {path} ({size / 1e6:.1f} MB)"]
    lines += [f"written: {count(len(files), 'file')} in {folder}; pdflatex report.tex sets them"] if folder else []
    return Outcome(answer, lambda: [heading(f"{record.name}, report"), *lines])
