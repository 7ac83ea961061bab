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
            help="Of png, pdf, svg, json; default is all but svg.",
        ),
    ] = ("png", "pdf", "json"),
    shared: Drawn = DRAWN_DEFAULTS,
) -> Outcome:
    """Draw the figures of a mechanism, each also as data.

    Files are named by what a figure shows: workspace.pdf. An old file is
    replaced whole or not at all.

    For example:
        assur figures zeng2019 -o out/figures
        assur figures zeng2019 --only structure model --format svg
    """
    record = shared.mechanism(mechanism)
    from assur.cli import drawings

    return drawings.outcome(record, output, only, formats, shared)
