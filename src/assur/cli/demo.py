"""`assur demo`: the main job on the mechanism of the paper, every claim checked while it is printed."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

from assur.cli.options import PLAIN, Outcome, Plain


def demo(
    *,
    output: Annotated[
        str, Parameter(name=("-o", "--output"), metavar="DIR", help="Where files are written; ./out if left out.")
    ] = "out",
    shared: Plain = PLAIN,
) -> Outcome:
    """The mechanism of the paper from topology to report, checked.

    Topology, direct and inverse solutions, Jacobians, singularities, workspace,
    audit of the printed numbers, figures and the report. Each claim that is
    printed is checked by a second route while it is printed. Exit code 1: a
    claim fails.

    For example:
        assur demo
        assur demo -o ./out --json
    """
    from assur.cli import demonstration
    from assur.cli.paths import output_folder

    return demonstration.outcome(output_folder(output), shared)
