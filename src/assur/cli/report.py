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
    shared: Shared = SHARED_DEFAULTS,
) -> Outcome:
    """Write one self-contained HTML file about a mechanism.

    Formulas, tables beside the source's values, figures, errata, citations and
    versions, with nothing outside the file. An old file is replaced whole or
    not at all. Every volume, area and count says by what right it is known.
    With --json: all single numbers, with their bounds.

    For example:
        assur report zeng2019 -o report.html
        assur report ./my.toml --set l2=300 -o my.html
    """
    record = shared.mechanism(mechanism)
    from assur.cli.interruption import handing_over
    from assur.cli.output import heading
    from assur.cli.paths import output_file
    from assur.cli.progress import progress, stages
    from assur.report.render import Page
    from assur.report.report import numbers_of, write_report
    from assur.results.answers.files import WrittenReport

    path = output_file(output, ENDINGS)

    def stopped(page: Page) -> Outcome:
        answer = WrittenReport(record.name, None, numbers_of(page))
        titles = ", ".join(section.title for section in page.sections) or "none"
        return Outcome(answer, lambda: [heading(f"{record.name}, report: not written"), f"sections done: {titles}"])

    with handing_over(Page, stopped), progress("report", shared) as step:
        page = write_report(record, path, stages(step))
    size = path.stat().st_size
    answer = WrittenReport(record.name, str(path), numbers_of(page), size)
    return Outcome(answer, lambda: [heading(f"{record.name}, report"), f"written: {path} ({size / 1e6:.1f} MB)"])
