"""`assur figures`: the figures of a mechanism, as pictures and as data."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

from assur.cli.options import DRAWN_DEFAULTS, Drawn, MechanismName, Outcome


def figures(
    mechanism: MechanismName,
    /,
    *,
    output: Annotated[
        str,
        Parameter(name=("-o", "--output"), metavar="DIR", help="The folder, made if missing; ./figures if left out."),
    ] = "figures",
    only: Annotated[
        tuple[str, ...],
        Parameter(consume_multiple=1, metavar="NAME", help="Only these figures, as --only structure model."),
    ] = (),
    formats: Annotated[
        tuple[str, ...],
        Parameter(
            name="--format",
            consume_multiple=1,
            metavar="FORMAT",
            help="Of png, pdf, svg, tex, json; default is all but svg.",
        ),
    ] = ("png", "pdf", "tex", "json"),
    width: Annotated[
        str,
        Parameter(
            metavar="WIDTH",
            help="Of a page: ieee (88.9 mm), ieee2 (182), elsevier (90), elsevier1.5 (140), elsevier2 (190), or mm.",
        ),
    ] = "",
    shared: Drawn = DRAWN_DEFAULTS,
) -> Outcome:
    r"""Draw the figures of a mechanism, each also as data.

    Files are named by what a figure shows: workspace.pdf. Beside each stands
    LaTeX that puts it into a paper, workspace.tex: \input{workspace}. An old
    file is replaced whole or not at all.

    With --width, figures fit a column or a page of a journal, drawn for it:
    letters stay 7 to 9 points, and panels stand below one another where it is
    narrow. Fonts are embedded.

    For example:
        assur figures zeng2019 -o out/figures
        assur figures zeng2019 --only structure model --format svg
        assur figures zeng2019 --width ieee --format pdf tex
    """
    record = shared.mechanism(mechanism)
    from assur.cli import drawings

    return drawings.outcome(record, output, only, formats, width, shared)
